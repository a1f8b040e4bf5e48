// Generic tests over the list of element kernels.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <set>

#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/eigenmodes.hpp"
#include "support/error_of.hpp"
#include "support/fe_models.hpp"
#include "support/random_body.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

bool solid(const ElementKernel& kernel) { return kernel.family == ElementFamily::solid; }
int corners_of(const ElementKernel& kernel) {
  return static_cast<int>(kernel.shape.neighbours.size());
}
bool brick(const ElementKernel& kernel) { return corners_of(kernel) == 8; }
bool wedge(const ElementKernel& kernel) { return corners_of(kernel) == 6; }
bool pyramid(const ElementKernel& kernel) { return corners_of(kernel) == 5; }

/// Corners moved at random, straight edges.
ElementInput distorted(FeElementType type, Random& random) {
  const ElementKernel& kernel = element_kernel(type);
  const Vec3 hex[8] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const Vec3 tet[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3 prism[6] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const Vec3 pyramid5[5] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.8}};
  const Vec3 bar[3] = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}};
  ElementInput in;
  const Mat3 R = random.rotation();
  const Vec3* p = tet;
  int corners = 4;
  if (brick(kernel)) p = hex, corners = 8;
  if (wedge(kernel)) p = prism, corners = 6;
  if (pyramid(kernel)) p = pyramid5, corners = 5;
  if (has_shell_section(type)) p = hex, corners = kernel.nodes % 3 == 0 ? 3 : 4;
  if (is_beam(type)) p = kernel.nodes == 3 ? bar : tet;
  corners = std::min(kernel.nodes, corners);
  for (int a = 0; a < corners; ++a) {
    Vec3 moved = p[a] + random.vec3(0.12);
    if (is_membrane(type)) moved(2) = 0.0;
    in.p[a] = R * moved + Vec3(1, 2, 3);
  }
  for (const FaceNodes& face : kernel.shape.faces) {
    for (int i = face.corners; i < face.count; ++i) {
      const int from = i - face.corners, to = (from + 1) % face.corners;
      const auto at = [&](int k) { return in.p[face.nodes[k]]; };
      in.p[face.nodes[i]] = 0.5 * (at(from) + at(to));
    }
  }
  if (type == FeElementType::beam3) in.p[1] = 0.5 * (in.p[0] + in.p[2]);
  in.material = {2e11, 0.3, 7500.0};
  in.section = {1e-3, 2e-7, 5e-7, 4e-7};
  in.shell.thickness = 0.02;
  in.reference = random.vec3();
  return in;
}

/// The six rigid motions of an element's dofs: translations, then rotations about the origin.
MatX rigid_motions(const ElementInput& in, const ElementKernel& kernel) {
  const int d = kernel.dofs_per_node;
  MatX R = MatX::Zero(d * kernel.nodes, 6);
  for (int a = 0; a < kernel.nodes; ++a) {
    R.block<3, 3>(d * a, 0).setIdentity();
    R.block<3, 3>(d * a, 3) = -skew(in.p[a]);
    if (d == 6) R.block<3, 3>(d * a + 3, 3).setIdentity();
  }
  return R;
}

double tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).dot((c - a).cross(d - a)) / 6.0;
}

