// floatframe export: the motion of a run as files of other programs.
#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/apps/recorded_run.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/export/export_file.hpp"
#include "floatframe/history/recorded_motion.hpp"
#include "floatframe/loops/run_error.hpp"

namespace floatframe {
namespace {

struct ExportArguments {
  RecordedRunArguments run;
  std::string vtk, glb, npz, csv;
  bool stress = false, overwrite = false;
  SelectionArguments selection;
};

/// Refuses to replace files of a series that another program has written.
void require_own_series(const std::string& folder) {
  std::error_code ignored;
  for (std::filesystem::directory_iterator it(folder, ignored), end; !ignored && it != end;
       it.increment(ignored)) {
    const std::string name = it->path().filename().string();
    if (is_file_of_series(name)) require_own({"--vtk", it->path().string()});
  }
}

int export_motion(const ExportArguments& arguments) {
  if (arguments.vtk.empty() && arguments.glb.empty() && arguments.npz.empty() &&
      arguments.csv.empty())
    throw InputError(ErrorCode::missing,
                     "found no file to write, expected --vtk, --glb, --npz or --csv");
  if (arguments.stress && arguments.npz.empty())
    throw InputError(ErrorCode::incomplete,
                     "found --stress without --npz, expected the file that is to hold it");
  const ExportSelection selection = arguments.selection.selection();
  const RecordedRun run = load_recorded_run(arguments.run);
  require_writable({{"--glb", arguments.glb}, {"--npz", arguments.npz}, {"--csv", arguments.csv}},
                   run.inputs, arguments.overwrite);
  if (!arguments.vtk.empty()) {
    require_folder(arguments.vtk);
    if (!arguments.overwrite) require_own_series(arguments.vtk);
  }
  const Model model = build_model(run.description);
  const std::vector<std::size_t> instants = selected_instants(run.history, selection);
  const ExportBodies bodies{&model, selected_bodies(run.history, model, selection),
                            instants.size()};
  try {
    RecordedMotion motion(run.history, model, recorded_options(run));
    std::vector<std::unique_ptr<ExportFile>> files;
    if (!arguments.vtk.empty()) files.push_back(vtk_series(bodies, arguments.vtk));
    if (!arguments.glb.empty()) files.push_back(glb_scene(bodies, arguments.glb));
    if (!arguments.npz.empty())
      files.push_back(numpy_archive(bodies, arguments.npz, arguments.stress));
    if (!arguments.csv.empty()) files.push_back(motion_table(bodies, arguments.csv));
    ProgressBar bar(true, static_cast<double>(instants.size()), "instants");
    for (std::size_t i = 0; i < instants.size(); ++i) {
      const SystemMotion& view = motion.at(instants[i]);
      for (const auto& file : files) file->add(view);
      bar.show(static_cast<double>(i + 1) / static_cast<double>(instants.size()));
    }
    bar.clear();
    for (const auto& file : files) {
      say_line(file->finish());  // the file may be standard output
    }
  } catch (const RunError& error) {
    say(std::string("the model cannot be started: ") + error.what());
    return exit_code::failed;
  }
  return exit_code::done;
}

}  // namespace

Command export_command() {
  const auto a = std::make_shared<ExportArguments>();
  return {
      .name = "export",
      .help = "The motion of a run as files for ParaView, Blender, NumPy and spreadsheets",
      .options = joined(
          joined(
              {recorded_result_position(a->run),
               text_option(
                   "--vtk", a->vtk, "DIR",
                   "Folder for a series of .vtu files and motion.pvd, which ParaView opens"),
               text_option("--glb", a->glb, "FILE",
                           "glTF 2.0 with animation, for Blender and viewers (.glb)"),
               text_option("--npz", a->npz, "FILE", "Arrays of NumPy (.npz)"),
               flag("--stress", a->stress,
                    "In the .npz file also the stress of bodies with stress data, at all places"),
               text_option("--csv", a->csv, "FILE",
                           "One table: a row for each instant, body and named node")},
              a->selection.table()),
          {recorded_model_option(a->run), overwrite_option(a->overwrite)}),
      .footer =
          "The model file and all files that it names must be unchanged since the run.\n"
          "Exit codes: 0 done, 1 the model cannot be started or a file not be written, 2 bad "
          "input.",
      .run = [a] { return export_motion(*a); }};
}

}  // namespace floatframe
