// The relative formulation for readers: its motion, energies and counts; not part of the step's
// inner loop.
#include <cassert>

#include "floatframe/formulation/composite_diagonal.hpp"
#include "floatframe/formulation/relative.hpp"

namespace floatframe {

void RelativeFormulation::fill_poses(SystemMotion& motion) const noexcept {
  motion.origin = tree_.origin();
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const TreeBody& b = tree_.body(static_cast<int>(i));
    motion.bodies[i].p_WB = tree_.origin() + b.p_OB;
    motion.bodies[i].v_WB = b.Z.head<3>() + b.w_WB.cross(b.p_OB);
  }
}

void RelativeFormulation::fill_accelerations(SystemMotion& motion) const noexcept {
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const TreeBody& b = tree_.body(static_cast<int>(i));
    const Vec6 z = b.Zdot + b.Zdot_0;
    BodyKinematics& x = motion.bodies[i];
    x.alpha_WB = z.tail<3>();
    x.a_WB = z.head<3>() + x.alpha_WB.cross(b.p_OB) + b.w_WB.cross(b.w_WB.cross(b.p_OB)) +
             model_.gravity;
  }
  for (std::size_t k = 0; k < motion.markers.size(); ++k) {
    const PointMotion x = tree_.acceleration_in_world(static_cast<int>(k));
    motion.marker_accelerations[k] = x.linear;
    motion.marker_angular_accelerations[k] = x.angular;
  }
}

double RelativeFormulation::body_kinetic_energy(int i) const noexcept {
  const TreeBody& b = tree_.body(i);
  const MatX& M = terms_[i].M;
  const auto z = [&](Eigen::Index k) { return k < 6 ? b.Z[k] : b.yd[k - 6]; };
  double sum = 0.0;
  for (Eigen::Index k = 0; k < M.cols(); ++k)
    for (Eigen::Index l = 0; l < M.rows(); ++l) sum += 0.5 * z(k) * M(l, k) * z(l);
  return sum;
}

void RelativeFormulation::fill_momenta(int i, BodyKinematics& x) const noexcept {
  const TreeBody& b = tree_.body(i);
  const MatX& M = terms_[i].M;
  Vec6 h = M.topLeftCorner<6, 6>() * b.Z;  // the second half about the origin of the markers
  for (int j = 0; j < b.nm; ++j) h += M.block<6, 1>(0, 6 + j) * b.yd[j];
  x.momentum = h.head<3>();
  x.angular_momentum = h.tail<3>() + tree_.origin().cross(x.momentum);
}

VecX RelativeFormulation::mass_diagonal() const {
  assert(calls_.has_masses());
  return composite_diagonal(
      tree_, [this](int i) -> const MatX& { return terms_[static_cast<std::size_t>(i)].M; });
}

double RelativeFormulation::kinetic_energy(const VecX& v) noexcept {
  assert(calls_.has(CallOrder::velocities) && v.size() == velocities());
  double sum = 0.0;
  for (const int i : tree_.order()) {
    const TreeBody& b = tree_.body(i);
    BodyTerms& t = terms_[i];
    VecX& z = increments_[i];
    t.inertia.relative(b.p_OB, b.R_WB, b.w_WB, b.y.data(), b.yd.data(), t.M, t.Qv);
    z.head<6>() = b.Z;
    z.tail(b.nm) = v.segment(b.iy, b.nm);
    for (Eigen::Index k = 0; k < z.size(); ++k) sum += 0.5 * z[k] * t.M.col(k).dot(z);
  }
  return sum;
}

void RelativeFormulation::add_tree_wrenches(Reactions& reactions) const noexcept {
  assert(calls_.has(CallOrder::residual) && reactions.joints.size() == model_.joints.size());
  for (std::size_t j = 0; j < reactions.joints.size(); ++j) {
    const int i = tree_.body_of_joint(static_cast<int>(j));
    if (i < 0) continue;
    const Wrench w = tree_wrench(static_cast<int>(j), tree_.body(i));
    reactions.joints[j].force += w.F;
    reactions.joints[j].torque += w.T;
  }
}

BodyCoordinates RelativeFormulation::body_coordinates(int body) const {
  assert(body >= 0 && body < tree_.body_count());
  const TreeBody& b = tree_.body(body);
  return {b.iq, b.iyq - b.iq + b.nm, b.iyq, b.iv, b.nj + b.nm, b.iy, b.parent};
}

}  // namespace floatframe
