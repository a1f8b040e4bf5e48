// 8-node bricks. Nodes: bottom face 1-4 counter-clockwise seen from above, top face 5-8 above them.
// N_a = 1/8 prod_i (1 + c_i xi_i) with the local coordinates c of the corner; M as in
// isoparametric.hpp, stiffness with 2 x 2 x 2 points:
//   hex8   as in isoparametric.hpp: too stiff in bending
//   hex8i  also with the incompatible modes 1 - xi_k^2 of Wilson in each direction. Their strains
//          are those of the gradients j_0/j J_0^-T grad (1 - xi_k^2), J_0 and j_0 = det J_0 at the
//          centre (Taylor, Beresford, Wilson 1976), so that the patch test holds; their amplitudes
//          are eliminated, K = K_uu - K_ua K_aa^-1 K_au
//   hex8r  gradients b_i averaged over the volume (Flanagan, Belytschko 1981), and in the hourglass
//          patterns h = (xy, yz, zx, xyz) of the corners the stiffness K_i of hex8i of the
//          parallelepiped at the centre: no locking, and no weak modes.
//          K = V B^T D B + Gamma^T (H^T K_i H) Gamma, gamma = (h - sum_i (h.x_i) b_i)/8
// Mass of all with 3 x 3 x 3 points, which is exact on distorted bricks because N^T N det J has
// degree 4 in each direction.
#include <Eigen/LU>
#include <cmath>

#include "floatframe/fe/isoparametric.hpp"
#include "floatframe/fe/solid_element.hpp"
#include "floatframe/fe/solid_shapes.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

constexpr double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

void functions(const Vec3& xi, solid::Shape& N, solid::ShapeGradients& dN) {
  for (int a = 0; a < 8; ++a) {
    const double x = corner[a][0], y = corner[a][1], z = corner[a][2];
    const double f = 1 + x * xi(0), g = 1 + y * xi(1), h = 1 + z * xi(2);
    N(a) = 0.125 * f * g * h;
    dN.col(a) = 0.125 * Vec3(x * g * h, f * y * h, f * g * z);
  }
}

const solid::IsoparametricElement& element() {
  static const solid::IsoparametricElement made = [] {
    QuadratureRule corners;
    std::vector<Vec3> nodes;
    for (const auto& c : corner) {
      nodes.emplace_back(c[0], c[1], c[2]);
      corners.push_back({nodes.back(), 1.0});
    }
    return solid::isoparametric(8, &functions, {brick_rule(2), brick_rule(2)},
                                {brick_rule(3), brick_rule(2)},
                                {brick_rule(2), nodes, &solid::trilinear}, corners);
  }();
  return made;
}

using Modes = Eigen::Matrix<double, 9, 24>;
using Gradients8 = Eigen::Matrix<double, 3, 8>;
using Strain24 = Eigen::Matrix<double, 6, 24>;

Mat3 centre_jacobian(const solid::Positions& P) {
  Mat3 J = Mat3::Zero();
  for (int a = 0; a < 8; ++a) {
    J += 0.125 * P.col(a) * Eigen::RowVector3d(corner[a][0], corner[a][1], corner[a][2]);
  }
  return J;
}

/// Strains of the nine incompatible modes at point q: j0/j J0^-T grad(1 - xi_k^2).
Eigen::Matrix<double, 6, 9> incompatible_strains(const Mat3& J0, const Vec3& xi, double detJ) {
  const Mat3 inverse = J0.inverse();
  solid::ShapeGradients g(3, 3);
  for (int k = 0; k < 3; ++k) {
    g.col(k) = (-2.0 * xi(k) * J0.determinant() / detJ) * inverse.row(k).transpose();
  }
  return solid::strain_matrix(g);
}

