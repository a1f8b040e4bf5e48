#pragma once
// The balance of every body by itself: inertia about its frame, gravity, modal stiffness and
// damping, force elements, and what joints, rods and motions transmit, all of it from the motion of
// the body and of its markers. Nothing of the formulation's residual is used.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/model/reactions.hpp"

namespace floatframe::test {

struct BodyBalance {
  double error = 0.0;  ///< largest, relative to the largest force (times the length of the body,
                       ///< of modes times their largest displacement)
  double largest_force = 0.0;  ///< [N]
  std::string body;            ///< with that error
};

/// `f` is at the state with the accelerations that go with the reactions, after `dynamics`.
inline BodyBalance body_balance(const Formulation& f, const Reactions& reactions,
                                InertiaMethod method) {
  const SystemMotion& motion = f.motion({.accelerations = true});
  const Model& model = f.model();
  const std::size_t n = model.bodies.size();
  std::vector<VecX> sum(n);
  double largest = 1e-12;  // [N], of a mechanism that nothing moves
  const auto add = [&](int marker, const Vec3& force, const Vec3& torque) {
    const LocalMarker& m = f.local_marker(marker);
    if (m.body < 0) return;
    const Vec3 arm = motion.body(m.body).R_WB * m.p_B;
    VecX& h = sum[m.body];
    h.head<3>() -= force;
    h.segment<3>(3) -= arm.cross(force) + torque;
    largest = std::max({largest, force.norm(), torque.norm() / model.bodies[m.body].length});
    if (!m.local) return;
    VecX own = m.Jr.transpose() * force;
    if (m.rotates) own += m.Jw.transpose() * torque;
    h.tail(own.size()) -= own;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const BodyKinematics& b = motion.bodies[i];
    const int nm = model.bodies[i].modes();
    BodyInertia inertia(model.bodies[i], method);
    MatX M = MatX::Zero(6 + nm, 6 + nm);
    VecX Qv = VecX::Zero(6 + nm), z(6 + nm);
    inertia.relative(Vec3::Zero(), b.R_WB, b.w_WB, b.y.data(), b.yd.data(), M, Qv);
    z << b.a_WB - model.gravity, b.alpha_WB, b.ydd;
    sum[i] = M * z - Qv;
    if (nm == 0) continue;
    sum[i].tail(nm) += model.bodies[i].data->K * b.y + model.bodies[i].data->D * b.yd;
  }
  for (const VecX& h : sum) largest = std::max(largest, h.head<3>().norm());
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& force = model.elements[k];
    const Efforts& x = motion.efforts[k];
    for (std::size_t i = 0; i < x.markers(); ++i)
      add(force.markers[i], x.wrench[i].F, x.wrench[i].T);
  }
  const auto between = [&](int a, int b, const Reactions::Wrench& w) {
    const Vec3 d = motion.marker(b).r - motion.marker(a).r;
    add(b, w.force, w.torque);
    add(a, -w.force, -(w.torque + d.cross(w.force)));
  };
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    between(model.joints[j].frame_F, model.joints[j].frame_M, reactions.joints[j]);
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    if (const Element& e = model.elements[k]; e.links())
      between(e.markers[0], e.markers[1], reactions.elements[k]);
  // The largest displacement of a mode is what a force does to it at most.
  const auto shape_size = [&](std::size_t body, Eigen::Index mode) {
    double most = 0.0;
    for (const ModalNode& node : model.bodies[body].data->nodes)
      most = std::max({most, node.X.col(mode).norm(),
                       node.X_theta.col(mode).norm() * model.bodies[body].length});
    return most > 0.0 ? most : 1.0;
  };
  BodyBalance balance;
  balance.largest_force = largest;
  for (std::size_t i = 0; i < n; ++i) {
    double error = std::max(sum[i].head<3>().norm() / largest,
                            sum[i].segment<3>(3).norm() / (largest * model.bodies[i].length));
    for (Eigen::Index m = 0; m < sum[i].size() - 6; ++m)
      error = std::max(error, std::abs(sum[i][6 + m]) / (largest * shape_size(i, m)));
    if (!(error <= balance.error)) {
      balance.error = error;
      balance.body = model.bodies[i].name;
    }
  }
  return balance;
}

}  // namespace floatframe::test
