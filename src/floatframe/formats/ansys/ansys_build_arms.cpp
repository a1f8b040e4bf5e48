// Beams whose centroid is not at their nodes (SECOFFSET): an end is a node of its own, tied
// rigidly: u' = u + theta x d, theta' = theta.
#include "floatframe/formats/ansys/ansys_build.hpp"

namespace floatframe {
namespace {

void ansys_arm_equations(const AnsysArm& a, FeModel& model) {
  for (int k = 0; k < 3; ++k) {
    LinearEquation move, turn;
    move.source = turn.source = a.at;
    turn.terms = {{a.fresh, 3 + k, 1.0}, {a.node, 3 + k, -1.0}};
    move.terms = {{a.fresh, k, 1.0}, {a.node, k, -1.0}};
    const Vec3 lever = a.arm.cross(Vec3::Unit(k));  // e_k . (theta x d) = theta . (d x e_k)
    for (int i = 0; i < 3; ++i)
      if (lever(i) != 0.0) move.terms.push_back({a.node, 3 + i, -lever(i)});
    model.equations.push_back(std::move(move));
    model.equations.push_back(std::move(turn));
  }
}

}  // namespace

int ansys_arm_node(AnsysBuild& b, int node, const Vec3& arm, const FeSource& at) {
  const auto [it, fresh] = b.arm_nodes.try_emplace({double(node), arm(0), arm(1), arm(2)}, -1);
  if (fresh) {
    it->second = b.add_node(b.model.positions[node] + arm, at);
    b.arms.push_back({it->second, node, arm, at});
  }
  return it->second;
}

/// Nodes with rotations by equations; to others a spider gives them.
void build_ansys_arms(AnsysBuild& b) {
  const std::vector<char> rotates = b.nodes_with_rotations();
  std::map<int, std::size_t> spiders;
  for (const AnsysArm& a : b.arms) {
    if (rotates[a.node] != 0) {
      ansys_arm_equations(a, b.model);
      continue;
    }
    const auto [it, fresh] = spiders.try_emplace(a.node, b.model.spiders.size());
    if (fresh) {
      Spider s;
      s.name = "beams of node " + std::to_string(b.model.node_ids[a.node]);
      s.reference = a.node;
      s.source = a.at;
      b.model.spiders.push_back(std::move(s));
    }
    b.model.spiders[it->second].nodes.push_back(a.fresh);
  }
}

}  // namespace floatframe
