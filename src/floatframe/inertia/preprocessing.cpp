#include "floatframe/inertia/preprocessing.hpp"

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
  Si.resize(9, nm);
  Sij.resize(9 * nm, nm);
  Sij_skew.resize(3 * nm, nm);
  Sij_sum.resize(6, nm * nm);
  M_ff = v.Sij[0][0] + v.Sij[1][1] + v.Sij[2][2];  // (40)
  for (int i = 0; i < 3; ++i) Si.middleRows<3>(3 * i) = v.Si[i];
  for (int a = 0; a < nm; ++a) {
    for (int b = 0; b < nm; ++b) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) Sij(9 * a + 3 * i + j, b) = v.Sij[i][j](b, a);
      }
      Sij_skew(3 * a, b) = v.Sij[0][1](a, b) - v.Sij[1][0](a, b);
      Sij_skew(3 * a + 1, b) = v.Sij[0][2](a, b) - v.Sij[2][0](a, b);
      Sij_skew(3 * a + 2, b) = v.Sij[1][2](a, b) - v.Sij[2][1](a, b);
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

void relative_preprocessing(const PreprocessingData& data, const Vec3& r0, const Mat3& A,
                            const Vec3& omega, const double* y, const double* ydot,
                            PreprocessingWorkspace& work, MatX& M, VecX& Qv) noexcept {
  const int nm = data.modes();
  const int nq = 6 + nm;
  DeformedInvariants& d = work.deformed;
  deform(data, y, d);

  const Vec3 c = A * d.m_bar;
  const Vec3 m_vec = data.m * r0 + c;                               // (49)
  const Mat3 J_bar = d.P_bar.trace() * Mat3::Identity() - d.P_bar;  // (21)
  const Mat3 AJ = A * J_bar;
  Mat3 J = AJ * A.transpose();  // (51), about the frame origin
  J += (data.m * r0.squaredNorm() + 2.0 * r0.dot(c)) *
       Mat3::Identity();  // ... moved to the origin of r0
  J -= m_vec * r0.transpose();
  J -= r0 * c.transpose();

  M.topLeftCorner<6, 6>().setZero();
  for (int k = 0; k < 3; ++k) M(k, k) = data.m;  // (47)
  const Mat3 m_tilde = skew(m_vec);
  M.block<3, 3>(3, 0) = m_tilde;  // (48)
  M.block<3, 3>(0, 3) = -m_tilde;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) M(3 + i, 3 + j) = 0.5 * (J(i, j) + J(j, i));
  }

  // Velocity terms shared by all modes.
  const Vec3 w = A.transpose() * omega;  // omega in body axes
  const Vec3 AS_rate = A * times(data.S, ydot);
  const Mat3 S_d_rate = times9(d.S_d, ydot);
  const Vec3 F_d_rate =
      r0.cross(omega.cross(AS_rate)) + A * (w * S_d_rate.trace() - S_d_rate * w);  // F_d ydot, (62)
  Qv.head<3>() = omega.cross(m_vec.cross(omega)) - 2.0 * omega.cross(AS_rate);     // (60)
  Qv.segment<3>(3) = -omega.cross(M.block<3, 3>(3, 3) * omega) - 2.0 * F_d_rate;   // (61)
  // F_d^T omega = S^T A^T ((omega x r0) x omega) + sum_ij (|w|^2 delta_ij - w_i w_j) (S_d^i)_(j)
  const Vec3 g = A.transpose() * omega.cross(r0).cross(omega);
  const Mat3 W = w.squaredNorm() * Mat3::Identity() - w * w.transpose();
  const Eigen::Map<const Eigen::Matrix<double, 9, 1>> W9(W.data());

  double* skew_rate = work.product.data();
  affine(nullptr, data.Sij_skew.data(), 3 * nm, nm, ydot, skew_rate);
  for (int a = 0; a < nm; ++a) {
    const Vec3 s = data.S.col(a);
    const auto S_d = d.S_d.col(a).head<9>();
    const Vec3 AS = A * s;  // (50)
    const Vec3 F_bar(S_d(5) - S_d(7), S_d(6) - S_d(2), S_d(1) - S_d(3));
    const Vec3 F = r0.cross(AS) + A * F_bar;  // (53)
    M.block<3, 1>(0, 6 + a) = AS;
    M.block<3, 1>(3, 6 + a) = F;
    const double C_rate = -w.z() * skew_rate[3 * a] + w.y() * skew_rate[3 * a + 1] -
                          w.x() * skew_rate[3 * a + 2];  // (C ydot)_a
    Qv(6 + a) = g.dot(s) + W9.dot(S_d) - 2.0 * C_rate;   // (63)
  }
  for (int a = 0; a < nm; ++a) {
    double* column = M.data() + static_cast<std::ptrdiff_t>(a + 6) * nq;
    const double* mff = data.M_ff.data() + static_cast<std::ptrdiff_t>(a) * nm;
    for (int b = 0; b < nm; ++b) column[6 + b] = mff[b];  // (54)
    for (int k = 0; k < 6; ++k) M(6 + a, k) = column[k];
  }
}

void absolute_preprocessing(const PreprocessingData& data, const Mat3& A, const Mat3& Adot,
                            const double* y, const double* ydot, PreprocessingWorkspace& work,
                            MatX& M, VecX& Qv) noexcept {
  const int nm = data.modes();
  const int nq = 12 + nm;
  DeformedInvariants& d = work.deformed;
  deform(data, y, d);

  M.topLeftCorner<12, 12>().setZero();
  for (int k = 0; k < 3; ++k) {
    M(k, k) = data.m;  // (27)
    for (int i = 0; i < 3; ++i) {
      M(k, 3 + 3 * i + k) = M(3 + 3 * i + k, k) = d.m_bar(i);                       // (30)
      for (int j = 0; j < 3; ++j) M(3 + 3 * i + k, 3 + 3 * j + k) = d.P_bar(i, j);  // (34)
    }
  }

  Qv.head<3>() = -2.0 * (Adot * times(data.S, ydot));  // (43)
  const Mat3 S_d_rate = times9(d.S_d, ydot);
  Mat3 Q_theta;
  Q_theta.noalias() = -2.0 * (Adot * S_d_rate);  // (44)
  Qv.segment<9>(3) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(Q_theta.data());

  const Mat3 G = A.transpose() * A;
  const Mat3 H = A.transpose() * Adot;
  // sum_ij H_ij S^ij ydot: row 3i+j of Sij ydot is ydot^T S^ij = (S^ji ydot)^T, so it meets H_ji.
  const Eigen::Map<const Eigen::Matrix<double, 9, 1>> H9(H.data());  // entry 3i+j: H(j, i)
  double* rate = work.S_dot.data();
  affine(nullptr, data.Sij.data(), 9 * nm, nm, ydot, rate);
  for (int a = 0; a < nm; ++a) {
    M.block<3, 1>(0, 12 + a).noalias() = A * data.S.col(a);  // (35)
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
}

void subtract_literal_correction(const PreprocessingData& data, const DeformedInvariants& deformed,
                                 const Vec3& r0, const Mat3& A, const Vec3& omega, const Vec3& sdot,
                                 VecX& Qv) noexcept {
  const Vec3 a = omega.cross(sdot);
  const Vec3 m_vec = data.m * r0 + A * deformed.m_bar;
  const Vec3 a_body = A.transpose() * a;
  Qv.head<3>() -= data.m * a;
  Qv.segment<3>(3) -= m_vec.cross(a);
  for (int k = 0; k < data.modes(); ++k) Qv(6 + k) -= data.S.col(k).dot(a_body);
}

}  // namespace floatframe
