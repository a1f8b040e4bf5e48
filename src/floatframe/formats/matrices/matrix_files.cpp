#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"

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

/// `file` without .gz.
Path plain_name(const Path& file) {
  return same_word(file.extension().string(), ".gz") ? Path(file).replace_extension() : file;
}

/// The file given in the options, or the first existing candidate, also with .gz. Empty paths
/// are no candidates. If there is none: an error "`what` missing: ... give the `option` file".
Path companion(const Path& file, const Path& given, std::vector<Path> candidates,
               std::string_view what, std::string_view option, ErrorList& errors) {
  if (!given.empty()) return given;
  std::erase(candidates, Path{});
  if (const std::optional<Path> found = first_file(candidates)) return *found;
  std::string names;
  for (const Path& candidate : candidates)
    names += (names.empty() ? "" : " or ") + shown(candidate.filename().string());
  errors.add(
      ErrorCode::missing, {file.string()},
      fmt::format("{} missing: {}give the {} file", what,
                  names.empty() ? "" : "there is no " + names + " in the same folder; ", option));
  return {};
}

constexpr const char* coordinates = "the coordinates of the nodes are";

}  // namespace

Path stem_of(const Path& file) { return plain_name(file).replace_extension(); }

Path with_ending(const Path& stem, const std::string& ending) {
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

Path with_letter(const Path& stem, char letter) {
  const std::string name = stem.string();
  if (!name.ends_with("_K") && !name.ends_with("_k")) return {};
  const std::string other(1, letter);
  return name.substr(0, name.size() - 1) + (name.back() == 'K' ? other : lower_case(other));
}

/// arm_C.mtx next to arm_K.mtx, arm_DMPV1.mtx next to arm_STIF1.mtx.
Path damping_beside(const Path& stiffness) {
  const std::string ending = plain_name(stiffness).extension().string();
  if (!same_word(ending, ".mtx")) return {};
  std::vector<Path> named = {with_ending(with_letter(stem_of(stiffness), 'C'), ending),
                             with_ending(with_word(stiffness, "STIF", "DMPV"), ending)};
  std::erase(named, Path{});
  return first_file(named).value_or(Path{});
}

Path nodes_beside(const Path& file, const Path& given, const std::vector<const char*>& endings) {
  std::vector<Path> candidates;
  for (const char* ending : endings) candidates.push_back(with_ending(stem_of(file), ending));
  ErrorList errors;
  Path nodes = companion(file, given, std::move(candidates), coordinates, "nodes", errors);
  errors.throw_if_any();
  return nodes;
}

FeModel read_matrix_files(const Path& file, const FeReadOptions& options,
                          const MatrixPlaces& places, const ReadMatrices& read) {
  ErrorList errors;
  const Path stiffness = companion(file, places.stiffness.empty() ? file : Path{}, places.stiffness,
                                   "the stiffness is", "stiffness", errors);
  const Path mass =
      companion(file, options.mass, places.mass, "the mass matrix is", "mass", errors);
  std::optional<Path> dofs;
  if (places.dofs)
    dofs = companion(file, options.dofs, *places.dofs, "the map of degrees of freedom is", "dofs",
                     errors);
  const Path nodes = companion(file, options.nodes, places.nodes, coordinates, "nodes", errors);
  errors.throw_if_any();
  const Path damping =
      options.damping_matrix.empty() ? damping_beside(stiffness) : options.damping_matrix;
  TextSource stiffness_source(stiffness), mass_source(mass);
  std::optional<TextSource> dof_source, damping_source;
  if (dofs) dof_source.emplace(*dofs);
  if (!damping.empty()) damping_source.emplace(damping);
  return read(stiffness_source, mass_source, dof_source ? &*dof_source : nullptr, read_nodes(nodes),
              damping_source ? &*damping_source : nullptr);
}

std::string_view first_line(std::string_view text, std::string_view comments) {
  while (!text.empty()) {
    const std::string_view line = trimmed(next_line(text));
    if (!line.empty() && comments.find(line.front()) == std::string_view::npos) return line;
  }
  return {};
}

}  // namespace floatframe
