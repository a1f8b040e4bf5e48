// Tangent of the absolute formulation, assembled into the fronts of the bodies.
#include "floatframe/formulation/absolute.hpp"

namespace floatframe {

void AbsoluteFormulation::gradient(int marker, bool through_point, const Vec3& force,
                                   const Vec3& torque, Gradient& g) const noexcept {
  g.clear(-1);
  if (marker < 0) return;
  const MarkerData& m = markers_[marker];
  if (m.body < 0) return;
  g.body = m.body;
  const BodyData& b = bodies_[m.body];
  const auto put = [&](int index, double value) {
    if (value != 0.0) g.put(index, value);
  };
  const bool on_body = !(through_point && m.point >= 0);
  if (on_body)
    for (int i = 0; i < 3; ++i) put(i, force[i]);
  for (int c = 0; c < 3; ++c) {
    Vec3 x = 0.5 * torque.cross(b.A.col(c));
    if (on_body) x += m.p_B[c] * force;
    for (int i = 0; i < 3; ++i) put(3 + 3 * c + i, x[i]);
  }
  if (m.local)
    for (int k = 0; k < b.nm; ++k) {
      double x = on_body ? m.Jr.col(k).dot(force) : 0.0;
      if (m.rotates) x += m.Jw.col(k).dot(torque);
      put(12 + k, x);
    }
  if (!on_body)
    for (int i = 0; i < 3; ++i) put(m.point - b.offset + i, force[i]);
}

void AbsoluteFormulation::add_rank_one(BlockLdlt& matrix, const Gradient& a, const Gradient& b,
                                       double weight) const noexcept {
  const auto own = [&](const Gradient& g) {
    if (g.body < 0) return;
    MatX& f = matrix.front(g.body);
    for (int j = 0; j < g.count; ++j) {
      const double w = weight * g.value[j];
      double* column = f.data() + static_cast<Eigen::Index>(g.index[j]) * f.rows();
      for (int i = j; i < g.count; ++i) column[g.index[i]] += w * g.value[i];
    }
  };
  own(a);
  own(b);
  if (a.body < 0 || b.body < 0) return;
  int oa = 0, ob = 0;
  MatX& f = matrix.front(a.body, b.body, oa, ob);
  const bool a_first = oa < ob;
  const Gradient& first = a_first ? a : b;
  const Gradient& second = a_first ? b : a;
  const int of = std::min(oa, ob), os = std::max(oa, ob);
  for (int j = 0; j < first.count; ++j) {
    const double w = weight * first.value[j];
    double* column = f.data() + static_cast<Eigen::Index>(of + first.index[j]) * f.rows() + os;
    for (int i = 0; i < second.count; ++i) column[second.index[i]] += w * second.value[i];
  }
}

void AbsoluteFormulation::keep_row(Factors& l, int row, const Gradient& a,
                                   const Gradient& b) const noexcept {
  auto at = static_cast<std::size_t>(l.row_start[row]);
  for (const Gradient* g : {&a, &b}) {
    if (g->body < 0) continue;
    const int offset = bodies_[g->body].offset;
    for (std::size_t k = 0; k < static_cast<std::size_t>(g->count); ++k, ++at) {
      l.column[at] = offset + g->index[k];
      l.value[at] = g->value[k];
    }
  }
  l.row_start[row + 1] = static_cast<int>(at);
}

/// Rows (1) of body i: penalty, and the geometric stiffness of their multipliers.
void AbsoluteFormulation::assemble_axes(const TangentWeights& t, int i, Factors& factors) noexcept {
  const BodyData& b = bodies_[i];
  MatX& f = factors.matrix.front(i);
  const VecX& lambda = constraint_set_.multipliers();
  const double l2 = t.penalty * b.length * b.length;
  for (int k = 0; k < 6; ++k) {
    const int ia = 3 + 3 * pair_a[k], ib = 3 + 3 * pair_b[k];
    const Vec3 u = b.A.col(pair_a[k]), v = b.A.col(pair_b[k]);
    const double g = t.geometric ? t.s * b.length * lambda[b.row + k] : 0.0;
    if (k < 3) {
      f.block<3, 3>(ia, ia) += l2 * u * u.transpose();
      for (int c = 0; c < 3; ++c) f(ia + c, ia + c) += g;
    } else {
      f.block<3, 3>(ia, ia) += l2 * v * v.transpose();
      f.block<3, 3>(ib, ib) += l2 * u * u.transpose();
      f.block<3, 3>(ib, ia) += l2 * u * v.transpose();
      for (int c = 0; c < 3; ++c) f(ib + c, ia + c) += g;
    }
    ga_.clear(i);
    gb_.clear(-1);
    for (int c = 0; c < 3; ++c) {
      ga_.put(ia + c, b.length * v[c]);
      if (k >= 3) ga_.put(ib + c, b.length * u[c]);
    }
    keep_row(factors, b.row + k, ga_, gb_);
  }
}

/// Rows (2) of body i. They are bilinear in A and y: geometric stiffness of their multipliers.
void AbsoluteFormulation::assemble_points(const TangentWeights& t, int i,
                                          Factors& factors) noexcept {
  const BodyData& b = bodies_[i];
  MatX& f = factors.matrix.front(i);
  const VecX& lambda = constraint_set_.multipliers();
  for (int p = 0; p < b.points; ++p) {
    const MarkerData& m = point(b, p);
    const int at = 12 + b.nm + 3 * p, row = b.row + 6 + 3 * p;
    for (int c = 0; c < 3 && t.geometric; ++c)
      for (int k = 0; k < b.nm; ++k)
        for (int j = 0; j < 3; ++j) f(12 + k, 3 + 3 * c + j) -= t.s * lambda[row + j] * m.X(c, k);
    for (int c = 0; c < 3; ++c) {
      gradient(b.point_marker[p], false, -Vec3::Unit(c), Vec3::Zero(), ga_);
      ga_.put(at + c, 1.0);
      gb_.clear(-1);
      add_rank_one(factors.matrix, ga_, gb_, t.penalty);
      keep_row(factors, row + c, ga_, gb_);
    }
  }
}

void AbsoluteFormulation::assemble_forces(const TangentWeights& t, Factors& factors) noexcept {
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& force = model_.forces[k];
    const ForceState& state = force_set_.state(k);
    for (int r = 0; r < state.row_count; ++r) {
      const TangentRow& row = state.rows[r];
      const double weight = t.s * row.k + t.damping * row.c;
      if (weight == 0.0) continue;
      gradient(force.a, false, row.g.Fa, row.g.Ta, ga_);
      gradient(force.b, false, row.g.Fb, row.g.Tb, gb_);
      if (ga_.body >= 0 && ga_.body == gb_.body)
        continue;  // within one body only its modes feel it: left to Newton
      add_rank_one(factors.matrix, ga_, gb_, weight);
    }
  }
}

