// floatframe reduce: from a finite-element file to a body file, with a report on its health.
#include <fmt/format.h>

#include <filesystem>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/part_arguments.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/formats/sid/sid_file.hpp"
#include "floatframe/parts/fe_info.hpp"

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

std::vector<Option> file_options(ReduceArguments& a) {
  return {file_position("PART", a.part, "Finite-element file (also .gz)"),
          text_option("-o,--out", a.out, "FILE",
                      "Body file to write; default: PART.ffb in this folder"),
          text_option("--report", a.report, "FILE", "Health report as JSON"),
          text_option("--sid", a.sid, "FILE", "Standard Input Data (SID_FEM) as well"),
          text_option("--units", a.units, "UNITS",
                      "Unit system of PART: mm-t-s, m-kg-s (si), ...; required"),
          text_option("--format", a.job.format, "NAME", "Format of PART; default: by its content"),
          word_option("--dialect", a.dialect, {"abaqus", "calculix"},
                      "Whose deck PART is, abaqus or calculix; default: by its content"),
          text_option("--material", a.material, "E,NU,RHO",
                      "young,poisson,density for files without, in their units"),
          text_option("--nodes", a.nodes, "FILE", "File with the nodes of matrices"),
          text_option("--mass", a.mass, "FILE", "Mass matrix, if it is not beside the stiffness"),
          text_option("--dofs", a.dofs, "FILE", "Dof map of matrices, if not beside them")};
}

std::vector<Option> reduction_options(ReduceArguments& a) {
  return {repeated_option("--interface", a.interfaces, "NAME=...",
                          "Where the part is held or driven; repeatable"),
          repeated_option("--marker", a.markers, "NAME=...",
                          "Where loads act (residual) or outputs are taken; repeatable"),
          text_option("--modes", a.modes, "N",
                      "Number of normal modes; default 20 if nothing selects them"),
          text_option("--fmax", a.fmax, "HZ", "All normal modes below this frequency [Hz]"),
          text_option("--effective-mass", a.effective_mass, "FRACTION",
                      "Normal modes until this fraction of the effective mass is reached"),
          word_option("--method", a.method, {"craig_bampton", "free_free", "craig_chang"},
                      "craig_bampton (default), free_free or craig_chang"),
          text_option("--reference", a.reference, "WORD",
                      "Body frame: mean_axis (default), buckens or node:NAME of an interface"),
          word_option("--integration", a.integration, {"exact", "ccx"},
                      "exact (default), or ccx: as CalculiX"),
          text_option("--damping", a.damping, "FRACTION",
                      "Modal damping, fraction of critical; default 0"),
          word_option("--solver", a.solver, {"auto", "mumps", "eigen"},
                      "auto (default), mumps or eigen"),
          flag("--no-free-check", a.no_free_check,
               "No free modes of the full model in the report (saves a factorisation)"),
          flag("--no-stress", a.no_stress, "No stress modes in the body file"),
          flag("--projection", a.job.options.keep_projection,
               "Nodes and mass matrix in the body file, for inertia terms by projection"),
          flag("--quiet", a.quiet, "No progress; the report is still printed")};
}

}  // namespace

Command reduce_command() {
  const auto a = std::make_shared<ReduceArguments>();
  return {
      .name = "reduce",
      .help = "Reduce a finite-element part to a flexible body and report on its health",
      .options = joined(file_options(*a), reduction_options(*a)),
      .footer =
          "An interface or marker is NAME=WAY:VALUE[,OPTION=VALUE ...], lengths in the units of "
          "PART:\n"
          "  BALL=set:BALL                            nodes of a set, physical group or surface\n"
          "  BALL=node:123                            a node by its number\n"
          "  BALL=nearest:1,2,3                       the node nearest to a point\n"
          "  END=plane:0,0,0,normal=x                 nodes on a plane\n"
          "  EYE=cylinder:0,0,0,axis=y,radius=12      nodes on a bore; also length=30\n"
          "  BALL=sphere:1,2,3,radius=10              nodes on a sphere\n"
          "Options: at=x,y,z (reference point), tolerance=0.1; of interfaces type=rigid|mean and\n"
          "dofs=all|xyz|x+z|xyz+rz; of markers residual (attachment modes for loads that act "
          "there).\n"
          "Example: floatframe reduce arm.inp --units mm-t-s --interface BALL=set:BALL \\\n"
          "  --interface EYE=cylinder:0,0,0,axis=y,radius=12 --modes 20 -o arm.ffb\n"
          "Report on standard output, progress on standard error. docs/parts.md explains both.\n"
          "Exit codes: 0 done, 1 failed, 2 bad input; nothing half-written stays.",
      .run = [a] { return reduce_file(*a); }};
}

}  // namespace floatframe
