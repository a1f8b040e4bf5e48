#include "floatframe/formats/matrices/read_op4.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "floatframe/formats/matrices/matrix_files.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/op4_file.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"

namespace floatframe {
namespace {

using Row = std::pair<int, int>;  // node, component; scalar point, 0

/// Components as bits; none: a scalar point.
void add_rows(std::set<Row>& rows, int id, unsigned components) {
  if (id <= 0) return;
  if (components == 0) rows.insert({id, 0});
  for (int c = 1; components != 0; ++c, components >>= 1u)
    if ((components & 1u) != 0) rows.insert({id, c});
}

/// The degrees of freedom that the cards of a superelement give its matrices.
std::vector<DofLabel> rows_of_cards(TextSource& source) {
  std::set<Row> external, analysis, all;
  NastranCards cards(source, has_begin_bulk(source.first_text()), NastranBegin::any);
  NastranCard card;
  while (cards.next(card)) {
    NastranFields f(source, card);
    const std::string& name = card.name;
    const auto add_list = [&](std::set<Row>& rows, std::size_t i, unsigned components) {
      for (; i < f.size(); ++i) {
        if (f.blank(i)) continue;
        const auto [first, last] = f.range(i, "a node or scalar point");
        for (int k = 0; k <= std::min(last - first, 100000); ++k)
          add_rows(rows, first + k, components);
      }
    };
    if (name == "GRID") add_rows(all, f.label(0, "the number of the node"), 63u);
    if (name == "SPOINT") add_list(all, 0, 0);
    if (name == "ASET1" || name == "QSET1")
      add_list(analysis, 1, f.components(0, "the components"));
    if (name != "EXTRN" && name != "ASET" && name != "QSET") continue;
    for (std::size_t i = 0; i < f.size(); i += 2)
      if (!f.blank(i))
        add_rows(name == "EXTRN" ? external : analysis, f.label(i, "a node"),
                 f.components(i + 1, "the components"));
  }
  source.throw_if_any();
  std::vector<DofLabel> labels;
  for (const auto& [id, component] : !external.empty()   ? external
                                     : !analysis.empty() ? analysis
                                                         : all)
    labels.push_back({id, component, {0, 0}});
  return labels;
}

/// The matrices of one letter that may be meant: real and square, of `size` rows if it is not 0;
/// those of one row stand for none. Names that superelements give come first.
const Op4Matrix* choose_op4(const std::vector<Op4Matrix>& matrices, char letter, int size,
                            const std::string& file) {
  std::vector<const Op4Matrix*> found;
  for (const Op4Matrix& m : matrices)
    if (m.name.starts_with(letter) && !m.name.starts_with("K4") && m.real_square() && m.rows > 1 &&
        (size == 0 || m.rows == size))
      found.push_back(&m);
  if (found.empty()) return nullptr;
  for (const char* rest : {"XX", "AA", "AAX"})
    for (const Op4Matrix* m : found)
      if (m->name == letter + std::string(rest)) return m;
  if (found.size() == 1) return found.front();
  std::vector<std::string> names;
  for (const Op4Matrix* m : found) names.push_back(m->name);
  throw InputError(ErrorCode::wrong_value, {file},
                   fmt::format("the file has the matrices {}; expected one whose name begins with "
                               "{}, or {}XX, {}AA or {}AAX",
                               fmt::join(names, ", "), letter, letter, letter, letter));
}

/// Both halves, also of a matrix that is stored as one.
SparseMatrix whole(const Op4Matrix& m) {
  SparseMatrix A(m.rows, m.rows);
  A.setFromTriplets(m.entries.begin(), m.entries.end());
  const SparseMatrix lower = A.triangularView<Eigen::Lower>(),
                     upper = A.triangularView<Eigen::Upper>();
  if (lower.nonZeros() == A.nonZeros()) return A.selfadjointView<Eigen::Lower>();
  if (upper.nonZeros() == A.nonZeros()) return A.selfadjointView<Eigen::Upper>();
  return A;
}

}  // namespace

FeModel read_op4(const std::filesystem::path& file, const FeReadOptions& options) {
  const std::string name = file.string();
  const std::vector<Op4Matrix> matrices = read_op4_matrices(read_whole_file(file), name);
  const Op4Matrix* K = choose_op4(matrices, 'K', 0, name);
  const Op4Matrix* M = K == nullptr ? nullptr : choose_op4(matrices, 'M', K->rows, name);
  std::vector<std::string> names;
  for (const Op4Matrix& m : matrices)
    if (m.rows > 1) names.push_back(m.name);  // those of one row stand for none
  if (M == nullptr)
    throw InputError(
        ErrorCode::missing, {name},
        fmt::format("the file has no real, square {}; its matrices: {}",
                    K == nullptr ? "stiffness K" : "mass M of the size of the stiffness",
                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  const Op4Matrix* B = choose_op4(matrices, 'B', K->rows, name);
  const std::filesystem::path nodes = nodes_beside(
      file, options.nodes, {".pch", ".asm", ".bdf", ".dat", ".nas", ".blk", "_nodes.csv"});
  std::filesystem::path dofs = options.dofs;
  if (const auto table = with_ending(stem_of(file), "_dofs.csv");
      dofs.empty() && std::filesystem::exists(table))
    dofs = table;
  TextSource source(dofs.empty() ? nodes : dofs);
  const std::vector<DofLabel> labels =
      dofs.empty() ? rows_of_cards(source) : read_dof_labels(source);
  source.throw_if_any();
  if (std::ssize(labels) != K->rows)
    source.stop(ErrorCode::wrong_count, {0, 0},
                "{} degrees of freedom for matrices of {} rows ({} of {}); give them as the dofs "
                "file, lines \"node,dir\"",
                labels.size(), K->rows, K->name, name);
  FeModel model = matrix_model(read_nodes(nodes), labels, whole(*K), whole(*M), source, {name});
  if (B != nullptr) add_matrix_damping(model, whole(*B), source);
  std::erase_if(names, [&](const std::string& n) {
    return n == K->name || n == M->name || (B != nullptr && n == B->name);
  });
  note_other_matrices(model, name, names);
  return model;
}

}  // namespace floatframe
