// Access to the relative formulation for outputs, energies and counts; not part of the step's inner
// loop.
#include "floatframe/formulation/composite_diagonal.hpp"
#include "floatframe/formulation/relative.hpp"

namespace floatframe {

Vec3 RelativeFormulation::body_velocity(int i) const noexcept {
  const TreeBody& b = tree_.body(i);
  return b.Z.head<3>() + b.w_WB.cross(b.p_OB);
}

PointMotion RelativeFormulation::body_acceleration(int i) const noexcept {
  const TreeBody& b = tree_.body(i);
  const Vec6 z = b.Zdot + b.Zdot_0;
  PointMotion x;
  x.angular = z.tail<3>();
  x.linear =
      z.head<3>() + x.angular.cross(b.p_OB) + b.w_WB.cross(b.w_WB.cross(b.p_OB)) + model_.gravity;
  return x;
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

VecX RelativeFormulation::mass_diagonal() const {
  return composite_diagonal(
      tree_, [this](int i) -> const MatX& { return terms_[static_cast<std::size_t>(i)].M; });
}

double RelativeFormulation::body_gravity_energy(int i) const noexcept {
  const TreeBody& b = tree_.body(i);
  const BodyInertia& inertia = terms_[i].inertia;
  const Vec3 m_bar = inertia.static_moment(b.y.data());
  return -model_.gravity.dot(inertia.data().m * (tree_.origin() + b.p_OB) + b.R_WB * m_bar);
}

double RelativeFormulation::body_elastic_energy(int i) const noexcept {
  const TreeBody& b = tree_.body(i);
  const MatX& K = model_.bodies[i].data->K;
  double sum = 0.0;
  for (int k = 0; k < b.nm; ++k) sum += 0.5 * b.y[k] * K.col(k).dot(b.y);
  return sum;
}

double RelativeFormulation::kinetic_energy(const VecX& v) noexcept {
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

double RelativeFormulation::gravity_energy(const VecX& q) const noexcept {
  double sum = 0.0;
  for (const int i : tree_.order()) {
    const TreeBody& b = tree_.body(i);
    const BodyInertia& inertia = terms_[i].inertia;
    const Vec3 m_bar = inertia.static_moment(q.data() + b.iyq);
    sum -= model_.gravity.dot(inertia.data().m * (tree_.origin() + b.p_OB) + b.R_WB * m_bar);
  }
  return sum;
}

double RelativeFormulation::elastic_energy(const VecX& q) const noexcept {
  double sum = 0.0;
  for (const int i : tree_.order()) {
    const TreeBody& b = tree_.body(i);
    const MatX& K = model_.bodies[i].data->K;
    for (int k = 0; k < b.nm; ++k) sum += 0.5 * q[b.iyq + k] * K.col(k).dot(q.segment(b.iyq, b.nm));
  }
  return sum;
}

double RelativeFormulation::modal_damping_power(const VecX& v) const noexcept {
  double sum = 0.0;
  for (const int i : tree_.order()) {
    const TreeBody& b = tree_.body(i);
    const MatX& D = model_.bodies[i].data->D;
    const double* rate = v.data() + b.iy;
    for (int k = 0; k < b.nm; ++k)
      for (int l = 0; l < b.nm; ++l) sum += rate[k] * D(l, k) * rate[l];
  }
  return sum;
}

void RelativeFormulation::tree_joint_wrench(int joint, Vec3& force, Vec3& torque) const noexcept {
  force.setZero();
  torque.setZero();
  const int i = tree_.body_of_joint(joint);
  if (i < 0) return;
  const TreeBody& b = tree_.body(i);
  const Vec6 h = wrenches_[i].head<6>();
  const double sign = b.reversed ? -1.0 : 1.0;  // on the child of the joint as described
  const Vec3& r = tree_.marker(model_.joints[joint].frame_M).s.r;
  force = sign * h.head<3>();
  torque = sign * (h.tail<3>() - r.cross(h.head<3>()));
}

double RelativeFormulation::total_mass() const noexcept {
  double m = 0.0;
  for (const BodyTerms& t : terms_) m += t.inertia.data().m;
  return m;
}

CoordinateCounts RelativeFormulation::counts() const {
  CoordinateCounts c;
  for (const TreeBody& b : tree_.bodies()) {
    c.rigid += b.nj;
    c.elastic += b.nm;
  }
  c.total = c.rigid + c.elastic;
  c.constraints = constraints();
  return c;
}

}  // namespace floatframe
