// floatframe fmu: a model as an FMU, which other programs step.
#include <fmt/format.h>

#include <filesystem>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/packing.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fmu/fmu_file.hpp"
#include "floatframe/model_file/pack_model.hpp"

namespace floatframe {
namespace {

struct FmuArguments {
  ModelArguments model;
  std::string out, kind = "cs", version = "2", outputs;
  bool overwrite = false, quiet = false;
};

/// `fixed`: a sentence about each parameter that cannot change.
PackedModel model_of(const FmuArguments& a, std::vector<std::string>& fixed) {
  if (is_packed_file(a.model.path)) {
    if (!a.outputs.empty() || !a.model.settings.empty())
      throw InputError(ErrorCode::exclusive,
                       fmt::format("{}: found {} with a packed model, expected the model file that "
                                   "it was packed from",
                                   a.model.path, a.outputs.empty() ? "--set" : "--outputs"));
    return read_packed_model(a.model.path);
  }
  return packed_of(a.model, a.outputs, PackOptions::Contents::steps, fixed);
}

int write(const FmuArguments& a) {
  const std::string out =
      a.out.empty() ? std::filesystem::path(a.model.path).stem().string() + ".fmu" : a.out;
  require_writable({{"-o", out}}, {a.model.path}, a.overwrite);
  std::vector<std::string> fixed;
  const PackedModel model = model_of(a, fixed);
  const FmuReport report = write_fmu(out, model, {a.version == "3" ? 3 : 2, fixed});
  if (a.quiet) return exit_code::done;
  std::string platforms;
  for (const std::string& p : report.platforms) platforms += (platforms.empty() ? "" : ", ") + p;
  print(
      fmt::format("{}: FMI {}.0 for co-simulation, {:.2f} MB with a model of {:.2f} MB\n"
                  "  inputs      {}\n  outputs     {}\n  parameters  {}\n  platforms   {}\n",
                  out, a.version, 1e-6 * static_cast<double>(report.bytes),
                  1e-6 * static_cast<double>(report.model_bytes), report.inputs, report.outputs,
                  report.parameters, platforms));
  for (const std::string& note : report.notes) say("note: " + note);
  for (const std::string& sentence : fixed) say("note: " + sentence);
  return exit_code::done;
}

}  // namespace

Command fmu_command() {
  const auto a = std::make_shared<FmuArguments>();
  return {.name = "fmu",
          .help = "Write a model as an FMU for co-simulation, for Simulink, dSPACE, FMPy, ...",
          .options = joined(
              model_options(a->model),
              {text_option("-o,--out", a->out, "FILE",
                           "FMU to write; default: MODEL.fmu in this folder"),
               word_option("--fmi", a->version, {"2", "3"}, "Version of the standard; default 2"),
               word_option("--kind", a->kind, {"cs"}, "Kind of FMU: cs, co-simulation"),
               text_option("--outputs", a->outputs, "LIST",
                           "Outputs to show, names with commas between them, 'chassis' for all of "
                           "chassis.x, chassis.y, ...; default: all"),
               overwrite_option(a->overwrite), flag("--quiet", a->quiet, "No summary, no notes")}),
          .footer =
              "The runtime for Linux and, if this program was built with it, Windows is inside: no "
              "compiler\nis needed, here or there. Parameters that take a new value without a "
              "build of the model are\nparameters of the FMU; notes say why others are not. "
              "docs/fmu.md explains all.\n"
              "Example: floatframe fmu examples/iltis/iltis.yaml -o vehicle.fmu --fmi 3\n"
              "Exit codes: 0 done, 1 the disk is full, 2 bad input; files are written atomically.",
          .run = [a] { return write(*a); }};
}

}  // namespace floatframe