/// K of hex8i and the amplitudes of the modes from the displacements.
void incompatible(const ElementInput& in, MatX& K, Modes& amplitudes) {
  const solid::SampledRule& rule = element().stiffness[0];
  const solid::Positions P = solid::positions(in, 8);
  const Mat3 J0 = centre_jacobian(P);
  Eigen::Matrix<double, 33, 33> all = Eigen::Matrix<double, 33, 33>::Zero();
  const auto add = [&](const solid::SampledRule& points, int q, const LayupPly* ply) {
    double detJ = 0.0;
    Eigen::Matrix<double, 6, 33> B;
    B.leftCols<24>() = solid::strain_matrix(solid::gradients(points, q, P, detJ));
    B.rightCols<9>() = incompatible_strains(J0, points.points[q], detJ);
    const Mat6 D = solid::elasticity_at(in, points, q, ply, P);
    const Eigen::Matrix<double, 6, 33> DB = (points.weight(q) * detJ) * (D * B);
    all.noalias() += B.transpose() * DB;
  };
  solid::each_point(element(), rule, in, add);
  const MatX modes = all.bottomRightCorner<9, 9>(), load = all.bottomLeftCorner<9, 24>();
  amplitudes = -ldlt_solve(modes, load);
  K = all.topLeftCorner<24, 24>() + all.topRightCorner<24, 9>() * amplitudes;
  K = (0.5 * (K + K.transpose())).eval();
}

void stiffness_i(const ElementInput& in, MatX& K) {
  Modes amplitudes;
  incompatible(in, K, amplitudes);
}

void nodal_strains_i(const ElementInput& in, MatX& B) {
  Modes amplitudes;
  MatX K;
  incompatible(in, K, amplitudes);
  solid::nodal_strains(element(), in, B);
  const solid::SampledRule& rule = element().stress;
  const solid::Positions P = solid::positions(in, 8);
  const Mat3 J0 = centre_jacobian(P);
  for (int q = 0; q < rule.size(); ++q) {
    double detJ = 0.0;
    solid::gradients(rule, q, P, detJ);
    const Eigen::Matrix<double, 6, 24> more =
        incompatible_strains(J0, rule.points[q], detJ) * amplitudes;
    for (int a = 0; a < 8; ++a) B.middleRows<6>(6 * a) += element().to_nodes(a, q) * more;
  }
}

void stressed_points_i(const ElementInput& in, std::vector<StressedPoint>& points) {
  Modes amplitudes;
  MatX K;
  incompatible(in, K, amplitudes);
  solid::stressed_points(element(), in, points);
  const solid::SampledRule& rule = element().stress;
  const solid::Positions P = solid::positions(in, 8);
  const Mat3 J0 = centre_jacobian(P);
  std::size_t k = 0;
  const auto add = [&](const solid::SampledRule& at, int q, const LayupPly* ply) {
    double detJ = 0.0;
    solid::gradients(at, q, P, detJ);
    const Eigen::Matrix<double, 6, 24> more =
        incompatible_strains(J0, at.points[q], detJ) * amplitudes;
    const Mat6 D = solid::elasticity_at(in, at, q, ply, P);
    points[k++].stress += (at.weight(q) * detJ) * (D * more);
  };
  solid::each_point(element(), rule, in, add);
}

/// Gradients of the shape functions averaged over the volume.
Gradients8 mean_gradients(const solid::Positions& P, double& volume) {
  // int dN/dx det J has degree 2 in each direction: 2 x 2 x 2 points are exact.
  const solid::SampledRule& rule = element().stiffness[0];
  Gradients8 b = Gradients8::Zero();
  volume = 0.0;
  for (int q = 0; q < rule.size(); ++q) {
    double detJ = 0.0;
    const solid::ShapeGradients g = solid::gradients(rule, q, P, detJ);
    b += (rule.weight(q) * detJ) * g;
    volume += rule.weight(q) * detJ;
  }
  b /= volume;
  return b;
}

