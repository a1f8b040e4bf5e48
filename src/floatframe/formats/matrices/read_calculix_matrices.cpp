// Matrices that CalculiX stores with *FREQUENCY, SOLVER=MATRIXSTORAGE.
#include <optional>

#include "floatframe/formats/matrices/matrix_files.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

bool looks_like_calculix_matrix(std::string_view beginning) {
  const std::string_view line = first_line(beginning, "");
  std::string_view rest = line;
  return is_triple(line) && line.find(',') == std::string_view::npos && next_word(rest) == "1" &&
         next_word(rest) == "1";
}

FeModel read_calculix_matrices(TextSource& stiffness, TextSource& mass, TextSource& dofs,
                               FeModel nodes, TextSource* damping) {
  return matrix_model_of(stiffness, mass, dofs, std::move(nodes), true, read_triples, damping);
}

FeModel read_calculix_matrices(const std::filesystem::path& file, const FeReadOptions& options) {
  const std::filesystem::path stem = stem_of(file);
  ErrorList errors;
  const std::filesystem::path stiffness =
      companion(file, {}, {with_ending(stem, ".sti")}, "the stiffness is", "stiffness", errors);
  const std::filesystem::path mass = companion(file, options.mass, {with_ending(stem, ".mas")},
                                               "the mass matrix is", "mass", errors);
  const std::filesystem::path dofs = companion(file, options.dofs, {with_ending(stem, ".dof")},
                                               "the map of degrees of freedom is", "dofs", errors);
  const std::filesystem::path nodes =
      companion(file, options.nodes, {with_ending(stem, ".inp"), with_ending(stem, ".csv")},
                "the coordinates of the nodes are", "nodes", errors);
  errors.throw_if_any();
  TextSource dof_source(dofs), stiffness_source(stiffness), mass_source(mass);
  std::optional<TextSource> damping;
  if (!options.damping_matrix.empty()) damping.emplace(options.damping_matrix);
  return read_calculix_matrices(stiffness_source, mass_source, dof_source, read_nodes(nodes),
                                damping ? &*damping : nullptr);
}

}  // namespace floatframe
