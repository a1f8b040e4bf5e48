#pragma once
// A rotor of round beams and rigid discs assembled directly in axes that do not turn: what rotors
// made of bodies are compared with. Independent of the library. Across the axis x, with (v, tilt)
// of the nodes in q_v and (w, tilt) in q_w:
//   M q_v'' + C_vv q_v' + C_vw q_w' + W G q_w' + K q_v ... = 0
//   M q_w'' + C_ww q_w' + C_wv q_v' - W G q_v' + K q_w ... = 0
// M: translations and rotary inertia of sections (Rayleigh), G: the polar inertia of sections and
// discs on the tilts. With a shear factor the beam is Timoshenko's, exact for loads at its ends.
// Source: Nelson, McVaugh, The dynamics of rotor-bearing systems using finite elements, ASME J.
// Eng. Ind. 98 (1976) 593-600.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace floatframe::test {

struct AssembledRotor {
  struct Disc {
    int node;
    double m, J_p, J_t;
  };
  /// K and C of (v, w).
  struct Bearing {
    int node;
    Eigen::Matrix2d K, C;
  };

  double young = 2e11, poisson = 0.3, density = 7800.0, diameter = 0.1;
  double shear_factor = 0.0;  ///< k of k G A; 0: no shear
  bool lumped = false;        ///< half the mass and rotary inertia of an element at each end
  std::vector<double> x;      ///< places of the nodes [m]
  std::vector<Disc> discs;
  std::vector<Bearing> bearings;

  double area() const { return std::numbers::pi * diameter * diameter / 4.0; }
  double second_moment() const { return std::numbers::pi * std::pow(diameter, 4) / 64.0; }
  int nodes() const { return static_cast<int>(x.size()); }

  /// N and T of (v, psi) at both ends of an element at s = x/L.
  static void shapes(double L, double phi, double s, Eigen::Vector4d& N, Eigen::Vector4d& T,
                     Eigen::Vector4d& T_slope, Eigen::Vector4d& N_slope) {
    const double f = 1.0 / (1.0 + phi), s2 = s * s, s3 = s2 * s;
    N << 1 - 3 * s2 + 2 * s3 + phi * (1 - s), L * (s - 2 * s2 + s3 + 0.5 * phi * (s - s2)),
        3 * s2 - 2 * s3 + phi * s, L * (s3 - s2 - 0.5 * phi * (s - s2));
    T << 6 / L * (s2 - s), 1 - 4 * s + 3 * s2 + phi * (1 - s), 6 / L * (s - s2),
        3 * s2 - 2 * s + phi * s;
    T_slope << 6 / L * (2 * s - 1), -4 + 6 * s - phi, 6 / L * (1 - 2 * s), 6 * s - 2 + phi;
    N_slope << -6 * s + 6 * s2 - phi, L * (1 - 4 * s + 3 * s2 + 0.5 * phi * (1 - 2 * s)),
        6 * s - 6 * s2 + phi, L * (3 * s2 - 2 * s - 0.5 * phi * (1 - 2 * s));
    N *= f, T *= f, T_slope *= f / L, N_slope *= f / L;
  }

