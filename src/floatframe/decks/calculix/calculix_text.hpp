#pragma once
// Common functions of the parts of a CalculiX deck. Numbers have 13 digits: CalculiX reads 20
// characters of a field.
//
// Beams offset from their nodes in CalculiX: OFFSET1 and OFFSET2 of *BEAM SECTION, in
// thicknesses along directions 1 and 2 of the section, the centroid at
//   -OFFSET1 t_1 n_1 - OFFSET2 t_2 n_2
// from the node. Beams at one node are joined rigidly there for any offsets, which equations
// between their rotations cannot express (CalculixEquations).
//
// Equations of a CalculiX deck: spiders and linear equations in independent degrees of
// freedom. Rotations of nodes without beams and shells are displacements of further nodes.
//
// CalculiX expands beams and shells to solids. Equations with rotations of their nodes are active
// only where it joins several of them by a rigid knot (`knots_of`), elsewhere it ignores them
// silently: rejected.
#include <fmt/format.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/core/plural.hpp"
#include "floatframe/decks/nodes_of_element.hpp"
#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/written/mesh_writer.hpp"
#include "floatframe/formats/written/written_numbers.hpp"

namespace floatframe {

/// A model whose beams are at the nodes that rigid arms tied them to, without these arms.
struct OffsetBeams {
  FeModel model;
  std::vector<std::array<double, 2>> offsets;  ///< of each element, in thicknesses
  std::vector<char> left_out;                  ///< nodes at the ends of arms, unused now
};

struct CalculixText {
  explicit CalculixText(const FeModel& m) : model(m) { numbers = written_numbers(m, notes); }
  const FeModel& model;
  WrittenNumbers numbers;
  std::string text;
  std::vector<std::string> notes;
  ErrorList errors;
  const OffsetBeams* beside = nullptr;  ///< if `model` is of it
  std::set<std::string> names;          ///< of sets, surfaces, materials and orientations
  RenamedNames renamed;
  long dofs = 0;  ///< degrees of freedom that depend on none, at least

  int node(int index) const { return numbers.node[index]; }
  int element(std::size_t index) const { return numbers.element[index]; }
  /// In capitals; for a set, surface or material of the model.
  std::string name_of(const std::string& given) {
    std::string name = written_name(given, true, names);
    renamed.add(given, name);
    return name;
  }
  template <class... Values>
  void add(fmt::format_string<Values...> lines, Values&&... values) {
    text += fmt::format(lines, std::forward<Values>(values)...);
  }
  template <class... Values>
  void error(const FeSource& at, fmt::format_string<Values...> sentence, Values&&... values) {
    errors.add(ErrorCode::unsupported, model.mark(at),
               fmt::format(sentence, std::forward<Values>(values)...));
  }
  template <class... Values>
  void note(fmt::format_string<Values...> sentence, Values&&... values) {
    notes.push_back(fmt::format(sentence, std::forward<Values>(values)...));
  }
};

/// "1.5e-05", at most 20 characters.
std::string calculix_number(double value);
/// "1, 0, 1.5e-05"
std::string calculix_vector(const Vec3& v);
/// A line of *NODE.
std::string calculix_node(int number, const Vec3& p);

/// Numbers, 16 per line; an element's lines end with a comma if it is continued.
void add_calculix_numbers(std::string& text, const std::vector<int>& numbers, bool goes_on);

/// Materials, orientations and sections of all elements, in separate sets.
void add_calculix_sections(CalculixText& deck);

/// Spiders and equations (CalculixEquations), springs, point masses.
void add_calculix_constraints(CalculixText& deck);

/// None unless the end of a beam with a rectangular or round section is on a rigid arm across it,
/// the same in both directions at all its nodes, and is connected to nothing else.
std::optional<OffsetBeams> offset_beams(const FeModel& model);

/// The writer of `convert`.
WrittenMesh calculix_deck(const FeModel& model, const MeshWriteOptions& options);

class CalculixEquations {
 public:
  using Terms = DependentDofs::Terms;

  explicit CalculixEquations(CalculixText& deck);

  /// Dependent degrees of freedom by independent ones. For a node without elements, such as the
  /// reference of a coupling of some directions, the dofs represented by others are fixed: its
  /// motions without effect have neither stiffness nor mass, and CalculiX finds wrong
  /// frequencies if there are any.
  void add_dependences();
  /// place = sum of `terms` in independent degrees of freedom; without a term it is zero.
  void add(const std::pair<int, int>& place, const Terms& terms, const FeSource& source);
  void add_zeros();
  /// One error for all rotations that would be lost.
  void say_refused();

  /// A sum over degrees of freedom of one node in independent ones.
  Terms independent(int node, const Vec6& factors) const;

  /// Is it the rotation of a knot? Springs reach it by equations only.
  bool is_turn_of_knot(int node, int axis) const;

  /// Number of the node and direction of the deck, for a spring.
  std::pair<int, int> place(int node, int axis, const FeSource& source);

 private:
  void refuse(int node, const FeSource& source);
  /// Their number, and the first.
  void note_directions(fmt::format_string<std::string, const std::string&> text,
                       const std::vector<std::string>& names) const;
  void hold_idle_motions(const std::vector<char>& in_elements);
  /// For equations that rigid motions do not satisfy, which are no joints of a free part.
  void note_not_rigid(const std::vector<char>& in_elements) const;

  CalculixText& deck_;
  DofTable table_;
  DependentDofs dependences_;
  std::vector<std::pair<int, int>> place_;
  std::set<int> knots_;  ///< numbers of nodes
  std::string zeros_;
  std::set<int> refused_;  ///< numbers of nodes
  int first_refused_ = 0;
  FeSource first_source_;
};

}  // namespace floatframe
