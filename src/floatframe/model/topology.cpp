#include "floatframe/model/topology.hpp"

#include <functional>
#include <queue>
#include <tuple>

#include "floatframe/model/joint_motion.hpp"

namespace floatframe {

Topology find_topology(const Model& model) {
  const std::size_t n = model.bodies.size();
  Topology t;
  std::vector<int> depth(n, -1);
  const auto depth_of = [&](int body) { return body < 0 ? 0 : depth[body]; };
  std::vector<std::vector<int>> joints_of(n);  // that may be in the tree
  // Joints with one end in the tree: coordinates, depth of that end, place in the list.
  std::priority_queue<std::tuple<int, int, int>, std::vector<std::tuple<int, int, int>>,
                      std::greater<>>
      open;
  const auto offer = [&](int j) {
    const Joint& joint = model.joints[j];
    const int dp = depth_of(joint.parent), dc = depth_of(joint.child);
    if ((dp < 0) == (dc < 0)) return;  // both reached or neither
    open.emplace(joint_velocities(joint.type), dp < 0 ? dc : dp, j);
  };
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    if (joint.cut) continue;
    for (const int body : {joint.parent, joint.child})
      if (body >= 0) joints_of[body].push_back(static_cast<int>(j));
    offer(static_cast<int>(j));
  }
  std::vector<char> used(model.joints.size(), 0);
  while (!open.empty()) {  // build_model adds free joints, so every body is reached
    const int j = std::get<2>(open.top());
    open.pop();
    const Joint& joint = model.joints[j];
    const bool reversed = depth_of(joint.parent) < 0;
    const int body = reversed ? joint.parent : joint.child;
    const int parent = reversed ? joint.child : joint.parent;
    if (depth_of(body) >= 0) continue;  // reached by another joint already
    used[j] = 1;
    depth[body] = depth_of(parent) + 1;
    t.links.push_back({body, j, parent, reversed});
    for (const int other : joints_of[body]) offer(other);
  }
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (!used[j] && joint_velocities(model.joints[j].type) < 6)
      t.cut_joints.push_back(static_cast<int>(j));
  return t;
}

}  // namespace floatframe
