// Springs and point masses of a CalculiX deck, after its equations.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "floatframe/decks/calculix/calculix_text.hpp"
#include "floatframe/fe/springs.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// CalculiX distinguishes the line of the stiffness from that of the directions by its point.
std::string with_point(std::string number) {
  if (number.find('.') == std::string::npos)
    number.insert(std::min(number.find('e'), number.size()), ".");
  return number;
}

/// A spring of any directions between further nodes: the first direction of each is its end's
/// part of the elongation, the others follow the spring's node, so that none is unconstrained.
class Springs {
 public:
  Springs(CalculixText& deck, CalculixEquations& equations)
      : deck_(deck),
        equations_(equations),
        in_elements_(nodes_of_elements(deck.model, [](const FeElement&) { return true; })) {
    for (const PointMass& m : deck.model.masses)
      if (m.mass != 0.0) in_elements_[m.node] = 1;
    for (const Spider& s : deck.model.spiders) in_elements_[s.reference] = 1;
  }

  void add(const Spring& s) {
    const bool grounded = s.nodes[1] < 0, straight = !grounded && along_its_line(s);
    std::vector<End> ends;
    for (int end = 0; end < (grounded ? 1 : 2); ++end) {
      // SPRING2 takes the second displacement less the first.
      const Vec6 d = end == 0 && !grounded ? Vec6(-s.directions[end]) : s.directions[end];
      const int node = s.nodes[end], axis = axis_of(d);
      ends.push_back(straight ? End{deck_.node(node), 0}
                     : axis >= 0 && !equations_.is_turn_of_knot(node, axis)
                         ? equations_.place(node, axis, s.source)
                         : further_node(s.source, node, d));
    }
    write(ends, s.stiffness);
  }

  /// Springs without their massless ends (spring_system): K = sum lambda v v^T. Each term is a
  /// spring between two further nodes, whose first directions are the parts of v . q of one node
  /// and of the others.
  void add_condensed(const SpringBlock& block, const FeSource& source) {
    const SymmetricEigen eigen = symmetric_eigen(block.K);
    const Eigen::Index last = eigen.values.size() - 1;
    for (Eigen::Index k = 0; k <= last; ++k) {
      if (!(eigen.values(k) > 1e-12 * eigen.values(last))) continue;
      std::map<int, Vec6> of_node;
      for (std::size_t i = 0; i < block.dofs.size(); ++i) {
        const double v = eigen.vectors(static_cast<Eigen::Index>(i), k);
        if (std::abs(v) < 1e-13) continue;
        of_node.try_emplace(block.dofs[i].node, Vec6::Zero()).first->second(block.dofs[i].axis) = v;
      }
      const auto first = of_node.begin(), second = std::next(first);
      const bool alone = second == of_node.end();
      std::vector<End> ends = {
          further_node(source, first->first, alone ? first->second : Vec6(-first->second))};
      if (!alone) {
        std::map<int, double> sum;
        for (auto it = second; it != of_node.end(); ++it) {
          must_be_in_an_element(source, it->first);
          for (const auto& [dof, factor] : equations_.independent(it->first, it->second))
            sum[dof] += factor;
        }
        ends.push_back(further_node(source, second->first, second->second));
        rows_[rows_.size() - 3].terms = {sum.begin(), sum.end()};  // of its first direction
      }
      write(ends, eigen.values(k));
    }
  }

  void finish() {
    if (!nodes_.empty())
      deck_.text +=
          "** Ends of springs: the first direction is a share of the elongation\n*NODE\n" + nodes_;
    for (const Row& row : rows_) equations_.add(row.place, row.terms, row.source);
    deck_.text += elements_;
  }

 private:
  using End = std::pair<int, int>;  ///< node and direction in the deck; 0: along the spring

  void write(const std::vector<End>& ends, double stiffness) {
    const int number = ++deck_.numbers.last_element;
    const std::string set = written_name(fmt::format("SPRING_{}", number), true, deck_.names);
    std::string nodes, directions;
    for (const auto& [node, direction] : ends) {
      nodes += fmt::format(", {}", node);
      if (direction > 0)
        directions += fmt::format("{}{}", directions.empty() ? "" : ", ", direction);
    }
    elements_ +=
        fmt::format("*ELEMENT, TYPE={}, ELSET={}\n{}{}\n*SPRING, ELSET={}\n{}\n{}\n",
                    ends.size() == 1     ? "SPRING1"
                    : directions.empty() ? "SPRINGA"
                                         : "SPRING2",
                    set, number, nodes, set, directions, with_point(calculix_number(stiffness)));
  }

