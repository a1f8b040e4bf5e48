#include "floatframe/model/topology.hpp"

#include <tuple>

#include "floatframe/model/joint_motion.hpp"

namespace floatframe {

Topology find_topology(const Model& model) {
  const int n = static_cast<int>(model.bodies.size());
  Topology t;
  std::vector<int> depth(static_cast<std::size_t>(n), -1);
  std::vector<char> used(model.joints.size(), 0);
  const auto depth_of = [&](int body) {
    return body < 0 ? 0 : depth[static_cast<std::size_t>(body)];
  };
  while (static_cast<int>(t.links.size()) < n) {
    int best = -1;
    bool best_reversed = false;
    std::tuple<int, int> best_key{7, 0};
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const Joint& joint = model.joints[j];
      if (used[j] || joint.cut) continue;
      const int dp = depth_of(joint.parent), dc = depth_of(joint.child);
      if ((dp < 0) == (dc < 0)) continue;  // both reached or neither
      const std::tuple<int, int> key{joint_velocities(joint.type), dp < 0 ? dc : dp};
      if (key < best_key) {
        best_key = key;
        best = static_cast<int>(j);
        best_reversed = dp < 0;
      }
    }
    if (best < 0) break;  // build_model adds free joints, so every body is reached
    used[static_cast<std::size_t>(best)] = 1;
    const Joint& joint = model.joints[static_cast<std::size_t>(best)];
    const int body = best_reversed ? joint.parent : joint.child;
    const int parent = best_reversed ? joint.child : joint.parent;
    depth[static_cast<std::size_t>(body)] = depth_of(parent) + 1;
    t.links.push_back({body, best, parent, best_reversed});
  }
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (!used[j] && joint_velocities(model.joints[j].type) < 6)
      t.cut_joints.push_back(static_cast<int>(j));
  return t;
}

}  // namespace floatframe
