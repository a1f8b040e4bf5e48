#include "floatframe/body/fe_invariants.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/lumped_mass.hpp"

namespace floatframe {
namespace {

/// Row z of one point and the Gram matrix of all.
class Gram {
 public:
  explicit Gram(int modes) : nm_(modes), width_(3 * modes + 4), sum_(MatX::Zero(width_, width_)) {}

  int width() const { return width_; }

  /// z of a point from its position and the 3 x nm mode shapes there.
  template <class Shapes>
  void fill(const Vec3& p, const Shapes& X, double one, Eigen::Ref<VecX> z) const {
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < nm_; ++a) z(i * nm_ + a) = X(i, a);
      z(3 * nm_ + i) = p(i);
    }
    z(3 * nm_ + 3) = one;
  }
  void add(double mass, const VecX& z) { add(mass, z, z); }
  /// Upper half of mass z1^T z2; the caller adds the transposed pair as well.
  void add(double mass, const VecX& z1, const VecX& z2) {
    for (int j = 0; j < width_; ++j) {
      const double f = mass * z2(j);
      double* column = sum_.data() + static_cast<std::ptrdiff_t>(j) * width_;
      for (int i = 0; i <= j; ++i) column[i] += z1(i) * f;
    }
  }
  InertiaInvariants invariants() const {
    const MatX G = sum_.selfadjointView<Eigen::Upper>();
    InertiaInvariants v = InertiaInvariants::zero(nm_);
    v.m = G(width_ - 1, width_ - 1);
    v.m_u = G.block(3 * nm_, width_ - 1, 3, 1);
    v.P_u = G.block(3 * nm_, 3 * nm_, 3, 3);
    for (int i = 0; i < 3; ++i) {
      v.S.row(i) = G.block(width_ - 1, i * nm_, 1, nm_);
      for (int k = 0; k < 3; ++k) {
        v.Si[i].row(k) = G.block(3 * nm_ + i, k * nm_, 1, nm_);
        v.Sij[i][k] = G.block(i * nm_, k * nm_, nm_, nm_);
      }
    }
    return v;
  }

 private:
  int nm_, width_;
  MatX sum_;
};

/// Adds a rigid particle with second moments P (about its centre) that rotates by theta = R y: each
/// principal direction e acts as a point with position e and shapes theta x e relative to the
/// centre.
template <class Rotations>
void add_second_moments(const Mat3& P, const Rotations& R, VecX& z, Gram& gram) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(P);
  for (int k = 0; k < 3; ++k) {
    const double sigma = eigen.eigenvalues()(k);
    if (sigma <= 0.0) continue;
    const Vec3 e = eigen.eigenvectors().col(k);
    Mat3X shapes(3, R.cols());
    for (int a = 0; a < R.cols(); ++a) shapes.col(a) = Vec3(R.col(a)).cross(e);
    gram.fill(e, shapes, 0.0, z);
    gram.add(sigma, z);
  }
}

int rows_per_node(const FeModel& model, const MatX& X) {
  const int n = model.nodes();
  if (X.rows() == 6 * n) return 6;
  if (X.rows() == 3 * n || X.cols() == 0) return 3;
  throw InputError(ErrorCode::wrong_count, "the mode shapes have " + std::to_string(X.rows()) +
                                               " rows; " + std::to_string(n) + " nodes need " +
                                               std::to_string(3 * n) + " or " +
                                               std::to_string(6 * n));
}

void add_isoparametric(const FeModel& model, const FeElement& element, const MatX& X, int rows,
                       MatX& mass, MatX& Z, Gram& gram) {
  const ElementKernel& kernel = element_kernel(element.type);
  scalar_mass_matrix(kernel, gather(model, element), mass);
  const int nm = static_cast<int>(X.cols());
  Z.resize(gram.width(), 2 * kernel.nodes);
  for (int k = 0; k < kernel.nodes; ++k) {
    const int node = element.nodes[k];
    gram.fill(model.positions[node], X.block(nm > 0 ? node * rows : 0, 0, nm > 0 ? 3 : 0, nm), 1.0,
              Z.col(k));
  }
  VecX z1(gram.width()), z2(gram.width());
  for (int k = 0; k < kernel.nodes; ++k) {
    z1 = Z.col(k);
    z2.setZero();
    for (int l = 0; l < kernel.nodes; ++l) z2 += mass(k, l) * Z.col(l);
    gram.add(1.0, z1, z2);
  }
}

constexpr int gauss_points = 5;

struct GaussPoint {
  double xi, weight;  ///< on [0, 1]
};

std::array<GaussPoint, gauss_points> gauss() {
  const double a = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double b = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double wa = (322.0 + 13.0 * std::sqrt(70.0)) / 900.0;
  const double wb = (322.0 - 13.0 * std::sqrt(70.0)) / 900.0;
  const double x[] = {-b, -a, 0.0, a, b};
  const double w[] = {wb, wa, 128.0 / 225.0, wa, wb};
  std::array<GaussPoint, gauss_points> points{};
  for (std::size_t i = 0; i < gauss_points; ++i) points[i] = {0.5 * (1.0 + x[i]), 0.5 * w[i]};
  return points;
}

