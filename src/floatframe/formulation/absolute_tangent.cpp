// Assembles (6) of absolute_tangent.hpp into the fronts of the bodies, and factorises it.
#include "floatframe/formulation/absolute_tangent.hpp"

#include <cassert>

namespace floatframe {

/// B^T of the wrench at a marker: (F, r x F + T, Jr^T F + Jw^T T), r from the body's origin.
void AbsoluteTangent::gradient(int marker, const Vec3& force, const Vec3& torque,
                               Gradient& g) const noexcept {
  assert(marker < std::ssize(markers_));
  g.body = marker < 0 ? -1 : markers_[marker].body;
  if (g.body < 0) return;
  const AbsoluteMarker& m = markers_[marker];
  const AbsoluteBody& b = bodies_[g.body];
  g.z.head<3>() = force;
  g.z.segment<3>(3) = torque + (m.s.r - b.p_WB).cross(force);
  for (int k = 0; k < b.nm; ++k) {
    double x = 0.0;
    if (m.local) x = m.Jr.col(k).dot(force);
    if (m.rotates) x += m.Jw.col(k).dot(torque);
    g.z[6 + k] = x;
  }
}

void AbsoluteTangent::join_gradient(std::size_t i) noexcept {
  Gradient& g = gradients_[i];
  if (g.body < 0) return;
  for (std::size_t k = 0; k < i; ++k) {
    if (gradients_[k].body != g.body) continue;
    const int n = 6 + bodies_[g.body].nm;
    gradients_[k].z.head(n) += g.z.head(n);
    g.body = -1;
    return;
  }
}

void AbsoluteTangent::gradients(std::span<const int> markers, const Wrench* w) noexcept {
  gradient_count_ = markers.size();
  for (std::size_t i = 0; i < markers.size(); ++i) {
    gradient(markers[i], w[i].F, w[i].T, gradients_[i]);
    join_gradient(i);
  }
}

void AbsoluteTangent::gradients(const ConstraintPart& p, const WrenchRow& w) noexcept {
  gradient_count_ = 2;
  gradient(p.a, w.a.F, w.a.T, gradients_[0]);
  gradient(p.b, w.b.F, w.b.T, gradients_[1]);
  join_gradient(1);
}

void AbsoluteTangent::add_product(const Gradient& a, const Gradient& b, double weight,
                                  BlockLdlt& matrix) noexcept {
  int oa = 0, ob = 0;
  MatX& f = matrix.front(a.body, b.body, oa, ob);
  const bool a_first = oa < ob;
  const Gradient& first = a_first ? a : b;
  const Gradient& second = a_first ? b : a;
  const int below = a_first ? ob : oa;
  const int nf = 6 + bodies_[first.body].nm, ns = 6 + bodies_[second.body].nm;
  for (int j = 0; j < nf; ++j) {
    const double w = weight * first.z[j];
    double* column = f.data() + static_cast<Eigen::Index>(j) * f.rows() + below;
    for (int i = 0; i < ns; ++i) column[i] += w * second.z[i];
  }
}

/// weight g g^T, g the sum of the gradients
void AbsoluteTangent::add_rank_one(BlockLdlt& matrix, double weight) noexcept {
  for (std::size_t a = 0; a < gradient_count_; ++a) {
    const Gradient& g = gradients_[a];
    if (g.body < 0) continue;
    MatX& f = matrix.front(g.body);
    const int n = 6 + bodies_[g.body].nm;
    for (int j = 0; j < n; ++j) {
      const double w = weight * g.z[j];
      double* column = f.data() + static_cast<Eigen::Index>(j) * f.rows();
      for (int i = j; i < n; ++i) column[i] += w * g.z[i];
    }
    for (std::size_t b = a + 1; b < gradient_count_; ++b)
      if (gradients_[b].body >= 0) add_product(g, gradients_[b], weight, matrix);
  }
}

/// The symmetric part of K over the motions (dr, dpi) of the markers a and b.
void AbsoluteTangent::add_curvature(int a, int b, const Mat12& K, BlockLdlt& matrix) noexcept {
  const int markers[2] = {a, b};
  int bodies[2], sizes[2] = {0, 0};
  for (int k = 0; k < 2; ++k) {
    for (int c = 0; c < 6; ++c) {
      gradient(markers[k], c < 3 ? Vec3(Vec3::Unit(c)) : Vec3(Vec3::Zero()),
               c < 3 ? Vec3(Vec3::Zero()) : Vec3(Vec3::Unit(c - 3)), gradients_[0]);
      if (gradients_[0].body >= 0) motions_[k].col(c) = gradients_[0].z;
    }
    bodies[k] = gradients_[0].body;
    if (bodies[k] >= 0) sizes[k] = 6 + bodies_[bodies[k]].nm;
  }
  const Mat12 S = 0.5 * (K + K.transpose());
  const auto add = [&](int row, int column, MatX& f, int below, bool lower) {
    const Mat6 part = S.block<6, 6>(6 * row, 6 * column);
    product_.topRows(sizes[row]).noalias() = motions_[row].topRows(sizes[row]).lazyProduct(part);
    for (int j = 0; j < sizes[column]; ++j)
      for (int i = lower ? j : 0; i < sizes[row]; ++i)
        f(below + i, j) += product_.row(i).dot(motions_[column].row(j));
  };
  const bool same = bodies[0] == bodies[1];
  for (int k = 0; k < 2; ++k)
    if (bodies[k] >= 0) add(k, k, matrix.front(bodies[k]), 0, true);
  if (bodies[0] < 0 || bodies[1] < 0) return;
  int starts[2];
  MatX& f = matrix.front(bodies[0], bodies[1], starts[0], starts[1]);
  const int later = starts[1] > starts[0] ? 1 : 0;
  add(later, 1 - later, f, starts[later], same);
  if (same) add(1 - later, later, f, 0, true);
}

/// B^T (mass M + stretch (x) I) B onto the lower triangle of f, `stretch` between the axes.
void AbsoluteTangent::add_mass(int body, double mass, const Mat3& stretch, MatX& f) const noexcept {
  const AbsoluteBody& b = bodies_[body];
  const MatX& M = terms_[body].M;
  // The image of a column of M under a rotation: sum of A_c x its part at the axis c.
  const auto turn = [&](Eigen::Index k) {
    const double* column = M.data() + k * M.rows();
    Vec3 t = Vec3::Zero();
    for (int c = 0; c < 3; ++c)
      t += b.A.col(c).cross(Vec3(column[3 + 3 * c], column[4 + 3 * c], column[5 + 3 * c]));
    return t;
  };
  for (int j = 0; j < 3; ++j) {
    for (int i = j; i < 3; ++i) f(i, j) += mass * M(i, j);
    f.block<3, 1>(3, j) += mass * turn(j);
  }
  for (int d = 0; d < 3; ++d) {
    Mat3 turned;  // of the columns of the axis d
    for (int k = 0; k < 3; ++k) turned.col(k) = mass * turn(3 + 3 * d + k);
    for (int c = 0; c < 3; ++c) turned += stretch(c, d) * skew(Vec3(b.A.col(c)));
    f.block<3, 3>(3, 3) -= turned * skew(Vec3(b.A.col(d)));
  }
  for (int k = 0; k < b.nm; ++k) {
    const double* column = M.data() + static_cast<Eigen::Index>(12 + k) * M.rows();
    const Vec3 t = turn(12 + k);
    for (int c = 0; c < 3; ++c) {
      f(6 + k, c) += mass * column[c];
      f(6 + k, 3 + c) += mass * t[c];
    }
    for (int j = k; j < b.nm; ++j) f(6 + j, 6 + k) += mass * column[12 + j];
  }
}

/// Inertia and stiffness of body i, and the geometric stiffness of the multipliers of (1), a
/// stretch between the axes, and of (2).
void AbsoluteTangent::assemble_body(const Weights& t, int i, BlockLdlt& matrix) const noexcept {
  const AbsoluteBody& b = bodies_[i];
  MatX& f = matrix.front(i);
  const VecX& lambda = constraints_.multipliers();
  Mat3 stretch = Mat3::Zero();
  if (t.geometric)
    for (int k = 0; k < 6; ++k)
      stretch(b.pair_a[k], b.pair_b[k]) = stretch(b.pair_b[k], b.pair_a[k]) =
          t.s * b.length * lambda[b.row + k];
  add_mass(i, t.mass, stretch, f);
  if (b.nm == 0) return;
  const FlexibleBody& data = *model_.bodies[i].data;
  f.block(6, 6, b.nm, b.nm) += t.s * data.K + t.damping * data.D;
  if (!t.geometric) return;
  for (int p = 0; p < b.points; ++p) {
    const AbsoluteMarker& m = kinematics_.point(b, p);
    const Vec3 w = t.s * lambda.segment<3>(b.point_row(p));
    for (int k = 0; k < b.nm; ++k) {
      Vec3 moved = Vec3::Zero();
      for (int c = 0; c < 3; ++c) moved += m.X(c, k) * b.A.col(c);
      const Vec3 turn = moved.cross(w);
      for (int c = 0; c < 3; ++c) f(6 + k, 3 + c) -= turn[c];
    }
  }
}

/// K_G of second-order displacements: due to accelerations of the bodies, and forces and
/// multipliers on them.
void AbsoluteTangent::assemble_stiffening(const Weights& t, BlockLdlt& matrix) noexcept {
  const VecX& acceleration = kinematics_.accelerations();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const SecondOrder* second_order = terms_[i].inertia.second_order();
    if (!second_order) continue;
    const AbsoluteBody& b = bodies_[i];
    K_G_[i].setZero();
    const Vec3 a = b.A.transpose() * (acceleration.segment<3>(b.offset) - model_.gravity);
    Mat3 G;
    for (int c = 0; c < 3; ++c)
      G.col(c).noalias() = b.A.transpose() * acceleration.segment<3>(b.axis(c));
    add_stiffness(*second_order, a, G, t.s, K_G_[i]);
  }
  const auto add = [&](int marker, const Vec3& force, const Vec3& torque) {
    const AbsoluteMarker& m = markers_[marker];
    if (!m.second) return;
    const Mat3& A = bodies_[m.body].A;
    m.add_stiffness(A.transpose() * force, A.transpose() * torque, t.s, K_G_[m.body]);
  };
  forces_.add_wrenches(add);
  const VecX& lambda = constraints_.multipliers();
  for (const AbsoluteBody& b : bodies_)
    for (int p = 0; p < b.points; ++p)
      add(b.point_marker[p], -lambda.segment<3>(b.point_row(p)), Vec3::Zero());
  constraints_.add_wrenches(lambda, [&](int marker, const Vec3& force, const Vec3& torque) {
    const bool through_point = markers_[marker].point >= 0;
    add(marker, through_point ? Vec3(Vec3::Zero()) : force, torque);
  });
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (const int nm = bodies_[i].nm; terms_[i].inertia.second_order())
      matrix.front(static_cast<int>(i)).block(6, 6, nm, nm) += K_G_[i];
}

