// The spanning tree: which joints are cut, automatic free joints, order of the links.
#include "floatframe/model/topology.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/random_count.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

std::set<std::string> cut_names(const Model& m) {
  std::set<std::string> names;
  for (const int j : find_topology(m).cut_joints) names.insert(m.joints[j].name);
  return names;
}

RandomSystem with_bodies(const std::vector<std::string>& names) {
  RandomSystem s(5);
  for (const std::string& n : names) s.add_body(n, 0);
  return s;
}

/// One corner of a vehicle: arm and knuckle, track rod, leaf spring carried by the chassis.
RandomSystem corner() {
  RandomSystem s = with_bodies({"chassis", "arm", "knuckle", "track_rod", "rack"});
  s.add_joint("arm_hinge", JointType::revolute, "chassis", 0, "arm", 0);
  s.add_joint("ball", JointType::spherical, "arm", 0, "knuckle", 0);
  s.add_joint("rack_slide", JointType::prismatic, "chassis", 0, "rack", 0);
  s.add_joint("rod_inner", JointType::universal, "rack", 0, "track_rod", 0);
  s.add_joint("rod_outer", JointType::spherical, "knuckle", 0, "track_rod", 0);
  return s;
}

void expect_tree(const Model& m) {
  const Topology t = find_topology(m);
  EXPECT_EQ(t.links.size(), m.bodies.size());
  std::set<int> seen{-1};
  for (const Topology::Link& l : t.links) {
    EXPECT_TRUE(seen.count(l.parent)) << "parents come before children";
    EXPECT_TRUE(seen.insert(l.body).second) << "every body once";
    const Joint& j = m.joints[l.joint];
    EXPECT_EQ(l.reversed ? j.parent : j.child, l.body);
    EXPECT_EQ(l.reversed ? j.child : j.parent, l.parent);
  }
}

TEST(Topology, SuspensionLoopIsCutAtItsFreestJoint) {
  const Model m = build_model(corner().d);
  expect_tree(m);
  EXPECT_EQ(m.joints.back().name, "chassis.free");
  EXPECT_TRUE(m.joints.back().automatic);
  // Revolute, prismatic and universal enter the tree before the two ball joints. From then on the
  // first ball in the file has the shorter or equal chain and wins; the other closes the loop.
  EXPECT_EQ(cut_names(m), std::set<std::string>{"rod_outer"});
}

/// The definition, word by word: of all joints that lead to a new body the best, again and again.
std::vector<int> joints_of_tree(const Model& m) {
  std::vector<int> depth(m.bodies.size(), -1), tree;
  const auto of = [&](int body) { return body < 0 ? 0 : depth[body]; };
  for (;;) {
    int best = -1;
    std::pair<int, int> best_key{7, 0};
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      const Joint& joint = m.joints[j];
      const int p = of(joint.parent), c = of(joint.child);
      const std::pair<int, int> key{joint_velocities(joint.type), std::max(p, c)};
      if (joint.cut || (p < 0) == (c < 0) || !(key < best_key)) continue;
      best_key = key;
      best = static_cast<int>(j);
    }
    if (best < 0) return tree;
    const Joint& joint = m.joints[best];
    const int end = of(joint.parent) < 0 ? joint.parent : joint.child;
    depth[end] = best_key.second + 1;
    tree.push_back(best);
  }
}

TEST(Topology, IsThatOfTheDefinition) {
  const int count = random_count();
  for (int seed = 0; seed < count; ++seed) {
    Random random(static_cast<unsigned>(seed));
    const auto whole = [&](int most) {
      return std::min(static_cast<int>(random(0.0, most + 1.0)), most);
    };
    std::vector<std::string> names;
    for (int k = 0; k < 8; ++k) names.push_back("b" + std::to_string(k));
    RandomSystem s = with_bodies(names);
    for (int k = 0; k < 14; ++k) {
      const int child = whole(7), parent = whole(8);
      if (parent == child) continue;
      s.add_joint("j" + std::to_string(k), all_joint_types[whole(6)],
                  parent == 8 ? ground_name : names[parent], 0, names[child], 0)
          .cut = whole(5) == 0;
    }
    const Model m = build_model(s.d);
    expect_tree(m);
    std::vector<int> joints;
    for (const Topology::Link& l : find_topology(m).links) joints.push_back(l.joint);
    EXPECT_EQ(joints, joints_of_tree(m)) << seed;
  }
}

