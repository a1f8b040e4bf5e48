#include "floatframe/decks/rigid_arms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
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
  for (const FeElement& e : model.elements) {
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
  for (const FeElement& e : model.elements) {
    if (!is_beam(e.type)) continue;
    BeamOnNodes beam;
    const BeamSection& section = model.sections[e.section];
    beam.holds = section.Iy > 0.0 && section.Iz > 0.0;
    for (int k = 0; k < element_nodes(e.type); ++k) {
      beam.nodes[k] = at[e.nodes[k]];
      beam.offset |= at[e.nodes[k]] != e.nodes[k];
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

}  // namespace floatframe
