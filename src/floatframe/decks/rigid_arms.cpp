#include "floatframe/decks/rigid_arms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "floatframe/decks/nodes_of_element.hpp"
#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/shell_layers.hpp"
#include "floatframe/math/rigid_motion.hpp"

namespace floatframe {
namespace {

void add_arm_equations(FeModel& model, int end, int node, const FeSource& at) {
  const Mat6 rigid = rigid_motion_at(model.positions[end] - model.positions[node]);
  for (const int row : {0, 3, 1, 4, 2, 5}) {
    LinearEquation equation{{{end, row, 1.0}}, at};
    for (int k = 0; k < 6; ++k)
      if (rigid(row, k) != 0.0) equation.terms.push_back({node, k, -rigid(row, k)});
    model.equations.push_back(std::move(equation));
  }
}

/// cos of the largest angle between a shell and the mean of those at the node: beyond, its bending
/// resists the turn about the normal of the others.
constexpr double smooth = 0.93969262;  // 20 degrees

bool has_node(const Element& e, int node) {
  const std::span<const int> nodes = nodes_of_element(e);
  return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

Vec3 normal_of(const FeModel& model, int shell) {
  const std::span<const int> nodes = nodes_of_element(model.elements[shell]);
  std::array<Vec3, 8> p;
  for (std::size_t k = 0; k < nodes.size(); ++k) p[k] = model.positions[nodes[k]];
  return shell_normal({p.data(), nodes.size()});
}

bool are_smooth(const FeModel& model, const std::vector<int>& shells) {
  Vec3 sum = Vec3::Zero();
  for (const int shell : shells) {
    const Vec3 n = normal_of(model, shell);
    sum += n.dot(sum) < 0.0 ? Vec3(-n) : n;
  }
  return std::all_of(shells.begin(), shells.end(), [&](int shell) {
    return std::abs(normal_of(model, shell).dot(sum)) >= smooth * sum.norm();
  });
}

/// Each node with the beams that may stiffen shells there: its shells.
class StiffenedNodes {
 public:
  StiffenedNodes(const FeModel& model, std::span<const BeamOnNodes> beams)
      : model_(model), shells_(model.positions.size()), state_(model.positions.size(), none) {
    for (const BeamOnNodes& beam : beams)
      if (beam.beside && beam.holds)
        for (const int k : beam.nodes)
          if (k >= 0) state_[k] = wanted;
    for (std::size_t i = 0; i < model.elements.size(); ++i) {
      if (!is_shell(model.elements[i].type)) continue;
      for (const int k : nodes_of_element(model.elements[i]))
        if (state_[k] == wanted) shells_[k].push_back(static_cast<int>(i));
    }
    for (const BeamOnNodes& beam : beams) look_at(beam);
  }

  const std::vector<int>& shells(int node) const { return shells_[node]; }
  bool is_one(int node) const {
    return state_[node] == stiffened && are_smooth(model_, shells_[node]);
  }

 private:
  enum State : char { none, wanted, stiffened, left };  // left by a beam that goes elsewhere

  void look_at(const BeamOnNodes& beam) {
    for (const int node : beam.nodes) {
      if (node < 0 || state_[node] == none || state_[node] == left) continue;
      if (!goes_along(beam, node))
        state_[node] = left;
      else if (beam.beside && beam.holds)
        state_[node] = stiffened;
    }
  }

  bool goes_along(const BeamOnNodes& beam, int node) const {
    return std::all_of(beam.nodes.begin(), beam.nodes.end(), [&](int other) {
      return other < 0 || std::any_of(shells_[node].begin(), shells_[node].end(), [&](int shell) {
               return has_node(model_.elements[shell], other);
             });
    });
  }

  const FeModel& model_;
  std::vector<std::vector<int>> shells_;  ///< of the nodes that are not `none`
  std::vector<State> state_;
};

}  // namespace

int add_generated_node(FeModel& model, TextSource& source, const Vec3& p, const FeSource& at,
                       int& largest) {
  largest = largest == 0 ? *std::max_element(model.node_ids.begin(), model.node_ids.end())
                         : std::max(largest, model.node_ids.back());
  if (largest == std::numeric_limits<int>::max())
    source.stop(ErrorCode::not_a_number, at,
                "a node of its own is needed here, but there is no number above {}", largest);
  model.positions.push_back(p);
  model.node_ids.push_back(++largest);
  model.node_sources.push_back(at);
  model.generated_nodes.push_back(model.nodes() - 1);
  if (!model.node_names.empty()) model.node_names.emplace_back();
  return model.nodes() - 1;
}

Spider& add_rigid_spider(FeModel& model, int reference, std::string name, const FeSource& at) {
  Spider& s = model.spiders.emplace_back();
  s.reference = reference;
  s.name = std::move(name);
  s.source = at;
  return s;
}

std::vector<char> nodes_with_rotations(const FeModel& model) {
  std::vector<char> rotates(model.positions.size(), 0);
  for (const Element& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    for (int k = 0; k < kernel.nodes; ++k)
      if (kernel.dofs_per_node == 6) rotates[e.nodes[k]] = 1;
  }
  for (const Spider& s : model.spiders) rotates[s.reference] = 1;
  for (const Spring& s : model.springs)
    for (int end = 0; end < 2; ++end)
      if (s.nodes[end] >= 0 && !s.directions[end].tail<3>().isZero(0.0)) rotates[s.nodes[end]] = 1;
  return rotates;
}

int RigidArms::end(FeModel& model, TextSource& source, int node, const Vec3& arm,
                   const FeSource& at) {
  if (!std::isfinite(arm.squaredNorm()))  // stiffness about the node holds that square
    source.stop(ErrorCode::not_finite, at,
                "the end of a beam is ({:g}, {:g}, {:g}) from {}, expected numbers whose squares "
                "do not overflow",
                arm(0), arm(1), arm(2), model.node_label(node));
  const auto [it, fresh] = end_of_.try_emplace({double(node), arm(0), arm(1), arm(2)}, -1);
  if (!fresh) return it->second;
  it->second = add_generated_node(model, source, model.positions[node] + arm, at, largest_id_);
  arms_.push_back({it->second, node, at});
  return it->second;
}

/// At the nodes of the file.
std::vector<BeamOnNodes> RigidArms::beams(const FeModel& model) const {
  std::vector<int> at(model.positions.size());
  std::iota(at.begin(), at.end(), 0);
  for (const Arm& a : arms_) at[a.end] = a.node;
  std::vector<BeamOnNodes> out;
  for (const Element& e : model.elements) {
    if (!is_beam(e.type)) continue;
    BeamOnNodes beam;
    const BeamSection& section = model.sections[e.section];
    beam.holds = section.Iy > 0.0 && section.Iz > 0.0;
    for (int k = 0; k < element_nodes(e.type); ++k) {
      beam.nodes[k] = at[e.nodes[k]];
      beam.beside |= at[e.nodes[k]] != e.nodes[k];
    }
    out.push_back(beam);
  }
  return out;
}

void RigidArms::tie(FeModel& model) const {
  if (arms_.empty()) return;
  free_drilling_at_stiffeners(model, beams(model));
  const std::vector<int> dofs = dofs_without_springs(model);
  std::map<int, std::size_t> spiders;
  for (const Arm& a : arms_) {
    if (dofs[a.node + 1] == 6) {
      add_arm_equations(model, a.end, a.node, a.at);
      continue;
    }
    const auto [it, fresh] = spiders.try_emplace(a.node, model.spiders.size());
    if (fresh)
      add_rigid_spider(model, a.node, fmt::format("beams of {}", model.node_label(a.node)), a.at);
    model.spiders[it->second].nodes.push_back(a.end);
  }
}

void free_drilling_at_stiffeners(FeModel& model, std::span<const BeamOnNodes> beams) {
  const auto stiffens = [](const BeamOnNodes& b) { return b.beside && b.holds; };
  if (std::none_of(beams.begin(), beams.end(), stiffens)) return;
  const StiffenedNodes nodes(model, beams);
  int count = 0;
  for (int k = 0; k < model.nodes(); ++k) {
    if (nodes.shells(k).empty() || !nodes.is_one(k)) continue;
    ++count;
    for (const int shell : nodes.shells(k)) {
      Element& e = model.elements[shell];
      const std::span<const int> of_shell = nodes_of_element(e);
      for (std::size_t a = 0; a < of_shell.size(); ++a)
        if (of_shell[a] == k) e.own_drilling |= 1u << a;
    }
  }
  if (count > 0)
    model.notes.push_back(
        fmt::format("at {} nodes of beams along shells and next to them the shells do not resist "
                    "the turn about "
                    "their normal, as in most programs; here they do elsewhere",
                    count));
}

}  // namespace floatframe