  /// The only degree of freedom of a direction, with the factor 1; else -1.
  static int axis_of(const Vec6& d) {
    int axis = 0;
    d.maxCoeff(&axis);
    return d == Vec6::Unit(axis) ? axis : -1;
  }

  bool along_its_line(const Spring& s) const {
    const Vec3 d = deck_.model.positions[s.nodes[1]] - deck_.model.positions[s.nodes[0]];
    if (!(d.norm() > 0.0)) return false;
    Vec6 line = Vec6::Zero();
    line.head<3>() = d.normalized();
    return (s.directions[0] + line).norm() < 1e-14 && (s.directions[1] - line).norm() < 1e-14;
  }

  /// CalculiX leaves out degrees of freedom of nodes that only equations have.
  void must_be_in_an_element(const FeSource& source, int node) {
    if (in_elements_[node] != 0) return;
    deck_.error(source,
                "a spring that is neither along an axis nor along the line of its nodes ends at "
                "{}, which no element has: CalculiX would hold it there",
                deck_.model.node_label(node));
  }

  End further_node(const FeSource& source, int node, const Vec6& direction) {
    must_be_in_an_element(source, node);
    const int number = ++deck_.numbers.last_node;
    nodes_ += calculix_node(number, deck_.model.positions[node]);
    rows_.push_back({{number, 1}, equations_.independent(node, direction), source});
    for (int axis = 1; axis < 3; ++axis)
      rows_.push_back({{number, axis + 1}, equations_.independent(node, Vec6::Unit(axis)), source});
    return {number, 1};
  }

  struct Row {
    End place;
    DependentDofs::Terms terms;
    FeSource source;
  };

  CalculixText& deck_;
  CalculixEquations& equations_;
  std::string nodes_, elements_;
  std::vector<char> in_elements_;  ///< nodes that elements, masses or references of spiders are at
  std::vector<Row> rows_;
};

/// Does it end at a degree of freedom without mass that only springs hold?
bool is_loose(const Spring& s, const std::set<std::pair<int, int>>& condensed) {
  for (int end = 0; end < 2; ++end)
    for (int axis = 0; axis < 6; ++axis)
      if (s.directions[end](axis) != 0.0 && condensed.contains({s.nodes[end], axis})) return true;
  return false;
}

void add_springs(CalculixText& deck, Springs& springs) {
  const FeModel& model = deck.model;
  if (model.springs.empty()) return;
  const DofTable table = dof_table(model);
  std::set<std::pair<int, int>> condensed;
  for (const Dof& dof : spring_system(model, table).condensed)
    condensed.insert({dof.node, dof.axis});
  std::vector<Spring> loose;
  for (const Spring& s : model.springs) {
    if (is_loose(s, condensed))
      loose.push_back(s);
    else
      springs.add(s);
  }
  if (loose.empty()) return;
  FeModel only = model;
  only.springs = loose;
  for (const SpringBlock& block : spring_system(only, table).blocks)
    springs.add_condensed(block, loose.front().source);
  deck.note(
      "{} that massless nodes or rotations of solids have an end at: the stiffness between the "
      "others is written, as springs of further nodes",
      plural(static_cast<long>(loose.size()), "spring"));
}

void add_masses(CalculixText& deck) {
  int& number = deck.numbers.last_element;
  long turning = 0;
  for (const PointMass& m : deck.model.masses) {
    turning += !m.J.isZero(0.0);
    if (m.mass == 0.0) continue;
    const std::string set = written_name(fmt::format("MASS_{}", ++number), true, deck.names);
    deck.add("*ELEMENT, TYPE=MASS, ELSET={0}\n{1}, {2}\n*MASS, ELSET={0}\n{3}\n", set, number,
             deck.node(m.node), calculix_number(m.mass));
  }
  if (turning > 0)
    deck.note("the inertia of {} about the node is left out: CalculiX has masses without inertia",
              plural(turning, "point mass", "point masses"));
}

}  // namespace

void add_calculix_constraints(CalculixText& deck) {
  CalculixEquations equations(deck);
  equations.add_dependences();
  Springs springs(deck, equations);
  add_springs(deck, springs);
  springs.finish();
  equations.add_zeros();
  equations.say_refused();
  add_masses(deck);
}

}  // namespace floatframe
