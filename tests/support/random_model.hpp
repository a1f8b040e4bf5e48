#pragma once
// Random flexible and rigid bodies, systems of them, and states, for tests that run over every
// joint type. Modes are random numbers, not the shapes of any structure: nothing in the
// formulations may depend on more than the invariants and the modal rows of the nodes.
#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {

/// Every joint of the library's list.
inline constexpr auto all_joint_types = std::to_array(joint_types);

inline std::string node_name(int k) {
  std::string name("n");
  name += std::to_string(k);
  return name;
}

/// Point masses on random nodes with random modal translations and rotations; invariants and
/// projection data describe the same masses. K is positive definite.
inline FlexibleBody random_flexible_body(Random& random, int modes, int nodes = 6) {
  FlexibleBody f;
  f.invariants = InertiaInvariants::zero(modes);
  auto projection = std::make_shared<ProjectionData>();
  projection->p = Mat3X::Zero(3, nodes);
  projection->X = MatX::Zero(3 * nodes, modes);
  projection->M_s.resize(nodes, nodes);
  InertiaInvariants& v = f.invariants;
  for (int k = 0; k < nodes; ++k) {
    ModalNode n;
    n.name = node_name(k);
    n.p = random.vec3(0.6);
    n.X = random.matrix(3, modes, 0.4);
    n.X_theta = random.matrix(3, modes, 0.8);
    const double m = random(0.5, 2.0);
    v.m += m;
    v.m_u += m * n.p;
    v.P_u += m * n.p * n.p.transpose();
    v.S += m * n.X;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      v.Si[i] += m * n.p[row] * n.X;
      for (std::size_t j = 0; j < 3; ++j)
        v.Sij[i][j] += m * n.X.row(row).transpose() * n.X.row(static_cast<Eigen::Index>(j));
    }
    projection->p.col(k) = n.p;
    projection->X.middleRows<3>(3 * k) = n.X;
    projection->M_s.insert(k, k) = m;
    f.nodes.push_back(n);
  }
  projection->M_s.makeCompressed();
  f.projection = projection;
  const MatX a = random.matrix(modes, modes);
  f.K = 50.0 * (a * a.transpose() + MatX::Identity(modes, modes));
  f.D = MatX::Zero(modes, modes);
  return f;
}

inline RigidDescription random_rigid_body(Random& random) {
  RigidDescription r;
  r.mass = random(0.5, 2.0);
  r.p_BC = random.vec3(0.3);
  const Mat3 A = random.rotation();
  r.J_C = A * Vec3(0.11, 0.13, 0.19).asDiagonal() * A.transpose();
  return r;
}

/// Builds a description body by body; nodes and points are taken in turn.
struct RandomSystem {
  Random random;
  ModelDescription d;
  explicit RandomSystem(unsigned seed) : random(seed) { d.gravity = Vec3(0.4, -0.7, -9.6); }

  void add_body(const std::string& name, int modes) {
    BodyDescription b;
    b.name = name;
    b.X_WB = {random.vec3(1.5), random.rotation()};
    if (modes > 0)
      b.kind = random_flexible_body(random, modes);
    else
      b.kind = random_rigid_body(random);
    d.bodies.push_back(std::move(b));
  }
  /// Node k of a flexible body, a random point of a rigid one or of the ground.
  AttachmentDescription at(const std::string& name, int k) {
    AttachmentDescription a;
    a.body = name;
    for (const BodyDescription& b : d.bodies)
      if (b.name == name && std::holds_alternative<FlexibleBody>(b.kind))
        a.node = node_name(k);
      else if (b.name == name)
        a.point = b.X_WB * random.vec3(0.5);
    if (name == ground_name) a.point = random.vec3(1.5);
    return a;
  }
  JointDescription& add_joint(const std::string& name, JointType type, const std::string& parent,
                              int parent_node, const std::string& child, int child_node) {
    JointDescription j;
    j.name = name;
    j.type = type;
    j.parent = at(parent, parent_node);
    j.child = at(child, child_node);
    j.axis = random.vec3();
    j.axis_2 = random.vec3();
    d.joints.push_back(std::move(j));
    return d.joints.back();
  }
};

/// A configuration away from the start and random velocities.
inline void random_configuration(RelativeFormulation& f, Random& random, VecX& q, VecX& v) {
  VecX q0;
  f.start(q0, v);
  q = q0;
  VecX x = random.vector(f.velocities(), 0.7);
  const std::vector<bool> elastic = f.tree().elastic_coordinates();
  for (int i = 0; i < x.size(); ++i)
    if (elastic[i]) x[i] *= 0.3;
  f.retract(q0, x, q);
  v = random.vector(f.velocities(), 1.5);
}

/// d(absolute velocities)/d(relative velocities) at q.
inline MatX velocity_map(RelativeFormulation& tree, AbsoluteFormulation& absolute, const VecX& q) {
  MatX T(absolute.velocities(), tree.velocities());
  VecX qa, va;
  for (int j = 0; j < tree.velocities(); ++j) {
    absolute.start_from(tree, q, VecX::Unit(tree.velocities(), j), qa, va);
    T.col(j) = va;
  }
  return T;
}

/// Absolute accelerations of the motion with relative accelerations a: central difference of the
/// absolute velocities along it.
inline VecX absolute_accelerations(RelativeFormulation& tree, AbsoluteFormulation& absolute,
                                   const VecX& q, const VecX& v, const VecX& a, double dt = 1e-5) {
  VecX q1 = q, qa, plus, minus;
  tree.retract(q, dt * v + 0.5 * dt * dt * a, q1);
  absolute.start_from(tree, q1, v + dt * a, qa, plus);
  tree.retract(q, -dt * v + 0.5 * dt * dt * a, q1);
  absolute.start_from(tree, q1, v - dt * a, qa, minus);
  return (plus - minus) / (2.0 * dt);
}

/// Orthonormal columns: the increments that keep the constraints which the formulation holds
/// exactly, a body's own in absolute coordinates; their rows stand first. After `evaluate_at`.
template <class F>
MatX free_directions(F& f) {
  const int n = f.velocities();
  if constexpr (std::is_same_v<F, AbsoluteFormulation>) {
    int own = 0;
    for (const AbsoluteBody& b : f.kinematics().bodies()) own += b.rows();
    const MatX kernel = f.constraint_jacobian().topRows(own).fullPivLu().kernel();
    return kernel.householderQr().householderQ() * MatX::Identity(n, kernel.cols());
  }
  return MatX::Identity(n, n);
}

/// Positions and velocities in one call.
template <class F>
void evaluate_at(F& f, double t, const VecX& q, const VecX& v) {
  f.positions(t, q);
  f.velocities(v);
}

inline double largest(const MatX& x) { return x.size() == 0 ? 0.0 : x.cwiseAbs().maxCoeff(); }

/// Both formulations of a model in the same random configuration.
struct RandomPair {
  RandomPair(const Model& m, unsigned seed, InertiaMethod inertia = InertiaMethod::preprocessing)
      : relative(m, inertia), absolute(m, inertia), random(seed) {
    random_configuration(relative, random, q, v);
    absolute.start_from(relative, q, v, qa, va);
  }

  RelativeFormulation relative;
  AbsoluteFormulation absolute;
  Random random;
  VecX q, v, qa, va;
};

}  // namespace floatframe::test