void AbsoluteFormulation::assemble_parts(const TangentWeights& t, Factors& factors) noexcept {
  for (std::size_t k = 0; k < constraint_set_.parts().size(); ++k) {
    const ConstraintPart& p = constraint_set_.parts()[k];
    const int row = constraint_set_.offset(k);
    for (int r = 0; r < p.rows(); ++r) {
      const WrenchRow& g = constraint_set_.row(row + r).gradient;
      gradient(p.a, true, g.Fa, g.Ta, ga_);
      gradient(p.b, true, g.Fb, g.Tb, gb_);
      add_rank_one(factors.matrix, ga_, gb_, t.penalty);
      keep_row(factors, row + r, ga_, gb_);
    }
    if (t.geometric && constraint_kind(p.type).gradients == PartGradients::line) {
      const double w = t.s * constraint_set_.multipliers()[row] / p.scale;
      for (int c = 0; c < 3; ++c) {
        gradient(p.a, true, -Vec3::Unit(c), Vec3::Zero(), ga_);
        gradient(p.b, true, Vec3::Unit(c), Vec3::Zero(), gb_);
        add_rank_one(factors.matrix, ga_, gb_, w);
      }
    }
  }
}

int AbsoluteFormulation::eliminate(const TangentWeights& t, Factors& factors) noexcept {
  factors.matrix.set_zero();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const int i = static_cast<int>(k);
    const BodyData& b = bodies_[k];
    MatX& f = factors.matrix.front(i);
    f.topLeftCorner(12 + b.nm, 12 + b.nm) += t.mass * b.M;
    if (b.nm > 0) {
      const FlexibleBody& data = *model_.bodies[k].data;
      f.block(12, 12, b.nm, b.nm) += t.s * data.K + t.damping * data.D;
    }
    assemble_axes(t, i, factors);
    assemble_points(t, i, factors);
  }
  assemble_forces(t, factors);
  assemble_parts(t, factors);
  return factors.matrix.factorize();
}

void AbsoluteFormulation::solve(VecX& b, const VecX& w, VecX& increments, int slot) noexcept {
  Factors& l = factors_[slot];
  for (int i = 0; i < constraints(); ++i)
    for (int k = l.row_start[i]; k < l.row_start[i + 1]; ++k) b[l.column[k]] += w[i] * l.value[k];
  l.matrix.solve(b);
  for (int i = 0; i < constraints(); ++i) {
    double sum = 0.0;
    for (int k = l.row_start[i]; k < l.row_start[i + 1]; ++k) sum += l.value[k] * b[l.column[k]];
    increments[i] = sum;
  }
}

}  // namespace floatframe
