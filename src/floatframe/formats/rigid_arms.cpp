#include "floatframe/formats/rigid_arms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/stiffeners.hpp"

namespace floatframe {
namespace {

/// The end moves with the node and turns with `turning`, which is the node but for the ends of
/// stiffeners after the first at a node; about `normal` by itself.
void add_arm_equations(FeModel& model, int end, int node, int turning, const FeSource& at,
                       const std::optional<Vec3>& normal) {
  const Vec3 arm = model.positions[end] - model.positions[node];
  int own = -1;  // of the rotations of the end the one that is its own
  if (normal) normal->cwiseAbs().maxCoeff(&own);
  for (int k = 0; k < 3; ++k) {
    LinearEquation move, turn;
    move.source = turn.source = at;
    turn.terms = {{end, 3 + k, 1.0}, {turning, 3 + k, -1.0}};
    move.terms = {{end, k, 1.0}, {node, k, -1.0}};
    const Vec3 lever = arm.cross(Vec3::Unit(k));  // e_k . (theta x d) = theta . (d x e_k)
    for (int i = 0; i < 3; ++i)
      if (lever(i) != 0.0) move.terms.push_back({node, 3 + i, -lever(i)});
    model.equations.push_back(std::move(move));
    if (k == own) continue;
    // theta' - theta is along the normal.
    if (const double share = own < 0 ? 0.0 : (*normal)(k) / (*normal)(own); share != 0.0) {
      turn.terms.push_back({end, 3 + own, -share});
      turn.terms.push_back({turning, 3 + own, share});
    }
    model.equations.push_back(std::move(turn));
  }
}

}  // namespace

int add_own_node(FeModel& model, TextSource& source, const Vec3& p, const FeSource& at,
                 int& largest) {
  largest = largest == 0 ? *std::max_element(model.node_ids.begin(), model.node_ids.end())
                         : std::max(largest, model.node_ids.back());
  if (largest == std::numeric_limits<int>::max())
    source.stop(at, fmt::format("a node of its own is needed here, but there is no number above {}",
                                largest));
  model.positions.push_back(p);
  model.node_ids.push_back(++largest);
  model.node_sources.push_back(at);
  if (!model.node_names.empty()) model.node_names.emplace_back();
  return model.nodes() - 1;
}

int RigidArms::end(FeModel& model, TextSource& source, int node, const Vec3& arm,
                   const FeSource& at) {
  if (!std::isfinite(arm.squaredNorm()))  // stiffness about the node holds that square
    source.stop(at, fmt::format("the end of a beam is ({:g}, {:g}, {:g}) from {}, expected numbers "
                                "whose squares can be reckoned with",
                                arm(0), arm(1), arm(2), model.node_label(node)));
  const auto [it, fresh] = end_of_.try_emplace({double(node), arm(0), arm(1), arm(2)}, -1);
  if (!fresh) return it->second;
  it->second = add_own_node(model, source, model.positions[node] + arm, at, largest_id_);
  arms_.push_back({it->second, node, at});
  return it->second;
}

std::vector<std::optional<Vec3>> RigidArms::own_turns(const FeModel& model) const {
  std::vector<int> arm_of(model.positions.size(), -1);
  std::vector<char> wanted(model.positions.size(), 0);
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    arm_of[arms_[a].end] = static_cast<int>(a);
    wanted[arms_[a].node] = 1;
  }
  std::vector<std::vector<int>> others(arms_.size());  // nodes that its beams go to
  std::vector<char> bends(arms_.size(), 1);
  for (const Element& e : model.elements) {
    const std::span<const int> nodes(e.nodes.data(), element_nodes(e.type));
    for (const int end : nodes) {
      if (arm_of[end] < 0) continue;
      const bool beam = is_beam(e.type) && model.sections[e.section].Iy > 0.0 &&
                        model.sections[e.section].Iz > 0.0;
      if (!beam) bends[arm_of[end]] = 0;
      for (const int k : nodes)
        if (k != end) others[arm_of[end]].push_back(arm_of[k] < 0 ? k : arms_[arm_of[k]].node);
    }
  }
  const ShellsAtNodes shells(model, wanted);
  std::vector<std::optional<Vec3>> out(arms_.size());
  for (std::size_t a = 0; a < arms_.size(); ++a)
    if (bends[a] != 0) out[a] = shells.normal_along(arms_[a].node, others[a]);
  return out;
}

void RigidArms::tie(FeModel& model) const {
  if (arms_.empty()) return;
  std::vector<std::optional<Vec3>> own = own_turns(model);
  const std::vector<int> dofs = dofs_without_springs(model);
  std::map<int, std::size_t> spiders;
  std::map<int, int> stiffener_at;  // the end with a turn of its own, with which others turn
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    const Arm& a = arms_[i];
    if (dofs[a.node + 1] == 6) {
      int turning = a.node;
      if (own[i]) {
        const auto [first, fresh] = stiffener_at.try_emplace(a.node, a.end);
        if (!fresh) turning = first->second, own[i].reset();
      }
      add_arm_equations(model, a.end, a.node, turning, a.at, own[i]);
      continue;
    }
    const auto [it, fresh] = spiders.try_emplace(a.node, model.spiders.size());
    if (fresh) {
      Spider s;
      s.name = fmt::format("beams of {}", model.node_label(a.node));
      s.reference = a.node;
      s.source = a.at;
      model.spiders.push_back(std::move(s));
    }
    model.spiders[it->second].nodes.push_back(a.end);
  }
  note_stiffeners(model, static_cast<int>(stiffener_at.size()));
}

}  // namespace floatframe
