// Relative inertia terms, (46)-(63). Rows over the modes are processed in whole SIMD lanes.
#include <cassert>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/lanes.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

/// out += C x, C rows x n with a multiple of four rows.
void add_columns(const double* C, int rows, int n, const double* x, double* out) noexcept {
  assert(rows % 4 == 0 && n >= 0);
  int b = 0;
  for (; b + 1 < n; b += 2) {
    const double* c0 = C + static_cast<std::ptrdiff_t>(b) * rows;
    const double* c1 = c0 + rows;
    const double x0 = x[b], x1 = x[b + 1];
    for (int r = 0; r < rows; r += 4) lanes(out + r) += x0 * lanes(c0 + r) + x1 * lanes(c1 + r);
  }
  if (b < n) {
    const double* c0 = C + static_cast<std::ptrdiff_t>(b) * rows;
    for (int r = 0; r < rows; r += 4) lanes(out + r) += x[b] * lanes(c0 + r);
  }
}

/// A row of x padded with zeros. Whole lanes are stored: a load of a lane right after four single
/// stores would stall.
void pad(const double* x, int n, double* row) noexcept {
  int a = 0;
  for (; a + 4 <= n; a += 4) lanes(row + a) = lanes(x + a);
  if (a < n)
    lanes(row + a) = Lanes{x[a], a + 1 < n ? x[a + 1] : 0.0, a + 2 < n ? x[a + 2] : 0.0, 0.0};
}

/// a . x over one row.
double dot(const double* a, const double* x, int stride) noexcept {
  assert(stride % 4 == 0);
  Lanes s = {};
  for (int r = 0; r < stride; r += 4) s += lanes(a + r) * lanes(x + r);
  return sum(s);
}

/// Rows 3i+j as the 3 x 3 matrix whose column i is S^i x.
Mat3 lane_times9(const double* rows, const double* x, int stride) noexcept {
  Mat3 s;
  for (int c = 0; c < 9; ++c) s.data()[c] = dot(rows + c * stride, x, stride);
  return s;
}

/// Integrals that depend on the amplitudes, in body axes.
struct DeformedIntegrals {
  Vec3 m_u;           ///< m_u + S y, (29)
  Mat3 P_u;           ///< (33)
  Vec3 S_rate;        ///< S ydot
  Mat3 S_d_rate;      ///< column i: S_d^i ydot
  const double* S_d;  ///< 9 rows over the modes: row 3i+j is row j of S_d^i, (38)
};

/// `y_row`, `ydot_row`: y and ydot padded with zeros. `stiffening` gets S(y).
template <bool stiffened>
inline DeformedIntegrals deformed_integrals(const PreprocessingData& data,
                                            [[maybe_unused]] StiffeningData* stiffening,
                                            const double* y, const double* ydot, double* S_d,
                                            double* y_row, double* ydot_row) noexcept {
  const int nm = data.modes(), nl = data.by_modes.stride;
  DeformedIntegrals out{data.m_u, data.P_u, Vec3::Zero(), Mat3::Zero(), S_d};
  if (nm == 0) return out;
  assert(data.by_modes.Si.size() == 9 * nl && data.by_modes.Sij.rows() == 9 * nl);
  pad(y, nm, y_row);
  pad(ydot, nm, ydot_row);
  const double* S = data.by_modes.S.data();
  const double* Si = data.by_modes.Si.data();
  for (int r = 0; r < 9 * nl; r += 4) lanes(S_d + r) = lanes(Si + r);
  if constexpr (stiffened)
    add_columns(stiffening->S_ij_by_modes.data(), 9 * nl, nm, y, S_d);
  else
    add_columns(data.by_modes.Sij.data(), 9 * nl, nm, y, S_d);  // (38)
  const Mat3 first = lane_times9(Si, y_row, nl);                // column i: S^i y
  const Mat3 second = lane_times9(S_d, y_row, nl);              // column i: S_d^i y
  if constexpr (stiffened) {
    double* Sy = stiffening->S_by_mode.data();
    assert(stiffening->S_by_mode.size() == 3 * nl && stiffening->S2_by_modes.rows() == 3 * nl);
    for (int r = 0; r < 3 * nl; r += 4) lanes(Sy + r) = lanes(S + r);
    add_columns(stiffening->S2_by_modes.data(), 3 * nl, nm, y, Sy);
    for (int j = 0; j < 3; ++j) {
      out.m_u[j] += 0.5 * (dot(S + j * nl, y_row, nl) + dot(Sy + j * nl, y_row, nl));
      out.S_rate[j] = dot(Sy + j * nl, ydot_row, nl);
    }
    out.S_d_rate = lane_times9(S_d, ydot_row, nl);
    const Mat3 both = first + second;
    out.P_u += 0.5 * (both + both.transpose());
    return out;
  }
  for (int j = 0; j < 3; ++j) {
    out.m_u[j] += dot(S + j * nl, y_row, nl);  // (29)
    out.S_rate[j] = dot(S + j * nl, ydot_row, nl);
  }
  out.S_d_rate = lane_times9(S_d, ydot_row, nl);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      out.P_u(j, i) = out.P_u(i, j) += first(i, j) + second(j, i);  // (33)
  return out;
}

