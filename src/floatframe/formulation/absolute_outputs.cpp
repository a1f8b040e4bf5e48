// The absolute formulation for readers: its motion, energies and counts; not part of the step's
// inner loop.
#include <cassert>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {

void AbsoluteFormulation::fill_poses(SystemMotion& motion) const noexcept {
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    motion.bodies[i].p_WB = kinematics_.bodies()[i].p_WB;
    motion.bodies[i].v_WB = kinematics_.bodies()[i].v_WB;
  }
}

void AbsoluteFormulation::fill_accelerations(SystemMotion& motion) const noexcept {
  const VecX& a = kinematics_.accelerations();
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const AbsoluteBody& b = kinematics_.bodies()[i];
    BodyKinematics& x = motion.bodies[i];
    x.a_WB = a.segment<3>(b.offset);
    x.alpha_WB.setZero();
    for (int c = 0; c < 3; ++c)  // of (4): Adot x Adot is zero
      x.alpha_WB += 0.5 * b.A.col(c).cross(a.segment<3>(b.axis(c)));
  }
  for (std::size_t k = 0; k < motion.markers.size(); ++k) {
    const int marker = static_cast<int>(k);
    motion.marker_accelerations[k] = kinematics_.point_acceleration(marker);
    motion.marker_angular_accelerations[k] = kinematics_.acceleration_of(marker).angular;
  }
}

double AbsoluteFormulation::body_kinetic_energy(int i) const noexcept {
  const AbsoluteBody& b = kinematics_.bodies()[i];
  const MatX& M = terms_[i].M;
  const auto rate = [&](Eigen::Index k) {
    return k < 3 ? b.v_WB[k] : k < 12 ? b.Adot((k - 3) % 3, (k - 3) / 3) : b.yd[k - 12];
  };
  double sum = 0.0;
  for (Eigen::Index k = 0; k < M.cols(); ++k)
    for (Eigen::Index l = 0; l < M.rows(); ++l) sum += 0.5 * rate(k) * M(l, k) * rate(l);
  return sum;
}

void AbsoluteFormulation::fill_momenta(int i, BodyKinematics& x) const noexcept {
  const AbsoluteBody& b = kinematics_.bodies()[i];
  const MatX& M = terms_[i].M;
  const auto momentum = [&](Eigen::Index k) {  // of the coordinates k to k + 2
    Vec3 h = M.block<3, 3>(k, 0) * b.v_WB;
    for (int c = 0; c < 3; ++c) h += M.block<3, 3>(k, 3 + 3 * c) * b.Adot.col(c);
    for (int j = 0; j < b.nm; ++j) h += M.block<3, 1>(k, 12 + j) * b.yd[j];
    return h;
  };
  x.momentum = momentum(0);
  x.angular_momentum = x.p_WB.cross(x.momentum);
  for (int c = 0; c < 3; ++c) x.angular_momentum += b.A.col(c).cross(momentum(3 + 3 * c));
}

double AbsoluteFormulation::kinetic_energy(const VecX& v) noexcept {
  assert(calls_.has(CallOrder::positions) && v.size() == velocities());
  double sum = 0.0;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const AbsoluteBody& b = kinematics_.bodies()[i];
    BodyTerms& t = terms_[i];
    t.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), t.M, t.Qv);
    const auto x = v.segment(b.offset, 12 + b.nm);
    for (Eigen::Index k = 0; k < x.size(); ++k) sum += 0.5 * x[k] * t.M.col(k).dot(x);
  }
  return sum;
}

BodyCoordinates AbsoluteFormulation::body_coordinates(int body) const {
  assert(is_index(body, kinematics_.bodies()));
  const AbsoluteBody& b = kinematics_.bodies()[body];
  return {b.offset, b.size(), b.offset + 12, b.offset, b.size(), b.offset + 12, -1};
}

SparseRowMatrix AbsoluteFormulation::constraint_rows() {
  assert(calls_.has(CallOrder::velocities));
  // A row involves two of many bodies: only their coordinates are processed.
  SparseRowMatrix J(constraints(), velocities());
  std::vector<Eigen::Triplet<double>> entries;
  VecX row = VecX::Zero(velocities());
  const auto keep = [&](int i, int body) {
    if (body < 0) return;
    const AbsoluteBody& b = kinematics_.bodies()[body];
    for (int k = b.offset; k < b.offset + b.size(); ++k) {
      if (row[k] != 0.0) entries.emplace_back(i, k, row[k]);
      row[k] = 0.0;
    }
  };
  VecX w = VecX::Zero(constraints());
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const AbsoluteBody& b = kinematics_.bodies()[k];
    for (int i = b.row; i < b.row + b.rows(); ++i) {
      w[i] = 1.0;
      kinematics_.add_own_forces(b, w, row);
      w[i] = 0.0;
      keep(i, static_cast<int>(k));
    }
  }
  const std::vector<ConstraintPart>& parts = constraint_set_.parts();
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (int r = 0; r < parts[k].rows(); ++r) {
      const int i = constraint_set_.offset(k) + r;
      w[i] = 1.0;
      const WrenchRow g = constraint_set_.wrench(k, w);
      w[i] = 0.0;
      kinematics_.add_wrench(parts[k].a, true, g.a.F, g.a.T, row);
      kinematics_.add_wrench(parts[k].b, true, g.b.F, g.b.T, row);
      const int a = model_.markers[parts[k].a].body, b = model_.markers[parts[k].b].body;
      keep(i, a);
      if (b != a) keep(i, b);
    }
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

VecX AbsoluteFormulation::mass_diagonal() const {
  assert(calls_.has_masses());
  VecX diagonal = VecX::Zero(velocities());
  for (std::size_t i = 0; i < terms_.size(); ++i)
    diagonal.segment(kinematics_.bodies()[i].offset, terms_[i].M.rows()) = terms_[i].M.diagonal();
  return diagonal;
}

MatX AbsoluteFormulation::mass_matrix() const {
  assert(calls_.has_masses());
  MatX M = MatX::Zero(velocities(), velocities());
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const int at = kinematics_.bodies()[i].offset;
    M.block(at, at, terms_[i].M.rows(), terms_[i].M.cols()) = terms_[i].M;
  }
  return M;
}

}  // namespace floatframe