double volume(ElementInput in, FeElementType type) {
  const ElementKernel& kernel = element_kernel(type);
  const auto area = [&](std::size_t i, std::size_t j, std::size_t k) {
    return 0.5 * (in.p[j] - in.p[i]).cross(in.p[k] - in.p[i]).norm();
  };
  if (is_beam(type) || is_rod(type)) {
    return in.section.A * (in.p[kernel.nodes == 3 ? 2 : 1] - in.p[0]).norm();
  }
  const auto quadrilateral = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return 0.5 * (area(a, b, c) + area(a, c, d) + area(a, b, d) + area(b, c, d));
  };
  const double h = in.shell.thickness;
  if (type == FeElementType::tri3 || type == FeElementType::tri6) return h * area(0, 1, 2);
  if (is_membrane(type) && kernel.nodes % 3 == 0) return h * area(0, 1, 2);
  if (type == FeElementType::quad4 || type == FeElementType::shear4 || is_membrane(type))
    return h * quadrilateral(0, 1, 2, 3);
  if (type == FeElementType::quad8) in.p[8].setZero();
  for (int a = 0; a < 8 && type == FeElementType::quad8; ++a)
    in.p[8] += (a < 4 ? -0.25 : 0.5) * in.p[a];
  if (type == FeElementType::quad8)
    return h * (quadrilateral(0, 4, 8, 7) + quadrilateral(4, 1, 5, 8) + quadrilateral(8, 5, 2, 6) +
                quadrilateral(7, 8, 6, 3));
  if (corners_of(kernel) == 4) return tetrahedron(in.p[0], in.p[1], in.p[2], in.p[3]);
  // Divergence theorem with bilinear faces: each face as the mean of its two triangulations.
  double sum = 0.0;
  for (const FaceNodes& f : kernel.shape.faces) {
    const auto p = [&](int i) { return in.p[f.nodes[i % f.corners]]; };
    if (f.corners == 3) {
      sum += p(0).dot(p(1).cross(p(2))) / 6.0;
      continue;
    }
    for (int start = 0; start < 2; ++start) {
      sum += 0.5 * p(start).dot(p(start + 1).cross(p(start + 2))) / 6.0;
      sum += 0.5 * p(start).dot(p(start + 2).cross(p(start + 3))) / 6.0;
    }
  }
  return sum;
}

TEST(Elements, RigidMotionsGiveNoForceAndTheMassIsRhoV) {
  Random random(1);
  for (const FeElementType type : fe_element_types) {
    const ElementKernel& kernel = element_kernel(type);
    SCOPED_TRACE(fe_element_name(type));
    for (int i = 0; i < 5; ++i) {
      const ElementInput in = distorted(type, random);
      ASSERT_EQ(kernel.error(in), "");
      MatX K, M, M_s;
      kernel.stiffness(in, K);
      kernel.mass(in, false, M);
      kernel.scalar_mass(in, M_s);
      const MatX R = rigid_motions(in, kernel);
      EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.maxCoeff());
      EXPECT_LT((K * R).cwiseAbs().maxCoeff(), 2e-12 * K.cwiseAbs().maxCoeff());
      // 8 points of 6 strains leave a reduced brick six zero-energy modes of its own.
      const int zero = type == FeElementType::hex20r       ? 12
                       : is_rod(type)                      ? 5
                       : is_panel(type)                    ? 11
                       : type == FeElementType::membrane8r ? 12
                       : is_membrane(type)                 ? kernel.nodes + 3
                                                           : 6;
      const VecX lambda = symmetric_eigenvalues(K);
      EXPECT_GT(lambda(zero), 1e-9 * K.maxCoeff());
      EXPECT_GT(lambda(0), -1e-12 * K.maxCoeff());
      const double mass = 7500.0 * volume(in, type);
      EXPECT_NEAR(M_s.sum() / mass, 1.0, 1e-13);
      const MatX rigid = R.transpose() * M * R;
      EXPECT_LT((rigid.topLeftCorner<3, 3>() - mass * Mat3::Identity()).cwiseAbs().maxCoeff(),
                1e-12 * mass);
      EXPECT_LT((M - M.transpose()).cwiseAbs().maxCoeff(), 1e-13 * M.maxCoeff());
      EXPECT_GT(symmetric_eigenvalues(M_s)(0), 0.0);
      EXPECT_GT(symmetric_eigenvalues(M)(0), -1e-14 * M.maxCoeff());
    }
  }
}

/// Displacements u = G x of the nodes, and the strains.
VecX linear_field(const ElementInput& in, int nodes, const Mat3& G, Vec6& strain) {
  VecX u(3 * nodes);
  for (int a = 0; a < nodes; ++a) u.segment<3>(3 * a) = G * in.p[a];
  strain << G(0, 0), G(1, 1), G(2, 2), G(0, 1) + G(1, 0), G(1, 2) + G(2, 1), G(2, 0) + G(0, 2);
  return u;
}

TEST(Elements, ConstantStrainIsExact) {
  Random random(2);
  for (const FeElementType type : fe_element_types) {
    const ElementKernel& kernel = element_kernel(type);
    if (!solid(kernel)) continue;
    SCOPED_TRACE(fe_element_name(type));
    const ElementInput in = distorted(type, random);
    Vec6 strain;
    const VecX u = linear_field(in, kernel.nodes, random.matrix(3, 3), strain);
    MatX K, B;
    kernel.stiffness(in, K);
    const double energy = strain.dot(elasticity_matrix(in.material) * strain) * volume(in, type);
    EXPECT_NEAR(u.dot(K * u) / energy, 1.0, 1e-12);
    kernel.nodal_strains(in, B);
    for (int a = 0; a < kernel.nodes; ++a) {
      EXPECT_LT((B.middleRows<6>(6 * a) * u - strain).norm(), 1e-11 * strain.norm()) << a;
    }
  }
}

