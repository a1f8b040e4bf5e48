#include "floatframe/formats/matrices/matrix_files.hpp"

#include <fmt/format.h>

#include <optional>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

using Path = std::filesystem::path;

namespace {

/// The first of the files, or it with .gz, that exists.
std::optional<Path> first_file(const std::vector<Path>& files) {
  for (const Path& file : files) {
    for (const char* ending : {"", ".gz"}) {
      std::error_code error;
      const Path candidate = file.string() + ending;
      if (std::filesystem::is_regular_file(candidate, error)) return candidate;
    }
  }
  return std::nullopt;
}

}  // namespace

std::filesystem::path stem_of(const std::filesystem::path& file) {
  std::filesystem::path stem = file;
  if (same_word(stem.extension().string(), ".gz")) stem.replace_extension();
  stem.replace_extension();
  return stem;
}

Path with_ending(const Path& stem, const char* ending) {
  return stem.empty() ? Path{} : Path(stem.string() + ending);
}

Path with_word(const Path& file, std::string_view word, std::string_view other) {
  const std::string name = stem_of(file).filename().string();
  const std::size_t at = upper_case(name).rfind(word);
  if (at == std::string::npos) return {};
  const bool lower = name[at] >= 'a';
  return file.parent_path() /
         (name.substr(0, at) + (lower ? lower_case(other) : std::string(other)) +
          name.substr(at + word.size()));
}

Path before_word(const Path& file, std::string_view word) {
  const std::string name = stem_of(file).filename().string();
  const std::size_t at = upper_case(name).rfind(word);
  return at == std::string::npos ? Path{} : file.parent_path() / name.substr(0, at);
}

/// arm_C.mtx beside arm_K.mtx, arm_DMPV1.mtx beside arm_STIF1.mtx.
Path damping_beside(const Path& stiffness) {
  Path plain = stiffness;
  if (same_word(plain.extension().string(), ".gz")) plain.replace_extension();
  const std::string ending = plain.extension().string();
  if (!same_word(ending, ".mtx")) return {};
  const std::string stem = stem_of(stiffness).string();
  std::vector<Path> named;
  if (stem.ends_with("_K") || stem.ends_with("_k"))
    named.emplace_back(stem.substr(0, stem.size() - 1) + (stem.back() == 'K' ? "C" : "c") + ending);
  if (const Path abaqus = with_word(stiffness, "STIF", "DMPV"); !abaqus.empty())
    named.emplace_back(abaqus.string() + ending);
  return first_file(named).value_or(Path{});
}

Path companion(const Path& file, const Path& given, const std::vector<Path>& candidates,
               std::string_view what, std::string_view option, ErrorList& errors) {
  if (!given.empty()) return given;
  std::vector<Path> named;
  for (const Path& candidate : candidates) {
    if (!candidate.empty()) named.push_back(candidate);
  }
  if (const std::optional<Path> found = first_file(named)) return *found;
  std::string names;
  for (const Path& candidate : named) {
    names += (names.empty() ? "" : " or ") + shown(candidate.filename().string());
  }
  errors.add(ErrorCode::missing, {file.string()},
             fmt::format("{} missing: {}give the {} file", what,
                         names.empty() ? "" : "there is no " + names + " beside it; ", option));
  return {};
}

NamedMatrices named_matrices(const Path& file, const char* ending) {
  NamedMatrices named{stem_of(file), {}};
  const std::string name = named.begin.filename().string();
  if (!name.ends_with("_K") && !name.ends_with("_k")) return named;
  named.begin = file.parent_path() / name.substr(0, name.size() - 2);
  named.mass = named.begin.string() + (name.ends_with("_K") ? "_M" : "_m") + ending;
  return named;
}

std::string_view first_line(std::string_view text, std::string_view comments) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    if (!line.empty() && comments.find(line.front()) == std::string_view::npos) return line;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return {};
}

bool is_triple(std::string_view line) {
  std::vector<std::string_view> fields;
  split_blanks(line, fields);
  return fields.size() == 3 && parse_label(fields[0]) && parse_label(fields[1]) &&
         parse_real(fields[2]);
}

}  // namespace floatframe
