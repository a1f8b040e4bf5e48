#include "floatframe/fe/free_turns.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/union_find.hpp"

namespace floatframe {
namespace {

/// Squares of widths: a cloud narrower than 1e-5 of its length is a line.
constexpr double line_width = 1e-10;

/// Nodes that rotate together.
struct TurningGroup {
  std::vector<int> nodes;
  std::vector<int> points;  ///< whose places matter: something moves them, or they move something
  bool held = false;        ///< its rotation may have stiffness
  bool bars = false;
  std::string label;
  FeSource source;
};

class TurningGroups {
 public:
  explicit TurningGroups(const FeModel& model)
      : model_(model), dofs_(dofs_without_springs(model)), joined_(model.nodes()) {
    join_nodes();
    for (int k = 0; k < model_.nodes(); ++k)
      if (turns(k)) groups_[joined_.root(k)].nodes.push_back(k);
    gather_elements();
    gather_spiders();
    gather_others();
  }

  const std::map<int, TurningGroup>& groups() const { return groups_; }

  bool turns(int node) const { return dofs_[static_cast<std::size_t>(node) + 1] == 6; }

 private:
  static bool all_turns(const Spider& s) { return (s.mask & 56u) == 56u; }

  TurningGroup& group(int node) { return groups_.at(joined_.root(node)); }

  void add_point(int node) {
    if (turns(node)) group(node).points.push_back(node);
  }

  void hold(int node) {
    if (turns(node)) group(node).held = true;
  }

  void join_nodes() {
    for (const FeElement& e : model_.elements)
      if (is_beam(e.type))
        for (int a = 1; a < element_nodes(e.type); ++a) joined_.join(e.nodes[a], e.nodes[0]);
    for (const Spider& s : model_.spiders) {
      if (s.kind != Spider::Kind::rigid || !all_turns(s)) continue;
      for (const int node : s.nodes)
        if (turns(node)) joined_.join(node, s.reference);
    }
  }

  void gather_elements() {
    for (std::size_t i = 0; i < model_.elements.size(); ++i) {
      const FeElement& e = model_.elements[i];
      const bool beam = is_beam(e.type), shell = !beam && element_kernel(e.type).dofs_per_node == 6;
      for (int a = 0; a < element_nodes(e.type); ++a) {
        add_point(e.nodes[a]);
        if (shell) hold(e.nodes[a]);
      }
      if (!beam) continue;
      TurningGroup& g = group(e.nodes[0]);
      if (g.label.empty()) {
        g.label = model_.element_label(static_cast<int>(i));
        g.source = e.source;
      }
      g.bars = true;
    }
  }

  void gather_spiders() {
    for (const Spider& s : model_.spiders) {
      if (s.kind == Spider::Kind::mean) {
        hold(s.reference);
        for (const int node : s.nodes) add_point(node);
        continue;
      }
      TurningGroup& g = group(s.reference);
      if (g.label.empty()) {
        g.label = s.name.empty() ? "the rigid spider of " + model_.node_label(s.reference)
                                 : "spider '" + s.name + "'";
        g.source = s.source;
      }
      if ((s.mask & 7u) != 7u) g.held = true;
      for (const int node : s.nodes) {
        if (node == s.reference || (turns(node) && all_turns(s))) continue;
        g.points.push_back(node);
        if (!turns(node)) continue;
        add_point(node);  // a separate reference, carried by this one
        if ((s.mask & 56u) != 0u) hold(node), g.held = true;
      }
    }
  }

  void gather_others() {
    for (const PointMass& m : model_.masses) {
      if (!m.J.isZero(0.0)) hold(m.node);
      if (m.mass != 0.0) add_point(m.node);
    }
    for (const Spring& s : model_.springs)
      for (int end = 0; end < 2; ++end) {
        if (s.nodes[end] < 0) continue;
        if (!s.directions[end].tail<3>().isZero(0.0)) hold(s.nodes[end]);
        add_point(s.nodes[end]);
      }
    for (const LinearEquation& e : model_.equations)
      for (const LinearEquation::Term& t : e.terms) {
        if (t.axis >= 3) hold(t.node);
        add_point(t.node);
      }
  }