// Patch test: eight elements of a kind round a node in the middle, which is moved; the surface
// follows a linear field. The node in the middle must be in equilibrium.
TEST(Elements, PatchTestOfBricks) {
  Random random(12);
  for (const FeElementType type :
       {FeElementType::hex8, FeElementType::hex8i, FeElementType::hex8r}) {
    FeModel model;
    model.materials = {{2e11, 0.3, 7500.0}};
    for (int k = 0; k < 27; ++k) {
      model.positions.push_back(Vec3(k % 3, k / 3 % 3, k / 9) + random.vec3(0.15));
    }
    for (int k = 0; k < 8; ++k) {
      const int n = k % 2 + k / 2 % 2 * 3 + k / 4 * 9;
      add_element(model, type, {n, n + 1, n + 4, n + 3, n + 9, n + 10, n + 13, n + 12});
    }
    validate(model);
    const FeSystem system = assemble(model);
    const Mat3 G = random.matrix(3, 3);
    VecX u(81);
    for (int k = 0; k < 27; ++k) {
      u.segment<3>(3 * k) = G * model.positions[k];
    }
    const VecX f = system.K * u;
    EXPECT_LT(f.segment<3>(39).norm(), 1e-12 * f.norm()) << fe_element_name(type);
    EXPECT_GT(f.segment<3>(0).norm(), 1e-3 * f.norm());
  }
}

struct FacePoint {
  Vec3 p = Vec3::Zero(), dx = Vec3::Zero(), dy = Vec3::Zero();
};

/// Quadratic triangle or 8-node serendipity quadrilateral, from their textbook shape functions.
Vec3 face_position(const ElementInput& in, const FaceNodes& f, double x, double y) {
  double N[8];
  if (f.corners == 3) {
    const double z = 1 - x - y;
    N[0] = z * (2 * z - 1), N[1] = x * (2 * x - 1), N[2] = y * (2 * y - 1);
    N[3] = 4 * z * x, N[4] = 4 * x * y, N[5] = 4 * y * z;
  } else {
    const double cx[4] = {-1, 1, 1, -1}, cy[4] = {-1, -1, 1, 1};
    for (int i = 0; i < 4; ++i) {
      N[i] = 0.25 * (1 + cx[i] * x) * (1 + cy[i] * y) * (cx[i] * x + cy[i] * y - 1);
    }
    N[4] = 0.5 * (1 - x * x) * (1 - y), N[6] = 0.5 * (1 - x * x) * (1 + y);
    N[5] = 0.5 * (1 + x) * (1 - y * y), N[7] = 0.5 * (1 - x) * (1 - y * y);
  }
  Vec3 p = Vec3::Zero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(f.count); ++i) {
    p += N[i] * in.p[f.nodes[i]];
  }
  return p;
}

FacePoint on_face(const ElementInput& in, const FaceNodes& f, double x, double y) {
  // Richardson's difference is exact for polynomials of degree 4.
  const auto derivative = [](const auto& g) {
    const double h = 0.25;
    return Vec3((8.0 * (g(h) - g(-h)) - (g(2 * h) - g(-2 * h))) / (12.0 * h));
  };
  return {face_position(in, f, x, y),
          derivative([&](double h) { return face_position(in, f, x + h, y); }),
          derivative([&](double h) { return face_position(in, f, x, y + h); })};
}

