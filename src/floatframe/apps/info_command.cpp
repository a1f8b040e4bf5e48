// floatframe info: summary of a finite-element file, a body file or a SID_FEM file.

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/part_arguments.hpp"
#include "floatframe/parts/file_info.hpp"

namespace floatframe {
namespace {

struct InfoArguments {
  PartArguments options;
  std::string file;
  bool json = false;
};

int info(const InfoArguments& a) {
  PartJob job = a.options.job();
  job.file = a.file;
  print(a.json ? file_info_json(job) : file_info_text(job));
  return 0;
}

}  // namespace

Command info_command() {
  const auto a = std::make_shared<InfoArguments>();
  return {
      .name = "info",
      .help = "Show what is in a finite-element file, a body file or a SID_FEM file",
      .options =
          joined({file_position("FILE", a->file, "Finite-element file (also .gz), .ffb or SID_FEM"),
                  flag("--json", a->json, "JSON on standard output")},
                 a->options.table(true)),
      .footer =
          "Finite-element files: numbers in the units of the file; sets and spiders that could be\n"
          "interfaces of `floatframe reduce`; what the reader ignored. Body files: SI units, "
          "where\n"
          "they came from, modes, markers and the health report.\n"
          "Exit codes: 0 done, 2 bad input.",
      .run = [a] { return info(*a); }};
}

}  // namespace floatframe
