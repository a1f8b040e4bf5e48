// 8-node trilinear brick. Nodes: bottom face 1-4 counter-clockwise seen from above, top face 5-8
// above them. Stiffness with 2 x 2 x 2 Gauss points; scalar mass with 3 x 3 x 3, which is exact on
// distorted bricks because N^T N det J has degree 4 in each direction.
#include <Eigen/LU>
#include <cmath>

#include "floatframe/fe/solid_element.hpp"

namespace floatframe {
namespace {

constexpr double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

struct Point {
  Eigen::Matrix<double, 8, 1> N;
  Eigen::Matrix<double, 3, 8> dN;  ///< with respect to the local coordinates
  Mat3 J;                          ///< J(i, j) = dx_j / dxi_i
};

Point evaluate(const ElementInput& in, double r, double s, double t) {
  Point q;
  q.J.setZero();
  for (int a = 0; a < 8; ++a) {
    const double x = corner[a][0], y = corner[a][1], z = corner[a][2];
    q.N(a) = 0.125 * (1 + x * r) * (1 + y * s) * (1 + z * t);
    q.dN(0, a) = 0.125 * x * (1 + y * s) * (1 + z * t);
    q.dN(1, a) = 0.125 * y * (1 + x * r) * (1 + z * t);
    q.dN(2, a) = 0.125 * z * (1 + x * r) * (1 + y * s);
    q.J += q.dN.col(a) * in.p[static_cast<std::size_t>(a)].transpose();
  }
  return q;
}

std::string fault(const ElementInput& in) {
  double size = 0.0;
  for (std::size_t a = 1; a < 8; ++a) size = std::max(size, (in.p[a] - in.p[0]).norm());
  const double limit = 1e-12 * size * size * size;
  for (const auto& c : corner) {
    if (!(evaluate(in, c[0], c[1], c[2]).J.determinant() > limit)) {
      return "is inverted or flat (its Jacobian is not positive at every corner)";
    }
  }
  return {};
}

void stiffness(const ElementInput& in, MatX& out) {
  const double g = 1.0 / std::sqrt(3.0);
  const Mat6 D = elasticity_matrix(in.material);
  out = MatX::Zero(24, 24);
  for (const auto& c : corner) {
    const Point q = evaluate(in, g * c[0], g * c[1], g * c[2]);
    const solid::Gradients gradients = q.J.inverse() * q.dN;
    const solid::Strain B = solid::strain_matrix(gradients);
    out.noalias() += B.transpose() * D * B * q.J.determinant();
  }
}

void scalar_mass(const ElementInput& in, MatX& out) {
  const double x[3] = {-std::sqrt(0.6), 0.0, std::sqrt(0.6)};
  const double w[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  out = MatX::Zero(8, 8);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        const Point q = evaluate(in, x[i], x[j], x[k]);
        out.noalias() +=
            (in.material.density * w[i] * w[j] * w[k] * q.J.determinant()) * q.N * q.N.transpose();
      }
    }
  }
}

void mass(const ElementInput& in, bool, MatX& out) {
  MatX scalar;
  scalar_mass(in, scalar);
  solid::expand(scalar, out);
}

}  // namespace

const ElementKernel hex8_kernel{ElementType::hex8, "hex8", 8,           3, &fault,
                                &stiffness,        &mass,  &scalar_mass};

}  // namespace floatframe