TEST(Topology, NamedCutsStayOutOfTheTree) {
  RandomSystem s = corner();
  s.d.joints[1].cut = true;
  const Model m = build_model(s.d);
  expect_tree(m);
  EXPECT_EQ(cut_names(m), std::set<std::string>{"ball"});
  for (const Topology::Link& l : find_topology(m).links)
    if (m.joints[l.joint].name == "rod_outer") {
      EXPECT_TRUE(l.reversed);
    }
}

TEST(Topology, FourBarLoopTakesTheShorterChain) {
  RandomSystem s = with_bodies({"crank", "coupler", "rocker"});
  s.add_joint("a", JointType::revolute, ground_name, 0, "crank", 0);
  s.add_joint("b", JointType::revolute, "crank", 0, "coupler", 0);
  s.add_joint("c", JointType::revolute, "coupler", 0, "rocker", 0);
  s.add_joint("d", JointType::revolute, ground_name, 0, "rocker", 0);
  const Model m = build_model(s.d);
  expect_tree(m);
  EXPECT_EQ(cut_names(m), std::set<std::string>{"c"});
}

TEST(Topology, DisconnectedBodiesHangFromTheGroundByFreeJoints) {
  RandomSystem s = with_bodies({"alone", "first", "second", "grounded"});
  s.add_joint("pair", JointType::spherical, "first", 0, "second", 0);
  s.add_joint("hinge", JointType::revolute, ground_name, 0, "grounded", 0);
  const Model m = build_model(s.d);
  expect_tree(m);
  std::vector<std::string> automatic;
  for (const Joint& j : m.joints)
    if (j.automatic) automatic.push_back(j.name);
  EXPECT_EQ(automatic, (std::vector<std::string>{"alone.free", "first.free"}));
  EXPECT_TRUE(cut_names(m).empty());
}

TEST(Topology, AutomaticFreeJointStartsInTheDesignPose) {
  RandomSystem s = with_bodies({"alone"});
  const Model m = build_model(s.d);
  RelativeFormulation f(m, InertiaMethod::preprocessing);
  VecX q, v;
  f.start(q, v);
  kinematics_at(f, 0.0, q, v);
  EXPECT_LT((f.motion().body(0).p_WB - m.bodies[0].X_WB.p).norm(), 1e-15);
  EXPECT_LT(largest(f.motion().body(0).R_WB - m.bodies[0].X_WB.R), 1e-15);
}

TEST(Topology, CutAloneLeavesTheBodyFree) {
  RandomSystem s = with_bodies({"body"});
  s.add_joint("hinge", JointType::revolute, ground_name, 0, "body", 0).cut = true;
  const Model m = build_model(s.d);
  expect_tree(m);
  EXPECT_EQ(cut_names(m), std::set<std::string>{"hinge"});
  EXPECT_EQ(RelativeFormulation(m, InertiaMethod::preprocessing).velocities(), 6);
}

TEST(Topology, FreeJointsBetweenBodiesAreNeverCutRows) {
  RandomSystem s = with_bodies({"a", "b"});
  s.add_joint("hinge_a", JointType::revolute, ground_name, 0, "a", 0);
  s.add_joint("hinge_b", JointType::revolute, ground_name, 0, "b", 0);
  s.add_joint("measure", JointType::free, "a", 0, "b", 0);
  const Model m = build_model(s.d);
  expect_tree(m);
  EXPECT_TRUE(cut_names(m).empty());
}

}  // namespace
}  // namespace floatframe::test
