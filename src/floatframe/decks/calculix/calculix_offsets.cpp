#include <algorithm>
#include <cmath>

#include "floatframe/decks/calculix/calculix_text.hpp"
#include "floatframe/fe/beam_tangent.hpp"
#include "floatframe/math/rigid_motion.hpp"

namespace floatframe {
namespace {

constexpr double same_arm = 1e-9;

/// Ends of arms: nodes that follow exactly one other node rigidly, in all directions.
class ArmEnds {
 public:
  explicit ArmEnds(const FeModel& model) : model_(model) {
    for (const Spider& s : model.spiders)
      for (const int end : s.nodes)
        if (s.kind == Spider::Kind::rigid && s.mask == 63u) node_of_[end] = s.reference;
    std::map<int, std::vector<const LinearEquation*>> equations;
    for (const LinearEquation& e : model.equations)
      if (!e.terms.empty()) equations[e.terms.front().node].push_back(&e);
    for (const auto& [end, list] : equations)
      if (const int node = node_of(end, list); node >= 0) node_of_[end] = node;
    leave_out_others();
  }

  /// The node that `end` follows; -1: it is no end of an arm.
  int operator()(int end) const {
    const auto it = node_of_.find(end);
    return it == node_of_.end() ? -1 : it->second;
  }
  /// The node that `node` of a beam is at when its arm is gone.
  int foot(int node) const {
    const int there = (*this)(node);
    return there < 0 ? node : there;
  }
  void leave_out(int end) { node_of_.erase(end); }

 private:
  /// u' = u + theta x d, theta' = theta: six equations; -1 if they differ from these.
  int node_of(int end, const std::vector<const LinearEquation*>& list) const {
    if (list.size() != 6) return -1;
    int node = -1;
    unsigned axes = 0;
    Mat6 A = Mat6::Zero();
    for (const LinearEquation* e : list) {
      const LinearEquation::Term& first = e->terms.front();
      axes |= 1u << static_cast<unsigned>(first.axis);
      for (std::size_t k = 1; k < e->terms.size(); ++k) {
        const LinearEquation::Term& t = e->terms[k];
        if (node >= 0 && t.node != node) return -1;
        node = t.node;
        A(first.axis, t.axis) -= t.factor / first.factor;
      }
    }
    if (axes != 63u || node < 0 || node == end) return -1;
    const Mat6 rigid = rigid_motion_at(model_.positions[end] - model_.positions[node]);
    return (A - rigid).norm() <= same_arm * rigid.norm() ? node : -1;
  }

  /// Nodes with anything other than beams and the arm must be kept.
  void leave_out_others() {
    std::map<int, int> spiders;
    for (const Spider& s : model_.spiders) {
      leave_out(s.reference);
      for (const int end : s.nodes)
        if (++spiders[end] > 1 || s.kind != Spider::Kind::rigid) leave_out(end);
    }
    for (const LinearEquation& e : model_.equations)
      for (const LinearEquation::Term& t : e.terms)
        if (t.node != e.terms.front().node || spiders.contains(t.node)) leave_out(t.node);
    for (const PointMass& m : model_.masses) leave_out(m.node);
    for (const Spring& s : model_.springs)
      for (const int node : s.nodes) leave_out(node);
    for (const Support& s : model_.supports) leave_out(s.node);
    for (const auto& [name, nodes] : model_.node_sets)
      for (const int node : nodes) leave_out(node);
    for (const FeElement& e : model_.elements)
      if (!is_beam(e.type))
        for (const int node : nodes_of_element(e)) leave_out(node);
  }

  const FeModel& model_;
  std::map<int, int> node_of_;
};

/// OFFSET1 and OFFSET2 of a beam with ends of arms; none if its arms differ.
std::optional<std::array<double, 2>> written_offsets(const FeModel& model, const FeElement& e,
                                                     const ArmEnds& ends) {
  if (e.section < 0 || static_cast<std::size_t>(e.section) >= model.sections.size())
    return std::nullopt;
  const BeamSection& section = model.sections[e.section];
  if (section.outline == BeamSection::Outline::unknown) return std::nullopt;
  const int count = element_nodes(e.type);
  std::array<Vec3, 3> at{}, arm{};
  for (int k = 0; k < count; ++k) {
    at[k] = model.positions[ends.foot(e.nodes[k])];
    arm[k] = model.positions[e.nodes[k]] - at[k];
  }
  const bool round = section.outline == BeamSection::Outline::round;
  const std::array<double, 2> thickness{section.width, round ? section.width : section.height};
  std::array<double, 2> out{};
  for (int k = 0; k < count; ++k) {
    const Vec3 t = beam_tangent(at, count, k).normalized();
    const Vec3 n2 = t.cross(e.reference).normalized(), n1 = n2.cross(t);
    const std::array<double, 2> of_node{-arm[k].dot(n1) / thickness[0],
                                        -arm[k].dot(n2) / thickness[1]};
    const double size = std::max({1.0, std::abs(of_node[0]), std::abs(of_node[1])});
    const bool across = std::abs(arm[k].dot(t)) <= same_arm * size * thickness[0];
    if (k == 0) out = of_node;
    for (std::size_t j = 0; j < 2; ++j)
      if (!across || !(std::abs(of_node[j] - out[j]) <= same_arm * size)) return std::nullopt;
  }
  return out;
}

/// Beams that CalculiX would treat as one line, whose normals it averages.
bool along_each_other(const FeModel& model, const FeElement& a, const FeElement& b) {
  const auto axis = [&](const FeElement& e) {
    const std::span<const int> nodes = nodes_of_element(e);
    return Vec3(model.positions[nodes.back()] - model.positions[nodes.front()]).normalized();
  };
  return std::abs(axis(a).dot(axis(b))) > 0.9;
}

/// CalculiX has no arm: other elements at a node would act on the offset beam. So the nodes at the
/// ends of arms belong only to beams, and beams in one line have the same arm.
class ArmNodes {
 public:
  explicit ArmNodes(const FeModel& model)
      : model_(model),
        taken_(nodes_of_elements(model, [](const FeElement& e) { return !is_beam(e.type); })) {
    for (const PointMass& m : model.masses) taken_[m.node] = 1;
    for (const Spring& s : model.springs)
      for (const int node : s.nodes)
        if (node >= 0) taken_[node] = 1;
  }

