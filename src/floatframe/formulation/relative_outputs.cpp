// What outputs, energies and counts take from the relative formulation; not part of the step's
// inner loop.
#include "floatframe/formulation/relative.hpp"

namespace floatframe {

Vec3 RelativeFormulation::marker_acceleration(int index) const noexcept {
  const MarkerData& m = markers_[index];
  Vec3 a = m.s.a_bias + model_.gravity;  // the ground accelerates with -g in this formulation
  if (m.body < 0) return a;
  const BodyData& b = body(m.body);
  a += b.Zdot.head<3>() + b.Zdot.tail<3>().cross(m.s.r);
  if (m.local) a.noalias() += m.Jr * b.ydd;
  return a;
}

Vec3 RelativeFormulation::body_position(int i) const noexcept { return origin_ + body(i).r0; }
const Mat3& RelativeFormulation::body_rotation(int i) const noexcept { return body(i).A; }
Vec3 RelativeFormulation::body_angular_velocity(int i) const noexcept { return body(i).w; }
Vec3 RelativeFormulation::body_velocity(int i) const noexcept {
  return body(i).Z.head<3>() + body(i).w.cross(body(i).r0);
}
double RelativeFormulation::amplitude(const VecX& q, int i, int mode) const noexcept {
  return q[body(i).iyq + mode];
}
double RelativeFormulation::amplitude_rate(const VecX& v, int i, int mode) const noexcept {
  return v[body(i).iy + mode];
}

double RelativeFormulation::kinetic_energy(const VecX& v) noexcept {
  double sum = 0.0;
  for (const int i : order_) {
    BodyData& b = body(i);
    b.inertia.relative(b.r0, b.A, b.w, b.y.data(), b.yd.data(), b.M, b.Qv);
    b.h.head<6>() = b.Z;
    b.h.tail(b.nm) = v.segment(b.iy, b.nm);
    for (Eigen::Index k = 0; k < b.h.size(); ++k) sum += 0.5 * b.h[k] * b.M.col(k).dot(b.h);
  }
  return sum;
}

double RelativeFormulation::gravity_energy(const VecX& q) const noexcept {
  double sum = 0.0;
  for (const int i : order_) {
    const BodyData& b = body(i);
    const PreprocessingData& d = b.inertia.data();
    Vec3 m_bar = d.m_u;
    for (int k = 0; k < b.nm; ++k) m_bar += d.S.col(k) * q[b.iyq + k];
    sum -= model_.gravity.dot(d.m * (origin_ + b.r0) + b.A * m_bar);
  }
  return sum;
}

double RelativeFormulation::elastic_energy(const VecX& q) const noexcept {
  double sum = 0.0;
  for (const int i : order_) {
    const BodyData& b = body(i);
    const MatX& K = model_.bodies[i].data->K;
    for (int k = 0; k < b.nm; ++k) sum += 0.5 * q[b.iyq + k] * K.col(k).dot(q.segment(b.iyq, b.nm));
  }
  return sum;
}

double RelativeFormulation::modal_damping_power(const VecX& v) const noexcept {
  double sum = 0.0;
  for (const int i : order_) {
    const BodyData& b = body(i);
    const MatX& D = model_.bodies[i].data->D;
    const double* rate = v.data() + b.iy;
    for (int k = 0; k < b.nm; ++k)
      for (int l = 0; l < b.nm; ++l) sum += rate[k] * D(l, k) * rate[l];
  }
  return sum;
}

double RelativeFormulation::motion_power(const VecX& lambda) const noexcept {
  double sum = 0.0;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    sum += lambda[static_cast<Eigen::Index>(r)] * rows_[r].phi_t;
  return sum;
}

int RelativeFormulation::tree_body_of_joint(int joint) const noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].joint == joint) return static_cast<int>(i);
  return -1;
}

void RelativeFormulation::tree_joint_wrench(int joint, Vec3& force, Vec3& torque) const noexcept {
  force.setZero();
  torque.setZero();
  const int i = tree_body_of_joint(joint);
  if (i < 0) return;
  const BodyData& b = body(i);
  const double sign = b.reversed ? -1.0 : 1.0;  // on the joint's own child
  const Vec3& r = markers_[b.frame_M].s.r;
  force = sign * b.wrench.head<3>();
  torque = sign * (b.wrench.tail<3>() - r.cross(b.wrench.head<3>()));
}

bool RelativeFormulation::is_elastic(int i) const noexcept {
  for (const BodyData& b : bodies_)
    if (i >= b.iy && i < b.iy + b.nm) return true;
  return false;
}

std::vector<int> RelativeFormulation::free_translations() const {
  std::vector<int> indices;
  for (const BodyData& b : bodies_)
    if (joint_is_free(b.type) && b.parent < 0)
      indices.insert(indices.end(), {b.iq, b.iq + 1, b.iq + 2});
  return indices;
}

double RelativeFormulation::total_mass() const noexcept {
  double m = 0.0;
  for (const BodyData& b : bodies_) m += b.inertia.data().m;
  return m;
}

std::string RelativeFormulation::coordinate_owner(int i) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const BodyData& b = bodies_[k];
    if (i >= b.iv && i < b.iv + b.nj) return "joint '" + model_.joints[b.joint].name + "'";
    if (i >= b.iy && i < b.iy + b.nm)
      return "mode " + std::to_string(i - b.iy + 1) + " of body '" + model_.bodies[k].name + "'";
  }
  return "coordinate " + std::to_string(i);
}

MatX RelativeFormulation::constraint_jacobian() {
  MatX J = MatX::Zero(nc_, nv_);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Element& e = part_elements_[k];
    if (e.cluster < 0) continue;
    const Cluster& c = clusters_[e.cluster];
    for (int r = 0; r < parts_[k].rows(); ++r) {
      const int row = part_offset_[k] + r;
      fill_gradient(e, rows_[row].gradient, slots_.data());
      for (int j = 0; j < e.width; ++j) {
        const int front = e.first + j;
        // Never touched: the parent's twist, and the rows that fill up the last lanes.
        if ((front >= c.size && front < c.size + 6) || front >= c.n) continue;
        const int column =
            front < c.size ? c.offset + front : body(c.parent).iy + front - c.size - 6;
        J(row, column) = slots_[j];
      }
    }
  }
  return J;
}

double RelativeFormulation::elimination_work() const noexcept {
  double sum = 0.0;
  for (const Cluster& c : clusters_)
    for (int j = 0; j < c.size; ++j) sum += 0.5 * (c.n - j) * (c.n - j + 1);
  return sum;
}

CoordinateCounts RelativeFormulation::counts() const {
  CoordinateCounts c;
  for (const BodyData& b : bodies_) {
    c.rigid += b.nj;
    c.elastic += b.nm;
  }
  c.total = c.rigid + c.elastic;
  c.constraints = nc_;
  return c;
}

}  // namespace floatframe