/// Mass of a curved element against a rule of many points on the parent domain.
TEST(Elements, MassOfCurvedElementsIsExact) {
  Random random(5);
  for (const FeElementType type : fe_element_types) {
    const ElementKernel& kernel = element_kernel(type);
    if (!solid(kernel) || kernel.nodes < 10) continue;
    SCOPED_TRACE(fe_element_name(type));
    ElementInput in = distorted(type, random);
    for (int a = corners_of(kernel); a < kernel.nodes; ++a) {
      in.p[a] += random.vec3(0.02);
    }
    ASSERT_EQ(kernel.error(in), "");
    MatX M;
    kernel.scalar_mass(in, M);
    // Divergence theorem on the curved faces: int x n_x dA with 12 x 12 points a face.
    double sum = 0.0;
    const LineRule line = gauss_jacobi(12, 0);
    QuadratureRule square;
    for (int i = 0; i < 144; ++i) {
      square.push_back({Vec3(2 * line.u(i % 12) - 1, 2 * line.u(i / 12) - 1, 0),
                        4 * line.weight(i % 12) * line.weight(i / 12)});
    }
    for (const FaceNodes& f : kernel.shape.faces) {
      for (const QuadraturePoint& q : f.corners == 3 ? triangle_rule(12) : square) {
        const FacePoint point = on_face(in, f, q.xi(0), q.xi(1));
        sum += q.weight * point.p(0) * point.dx.cross(point.dy)(0);
      }
    }
    EXPECT_NEAR(M.sum() / 7500.0 / sum, 1.0, 1e-12);
  }
}

// Faces close the element, each edge met once in either sense, and the edges at a corner are those
// of the faces.
TEST(Elements, FacesAndCornersFitTogether) {
  for (const FeElementType type : fe_element_types) {
    const ElementKernel& kernel = element_kernel(type);
    SCOPED_TRACE(fe_element_name(type));
    EXPECT_EQ(kernel.shape.faces.empty(), is_beam(type) || is_rod(type));
    std::multiset<std::pair<int, int>> edges;
    for (const FaceNodes& f : kernel.shape.faces) {
      for (int i = 0; i < f.count; ++i) EXPECT_LT(f.nodes[i], kernel.nodes);
      for (int i = 0; i < f.corners; ++i) edges.emplace(f.nodes[i], f.nodes[(i + 1) % f.corners]);
    }
    for (const auto& [a, b] : edges) {
      EXPECT_EQ(edges.count({a, b}), 1u) << a << " " << b;
      EXPECT_EQ(edges.count({b, a}), 1u) << a << " " << b;
    }
    const int corners = static_cast<int>(kernel.shape.neighbours.size());
    EXPECT_EQ(corners > 0, kernel.family == ElementFamily::solid);
    for (int c = 0; c < corners; ++c)
      for (const int other : kernel.shape.neighbours[c]) EXPECT_EQ(edges.count({c, other}), 1u);
  }
}

TEST(Elements, DistortedBrickMassIsExact) {
  // Against 5 x 5 x 5 Gauss points by splitting nothing: moments of the mass up to second order,
  // from a refined rule.
  Random random(3);
  const ElementKernel& kernel = element_kernel(FeElementType::hex8);
  const ElementInput in = distorted(FeElementType::hex8, random);
  MatX M;
  kernel.scalar_mass(in, M);
  const double x[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                       0.9061798459386640};
  const double w[5] = {0.2369268850561891, 0.4786286704993665, 128.0 / 225.0, 0.4786286704993665,
                       0.2369268850561891};
  const double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  MatX exact = MatX::Zero(8, 8);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      for (int k = 0; k < 5; ++k) {
        VecX N(8);
        Mat3 J = Mat3::Zero();
        for (int a = 0; a < 8; ++a) {
          const double fx = 1 + corner[a][0] * x[i], fy = 1 + corner[a][1] * x[j],
                       fz = 1 + corner[a][2] * x[k];
          N(a) = fx * fy * fz / 8.0;
          const Vec3 d =
              Vec3(corner[a][0] * fy * fz, corner[a][1] * fx * fz, corner[a][2] * fx * fy) / 8.0;
          J += d * in.p[a].transpose();
        }
        exact += 7500.0 * w[i] * w[j] * w[k] * J.determinant() * N * N.transpose();
      }
    }
  }
  EXPECT_LT(relative_error(M, exact), 1e-13);
}

TEST(FeModelErrors, IndicesAndInvertedElements) {
  FeModel model = to_model(reference_body("tet4"));
  std::swap(model.elements[0].nodes[0], model.elements[0].nodes[1]);
  model.elements[1].nodes[2] = 77;
  EXPECT_EQ(error_of([&] { validate(model); }), "geometry\nout_of_range");
}

}  // namespace
}  // namespace floatframe::test