void stiffness_r(const ElementInput& in, MatX& K) {
  const solid::Positions P = solid::positions(in, 8);
  double volume = 0.0;
  const Gradients8 b = mean_gradients(P, volume);
  const Strain24 B = solid::strain_matrix(b);
  const Strain24 DB = volume * elasticity_at(in, P.rowwise().mean()) * B;
  K = B.transpose() * DB;
  // Hourglass vectors without their linear part: gamma = (h - sum_i (h . x_i) b_i)/8.
  Eigen::Matrix<double, 8, 4> h;
  for (int a = 0; a < 8; ++a) {
    const double x = corner[a][0], y = corner[a][1], z = corner[a][2];
    h.row(a) << x * y, y * z, z * x, x * y * z;
  }
  const Gradients8 X = P;
  const Eigen::Matrix<double, 3, 4> Xh = X * h;
  const Eigen::Matrix<double, 8, 4> gamma = 0.125 * (h - b.transpose() * Xh);
  ElementInput block = in;
  const Mat3 J0 = centre_jacobian(P);
  const Vec3 centre = in.orientation ? Vec3(P.rowwise().mean()) : Vec3(Vec3::Zero());
  for (int a = 0; a < 8; ++a) {
    block.p[a] = centre + J0 * Vec3(corner[a][0], corner[a][1], corner[a][2]);
  }
  MatX K_block;
  stiffness_i(block, K_block);
  Eigen::Matrix<double, 24, 12> H = Eigen::Matrix<double, 24, 12>::Zero();
  Eigen::Matrix<double, 12, 24> Gamma = Eigen::Matrix<double, 12, 24>::Zero();
  for (int a = 0; a < 8; ++a) {
    for (int m = 0; m < 4; ++m) {
      H.block<3, 3>(3 * a, 3 * m) = h(a, m) * Mat3::Identity();
      Gamma.block<3, 3>(3 * m, 3 * a) = gamma(a, m) * Mat3::Identity();
    }
  }
  const Eigen::Matrix<double, 24, 12> KH = Eigen::Matrix<double, 24, 24>(K_block) * H;
  const Eigen::Matrix<double, 12, 12> S = H.transpose() * KH;
  const Eigen::Matrix<double, 12, 24> SG = S * Gamma;
  K += Gamma.transpose() * SG;
  K = (0.5 * (K + K.transpose())).eval();
}

void nodal_strains_r(const ElementInput& in, MatX& out) {
  double volume = 0.0;
  const Strain24 B = solid::strain_matrix(mean_gradients(solid::positions(in, 8), volume));
  out = B.replicate(8, 1);
}

void stressed_points_r(const ElementInput& in, std::vector<StressedPoint>& points) {
  double volume = 0.0;
  const solid::Positions P = solid::positions(in, 8);
  const Gradients8 b = mean_gradients(P, volume);
  points.resize(1);
  points[0].stress = volume * elasticity_at(in, P.rowwise().mean()) * solid::strain_matrix(b);
  solid::set_gradient(b, points[0].gradient);
}

constexpr ElementKernel with(ElementKernel kernel, void (*stiffness)(const ElementInput&, MatX&),
                             void (*nodal_strains)(const ElementInput&, MatX&),
                             void (*points)(const ElementInput&, std::vector<StressedPoint>&)) {
  kernel.stiffness = stiffness;
  kernel.nodal_strains = nodal_strains;
  kernel.stressed_points = points;
  return kernel;
}

}  // namespace

constinit const ElementKernel hex8_kernel =
    solid::layered<element>(solid::kernel<element>(8, shape::hex8));
constinit const ElementKernel hex8i_kernel = solid::layered<element>(with(
    solid::kernel<element>(8, shape::hex8), &stiffness_i, &nodal_strains_i, &stressed_points_i));
constinit const ElementKernel hex8r_kernel = with(
    solid::kernel<element>(8, shape::hex8), &stiffness_r, &nodal_strains_r, &stressed_points_r);

}  // namespace floatframe
