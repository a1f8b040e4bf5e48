// floatframe reduce: from a finite-element file to a body file, with a report on its health.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "floatframe/apps/command.hpp"
#include "floatframe/apps/part_arguments.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/formats/fe_info.hpp"
#include "floatframe/formats/health_text.hpp"
#include "floatframe/formats/sid_file.hpp"

namespace floatframe {
namespace {

struct ReduceArguments {
  PartJob job;
  std::string part, units, method = "craig_bampton", reference = "mean_axis", integration = "exact",
                           solver = "auto", material, out, report, sid, modes;
  std::string fmax, effective_mass, damping, nodes, mass, dofs, dialect;
  std::vector<std::string> interfaces, markers;
  bool no_free_check = false, no_stress = false, quiet = false;
};

/// Nothing in most files says which units they are in; the material may give a hint.
[[noreturn]] void units_are_missing(const PartJob& job) {
  std::vector<std::string> likely;
  try {
    likely = likely_units(read_fe_file(job.file, job.read, job.format));
  } catch (const InputError&) {  // its errors are reported when the units are known
  }
  throw InputError(fmt::format(
      "--units is missing: nothing in the file says its units; known are {}, or any "
      "<length>-<mass>-<time>{}",
      fmt::join(unit_system_names(), ", "),
      likely.empty() ? ""
                     : fmt::format(" (the material looks like {})", fmt::join(likely, " or "))));
}

PartJob job_of(const ReduceArguments& a) {
  PartJob job = a.job;
  job.file = a.part;
  job.units = a.units;
  job.read.nodes = a.nodes;
  job.read.mass = a.mass;
  job.read.dofs = a.dofs;
  job.read.dialect = deck_dialect(a.dialect).value_or(DeckDialect::by_content);
  if (!a.material.empty()) job.read.material = material_argument(a.material);
  if (job.units.empty()) units_are_missing(job);
  unit_system(job.units);
  PartOptions& o = job.options;
  for (const std::string& text : a.interfaces) o.interfaces.push_back(interface_argument(text));
  for (const std::string& text : a.markers) o.markers.push_back(marker_argument(text));
  if (!a.modes.empty())
    o.modes = whole_option_number("--modes", a.modes, {"a number of modes", 0, 10000});
  if (!a.fmax.empty()) o.max_frequency = option_number("--fmax", a.fmax, positive_number("Hz"));
  if (!a.effective_mass.empty())
    o.effective_mass = option_number("--effective-mass", a.effective_mass,
                                     {"a fraction above 0 and up to 1", "", 0.0, 1.0, true});
  if (!a.damping.empty())
    o.damping_ratio = option_number("--damping", a.damping,
                                    {"a fraction of critical damping from 0 to 1", "", 0.0, 1.0});
  if (a.modes.empty() && a.fmax.empty() && a.effective_mass.empty()) o.modes = default_modes;
  for (const ModeMethod m :
       {ModeMethod::craig_bampton, ModeMethod::free_free, ModeMethod::craig_chang})
    if (a.method == word(m)) o.method = m;
  o.reference = reference_argument(a.reference);
  o.integration = a.integration == "ccx" ? Integration::ccx : Integration::exact;
  o.solver = a.solver == "mumps"   ? SparseSolver::mumps
             : a.solver == "eigen" ? SparseSolver::eigen
                                   : SparseSolver::automatic;
  o.check_free_modes = !a.no_free_check;
  o.stresses = !a.no_stress;
  if (!a.quiet)
    o.progress = [](const std::string& stage, double seconds) {
      say_line(fmt::format("{:>8.2f} s  {}", seconds, stage));
    };
  return job;
}

int reduce_file(const ReduceArguments& a) {
  std::filesystem::path name = std::filesystem::path(a.part).filename();
  if (name.extension() == ".gz") name = name.stem();
  const std::string out = a.out.empty() ? name.stem().string() + ".ffb" : a.out;
  const PartJob job = job_of(a);
  const std::vector<OutputFile> outputs{{"-o", out}, {"--report", a.report}, {"--sid", a.sid}};
  require_writable(outputs, {a.part, a.nodes, a.mass, a.dofs});
  const BodyFile content = reduce_part_file(job);
  // Files that the part includes are known by now.
  std::vector<std::string> inputs;
  for (const auto& [file, hash] : content.provenance.files)
    inputs.push_back((std::filesystem::path(a.part).parent_path() / file).string());
  require_distinct(outputs, inputs);
  write_body_file(out, content);
  std::string files = fmt::format("\n  body    {}\n", out);
  if (!a.report.empty()) {
    write_file(a.report, health_json(content.part.health) + '\n');
    files += fmt::format("  report  {}\n", a.report);
  }
  if (!a.sid.empty()) {
    write_file(a.sid, write_sid(content.part.body,
                                fmt::format("{} by Floatframe {}", content.provenance.source,
                                            content.provenance.version)));
    files += fmt::format("  SID     {}\n", a.sid);
  }
  print(fmt::format("{} ({}): ", a.part, content.provenance.units) +
        health_text(content.part.health) + (a.quiet ? "" : files));
  return 0;
}

CLI::Option* add_places(CLI::App& app, const char* name, std::vector<std::string>& texts,
                        const char* help) {
  return app.add_option(name, texts, help)
      ->type_name("NAME=...")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

void add_files(CLI::App& app, ReduceArguments& a) {
  app.add_option("PART", a.part, "Finite-element file (also .gz)")->required()->type_name("");
  app.add_option("-o,--out", a.out, "Body file to write; default: PART.ffb in this folder")
      ->type_name("FILE");
  app.add_option("--report", a.report, "Health report as JSON")->type_name("FILE");
  app.add_option("--sid", a.sid, "Standard Input Data (SID_FEM) as well")->type_name("FILE");
  app.add_option("--units", a.units, "Unit system of PART: mm-t-s, m-kg-s (si), ...; required")
      ->type_name("UNITS");
  app.add_option("--format", a.job.format, "Format of PART; default: by its content")
      ->type_name("NAME");
  app.add_option("--dialect", a.dialect,
                 "Whose deck PART is, abaqus or calculix; default: by its content")
      ->check(CLI::IsMember({"abaqus", "calculix"}))
      ->type_name("WORD");
  app.add_option("--material", a.material,
                 "young,poisson,density for files without, in their units")
      ->type_name("E,NU,RHO");
  app.add_option("--nodes", a.nodes, "File with the nodes of matrices")->type_name("FILE");
  app.add_option("--mass", a.mass, "Mass matrix, if it is not beside the stiffness")
      ->type_name("FILE");
  app.add_option("--dofs", a.dofs, "Dof map of matrices, if not beside them")->type_name("FILE");
}

void add_options(CLI::App& app, ReduceArguments& a) {
  add_places(app, "--interface", a.interfaces, "Where the part is held or driven; repeatable");
  add_places(app, "--marker", a.markers,
             "Where loads act (residual) or outputs are taken; repeatable");
  app.add_option("--modes", a.modes, "Number of normal modes; default 20 if nothing selects them")
      ->type_name("N");
  app.add_option("--fmax", a.fmax, "All normal modes below this frequency [Hz]")->type_name("HZ");
  app.add_option("--effective-mass", a.effective_mass,
                 "Normal modes until this fraction of the effective mass is reached")
      ->type_name("FRACTION");
  app.add_option("--method", a.method, "craig_bampton (default), free_free or craig_chang")
      ->check(CLI::IsMember({"craig_bampton", "free_free", "craig_chang"}))
      ->type_name("WORD");
  app.add_option("--reference", a.reference,
                 "Body frame: mean_axis (default), buckens or node:NAME of an interface")
      ->type_name("WORD");
  app.add_option("--integration", a.integration, "exact (default), or ccx: as CalculiX")
      ->check(CLI::IsMember({"exact", "ccx"}))
      ->type_name("WORD");
  app.add_option("--damping", a.damping, "Modal damping, fraction of critical; default 0")
      ->type_name("FRACTION");
  app.add_option("--solver", a.solver, "auto (default), mumps or eigen")
      ->check(CLI::IsMember({"auto", "mumps", "eigen"}))
      ->type_name("WORD");
  app.add_flag("--no-free-check", a.no_free_check,
               "No free modes of the full model in the report (saves a factorisation)");
  app.add_flag("--no-stress", a.no_stress, "No stress modes in the body file");
  app.add_flag("--projection", a.job.options.keep_projection,
               "Nodes and mass matrix in the body file, for inertia terms by projection");
  app.add_flag("--quiet", a.quiet, "No progress; the report is still printed");
}

}  // namespace

void add_reduce_command(CLI::App& app, Action& action) {
  auto a = std::make_shared<ReduceArguments>();
  CLI::App* command = app.add_subcommand(
      "reduce", "Reduce a finite-element part to a flexible body and report on its health");
  add_files(*command, *a);
  add_options(*command, *a);
  command->footer(
      "An interface or marker is NAME=WAY:VALUE[,OPTION=VALUE ...], lengths in the units of PART:\n"
      "  BALL=set:BALL                            nodes of a set, physical group or surface\n"
      "  BALL=node:123                            a node by its number\n"
      "  BALL=nearest:1,2,3                       the node nearest to a point\n"
      "  END=plane:0,0,0,normal=x                 nodes on a plane\n"
      "  EYE=cylinder:0,0,0,axis=y,radius=12      nodes on a bore; also length=30\n"
      "  BALL=sphere:1,2,3,radius=10              nodes on a sphere\n"
      "Options: at=x,y,z (reference point), tolerance=0.1; of interfaces type=rigid|mean and\n"
      "dofs=all|xyz|x+z|xyz+rz; of markers residual (attachment modes for loads that act there).\n"
      "Example: floatframe reduce arm.inp --units mm-t-s --interface BALL=set:BALL \\\n"
      "  --interface EYE=cylinder:0,0,0,axis=y,radius=12 --modes 20 -o arm.ffb\n"
      "Report on standard output, progress on standard error. docs/parts.md explains both.\n"
      "Exit codes: 0 done, 1 failed, 2 bad input; nothing half-written stays.");
  command->callback([a, &action] { action = [a] { return reduce_file(*a); }; });
}

}  // namespace floatframe