void AbsoluteTangent::assemble_forces(const Weights& t, BlockLdlt& matrix) noexcept {
  for (std::size_t k = 0; k < model_.elements.size(); ++k) {
    const Efforts& efforts = forces_.state(k);
    for (int r = 0; r < efforts.row_count; ++r) {
      const double weight = t.s * efforts.rows[r].k + t.damping * efforts.rows[r].c;
      if (weight == 0.0) continue;
      gradients(model_.elements[k].markers, efforts.gradient(r));
      add_rank_one(matrix, weight);
    }
  }
}

/// Row r of a part with its gradients in gradients_: G of (6).
void AbsoluteTangent::assemble_row(const PartPlace& place, int r, BlockLdlt& matrix) noexcept {
  assert(place.home >= 0 && r >= 0);
  MatX& f = matrix.front(place.home);
  const int at = place.at + r;
  for (std::size_t k = 0; k < gradient_count_; ++k) {
    const Gradient& g = gradients_[k];
    if (g.body < 0) continue;
    const int n = 6 + bodies_[g.body].nm;
    if (g.body == place.home) {
      for (int j = 0; j < n; ++j) f(at, j) = g.z[j];
      continue;
    }
    int home = 0, other = 0;
    matrix.front(place.home, g.body, home, other);
    for (int j = 0; j < n; ++j) f(other + j, at) = g.z[j];
  }
}

