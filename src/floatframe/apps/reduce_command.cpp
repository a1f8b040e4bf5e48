// floatframe reduce: from a finite-element file to a body file, with a health report.
#include <fmt/format.h>

#include <filesystem>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/part_arguments.hpp"
#include "floatframe/apps/reduce_page.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/formats/sid/sid_file.hpp"
#include "floatframe/page/check_page.hpp"
#include "floatframe/page/page_writer.hpp"
#include "floatframe/parts/file_info.hpp"

namespace floatframe {
namespace {

struct ReduceArguments {
  PartArguments options;
  std::string part, out, report, sid;
  bool quiet = false, overwrite = false;
};

/// Most files do not state their units; the material may give a hint.
[[noreturn]] void units_are_missing(const PartJob& job) {
  throw InputError(ErrorCode::missing,
                   fmt::format("--units is missing: the file does not state its units; known are "
                               "{}, or any <length>-<mass>-<time>{}",
                               fmt::join(unit_system_names(), ", "), hint_of_units(job)));
}

PartJob job_of(const ReduceArguments& a) {
  PartJob job = a.options.job();
  job.file = a.part;
  if (job.units.empty()) units_are_missing(job);
  if (!a.quiet)
    job.options.progress = [](const std::string& stage, double seconds) {
      say_line(fmt::format("{:>8.2f} s  {}", seconds, stage));
    };
  return job;
}

int reduce_file(const ReduceArguments& a) {
  std::filesystem::path name = std::filesystem::path(a.part).filename();
  if (name.extension() == ".gz") name = name.stem();
  const std::string out = a.out.empty() ? name.stem().string() + ".ffb" : a.out;
  const bool page = is_page_name(a.report);
  if (page) require_page("--report");
  const PartJob job = job_of(a);
  const std::vector<OutputFile> outputs{{"-o", out}, {"--report", a.report}, {"--sid", a.sid}};
  std::vector<std::string> inputs{a.part};
  for (const std::filesystem::path& file : other_files(job)) inputs.push_back(file.string());
  require_writable(outputs, inputs, a.overwrite);
  const BodyFile content = reduce_part_file(job);
  // Files included by the part are known at this point.
  for (const auto& [file, hash] : content.provenance.files)
    inputs.push_back((std::filesystem::path(a.part).parent_path() / file).string());
  require_distinct(outputs, inputs);
  write_body_file(out, content);
  std::string files = fmt::format("\n  body    {}\n", out);
  if (!a.report.empty()) {
    write_file(a.report, page ? part_page(content) : health_json(content.part.health) + '\n');
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
          text_option("--report", a.report, "FILE",
                      "Health report: a page with the modes in motion (.html), else JSON"),
          text_option("--sid", a.sid, "FILE", "Standard Input Data (SID_FEM) as well"),
          overwrite_option(a.overwrite),
          flag("--quiet", a.quiet, "No progress; the report is still printed")};
}

}  // namespace

Command reduce_command() {
  const auto a = std::make_shared<ReduceArguments>();
  return {
      .name = "reduce",
      .help = "Reduce a finite-element part to a flexible body and report on its health",
      .options = joined(file_options(*a), a->options.table(false)),
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
          "Exit codes: 0 done, 1 failed, 2 bad input; files are written atomically.",
      .run = [a] { return reduce_file(*a); }};
}

}  // namespace floatframe
