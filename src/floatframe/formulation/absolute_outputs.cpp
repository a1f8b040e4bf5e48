// The absolute formulation for readers: its motion, energies and counts; not part of the step's
// inner loop.
#include <cassert>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {

void AbsoluteFormulation::fill_poses(SystemMotion& motion) const noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    motion.bodies[i].p_WB = bodies_[i].p_WB;
    motion.bodies[i].v_WB = bodies_[i].v_WB;
  }
}

void AbsoluteFormulation::fill_accelerations(SystemMotion& motion) const noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyData& b = bodies_[i];
    BodyKinematics& x = motion.bodies[i];
    x.a_WB = a_.segment<3>(b.offset);
    x.alpha_WB.setZero();
    for (int c = 0; c < 3; ++c)  // of (4): Adot x Adot is zero
      x.alpha_WB += 0.5 * b.A.col(c).cross(a_.segment<3>(b.offset + 3 + 3 * c));
  }
  for (std::size_t k = 0; k < motion.markers.size(); ++k)
    motion.marker_accelerations[k] = marker_acceleration(static_cast<int>(k));
}

double AbsoluteFormulation::body_kinetic_energy(int i) const noexcept {
  const BodyData& b = bodies_[i];
  const auto rate = [&](Eigen::Index k) {
    return k < 3 ? b.v_WB[k] : k < 12 ? b.Adot((k - 3) % 3, (k - 3) / 3) : b.yd[k - 12];
  };
  double sum = 0.0;
  for (Eigen::Index k = 0; k < b.M.cols(); ++k)
    for (Eigen::Index l = 0; l < b.M.rows(); ++l) sum += 0.5 * rate(k) * b.M(l, k) * rate(l);
  return sum;
}

double AbsoluteFormulation::kinetic_energy(const VecX& v) noexcept {
  assert(calls_.has(CallOrder::positions) && v.size() == nq_);
  double sum = 0.0;
  for (BodyData& b : bodies_) {
    b.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), b.M, b.Qv);
    const auto x = v.segment(b.offset, 12 + b.nm);
    for (Eigen::Index k = 0; k < x.size(); ++k) sum += 0.5 * x[k] * b.M.col(k).dot(x);
  }
  return sum;
}

BodyCoordinates AbsoluteFormulation::body_coordinates(int body) const {
  assert(is_index(body, bodies_));
  const BodyData& b = bodies_[body];
  return {b.offset, b.size(), b.offset + 12, b.offset, b.size(), b.offset + 12, -1};
}

std::string AbsoluteFormulation::coordinate_owner(int i) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const BodyData& b = bodies_[k];
    if (i < b.offset || i >= b.offset + b.size()) continue;
    const int j = i - b.offset;
    const std::string name = "body '" + model_.bodies[k].name + "'";
    if (j < 12) return name;
    if (j < 12 + b.nm) return "mode " + std::to_string(j - 11) + " of " + name;
    return "outer point " + std::to_string((j - 12 - b.nm) / 3 + 1) + " of " + name;
  }
  return "coordinate " + std::to_string(i);
}

SparseRowMatrix AbsoluteFormulation::constraint_rows() {
  assert(calls_.has(CallOrder::velocities));
  // A row involves two of many bodies: only their coordinates are processed.
  SparseRowMatrix J(constraints(), nq_);
  std::vector<Eigen::Triplet<double>> entries;
  VecX row = VecX::Zero(nq_);
  const auto keep = [&](int i, int body) {
    if (body < 0) return;
    const BodyData& b = bodies_[body];
    for (int k = b.offset; k < b.offset + b.size(); ++k) {
      if (row[k] != 0.0) entries.emplace_back(i, k, row[k]);
      row[k] = 0.0;
    }
  };
  VecX w = VecX::Zero(constraints());
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    for (int i = bodies_[k].row; i < bodies_[k].row + bodies_[k].rows(); ++i) {
      w[i] = 1.0;
      add_own_constraint_forces(bodies_[k], w, row);
      w[i] = 0.0;
      keep(i, static_cast<int>(k));
    }
  const std::vector<ConstraintPart>& parts = constraint_set_.parts();
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (int r = 0; r < parts[k].rows(); ++r) {
      const int i = constraint_set_.offset(k) + r;
      w[i] = 1.0;
      const WrenchRow g = constraint_set_.wrench(k, w);
      w[i] = 0.0;
      add_wrench(parts[k].a, true, g.Fa, g.Ta, row);
      add_wrench(parts[k].b, true, g.Fb, g.Tb, row);
      const int a = model_.markers[parts[k].a].body, b = model_.markers[parts[k].b].body;
      keep(i, a);
      if (b != a) keep(i, b);
    }
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

CoordinateCounts AbsoluteFormulation::counts() const {
  CoordinateCounts c;
  for (const BodyData& b : bodies_) {
    c.rigid += 12 + 3 * b.points;
    c.elastic += b.nm;
  }
  c.total = c.rigid + c.elastic;
  c.constraints = constraints();
  return c;
}

VecX AbsoluteFormulation::mass_diagonal() const {
  assert(calls_.has_masses());
  VecX diagonal = VecX::Zero(nq_);
  for (const BodyData& b : bodies_) diagonal.segment(b.offset, 12 + b.nm) = b.M.diagonal();
  return diagonal;
}

MatX AbsoluteFormulation::mass_matrix() const {
  assert(calls_.has_masses());
  MatX M = MatX::Zero(nq_, nq_);
  for (const BodyData& b : bodies_) M.block(b.offset, b.offset, 12 + b.nm, 12 + b.nm) = b.M;
  return M;
}

}  // namespace floatframe
