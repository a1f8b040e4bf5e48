#include "floatframe/run/body_energy.hpp"

#include "floatframe/body/modal_mass.hpp"

namespace floatframe {

BodyEnergy::BodyEnergy(const InertiaInvariants& v, const SecondOrder* second_order)
    : m_(v.m), m_u_(v.m_u), P_u_(v.P_u), modes_(v.modes()) {
  const MatX M_ff = modal_mass(v);
  for (int a = 0; a < modes_; ++a) {
    S_.emplace_back(v.S.col(a));
    std::array<double, 9>& rows = Si_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        rows[3 * i + j] = v.Si[i](static_cast<Eigen::Index>(j), a);
    for (int b = a; b < modes_; ++b) {
      const double twice = a < b ? 2.0 : 1.0;
      const auto S = [&](std::size_t i, std::size_t j) { return v.Sij[i][j](a, b); };
      pairs_.push_back({twice * S(0, 0), twice * S(1, 1), twice * S(2, 2),
                        twice * (S(0, 1) + S(1, 0)), twice * (S(0, 2) + S(2, 0)),
                        twice * (S(1, 2) + S(2, 1)), twice * M_ff(a, b), S(1, 2) - S(2, 1),
                        S(2, 0) - S(0, 2), S(0, 1) - S(1, 0)});
      if (!second_order) continue;
      const auto h = [&](std::size_t i, std::size_t j) { return second_order->S2i[i][j](a, b); };
      const std::array<double, 6> P{h(0, 0),           h(1, 1),           h(2, 2),
                                    h(0, 1) + h(1, 0), h(0, 2) + h(2, 0), h(1, 2) + h(2, 1)};
      for (std::size_t k = 0; k < P.size(); ++k) pairs_.back()[k] += twice * P[k];
      const auto& S2 = second_order->S2;
      second_.push_back({Vec3(S2[0](a, b), S2[1](a, b), S2[2](a, b)),
                         Vec3(h(1, 2) - h(2, 1), h(2, 0) - h(0, 2), h(0, 1) - h(1, 0))});
    }
  }
}

double BodyEnergy::kinetic(const Vec3& v, const Vec3& w, const double* y,
                           const double* ydot) const noexcept {
  Vec3 m_bar = m_u_, s = Vec3::Zero(), h = Vec3::Zero();
  Mat3 P = P_u_;
  double modal = 0.0;
  const Pair* pair = pairs_.data();
  for (int a = 0; a < modes_; ++a) {
    const auto k = static_cast<std::size_t>(a);
    const std::array<double, 9>& Si = Si_[k];
    m_bar += y[a] * S_[k];
    s += ydot[a] * S_[k];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        P(i, j) += y[a] * (Si[static_cast<std::size_t>(3 * i + j)] +
                           Si[static_cast<std::size_t>(3 * j + i)]);
    h += ydot[a] * Vec3(Si[5] - Si[7], Si[6] - Si[2], Si[1] - Si[3]);
    for (int b = a; b < modes_; ++b, ++pair) {
      const Pair& p = *pair;
      const double yy = y[a] * y[b], turn = y[a] * ydot[b] - y[b] * ydot[a];
      for (int i = 0; i < 3; ++i) P(i, i) += yy * p[static_cast<std::size_t>(i)];
      P(0, 1) += 0.5 * yy * p[3];
      P(0, 2) += 0.5 * yy * p[4];
      P(1, 2) += 0.5 * yy * p[5];
      modal += ydot[a] * ydot[b] * p[6];
      h += turn * Vec3(p[7], p[8], p[9]);
    }
  }
  if (!second_.empty()) {
    const std::array<Vec3, 2>* second = second_.data();
    for (int a = 0; a < modes_; ++a) {
      for (int b = a; b < modes_; ++b, ++second) {
        const double once = a < b ? 1.0 : 0.5;
        const double rate = once * (y[a] * ydot[b] + y[b] * ydot[a]);
        m_bar += once * y[a] * y[b] * (*second)[0];
        s += rate * (*second)[0];
        h += rate * (*second)[1];
      }
    }
  }
  const double wPw = w[0] * w[0] * P(0, 0) + w[1] * w[1] * P(1, 1) + w[2] * w[2] * P(2, 2) +
                     2.0 * (w[0] * w[1] * P(0, 1) + w[0] * w[2] * P(0, 2) + w[1] * w[2] * P(1, 2));
  const double turning = w.squaredNorm() * P.trace() - wPw;
  return 0.5 * (m_ * v.squaredNorm() + turning + modal) + v.dot(w.cross(m_bar) + s) + w.dot(h);
}

}  // namespace floatframe
