#include "floatframe/fe/quadrature.hpp"

#include <cmath>

#include "floatframe/math/dense.hpp"

namespace floatframe {

LineRule gauss_jacobi(int n, int alpha) {
  // Golub-Welsch: the points are the eigenvalues of the Jacobi matrix of the polynomials that are
  // orthogonal with the weight (1 - x)^alpha on [-1, 1].
  MatX J = MatX::Zero(n, n);
  const double a = alpha;
  for (int k = 0; k < n; ++k) {
    const double s = 2.0 * k + a;
    J(k, k) = alpha == 0 ? 0.0 : -a * a / (s * (s + 2.0));
    if (k == 0) continue;
    const double b = 4.0 * k * (k + a) * k * (k + a) / (s * s * (s + 1.0) * (s - 1.0));
    J(k, k - 1) = J(k - 1, k) = std::sqrt(b);
  }
  const SymmetricEigen eigen = symmetric_eigen(J);
  LineRule rule;
  rule.u = 0.5 * (eigen.values.array() + 1.0);
  rule.weight = eigen.vectors.row(0).array().square() / (a + 1.0);
  return rule;
}

QuadratureRule brick_rule(int n) {
  const LineRule g = gauss_jacobi(n, 0);
  QuadratureRule rule;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        rule.push_back({Vec3(2 * g.u(i) - 1, 2 * g.u(j) - 1, 2 * g.u(k) - 1),
                        8 * g.weight(i) * g.weight(j) * g.weight(k)});
      }
    }
  }
  return rule;
}

QuadratureRule tetrahedron_rule(int n) {
  const LineRule a = gauss_jacobi(n, 2), b = gauss_jacobi(n, 1), c = gauss_jacobi(n, 0);
  QuadratureRule rule;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const double u = a.u(i), v = b.u(j), w = c.u(k);
        rule.push_back(
            {Vec3(u, v * (1 - u), w * (1 - u) * (1 - v)), a.weight(i) * b.weight(j) * c.weight(k)});
      }
    }
  }
  return rule;
}

QuadratureRule tetrahedron_rule_4() {
  const double b = (5.0 - std::sqrt(5.0)) / 20.0, a = 1.0 - 3.0 * b, w = 1.0 / 24.0;
  return {{Vec3(b, b, b), w}, {Vec3(a, b, b), w}, {Vec3(b, a, b), w}, {Vec3(b, b, a), w}};
}

QuadratureRule triangle_rule_3() {
  constexpr double a = 1.0 / 6.0, b = 2.0 / 3.0;
  return {{Vec3(a, a, 0), a}, {Vec3(b, a, 0), a}, {Vec3(a, b, 0), a}};
}

QuadratureRule triangle_rule(int n) {
  const LineRule a = gauss_jacobi(n, 1), b = gauss_jacobi(n, 0);
  QuadratureRule rule;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      rule.push_back({Vec3(a.u(i), b.u(j) * (1 - a.u(i)), 0.0), a.weight(i) * b.weight(j)});
    }
  }
  return rule;
}

}  // namespace floatframe