  bool may_be(const ArmEnds& ends, int end) const {
    const int node = ends(end);
    if (taken_[node] != 0) return false;
    for (const Spider& s : model_.spiders) {
      if (s.reference != node && std::find(s.nodes.begin(), s.nodes.end(), node) == s.nodes.end())
        continue;
      if (s.reference != node ||
          std::any_of(s.nodes.begin(), s.nodes.end(), [&](int n) { return ends(n) != node; }))
        return false;
    }
    for (const LinearEquation& e : model_.equations) {
      const bool has = std::any_of(e.terms.begin(), e.terms.end(),
                                   [&](const LinearEquation::Term& t) { return t.node == node; });
      if (has && ends(e.terms.front().node) != node) return false;
    }
    return true;
  }

 private:
  const FeModel& model_;
  std::vector<char> taken_;
};

/// Does a beam in the same line meet it with another arm?
bool meets_another_arm(const FeModel& model, const ArmEnds& ends,
                       const std::map<int, std::vector<int>>& beams_at, const FeElement& e) {
  for (const int node : nodes_of_element(e)) {
    const auto at = beams_at.find(ends.foot(node));
    if (at == beams_at.end()) continue;
    for (const int i : at->second) {
      const FeElement& other = model.elements[i];
      const std::span<const int> nodes = nodes_of_element(other);
      if (std::find(nodes.begin(), nodes.end(), node) == nodes.end() &&
          along_each_other(model, e, other))
        return true;
    }
  }
  return false;
}

/// Omits ends of beams whose arms differ from OFFSET1 and OFFSET2, and everything attached to them.
void drop_unsupported_offsets(const FeModel& model, ArmEnds& ends) {
  const ArmNodes nodes(model);
  std::map<int, std::vector<int>> beams_at;
  for (std::size_t i = 0; i < model.elements.size(); ++i)
    if (is_beam(model.elements[i].type))
      for (const int node : nodes_of_element(model.elements[i]))
        beams_at[ends.foot(node)].push_back(static_cast<int>(i));
  bool changed = true;
  while (changed) {
    changed = false;
    for (const FeElement& e : model.elements) {
      if (!is_beam(e.type)) continue;
      const std::span<const int> at = nodes_of_element(e);
      if (std::none_of(at.begin(), at.end(), [&](int n) { return ends(n) >= 0; })) continue;
      if (std::all_of(at.begin(), at.end(),
                      [&](int n) { return ends(n) < 0 || nodes.may_be(ends, n); }) &&
          !meets_another_arm(model, ends, beams_at, e) && written_offsets(model, e, ends))
        continue;
      for (const int n : at) ends.leave_out(n);
      changed = true;
    }
  }
}

}  // namespace

std::optional<OffsetBeams> offset_beams(const FeModel& model) {
  ArmEnds ends(model);
  drop_unsupported_offsets(model, ends);
  std::set<int> moved;
  for (const FeElement& e : model.elements)
    if (is_beam(e.type))
      for (const int n : nodes_of_element(e))
        if (ends(n) >= 0) moved.insert(n);
  if (moved.empty()) return std::nullopt;
  OffsetBeams out{model, {}, {}};
  out.offsets.assign(model.elements.size(), {0.0, 0.0});
  out.left_out.assign(model.positions.size(), 0);
  for (const int end : moved) out.left_out[end] = 1;
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    FeElement& e = out.model.elements[i];
    if (!is_beam(e.type)) continue;
    bool beside = false;
    for (int k = 0; k < element_nodes(e.type); ++k) {
      int& node = e.nodes[k];
      if (!moved.contains(node)) continue;
      node = ends(node);
      beside = true;
    }
    if (beside) out.offsets[i] = *written_offsets(model, model.elements[i], ends);
  }
  std::erase_if(out.model.equations, [&](const LinearEquation& e) {
    return !e.terms.empty() && moved.contains(e.terms.front().node);
  });
  for (Spider& s : out.model.spiders)
    std::erase_if(s.nodes, [&](int node) { return moved.contains(node); });
  std::erase_if(out.model.spiders, [](const Spider& s) { return s.nodes.empty(); });
  return out;
}

}  // namespace floatframe
