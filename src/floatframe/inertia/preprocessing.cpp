#include "floatframe/inertia/preprocessing.hpp"

#include <cassert>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/debug_only.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

/// out = base + Z x for a column-major rows x columns array; four columns at a time.
void affine(const double* base, const double* Z, int rows, int columns, const double* x,
            double* out) noexcept {
  for (int r = 0; r < rows; ++r) out[r] = base ? base[r] : 0.0;
  int b = 0;
  for (; b + 3 < columns; b += 4) {
    const double* z0 = Z + static_cast<std::ptrdiff_t>(b) * rows;
    const double* z1 = z0 + rows;
    const double* z2 = z1 + rows;
    const double* z3 = z2 + rows;
    const double x0 = x[b], x1 = x[b + 1], x2 = x[b + 2], x3 = x[b + 3];
    for (int r = 0; r < rows; ++r) {
      out[r] += (z0[r] * x0 + z1[r] * x1) + (z2[r] * x2 + z3[r] * x3);
    }
  }
  for (; b < columns; ++b) {
    const double* z = Z + static_cast<std::ptrdiff_t>(b) * rows;
    for (int r = 0; r < rows; ++r) out[r] += z[r] * x[b];
  }
}

/// S x for the 3 x nm array S.
Vec3 times(const Mat3X& S, const double* x) noexcept {
  Vec3 s = Vec3::Zero();
  for (int a = 0; a < S.cols(); ++a) s += x[a] * S.col(a);
  return s;
}

/// The nine-row array times x, as the 3 x 3 matrix whose column i is S^i x.
Mat3 times9(const MatX& S, const double* x) noexcept {
  Eigen::Matrix<double, 9, 1> s = Eigen::Matrix<double, 9, 1>::Zero();
  for (int a = 0; a < S.cols(); ++a) s += x[a] * S.col(a).head<9>();
  return Eigen::Map<const Mat3>(s.data());
}

}  // namespace

PreprocessingData::PreprocessingData(const InertiaInvariants& v)
    : m(v.m), m_u(v.m_u), P_u(v.P_u), S(v.S) {
  const int nm = v.modes();
  // Masses may overflow: the start says so of the mass matrix.
  assert(!(v.m < 0.0) && is_symmetric(v.P_u));
  FLOATFRAME_DEBUG(for (const Mat3X& of_axis : v.Si) assert(of_axis.cols() == nm);)
  Si.resize(9, nm);
  Sij.resize(9 * nm, nm);
  Sij_sum.resize(6, nm * nm);
  M_ff = modal_mass(v);  // (40)
  assert(is_symmetric(M_ff) && !(M_ff.diagonal().array() < 0.0).any());
  for (int i = 0; i < 3; ++i) Si.middleRows<3>(3 * i) = v.Si[i];
  const int nl = by_modes.stride = (nm + 3) & ~3;
  by_modes.S = VecX::Zero(3 * nl);
  by_modes.Si = VecX::Zero(9 * nl);
  by_modes.Sij = MatX::Zero(9 * nl, nm);
  by_modes.Sij_skew = MatX::Zero(3 * nl, nm);
  for (int a = 0; a < nm; ++a) {
    for (int i = 0; i < 3; ++i) by_modes.S(i * nl + a) = v.S(i, a);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        by_modes.Si((3 * i + j) * nl + a) = v.Si[i](j, a);
        for (int b = 0; b < nm; ++b) by_modes.Sij((3 * i + j) * nl + a, b) = v.Sij[i][j](b, a);
      }
    }
    for (int b = 0; b < nm; ++b) {
      by_modes.Sij_skew(a, b) = v.Sij[0][1](a, b) - v.Sij[1][0](a, b);
      by_modes.Sij_skew(nl + a, b) = v.Sij[0][2](a, b) - v.Sij[2][0](a, b);
      by_modes.Sij_skew(2 * nl + a, b) = v.Sij[1][2](a, b) - v.Sij[2][1](a, b);
    }
  }
  for (int a = 0; a < nm; ++a) {
    for (int b = 0; b < nm; ++b) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) Sij(9 * a + 3 * i + j, b) = v.Sij[i][j](b, a);
      }
      const int c = a + nm * b;
      for (int i = 0; i < 3; ++i) Sij_sum(i, c) = v.Sij[i][i](a, b);
      Sij_sum(3, c) = v.Sij[0][1](a, b) + v.Sij[1][0](a, b);
      Sij_sum(4, c) = v.Sij[0][2](a, b) + v.Sij[2][0](a, b);
      Sij_sum(5, c) = v.Sij[1][2](a, b) + v.Sij[2][1](a, b);
    }
  }
}

void deform(const PreprocessingData& data, const double* y, DeformedInvariants& d) noexcept {
  const int nm = data.modes();
  assert((y || nm == 0) && d.S_d.rows() == 9 && d.S_d.cols() == nm);
  FLOATFRAME_DEBUG(poison(d.S_d));
  d.m_bar = data.m_u + times(data.S, y);                                 // (29)
  affine(data.Si.data(), data.Sij.data(), 9 * nm, nm, y, d.S_d.data());  // (38)
  const Mat3 first = times9(data.Si, y);                                 // column i: S^i y
  const Mat3 second = times9(d.S_d, y);                                  // column i: S_d^i y
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      d.P_bar(i, j) = data.P_u(i, j) + first(i, j) + second(j, i);  // (33)
      d.P_bar(j, i) = d.P_bar(i, j);
    }
  }
}

