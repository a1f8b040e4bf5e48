// floatframe info: what is in a finite-element file, a body file or a SID_FEM file.
#include <fmt/format.h>

#include <filesystem>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/part_arguments.hpp"
#include "floatframe/formats/sid/sid_file.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/parts/body_info.hpp"
#include "floatframe/parts/fe_info.hpp"

namespace floatframe {
namespace {

struct InfoArguments {
  PartArguments options;
  std::string file;
  bool json = false;
};

/// A SID begins with a number and the block `part`.
bool is_sid(const std::string& file) {
  const std::string text = read_beginning(file, 4096);
  return text.find("part") != std::string::npos && text.find("new modal") != std::string::npos;
}

int info(const InfoArguments& a) {
  std::error_code error;
  if (!std::filesystem::exists(a.file, error))
    throw InputError({a.file, 0, 0}, "the file does not exist");
  if (!std::filesystem::is_regular_file(a.file, error))
    throw InputError({a.file, 0, 0}, "this is not a regular file");
  const PartJob job = a.options.job();
  if (job.format.empty() && is_body_file(a.file)) {
    const BodyFile content = read_body_file(a.file);
    print(a.json ? body_info_json(a.file, content) : body_info_text(a.file, content));
  } else if (job.format.empty() && is_sid(a.file)) {
    const SidBody sid = read_sid(a.file);
    print(a.json ? sid_info_json(a.file, sid.body, sid.notes)
                 : sid_info_text(a.file, sid.body, sid.notes));
  } else {
    const FeModel model = read_fe_file(a.file, job.read, job.format);
    print(a.json ? fe_info_json(a.file, model) : fe_info_text(a.file, model));
  }
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
          "interfaces of `floatframe reduce`; what the reader passed over. Body files: SI units, "
          "where\n"
          "they came from, modes, markers and the health report.\n"
          "Exit codes: 0 done, 2 bad input.",
      .run = [a] { return info(*a); }};
}

}  // namespace floatframe
