// Tangent of the absolute formulation, assembled into the fronts of the bodies.
#include "floatframe/formulation/absolute.hpp"

namespace floatframe {

void AbsoluteFormulation::gradient(int marker, bool through_point, const Vec3& force,
                                   const Vec3& torque, Gradient& g) const noexcept {
  g.body = -1;
  g.count = 0;
  if (marker < 0) return;
  const MarkerData& m = markers_[marker];
  if (m.body < 0) return;
  g.body = m.body;
  const BodyData& b = body(m.body);
  const auto put = [&](int index, double value) {
    if (value == 0.0) return;
    g.index[g.count] = index;
    g.value[g.count++] = value;
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
                                       double weight) noexcept {
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

void AbsoluteFormulation::keep_row(Linearization& l, int row, const Gradient& a,
                                   const Gradient& b) noexcept {
  auto at = static_cast<std::size_t>(l.row_start[row]);
  for (const Gradient* g : {&a, &b}) {
    if (g->body < 0) continue;
    const int offset = body(g->body).offset;
    for (std::size_t k = 0; k < static_cast<std::size_t>(g->count); ++k, ++at) {
      l.column[at] = offset + g->index[k];
      l.value[at] = g->value[k];
    }
  }
  l.row_start[row + 1] = static_cast<int>(at);
}

int AbsoluteFormulation::eliminate(double mass, double damping, double s, double penalty,
                                   bool geometric, Linearization& linear) noexcept {
  BlockLdlt& matrix = linear.matrix;
  matrix.set_zero();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyData& b = bodies_[i];
    MatX& f = matrix.front(static_cast<int>(i));
    f.topLeftCorner(12 + b.nm, 12 + b.nm) += mass * b.M;
    if (b.nm > 0) {
      const FlexibleBody& data = *model_.bodies[i].data;
      f.block(12, 12, b.nm, b.nm) += s * data.K + damping * data.D;
    }
    // Orthonormality: penalty, and the geometric stiffness of its multipliers.
    const double l2 = penalty * b.length * b.length;
    for (int k = 0; k < 6; ++k) {
      const int ia = 3 + 3 * pair_a[k], ib = 3 + 3 * pair_b[k];
      const Vec3 u = b.A.col(pair_a[k]), v = b.A.col(pair_b[k]);
      const double g = geometric ? s * b.length * lambda_[b.row + k] : 0.0;
      if (k < 3) {
        f.block<3, 3>(ia, ia) += l2 * u * u.transpose();
        for (int c = 0; c < 3; ++c) f(ia + c, ia + c) += g;
      } else {
        f.block<3, 3>(ia, ia) += l2 * v * v.transpose();
        f.block<3, 3>(ib, ib) += l2 * u * u.transpose();
        f.block<3, 3>(ib, ia) += l2 * u * v.transpose();
        for (int c = 0; c < 3; ++c) f(ib + c, ia + c) += g;
      }
      ga_.body = static_cast<int>(i);
      gb_.body = -1;
      ga_.count = 0;
      for (int c = 0; c < 3; ++c) {
        const std::size_t at = ga_.count;
        ga_.index[at] = ia + c;
        ga_.value[at] = b.length * v[c];
        ++ga_.count;
        if (k < 3) continue;
        ga_.index[at + 1] = ib + c;
        ga_.value[at + 1] = b.length * u[c];
        ++ga_.count;
      }
      keep_row(linear, b.row + k, ga_, gb_);
    }
    for (int p = 0; p < b.points; ++p) {
      const MarkerData& m = markers_[b.point_marker[p]];
      const int at = 12 + b.nm + 3 * p;
      // The tip definition is bilinear in A and y: geometric stiffness of its multipliers.
      for (int c = 0; c < 3 && geometric; ++c)
        for (int k = 0; k < b.nm; ++k)
          for (int i2 = 0; i2 < 3; ++i2)
            f(12 + k, 3 + 3 * c + i2) -= s * lambda_[b.row + 6 + 3 * p + i2] * m.X(c, k);
      for (int c = 0; c < 3; ++c) {
        gradient(b.point_marker[p], false, -Vec3::Unit(c), Vec3::Zero(), ga_);
        ga_.index[ga_.count] = at + c;
        ga_.value[ga_.count++] = 1.0;
        gb_.body = -1;
        add_rank_one(matrix, ga_, gb_, penalty);
        keep_row(linear, b.row + 6 + 3 * p + c, ga_, gb_);
      }
    }
  }
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& force = model_.forces[k];
    const ForceState& state = force_states_[k];
    for (int r = 0; r < state.row_count; ++r) {
      const TangentRow& row = state.rows[r];
      const double weight = s * row.k + damping * row.c;
      if (weight == 0.0) continue;
      gradient(force.a, false, row.g.Fa, row.g.Ta, ga_);
      gradient(force.b, false, row.g.Fb, row.g.Tb, gb_);
      if (ga_.body >= 0 && ga_.body == gb_.body)
        continue;  // within one body only its modes feel it: left to Newton
      add_rank_one(matrix, ga_, gb_, weight);
    }
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    for (int r = 0; r < p.rows(); ++r) {
      const WrenchRow& g = rows_[part_offset_[k] + r - part_rows_].gradient;
      gradient(p.a, true, g.Fa, g.Ta, ga_);
      gradient(p.b, true, g.Fb, g.Tb, gb_);
      add_rank_one(matrix, ga_, gb_, penalty);
      keep_row(linear, part_offset_[k] + r, ga_, gb_);
    }
    if (geometric && constraint_kind(p.type).gradients == PartGradients::line) {
      const double w = s * lambda_[part_offset_[k]] / p.scale;
      for (int c = 0; c < 3; ++c) {
        gradient(p.a, true, -Vec3::Unit(c), Vec3::Zero(), ga_);
        gradient(p.b, true, Vec3::Unit(c), Vec3::Zero(), gb_);
        add_rank_one(matrix, ga_, gb_, w);
      }
    }
  }
  return matrix.factorize();
}

void AbsoluteFormulation::solve(VecX& b, const VecX& w, VecX& increments, int slot) noexcept {
  Linearization& l = linearizations_[slot];
  for (int i = 0; i < nc_; ++i)
    for (int k = l.row_start[i]; k < l.row_start[i + 1]; ++k) b[l.column[k]] += w[i] * l.value[k];
  l.matrix.solve(b);
  for (int i = 0; i < nc_; ++i) {
    double sum = 0.0;
    for (int k = l.row_start[i]; k < l.row_start[i + 1]; ++k) sum += l.value[k] * b[l.column[k]];
    increments[i] = sum;
  }
}

}  // namespace floatframe
