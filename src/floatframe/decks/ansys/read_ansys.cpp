#include "floatframe/decks/ansys/read_ansys.hpp"

#include <fmt/format.h>

#include <array>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Words that no other format of this folder begins a line with.
constexpr std::array<std::string_view, 8> ansys_signs = {
    "NBLOCK,", "EBLOCK,", "/PREP7", "/COM,ANSYS", "ETBLOCK,", "RLBLOCK,", "ET,", "NUMOFF,"};

void note_passed_over(AnsysBuild& build) {
  std::string list;
  for (const auto& [word, at] : build.content.passed_over)
    list += fmt::format("{}{}", list.empty() ? "" : ", ", word);
  if (!list.empty()) build.file_note("ignored, of loads and analyses: {}", list);
}

}  // namespace

bool looks_like_ansys(std::string_view beginning) {
  while (!beginning.empty()) {
    const std::size_t end = std::min(beginning.find('\n'), beginning.size());
    const std::string_view line = trimmed(beginning.substr(0, end));
    for (const std::string_view sign : ansys_signs)
      if (begins_with(line, sign)) return true;
    beginning.remove_prefix(std::min(end + 1, beginning.size()));
  }
  return false;
}

FeModel read_ansys(TextSource& source, const FeReadOptions& options) {
  AnsysContent content = read_ansys_content(source);
  AnsysBuild build{source, content, options, content.model};
  build_ansys_elements(build);
  build_ansys_springs(build);
  build_ansys_rigid(build);
  build_ansys_contact(build);
  build.arms.tie(build.model);
  build_ansys_masses(build);
  build.report_shared();
  build_ansys_equations(build);
  build_ansys_supports(build);
  build_ansys_components(build);
  note_passed_over(build);
  source.throw_if_any();
  content.model.files = source.files();
  return std::move(content.model);
}

FeModel read_ansys_nodes(TextSource& source) {
  AnsysContent content = read_ansys_content(source);
  const FeReadOptions options;
  AnsysBuild build{source, content, options, content.model};
  build.index.assign(content.elements.size(), -1);
  build_ansys_supports(build);
  build_ansys_components(build);
  source.throw_if_any();
  content.model.files = source.files();
  return std::move(content.model);
}

FeModel read_ansys(const std::filesystem::path& file, const FeReadOptions& options) {
  TextSource source(file);
  return read_ansys(source, options);
}

}  // namespace floatframe