/// (51), about the origin of r0; c = A m_bar.
inline Mat3 rotary_inertia(const Mat3& A, const Mat3& P_bar, double m, const Vec3& r0,
                           const Vec3& c, const Vec3& m_vec) noexcept {
  const Mat3 J_bar = P_bar.trace() * Mat3::Identity() - P_bar;  // (21)
  const Mat3 AJ = A * J_bar;
  Mat3 J = AJ * A.transpose();  // about the frame origin
  J += (m * r0.squaredNorm() + 2.0 * r0.dot(c)) * Mat3::Identity();
  J -= m_vec * r0.transpose();
  J -= r0 * c.transpose();
  return J;
}

/// Columns and rows of the modes in M and Q_v, four modes at a time. `w`: omega in body axes.
inline void mode_columns(const PreprocessingData& data, const double* S, const Vec3& r0,
                         const Mat3& A, const Vec3& omega, const Vec3& w, const double* S_d,
                         const double* skew_rate, double* Q_row, MatX& M) noexcept {
  const int nm = data.modes(), nq = 6 + nm, nl = data.by_modes.stride;
  // F_d^T omega = S^T A^T ((omega x r0) x omega) + sum_ij (|w|^2 delta_ij - w_i w_j) (S_d^i)_(j)
  const Vec3 g = A.transpose() * omega.cross(r0).cross(omega);
  const Mat3 W = w.squaredNorm() * Mat3::Identity() - w * w.transpose();
  double* M_data = M.data();
  for (int r = 0; r < nl; r += 4) {
    const Lanes s0 = lanes(S + r), s1 = lanes(S + nl + r), s2 = lanes(S + 2 * nl + r);
    const auto d = [&](int i, int j) -> const Lanes& { return lanes(S_d + (3 * i + j) * nl + r); };
    const Lanes f0 = d(1, 2) - d(2, 1), f1 = d(2, 0) - d(0, 2), f2 = d(0, 1) - d(1, 0);  // F_bar
    Lanes a[3], F[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = A(k, 0) * s0 + A(k, 1) * s1 + A(k, 2) * s2;  // (50)
      F[k] = A(k, 0) * f0 + A(k, 1) * f1 + A(k, 2) * f2;
    }
    F[0] += r0.y() * a[2] - r0.z() * a[1];  // (53)
    F[1] += r0.z() * a[0] - r0.x() * a[2];
    F[2] += r0.x() * a[1] - r0.y() * a[0];
    const Lanes C_rate = w.y() * lanes(skew_rate + nl + r) - w.z() * lanes(skew_rate + r) -
                         w.x() * lanes(skew_rate + 2 * nl + r);  // (C ydot)_a
    lanes(Q_row + r) = (g[0] * s0 + g[1] * s1 + g[2] * s2) +
                       (W(0, 0) * d(0, 0) + W(1, 1) * d(1, 1) + W(2, 2) * d(2, 2)) +
                       W(0, 1) * (d(0, 1) + d(1, 0)) + W(0, 2) * (d(0, 2) + d(2, 0)) +
                       W(1, 2) * (d(1, 2) + d(2, 1)) - 2.0 * C_rate;  // (63)
    const int count = nm - r < 4 ? nm - r : 4;
    for (int l = 0; l < count; ++l) {
      double* column = M_data + static_cast<std::ptrdiff_t>(6 + r + l) * nq;
      for (int k = 0; k < 3; ++k) {
        column[k] = M_data[k * nq + 6 + r + l] = a[k][l];
        column[3 + k] = M_data[(3 + k) * nq + 6 + r + l] = F[k][l];
      }
    }
  }
}