void AbsoluteTangent::assemble_parts(const Weights& t, BlockLdlt& matrix) noexcept {
  for (std::size_t k = 0; k < constraints_.parts().size(); ++k) {
    const ConstraintPart& p = constraints_.parts()[k];
    const PartPlace& place = places_[k];
    const int row = constraints_.offset(k);
    for (int r = 0; place.home >= 0 && r < p.rows(); ++r) {
      const int at = place.at + r;
      if (!(t.penalty > 0.0)) {  // without penalty these rows do not exist
        matrix.front(place.home)(at, at) = -1.0;
        continue;
      }
      matrix.front(place.home)(at, at) = -1.0 / t.penalty;
      if (constraints_.continues(k + 1)) {
        constraints_.gradient(k, r, row_);
        gradients(place.markers, row_.data());
      } else {
        gradients(p, constraints_.row(k, r).gradient);
      }
      assemble_row(place, r, matrix);
    }
    if (!t.geometric) continue;
    if (place.turns) {
      Mat12 K = Mat12::Zero();
      add_constraint_curvature(p, kinematics_.constraint_state(p.a),
                               kinematics_.constraint_state(p.b),
                               constraints_.multipliers().data() + row, K);
      add_curvature(p.a, p.b, t.s * K, matrix);
    }
    if (constraint_kind(p.type).gradients == PartGradients::line) {
      const double w = t.s * constraints_.multipliers()[row] / p.scale;
      for (int c = 0; c < 3; ++c) {
        const Vec3 e = Vec3::Unit(c), zero = Vec3::Zero();
        gradients(p, {{-e, zero}, {e, zero}});
        add_rank_one(matrix, w);
      }
    }
  }
}

int AbsoluteTangent::factorize(const Weights& t, int slot) noexcept {
  assert(!(t.mass < 0.0) && !(t.s < 0.0) && !(t.penalty < 0.0));  // or NaN: h^2 overflows
  BlockLdlt& matrix = factors_[slot];
  matrix.set_zero();
  for (std::size_t i = 0; i < bodies_.size(); ++i) assemble_body(t, static_cast<int>(i), matrix);
  if (second_order_ && t.geometric) assemble_stiffening(t, matrix);
  assemble_forces(t, matrix);
  assemble_parts(t, matrix);
  const int failed = matrix.factorize();
  if (failed < 0) return -1;
  for (std::size_t i = bodies_.size(); i-- > 0;) {
    const int j = failed - matrix.offset(static_cast<int>(i)), nm = bodies_[i].nm;
    if (j >= 0) return bodies_[i].offset + (j < 6 ? j : j < 6 + nm ? j + 6 : 0);
  }
  return 0;
}

}  // namespace floatframe