  struct Plane {
    Eigen::MatrixXd M, G, K;
  };
  Plane plane() const {
    const int n = 2 * nodes();
    Plane p{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
    const double E = young, I = second_moment(), A = area(), shear = young / (2 * (1 + poisson));
    constexpr int points = 5;
    const double at[points] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                               0.9061798459386640};
    const double weight[points] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                   0.4786286704993665, 0.2369268850561891};
    for (int e = 0; e + 1 < nodes(); ++e) {
      const double L = x[e + 1] - x[e];
      const double S = shear_factor * shear * A;
      const double phi = S > 0.0 ? 12.0 * E * I / (S * L * L) : 0.0;
      for (int g = 0; g < points; ++g) {
        const double s = 0.5 * (1.0 + at[g]), dx = 0.5 * weight[g] * L;
        Eigen::Vector4d N, T, dT, dN;
        shapes(L, phi, s, N, T, dT, dN);
        p.K.block<4, 4>(2 * e, 2 * e) += dx * E * I * dT * dT.transpose();
        if (S > 0.0) p.K.block<4, 4>(2 * e, 2 * e) += dx * S * (dN - T) * (dN - T).transpose();
        if (lumped) continue;
        p.M.block<4, 4>(2 * e, 2 * e) +=
            dx * density * (A * N * N.transpose() + I * T * T.transpose());
        p.G.block<4, 4>(2 * e, 2 * e) += dx * density * 2.0 * I * T * T.transpose();
      }
      for (int end = 0; end < 2 && lumped; ++end) {
        const int k = 2 * (e + end);
        const double half = 0.5 * density * L;
        p.M(k, k) += half * A;
        p.M(k + 1, k + 1) += half * I;
        p.G(k + 1, k + 1) += half * 2.0 * I;
      }
    }
    for (const Disc& d : discs) {
      p.M(2 * d.node, 2 * d.node) += d.m;
      p.M(2 * d.node + 1, 2 * d.node + 1) += d.J_t;
      p.G(2 * d.node + 1, 2 * d.node + 1) += d.J_p;
    }
    return p;
  }

  struct Matrices {
    Eigen::MatrixXd M, C, K;  ///< of (q_v, q_w)
  };
  Matrices matrices(double W) const {
    const Plane p = plane();
    const Eigen::Index n = p.M.rows();
    Matrices m{Eigen::MatrixXd::Zero(2 * n, 2 * n), {}, {}};
    m.C = m.K = m.M;
    m.M.topLeftCorner(n, n) = m.M.bottomRightCorner(n, n) = p.M;
    m.K.topLeftCorner(n, n) = m.K.bottomRightCorner(n, n) = p.K;
    m.C.topRightCorner(n, n) = W * p.G;
    m.C.bottomLeftCorner(n, n) = -W * p.G;
    for (const Bearing& b : bearings)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
          m.K(2 * b.node + i * n, 2 * b.node + j * n) += b.K(i, j);
          m.C(2 * b.node + i * n, 2 * b.node + j * n) += b.C(i, j);
        }
    return m;
  }

  /// Eigenvalues with Im > 0, ascending by it.
  std::vector<std::complex<double>> eigenvalues(double W) const {
    // In the modes of M and the symmetric part of K, z = (w y, y'): entries of like size.
    const Matrices m = matrices(W);
    const Eigen::MatrixXd K = 0.5 * (m.K + m.K.transpose());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, m.M);
    const Eigen::MatrixXd& Y = modes.eigenvectors();
    const Eigen::VectorXd w = modes.eigenvalues().cwiseMax(1e-12).cwiseSqrt();
    const Eigen::Index n = w.size();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n) = w.asDiagonal();
    const Eigen::MatrixXd rest = Y.transpose() * (m.K - K) * Y;
    A.bottomLeftCorner(n, n) = -(rest * w.cwiseInverse().asDiagonal());
    A.bottomLeftCorner(n, n).diagonal() -= w;
    A.bottomRightCorner(n, n) = -(Y.transpose() * m.C * Y);
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
    std::vector<std::complex<double>> out;
    for (Eigen::Index k = 0; k < solver.eigenvalues().size(); ++k)
      if (solver.eigenvalues()[k].imag() > 1e-6) out.push_back(solver.eigenvalues()[k]);
    std::sort(out.begin(), out.end(),
              [](const auto& a, const auto& b) { return a.imag() < b.imag(); });
    return out;
  }
  /// Of round bearings without damping: with r = v + i w, e^(i w t) turns with W,
  ///   (K - w^2 M + w W G) r = 0;   the positive w, ascending.
  std::vector<double> whirl(double W) const {
    Plane p = plane();
    for (const Bearing& b : bearings) p.K(2 * b.node, 2 * b.node) += b.K(0, 0);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(p.K, p.M);
    const Eigen::MatrixXd& Y = modes.eigenvectors();
    const Eigen::VectorXd w = modes.eigenvalues().cwiseMax(1e-12).cwiseSqrt();
    const Eigen::Index n = w.size();
    // z = (w_k y_k, w y_k): w z = (0 w_k; w_k W Y^T G Y) z, symmetric.
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n) = A.bottomLeftCorner(n, n) = w.asDiagonal();
    A.bottomRightCorner(n, n) = W * (Y.transpose() * p.G * Y);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
    std::vector<double> out;
    for (Eigen::Index k = 0; k < 2 * n; ++k)
      if (solver.eigenvalues()[k] > 1e-6) out.push_back(solver.eigenvalues()[k]);
    return out;
  }
};

/// The rotor of three discs of Lalanne, Ferraris, Rotordynamics Prediction in Engineering (1998),
/// its shaft of 1.3 m in `elements` parts. `round`: bearings of 6e7 N/m; else their own.
inline AssembledRotor lalanne_ferraris(bool round, int elements = 26) {
  AssembledRotor r;
  for (int k = 0; k <= elements; ++k) r.x.push_back(1.3 * k / elements);
  const auto node = [&](double x) { return static_cast<int>(std::lround(x / 1.3 * elements)); };
  const double outer[] = {0.12, 0.2, 0.2}, thick[] = {0.05, 0.05, 0.06}, at[] = {0.2, 0.5, 1.0};
  for (int k = 0; k < 3; ++k) {
    const double R2 = outer[k] * outer[k], r2 = 0.05 * 0.05, h = thick[k];
    const double m = 7800.0 * std::numbers::pi * (R2 - r2) * h;
    r.discs.push_back({node(at[k]), m, 0.5 * m * (R2 + r2), m * (0.25 * (R2 + r2) + h * h / 12.0)});
  }
  for (const int k : {0, elements}) {
    AssembledRotor::Bearing b{k, 6e7 * Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Zero()};
    if (!round) {
      b.K = Eigen::Vector2d(5e7, 7e7).asDiagonal();
      b.C = Eigen::Vector2d(500.0, 700.0).asDiagonal();
    }
    r.bearings.push_back(b);
  }
  return r;
}

}  // namespace floatframe::test