namespace {

/// With S(y) in stiffening.S.
void deform_stiffened(const PreprocessingData& data, StiffeningData& stiffening, const double* y,
                      DeformedInvariants& d) noexcept {
  const int nm = data.modes();
  assert((y || nm == 0) && d.S_d.rows() == 9 && d.S_d.cols() == nm);
  assert(stiffening.S.cols() == nm && stiffening.S2.cols() == nm);
  FLOATFRAME_DEBUG(poison(d.S_d));
  FLOATFRAME_DEBUG(poison(stiffening.S));
  affine(data.S.data(), stiffening.S2.data(), 3 * nm, nm, y, stiffening.S.data());
  d.m_bar = data.m_u + 0.5 * (times(data.S, y) + times(stiffening.S, y));
  affine(data.Si.data(), stiffening.S_ij.data(), 9 * nm, nm, y, d.S_d.data());
  const Mat3 both = times9(data.Si, y) + times9(d.S_d, y);
  d.P_bar = data.P_u + 0.5 * (both + both.transpose());
}

/// `stiffening`: null, or with S(y).
template <bool stiffened>
void absolute_terms(const PreprocessingData& data, const StiffeningData* stiffening, const Mat3& A,
                    const Mat3& Adot, const double* ydot, PreprocessingWorkspace& work, MatX& M,
                    VecX& Qv) noexcept {
  const int nm = data.modes();
  const int nq = 12 + nm;
  assert((ydot || nm == 0) && work.S_dot.size() == 9 * nm);
  assert(M.rows() == nq && M.cols() == nq && Qv.size() == nq);
  FLOATFRAME_DEBUG(poison(M));
  FLOATFRAME_DEBUG(poison(Qv));
  DeformedInvariants& d = work.deformed;
  const Mat3X& S = stiffened ? stiffening->S : data.S;

  M.topLeftCorner<12, 12>().setZero();
  for (int k = 0; k < 3; ++k) {
    M(k, k) = data.m;  // (27)
    for (int i = 0; i < 3; ++i) {
      M(k, 3 + 3 * i + k) = M(3 + 3 * i + k, k) = d.m_bar(i);                       // (30)
      for (int j = 0; j < 3; ++j) M(3 + 3 * i + k, 3 + 3 * j + k) = d.P_bar(i, j);  // (34)
    }
  }

  Qv.head<3>() = -2.0 * (Adot * times(S, ydot));  // (43)
  const Mat3 S_d_rate = times9(d.S_d, ydot);
  Mat3 Q_theta;
  Q_theta.noalias() = -2.0 * (Adot * S_d_rate);  // (44)
  if constexpr (stiffened) {
    const RateForces r = rate_forces(*stiffening, nm, ydot);
    Qv.head<3>() -= A * r.q;
    Q_theta.noalias() -= A * r.Q;
  }
  Qv.segment<9>(3) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(Q_theta.data());

  const Mat3 G = A.transpose() * A;
  const Mat3 H = A.transpose() * Adot;
  // sum_ij H_ij S^ij ydot: row 3i+j of Sij ydot is ydot^T S^ij = (S^ji ydot)^T, so it meets H_ji.
  const Eigen::Map<const Eigen::Matrix<double, 9, 1>> H9(H.data());  // entry 3i+j: H(j, i)
  double* rate = work.S_dot.data();
  affine(nullptr, data.Sij.data(), 9 * nm, nm, ydot, rate);
  for (int a = 0; a < nm; ++a) {
    M.block<3, 1>(0, 12 + a).noalias() = A * S.col(a);  // (35)
    for (int i = 0; i < 3; ++i) {
      M.block<3, 1>(3 + 3 * i, 12 + a).noalias() = A * d.S_d.block<3, 1>(3 * i, a);  // (37)
    }
    const Eigen::Map<const Eigen::Matrix<double, 9, 1>> rate9(rate + 9 * a);
    Qv(12 + a) = -2.0 * H9.dot(rate9);  // (45), any A
  }
  const double g0 = G(0, 0), g1 = G(1, 1), g2 = G(2, 2), g3 = G(0, 1), g4 = G(0, 2), g5 = G(1, 2);
  for (int a = 0; a < nm; ++a) {
    double* column = M.data() + static_cast<std::ptrdiff_t>(12 + a) * nq;
    const double* s = data.Sij_sum.data() + static_cast<std::ptrdiff_t>(6 * nm) * a;
    for (int b = 0; b < nm; ++b, s += 6) {
      column[12 + b] = (g0 * s[0] + g1 * s[1]) + (g2 * s[2] + g3 * s[3]) +
                       (g4 * s[4] + g5 * s[5]);  // (40), any A
    }
    for (int k = 0; k < 12; ++k) M(12 + a, k) = column[k];
  }
  assert(is_symmetric(M));
}

}  // namespace

void absolute_preprocessing(const PreprocessingData& data, const Mat3& A, const Mat3& Adot,
                            const double* y, const double* ydot, PreprocessingWorkspace& work,
                            MatX& M, VecX& Qv) noexcept {
  deform(data, y, work.deformed);
  absolute_terms<false>(data, nullptr, A, Adot, ydot, work, M, Qv);
}

void absolute_stiffened(const PreprocessingData& data, StiffeningData& stiffening, const Mat3& A,
                        const Mat3& Adot, const double* y, const double* ydot,
                        PreprocessingWorkspace& work, MatX& M, VecX& Qv) noexcept {
  deform_stiffened(data, stiffening, y, work.deformed);
  absolute_terms<true>(data, &stiffening, A, Adot, ydot, work, M, Qv);
}

}  // namespace floatframe