void add_hermite_beam(const FeModel& model, const FeElement& element, const MatX& X,
                      bool section_inertia, VecX& z, Gram& gram) {
  static const std::array<GaussPoint, gauss_points> points = gauss();
  const ElementInput in = gather(model, element);
  const double L = (in.p[1] - in.p[0]).norm();
  const Mat3 T = beam_axes(in);
  const int nm = static_cast<int>(X.cols());
  Eigen::Matrix<double, 12, Eigen::Dynamic> local(
      12, nm);  // end displacements and rotations, local axes
  for (int end = 0; end < 2; ++end) {
    const int row = nm > 0 ? 6 * element.nodes[end] : 0;
    if (nm == 0) break;
    local.middleRows<3>(6 * end) = T.transpose() * X.middleRows<3>(row);
    local.middleRows<3>(6 * end + 3) = T.transpose() * X.middleRows<3>(row + 3);
  }
  Mat3X shapes(3, nm), turn(3, nm), section(3, nm);
  for (const GaussPoint& g : points) {
    const double s = g.xi, s2 = s * s, s3 = s2 * s;
    const double h[4] = {1 - 3 * s2 + 2 * s3, L * (s - 2 * s2 + s3), 3 * s2 - 2 * s3,
                         L * (s3 - s2)};
    const double d[4] = {(-6 * s + 6 * s2) / L, 1 - 4 * s + 3 * s2, (6 * s - 6 * s2) / L,
                         3 * s2 - 2 * s};
    for (int a = 0; a < nm; ++a) {
      const auto q = local.col(a);
      shapes(0, a) = (1 - s) * q(0) + s * q(6);
      shapes(1, a) = h[0] * q(1) + h[1] * q(5) + h[2] * q(7) + h[3] * q(11);
      shapes(2, a) = h[0] * q(2) - h[1] * q(4) + h[2] * q(8) - h[3] * q(10);
      turn(0, a) = (1 - s) * q(3) + s * q(9);
      turn(1, a) = -(d[0] * q(2) - d[1] * q(4) + d[2] * q(8) - d[3] * q(10));
      turn(2, a) = d[0] * q(1) + d[1] * q(5) + d[2] * q(7) + d[3] * q(11);
    }
    shapes = T * shapes.eval();
    const double length = in.material.density * L * g.weight;
    const Vec3 p = in.p[0] + s * (in.p[1] - in.p[0]);
    gram.fill(p, shapes, 1.0, z);
    gram.add(length * in.section.A, z);
    if (section_inertia) {
      // theta x (T e_k), with int y^2 dA = Iz and int z^2 dA = Iy
      for (int k = 1; k < 3; ++k) {
        for (int a = 0; a < nm; ++a) section.col(a) = T * turn.col(a).cross(Vec3::Unit(k));
        gram.fill(T.col(k), section, 0.0, z);
        gram.add(length * (k == 1 ? in.section.Iz : in.section.Iy), z);
      }
    }
  }
}

}  // namespace

InertiaInvariants invariants_isoparametric(const FeModel& model, const MatX& X) {
  const int nm = static_cast<int>(X.cols());
  const int rows = rows_per_node(model, X);
  Gram gram(nm);
  MatX mass, Z;
  for (const FeElement& element : model.elements) {
    add_isoparametric(model, element, X, rows, mass, Z, gram);
  }
  VecX z(gram.width());
  for (const PointMass& p : model.masses) {
    gram.fill(model.positions[p.node], X.block(nm > 0 ? p.node * rows : 0, 0, nm > 0 ? 3 : 0, nm),
              1.0, z);
    gram.add(p.mass, z);
  }
  return gram.invariants();
}

InertiaInvariants invariants_hermite(const FeModel& model, const MatX& X, bool section_inertia) {
  const int nm = static_cast<int>(X.cols());
  const int rows = rows_per_node(model, X);
  if (model.has_beams() && nm > 0 && rows != 6) {
    throw InputError(ErrorCode::wrong_count,
                     "exact integrals of beams need mode shapes with six rows per node");
  }
  Gram gram(nm);
  MatX mass, Z;
  VecX z(gram.width());
  for (const FeElement& element : model.elements) {
    if (element.type == FeElementType::beam2) {
      add_hermite_beam(model, element, X, section_inertia, z, gram);
    } else {
      add_isoparametric(model, element, X, rows, mass, Z, gram);
    }
  }
  for (const PointMass& p : model.masses) {
    const int row = nm > 0 ? p.node * rows : 0;
    gram.fill(model.positions[p.node], X.block(row, 0, nm > 0 ? 3 : 0, nm), 1.0, z);
    gram.add(p.mass, z);
    if (p.J.cwiseAbs().maxCoeff() > 0.0) {
      const Mat3 P = 0.5 * p.J.trace() * Mat3::Identity() - p.J;  // (21)
      add_second_moments(P, X.block(nm > 0 ? row + 3 : 0, 0, nm > 0 ? 3 : 0, nm), z, gram);
    }
  }
  return gram.invariants();
}

}  // namespace floatframe