template <bool stiffened>
inline void relative_terms(const PreprocessingData& data, StiffeningData* stiffening,
                           const Vec3& r0, const Mat3& A, const Vec3& omega, const double* y,
                           const double* ydot, PreprocessingWorkspace& work, MatX& M,
                           VecX& Qv) noexcept {
  const int nm = data.modes();
  const int nq = 6 + nm;
  const int nl = data.by_modes.stride;
  assert(((y && ydot) || nm == 0) && work.rows.size() >= 15 * nl);
  assert(M.rows() == nq && M.cols() == nq && Qv.size() == nq);
  assert(is_rotation(A));
  FLOATFRAME_DEBUG(poison(M));
  FLOATFRAME_DEBUG(poison(Qv));
  FLOATFRAME_DEBUG(poison(work.rows));
  double* S_d = work.rows.data();
  double* skew_rate = S_d + 9 * nl;  // 3 rows: (S^12-S^21) ydot, ...
  double* y_row = skew_rate + 3 * nl;
  double* ydot_row = y_row + nl;
  double* Q_row = ydot_row + nl;
  const DeformedIntegrals u =
      deformed_integrals<stiffened>(data, stiffening, y, ydot, S_d, y_row, ydot_row);
  const Vec3 AS_rate = A * u.S_rate;
  const Vec3 c = A * u.m_u;
  const Vec3 m_vec = data.m * r0 + c;  // (49)
  const Mat3 J = rotary_inertia(A, u.P_u, data.m, r0, c, m_vec);

  M.topLeftCorner<6, 6>().setZero();
  for (int k = 0; k < 3; ++k) M(k, k) = data.m;  // (47)
  const Mat3 m_tilde = skew(m_vec);
  M.block<3, 3>(3, 0) = m_tilde;  // (48)
  M.block<3, 3>(0, 3) = -m_tilde;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) M(3 + i, 3 + j) = 0.5 * (J(i, j) + J(j, i));
  }

  const Vec3 w = A.transpose() * omega;
  const Vec3 F_d_rate = r0.cross(omega.cross(AS_rate)) +
                        A * (w * u.S_d_rate.trace() - u.S_d_rate * w);            // F_d ydot, (62)
  Qv.head<3>() = omega.cross(m_vec.cross(omega)) - 2.0 * omega.cross(AS_rate);    // (60)
  Qv.segment<3>(3) = -omega.cross(M.block<3, 3>(3, 3) * omega) - 2.0 * F_d_rate;  // (61)
  if (nm == 0) return;
  const double* S = data.by_modes.S.data();
  if constexpr (stiffened) {
    S = stiffening->S_by_mode.data();
    const RateForces f = rate_forces(*stiffening, nm, ydot);
    const Vec3 force = A * f.q;
    const Vec3 moment(f.Q(2, 1) - f.Q(1, 2), f.Q(0, 2) - f.Q(2, 0), f.Q(1, 0) - f.Q(0, 1));
    Qv.head<3>() -= force;
    Qv.segment<3>(3) -= r0.cross(force) + A * moment;
  }

  for (int r = 0; r < 3 * nl; r += 4) lanes(skew_rate + r) = Lanes{};
  add_columns(data.by_modes.Sij_skew.data(), 3 * nl, nm, ydot, skew_rate);
  mode_columns(data, S, r0, A, omega, w, S_d, skew_rate, Q_row, M);
  for (int a = 0; a < nm; ++a) Qv[6 + a] = Q_row[a];
  for (int a = 0; a < nm; ++a) {
    double* column = M.data() + static_cast<std::ptrdiff_t>(6 + a) * nq + 6;
    const double* mff = data.M_ff.data() + static_cast<std::ptrdiff_t>(a) * nm;
    for (int b = 0; b < nm; ++b) column[b] = mff[b];  // (54)
  }
  assert(is_symmetric(M));
}

}  // namespace

void relative_preprocessing(const PreprocessingData& data, const Vec3& r0, const Mat3& A,
                            const Vec3& omega, const double* y, const double* ydot,
                            PreprocessingWorkspace& work, MatX& M, VecX& Qv) noexcept {
  relative_terms<false>(data, nullptr, r0, A, omega, y, ydot, work, M, Qv);
}

void relative_stiffened(const PreprocessingData& data, StiffeningData& stiffening, const Vec3& r0,
                        const Mat3& A, const Vec3& omega, const double* y, const double* ydot,
                        PreprocessingWorkspace& work, MatX& M, VecX& Qv) noexcept {
  relative_terms<true>(data, &stiffening, r0, A, omega, y, ydot, work, M, Qv);
}

}  // namespace floatframe
