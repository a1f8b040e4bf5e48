// Positions and velocities of the absolute formulation.
#include <cassert>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {

void AbsoluteFormulation::positions(double t, const VecX& q) noexcept {
  time_ = t;
  assert(q.size() == nq_ && std::isfinite(t));
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::positions));
  FLOATFRAME_DEBUG(poison(a_));
  stiffens_ ? positions_of<true>(q) : positions_of<false>(q);
}

template <bool stiffens>
void AbsoluteFormulation::positions_of(const VecX& q) noexcept {
  for (BodyData& b : bodies_) {
    b.p_WB = q.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) b.A.col(c) = q.segment<3>(b.offset + 3 + 3 * c);
    b.y = q.segment(b.offset + 12, b.nm);
    FLOATFRAME_DEBUG(poison(b.v_WB));
    FLOATFRAME_DEBUG(poison(b.Adot));
    FLOATFRAME_DEBUG(poison(b.w_WB));
    FLOATFRAME_DEBUG(poison(b.yd));
  }
  for (MarkerData& m : markers_) {
    FLOATFRAME_DEBUG(poison_rates(m.s));
    FLOATFRAME_DEBUG(poison(m.v_P));
    if (m.body < 0) {
      m.s.r = m.X_NM.p;
      m.s.R = m.X_NM.R;
      continue;
    }
    const BodyData& b = bodies_[m.body];
    if (m.local) {
      m.deform<stiffens>(b.y);
      m.world_gradients(b.A);
    }
    m.s.r.noalias() = b.p_WB + b.A * m.p_B;
    m.s.R.noalias() = b.A * m.R_B;
    if (m.point >= 0) m.r_P = q.segment<3>(m.point);
  }
}

void AbsoluteFormulation::velocities(const VecX& v) noexcept {
  assert(v.size() == nq_ && calls_.has(CallOrder::positions));
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::velocities));
  stiffens_ ? velocities_of<true>(v) : velocities_of<false>(v);
}

template <bool stiffens>
void AbsoluteFormulation::velocities_of(const VecX& v) noexcept {
  VecX& phi = constraint_set_.values();
  FLOATFRAME_DEBUG(poison(phi));
  for (BodyData& b : bodies_) {
    b.v_WB = v.segment<3>(b.offset);
    for (int c = 0; c < 3; ++c) b.Adot.col(c) = v.segment<3>(b.offset + 3 + 3 * c);
    b.yd = v.segment(b.offset + 12, b.nm);
    b.w_WB.setZero();
    for (int c = 0; c < 3; ++c) b.w_WB += 0.5 * b.A.col(c).cross(b.Adot.col(c));
    for (int k = 0; k < 6; ++k) {
      const double dot = b.A.col(pair_a[k]).dot(b.A.col(pair_b[k]));
      phi[b.row + k] = b.length * (k < 3 ? 0.5 * (dot - 1.0) : dot);
    }
    for (int p = 0; p < b.points; ++p) {
      const MarkerData& m = point(b, p);
      phi.segment<3>(b.row + 6 + 3 * p) = m.r_P - m.s.r;
    }
  }
  for (MarkerData& m : markers_) {
    MarkerState& s = m.s;
    s.v.setZero();
    s.w.setZero();
    s.a_bias.setZero();
    s.alpha_bias.setZero();
    if (m.body < 0) continue;
    const BodyData& b = bodies_[m.body];
    s.v.noalias() = b.v_WB + b.Adot * m.p_B;
    s.w = b.w_WB;
    if (m.local) {
      m.deform_rate<stiffens>(b.yd);
      s.v.noalias() += b.A * m.pdot_B;
      s.a_bias.noalias() = 2.0 * (b.Adot * m.pdot_B);
      s.a_bias.noalias() += b.A * m.pddot_B;
      if (m.rotates) {
        s.w.noalias() += b.A * m.zeta_B;
        s.alpha_bias.noalias() = b.Adot * m.zeta_B;
        s.alpha_bias.noalias() += b.A * m.zetadot_B;
      }
    }
    if (m.point >= 0) m.v_P = v.segment<3>(m.point);
  }
  constraint_set_.evaluate(time_, [&](int marker) { return constraint_state(marker); });
}

MarkerState AbsoluteFormulation::constraint_state(int marker) const noexcept {
  const MarkerData& m = markers_[marker];
  MarkerState s = m.s;
  if (m.point >= 0) {
    s.r = m.r_P;
    s.v = m.v_P;
    s.a_bias.setZero();
  }
  return s;
}

}  // namespace floatframe
