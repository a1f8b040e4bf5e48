#pragma once
// Equations of a CalculiX deck: spiders and linear equations in degrees of freedom that depend on
// none. Rotations of nodes without beams and shells are displacements of further nodes.
//
// CalculiX makes solids of beams and shells. Equations with rotations of their nodes are in force
// only where it joins several of them by a rigid knot (`knots_of`), elsewhere it loses them
// silently: refused.
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/decks/calculix/calculix_text.hpp"
#include "floatframe/fe/dependent_dofs.hpp"

namespace floatframe {

class CalculixEquations {
 public:
  using Terms = DependentDofs::Terms;

  explicit CalculixEquations(CalculixText& deck);

  /// Dependent degrees of freedom by independent ones. Of a node without elements, as the
  /// reference of a coupling of some directions is, those are held that the others stand for: its
  /// motions that move nothing have neither stiffness nor mass, and CalculiX finds wrong
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
  /// How many there are, and the first.
  void note_directions(fmt::format_string<std::string, const std::string&> text,
                       const std::vector<std::string>& names) const;
  void hold_idle_motions(const std::vector<char>& in_elements);
  /// Of equations that rigid motions do not satisfy, which are no joints of a free part.
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