  const FeModel& model_;
  std::vector<int> dofs_;
  UnionFind joined_;
  std::map<int, TurningGroup> groups_;  ///< by their root
};

Vec3 centre(const FeModel& model, const std::vector<int>& nodes) {
  Vec3 c = Vec3::Zero();
  for (const int k : nodes) c += model.positions[k];
  return c / static_cast<double>(nodes.size());
}

/// sum r r^T about their centre: ascending eigenvalues and their directions.
Eigen::SelfAdjointEigenSolver<Mat3> spread(const FeModel& model, const std::vector<int>& nodes) {
  const Vec3 c = centre(model, nodes);
  Mat3 S = Mat3::Zero();
  for (const int k : nodes) {
    const Vec3 r = model.positions[k] - c;
    S += r * r.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Mat3>(S);
}

/// Elements without rotations at each node.
std::vector<std::vector<int>> elements_at(const FeModel& model) {
  std::vector<std::vector<int>> out(model.positions.size());
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const FeElement& e = model.elements[i];
    if (element_kernel(e.type).dofs_per_node != 3) continue;
    for (int a = 0; a < element_nodes(e.type); ++a) out[e.nodes[a]].push_back(static_cast<int>(i));
  }
  return out;
}

void ascending_once(std::vector<int>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

/// A node of the elements that holds the group, and those around it that define its rotation: none
/// that is tied by a spider, whose motion may come from another such rotation.
bool find_holder(const FeModel& model, const std::vector<std::vector<int>>& elements,
                 const std::vector<char>& tied, const TurningGroup& group, FreeTurn& turn) {
  const auto carried = [&](int k) {
    return tied[k] != 0 || std::binary_search(turn.group.begin(), turn.group.end(), k) ||
           std::binary_search(group.points.begin(), group.points.end(), k);
  };
  for (const int node : group.points) {
    std::vector<int> around;
    for (const int e : elements[node]) {
      const FeElement& element = model.elements[e];
      for (int a = 0; a < element_nodes(element.type); ++a)
        if (!carried(element.nodes[a])) around.push_back(element.nodes[a]);
    }
    ascending_once(around);
    if (around.size() < 3) continue;
    const Vec3 s = spread(model, around).eigenvalues();
    if (!(s(1) > 1e-4 * s(2))) continue;
    turn.holder = node;
    turn.around = std::move(around);
    return true;
  }
  return false;
}

/// The node with an independent rotation: no rigid spider moves it.
int leading_node(const FeModel& model, const std::vector<char>& follows,
                 const std::vector<int>& group) {
  for (const int k : group)
    if (follows[k] == 0 && k < model.nodes()) return k;
  return -1;
}

/// Nodes whose translation or rotation is prescribed by a rigid spider.
std::vector<char> followers(const FeModel& model) {
  std::vector<char> out(model.positions.size(), 0);
  for (const Spider& s : model.spiders)
    if (s.kind == Spider::Kind::rigid)
      for (const int node : s.nodes)
        if (node != s.reference) out[node] = 1;
  return out;
}

}  // namespace

std::vector<FreeTurn> free_turns(const FeModel& model) {
  std::vector<FreeTurn> out;
  if (model.matrices) return out;
  const TurningGroups groups(model);
  std::vector<std::vector<int>> elements;
  const std::vector<char> follows = followers(model);
  std::vector<char> tied = follows;
  for (const Spider& s : model.spiders) tied[s.reference] = 1;
  for (const auto& [root, given] : groups.groups()) {
    TurningGroup group = given;
    ascending_once(group.points);
    if (group.held || group.points.empty()) continue;
    const auto form = spread(model, group.points);
    const Vec3 size = form.eigenvalues();
    if (size(1) > line_width * size(2)) continue;
    FreeTurn turn;
    turn.group = group.nodes;
    // Of all nodes that rotate, to distinguish a point from a line.
    for (const int k : group.nodes)
      turn.length =
          std::max(turn.length, (model.positions[k] - model.positions[group.points[0]]).norm());
    turn.every_way = group.points.size() == 1 || size(2) <= line_width * turn.length * turn.length;
    if (turn.every_way && group.bars) continue;
    turn.axis = form.eigenvectors().col(2);
    turn.node = leading_node(model, follows, group.nodes);
    turn.label = group.label;
    turn.source = group.source;
    if (elements.empty()) elements = elements_at(model);
    if (turn.node < 0 || !find_holder(model, elements, tied, group, turn)) continue;
    out.push_back(std::move(turn));
  }
  return out;
}

std::vector<FreeTurn> line_turns(const FeModel& model) {
  std::vector<FreeTurn> out;
  for (const Spider& s : model.spiders) {
    if (s.kind != Spider::Kind::mean || (s.mask & 56u) == 56u) continue;
    FreeTurn turn;
    turn.node = s.reference;
    turn.group = {s.reference};
    turn.holder = s.nodes.front();
    turn.axis = spread(model, s.nodes).eigenvectors().col(2);
    turn.label = "interface '" + s.name + "'";
    turn.source = s.source;
    std::vector<int> line = s.nodes;
    ascending_once(line);
    const auto on_line = [&](int k) { return std::binary_search(line.begin(), line.end(), k); };
    for (const FeElement& e : model.elements) {
      const auto *first = e.nodes.data(), *last = first + element_nodes(e.type);
      if (std::any_of(first, last, on_line)) turn.around.insert(turn.around.end(), first, last);
    }
    ascending_once(turn.around);
    const Vec3 size =
        turn.around.size() < 3 ? Vec3(0, 0, 1) : spread(model, turn.around).eigenvalues();
    if (!(size(1) > 1e-4 * size(2)))
      throw InputError(
          ErrorCode::geometry,
          fmt::format("{}: its {} nodes lie on a line, and there are no elements next to it that "
                      "show how the part turns about it; choose nodes that do not lie on a line",
                      turn.label, s.nodes.size()));
    out.push_back(std::move(turn));
  }
  return out;
}

bool is_beside(const FeModel& model, const FreeTurn& turn, int node) {
  if (!std::binary_search(turn.group.begin(), turn.group.end(), node)) return false;
  Vec3 r = model.positions[node] - model.positions[turn.holder];
  if (!turn.every_way) r -= r.dot(turn.axis) * turn.axis;
  return r.squaredNorm() > line_width * turn.length * turn.length;
}

void tie_free_turns(FeModel& model, const std::vector<FreeTurn>& turns, bool note) {
  if (turns.empty()) return;
  for (const FreeTurn& turn : turns) {
    const Vec3 c = centre(model, turn.around);
    const auto form = spread(model, turn.around);
    const Mat3 J =
        form.eigenvalues().sum() * Mat3::Identity() -
        form.eigenvectors() * form.eigenvalues().asDiagonal() * form.eigenvectors().transpose();
    const auto add = [&](const Vec3& a) {
      LinearEquation equation;
      equation.source = turn.source;
      equation.for_first = true;
      Eigen::Index largest = 0;
      a.cwiseAbs().maxCoeff(&largest);
      for (Eigen::Index k = 0; k < 3; ++k) {
        const int axis = static_cast<int>((largest + k) % 3);
        if (a(axis) != 0.0) equation.terms.push_back({turn.node, axis + 3, a(axis)});
      }
      const Vec3 b = J.inverse() * a;
      for (const int node : turn.around) {
        const Vec3 factor = -b.cross(model.positions[node] - c);
        for (int axis = 0; axis < 3; ++axis)
          if (factor(axis) != 0.0) equation.terms.push_back({node, axis, factor(axis)});
      }
      model.equations.push_back(std::move(equation));
    };
    if (!turn.every_way) {
      add(turn.axis);
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) add(Vec3::Unit(axis));
  }
  if (!note) return;
  const FreeTurn& first = turns.front();
  model.notes.push_back(
      model.mark(first.source)
          .before(fmt::format(
              "nothing resists the turn of {} of nodes about the line that holds them: nodes "
              "without rotations; it follows the elements there; first: {}, held at {}",
              plural(static_cast<long>(turns.size()), "rigid or straight group"), first.label,
              model.node_label(first.holder))));
}

}  // namespace floatframe
