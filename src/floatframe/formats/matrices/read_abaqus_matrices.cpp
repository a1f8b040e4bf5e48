// Matrices that Abaqus writes with *MATRIX GENERATE and *MATRIX OUTPUT.
#include <fmt/format.h>

#include <map>
#include <optional>

#include "floatframe/formats/matrices/matrix_entries.hpp"
#include "floatframe/formats/matrices/matrix_files.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

bool is_quintuple(std::string_view line) {
  std::vector<std::string_view> fields;
  split_blanks(line, fields);
  return fields.size() == 5 && parse_integer(fields[0]) && parse_integer(fields[1]) &&
         parse_integer(fields[2]) && parse_integer(fields[3]) && parse_real(fields[4]);
}

/// Degrees of freedom in the order in which they are met.
class LabelTable {
 public:
  int row(int node, int direction, const FeSource& at) {
    const auto [it, added] =
        row_.emplace(std::pair(node, direction), static_cast<int>(labels.size()));
    if (added) labels.push_back({node, direction, at});
    return it->second;
  }
  std::vector<DofLabel> labels;

 private:
  std::map<std::pair<int, int>, int> row_;
};

/// Lines "node, direction, node, direction, value".
SymmetricEntries read_quintuples(TextSource& source, const std::string& what, LabelTable& table) {
  SymmetricEntries entries(source, what);
  std::vector<std::string_view> fields;
  std::string_view line;
  while (source.next(line)) {
    line = trimmed(line);
    if (line.empty() || line.front() == '*') continue;
    split_blanks(line, fields);
    if (fields.size() != 5) {
      source.error(ErrorCode::wrong_count,
                   "the line has {} fields, expected node, direction, node, direction, value",
                   fields.size());
      continue;
    }
    std::array<int, 4> number{};
    bool valid = true;
    for (std::size_t k = 0; k < 4 && valid; ++k) {
      const std::optional<int> value = parse_integer(fields[k]);
      if (!value)
        source.error(ErrorCode::not_a_number, "label {}: {}", k + 1, not_an_integer(fields[k]));
      valid = value.has_value();
      number[k] = value.value_or(0);
    }
    const std::optional<double> value = parse_real(fields[4]);
    if (valid && !value) source.error(ErrorCode::not_a_number, "value: " + not_a_real(fields[4]));
    if (!valid || !value) continue;
    for (std::size_t k = 0; k < 4 && valid; k += 2) {
      if (number[k] < 1) {
        source.stop(ErrorCode::unsupported, source.here(),
                    "node {} is internal to Abaqus (Lagrange multipliers of distributing "
                    "couplings, connectors or hybrid elements): write the matrices without them "
                    "and give the interfaces here",
                    number[k]);
      }
      if (number[k + 1] < 1 || number[k + 1] > 6) {
        source.error(ErrorCode::out_of_range, "direction {} of node {}: expected 1 to 6",
                     number[k + 1], number[k]);
        valid = false;
      }
    }
    if (!valid) continue;
    const FeSource at = source.here();
    const int row = table.row(number[0], number[1], at);
    entries.add(row, table.row(number[2], number[3], at), *value);
  }
  if (entries.size() == 0 && what != "damping")
    source.error(ErrorCode::missing, FeSource{0, 0}, "the {} has no entries", what);
  source.throw_if_any();
  return entries;
}

}  // namespace

bool looks_like_abaqus_matrix(std::string_view beginning) {
  const std::string_view line = first_line(beginning, "*");
  return is_quintuple(line) || (is_triple(line) && !looks_like_calculix_matrix(beginning));
}

FeModel read_abaqus_matrices(TextSource& stiffness, TextSource& mass, TextSource* dofs,
                             FeModel nodes, TextSource* damping) {
  if (dofs != nullptr) {
    return matrix_model_of(stiffness, mass, *dofs, std::move(nodes), false, read_triples, damping);
  }
  LabelTable table;
  SymmetricEntries K = read_quintuples(stiffness, "stiffness", table);
  const std::size_t n = table.labels.size();
  const auto known = [&](TextSource& source) {
    if (table.labels.size() == n) return;
    const DofLabel& label = table.labels[n];
    source.stop(ErrorCode::not_found, label.at, "degree of freedom {}.{} is not in the stiffness",
                label.node, label.direction);
  };
  SymmetricEntries M = read_quintuples(mass, "mass", table);
  known(mass);
  const std::vector<std::string> names = dof_names(table.labels);
  SparseMatrix stiff = K.finish(static_cast<int>(n), names, true);
  stiffness.throw_if_any();
  SparseMatrix heavy = M.finish(static_cast<int>(n), names, false);
  mass.throw_if_any();
  FeModel model = matrix_model(std::move(nodes), table.labels, std::move(stiff), std::move(heavy),
                               stiffness, {mass.files().front()});
  if (damping == nullptr) return model;
  SymmetricEntries C = read_quintuples(*damping, "damping", table);
  known(*damping);
  SparseMatrix viscous = C.finish(static_cast<int>(n), names, false);
  damping->throw_if_any();
  add_matrix_damping(model, std::move(viscous), *damping);
  return model;
}

FeModel read_abaqus_matrices(const std::filesystem::path& file, const FeReadOptions& options) {
  // arm_STIF2.mtx has arm_MASS2.mtx beside it, perhaps arm_DMPV2.mtx, and belongs to arm.inp.
  const std::filesystem::path mass_name = with_word(file, "STIF", "MASS");
  const std::filesystem::path job = before_word(file, "_STIF");
  ErrorList errors;
  const std::filesystem::path mass = companion(file, options.mass, {with_ending(mass_name, ".mtx")},
                                               "the mass matrix is", "mass", errors);
  const std::filesystem::path nodes =
      companion(file, options.nodes, {with_ending(job, ".inp"), with_ending(job, "_nodes.csv")},
                "the coordinates of the nodes are", "nodes", errors);
  const bool labels = !is_triple(first_line(read_beginning(file, 65536), "*"));
  std::filesystem::path map;
  if (!labels) {
    map = companion(file, options.dofs, {with_ending(job, "_dofs.csv")},
                    "the map of degrees of freedom is", "dofs", errors);
  }
  errors.throw_if_any();
  TextSource stiffness_source(file), mass_source(mass);
  std::optional<TextSource> damping;
  if (const auto found = damping_matrix_of(file, options); !found.empty()) damping.emplace(found);
  TextSource* viscous = damping ? &*damping : nullptr;
  if (labels) {
    return read_abaqus_matrices(stiffness_source, mass_source, nullptr, read_nodes(nodes), viscous);
  }
  TextSource dofs(map);
  return read_abaqus_matrices(stiffness_source, mass_source, &dofs, read_nodes(nodes), viscous);
}

}  // namespace floatframe
