// Solids of plies: against a stack of elements of one ply each whose nodes follow the shape
// functions of the whole, and against laminate theory; masses, stresses, what validate refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/model_checks.hpp"
#include "floatframe/math/dense.hpp"
#include "support/error_of.hpp"
#include "support/quadratic_mesh.hpp"
#include "support/random_body.hpp"
#include "support/solid_plies.hpp"

namespace floatframe::test {
namespace {

constexpr FeElementType layered_types[] = {FeElementType::hex8,   FeElementType::hex8i,
                                           FeElementType::hex20,  FeElementType::hex20r,
                                           FeElementType::wedge6, FeElementType::wedge15};

/// The functions that the shape functions of a type are made of, x^i y^j t^k.
std::vector<std::array<int, 3>> monomials(FeElementType type) {
  std::vector<std::array<int, 3>> out;
  const bool quadratic = element_kernel(type).nodes > 8;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int squares = (i == 2) + (j == 2) + (k == 2);
        bool in = false;
        if (is_wedge(type))
          in = quadratic ? i + j <= (k == 2 ? 1 : 2) : i + j <= 1 && k <= 1;
        else
          in = squares == 0 || (quadratic && squares == 1);
        if (in) out.push_back({i, j, k});
      }
  return out;
}

VecX monomials_at(FeElementType type, const Vec3& xi) {
  const auto list = monomials(type);
  VecX f(list.size());
  for (std::size_t m = 0; m < list.size(); ++m)
    f(m) = std::pow(xi(0), list[m][0]) * std::pow(xi(1), list[m][1]) * std::pow(xi(2), list[m][2]);
  return f;
}

/// Row a: shape functions at place a.
MatX shapes_at(FeElementType type, const std::vector<Vec3>& places) {
  const std::vector<Vec3> nodes = natural_nodes(type);
  const auto size = static_cast<Eigen::Index>(nodes.size());
  MatX V(size, size), at(places.size(), size);
  for (Eigen::Index a = 0; a < size; ++a) V.row(a) = monomials_at(type, nodes[a]);
  for (std::size_t a = 0; a < places.size(); ++a) at.row(a) = monomials_at(type, places[a]);
  return at * LeastNorm(V).pseudo_inverse();
}

const Material ply_material = anisotropic_material(elasticity_of(fibres), false, fibres_density);
const Material core{7e10, 0.33, 2700.0};

/// A parallelepiped, or, sheared in no direction, a block.
FeModel layered_element(FeElementType type, const Mat3& A) {
  FeModel model;
  model.materials = {ply_material, core};
  model.material_names = {"PLY", "CORE"};
  model.layups = {{{{0, 0.2, 0.5}, {1, 0.5, 0.0}, {0, 0.1, -0.9}}}};
  FeElement e;
  e.type = type;
  e.layup = 0;
  for (const Vec3& xi : natural_nodes(type)) {
    e.nodes[model.positions.size()] = model.nodes();
    model.positions.emplace_back(A * xi + Vec3(0.3, 0.1, -0.2));
  }
  model.elements = {e};
  return model;
}

Mat3 sheared(Random& random) {
  Mat3 A = random.matrix(3, 3);
  A = 0.3 * A / A.norm() + Mat3(Vec3(1.0, 0.8, 0.3).asDiagonal());
  return A;
}

TEST(Layups, AStackOfOnePlyEachThatFollowsTheWhole) {
  Random random(3);
  for (const FeElementType type : layered_types) {
    if (type == FeElementType::hex8i) continue;  // modes of its own
    for (const bool oriented : {false, true}) {
      SCOPED_TRACE(fe_element_name(type));
      const Mat3 A = sheared(random);
      FeModel model = layered_element(type, A);
      Orientation o;
      o.axes = random.rotation();
      if (oriented) {
        model.orientations = {o};
        model.elements[0].orientation = 0;
      }
      ASSERT_NO_THROW(validate(model));
      const ElementKernel& kernel = element_kernel(type);
      const ElementInput whole = gather(model, model.elements[0]);
      MatX K, M, K_stack = MatX::Zero(3 * kernel.nodes, 3 * kernel.nodes);
      MatX M_stack = MatX::Zero(kernel.nodes, kernel.nodes);
      const Vec3 n = A.col(0).cross(A.col(1)).normalized();
      const Vec3 axis = oriented ? Vec3(o.axes.col(0)) : Vec3(A.col(0));
      const Vec3 x = (axis - n * n.dot(axis)).normalized();
      double bottom = -1.0;
      for (const ShellPly& ply : model.layups[0].plies) {
        const double half = ply.thickness / 0.8;
        std::vector<Vec3> places = natural_nodes(type);
        for (Vec3& xi : places) xi(2) = bottom + half * (1.0 + xi(2));
        bottom += 2.0 * half;
        const MatX N = shapes_at(type, places);
        ElementInput part;
        for (int a = 0; a < kernel.nodes; ++a) part.p[a] = A * places[a];
        part.material = model.materials[ply.material];
        part.orientation.emplace();
        part.orientation->axes << x, n.cross(x), n;
        part.orientation->axes =
            Eigen::AngleAxisd(ply.angle, n).toRotationMatrix() * part.orientation->axes;
        kernel.stiffness(part, K);
        MatX T = MatX::Zero(3 * kernel.nodes, 3 * kernel.nodes);
        for (int a = 0; a < kernel.nodes; ++a)
          for (int b = 0; b < kernel.nodes; ++b)
            T.block<3, 3>(3 * a, 3 * b).diagonal().setConstant(N(a, b));
        K_stack += T.transpose() * K * T;
        kernel.scalar_mass(part, M);
        M_stack += N.transpose() * M * N;
      }
      kernel.stiffness(whole, K);
      kernel.scalar_mass(whole, M);
      EXPECT_LT((K - K_stack).norm(), 1e-12 * K.norm());
      EXPECT_LT((M - M_stack).norm(), 1e-12 * M.norm());
    }
  }
}

TEST(Layups, PliesOfOneMaterialAreThatMaterial) {
  Random random(5);
  for (const FeElementType type : layered_types) {
    if (type == FeElementType::hex20r) continue;  // two points a ply are more than two
    SCOPED_TRACE(fe_element_name(type));
    for (const int material : {0, 1}) {
      FeModel model = layered_element(type, sheared(random));
      for (ShellPly& ply : model.layups[0].plies) ply.material = material, ply.angle = 0.0;
      Orientation o;
      const Mat3 J = (Mat3() << model.positions[1] - model.positions[0],
                      model.positions[is_wedge(type) ? 2 : 3] - model.positions[0], Vec3::UnitZ())
                         .finished();
      const Vec3 n = J.col(0).cross(J.col(1)).normalized(), x = J.col(0).normalized();
      o.axes << x, n.cross(x), n;
      model.orientations = {o};
      FeElement plain = model.elements[0];
      plain.layup = -1;
      plain.material = material;
      plain.orientation = 0;
      const ElementKernel& kernel = element_kernel(type);
      MatX K, K_plain;
      kernel.stiffness(gather(model, model.elements[0]), K);
      kernel.stiffness(gather(model, plain), K_plain);
      EXPECT_LT((K - K_plain).norm(), 1e-12 * K.norm());
    }
  }
}

/// Without contraction across the plies a block in constant strain and curvature is in the plane
/// stress of laminate theory.
TEST(Layups, LaminateTheory) {
  EngineeringConstants c = fibres;
  c.E3 = 9e9;
  c.nu13 = c.nu23 = 0.0;
  const double lx = 0.7, ly = 0.4, t = 0.04;
  Random random(8);
  for (const FeElementType type :
       {FeElementType::hex8i, FeElementType::hex20, FeElementType::hex20r}) {
    SCOPED_TRACE(fe_element_name(type));
    FeModel model =
        layered_element(type, Vec3(0.5 * lx, 0.5 * ly, 0.5 * t).asDiagonal().toDenseMatrix());
    model.materials[0] = anisotropic_material(elasticity_of(c), false, 1600.0);
    model.materials[1] = anisotropic_material(
        elasticity_of(
            {.E1 = 7e9, .E2 = 7e9, .E3 = 7e9, .nu12 = 0.2, .G12 = 2e9, .G13 = 1e9, .G23 = 1e9}),
        false, 300.0);
    ShellSection section;
    section.plies = model.layups[0].plies;
    for (ShellPly& ply : section.plies) ply.thickness *= t / 0.8;
    section.thickness = t;
    const ShellLayers layers = shell_layers(section, model.materials[0], model.materials);
    MatX K;
    element_kernel(type).stiffness(gather(model, model.elements[0]), K);
    for (int sample = 0; sample < 5; ++sample) {
      const Vec3 e = random.vec3(1.0), k = random.vec3(1.0) / t;
      VecX u(K.rows());
      for (int a = 0; a < model.nodes(); ++a) {
        const Vec3 r = model.positions[a] - Vec3(0.3, 0.1, -0.2);
        const Vec3 s = e + r(2) * k;
        u.segment<3>(3 * a) << s(0) * r(0) + 0.5 * s(2) * r(1), s(1) * r(1) + 0.5 * s(2) * r(0),
            -0.5 * (k(0) * r(0) * r(0) + k(1) * r(1) * r(1) + k(2) * r(0) * r(1));
      }
      const double energy =
          lx * ly * (e.dot(layers.A * e) + 2.0 * e.dot(layers.B * k) + k.dot(layers.D * k));
      EXPECT_NEAR(u.dot(K * u) / energy, 1.0, 1e-11);
    }
  }
}

/// Free frequencies of a strip, one element through the thickness or one for each ply.
TEST(Layups, OneElementOrOneForEachPly) {
  const auto strip = [](bool layered) {
    const std::vector<ShellPly> plies = {{0, 0.01, 0.0}, {1, 0.02, 0.0}, {0, 0.01, 1.2}};
    const std::vector<double> z =
        layered ? std::vector<double>{0.0, 0.04} : std::vector<double>{0.0, 0.01, 0.03, 0.04};
    FeModel model = brick_strip(6, 0.6, 0.08, z);
    model.node_sets.clear();
    model.materials = {ply_material, core};
    model.layups = {{plies}};
    for (const ShellPly& ply : plies) model.layups.push_back({{ply}});
    for (std::size_t e = 0; e < model.elements.size(); ++e)
      model.elements[e].layup = layered ? 0 : 1 + static_cast<int>(e % (z.size() - 1));
    model = hex20_of(std::move(model));
    validate(model);
    const FeSystem system = assemble(model);
    return generalised_eigen(MatX(system.K), MatX(system.M)).values;
  };
  const VecX one = strip(true), stack = strip(false);
  for (int k = 6; k < 12; ++k) {
    const double ratio = std::sqrt(one(k) / stack(k));
    EXPECT_GE(ratio, 1.0 - 1e-9) << k;  // its shapes are a part of those of the stack
    EXPECT_LT(ratio, 1.03) << k;
  }
}

TEST(Layups, MassVolumeStress) {
  Random random(9);
  for (const FeElementType type : layered_types) {
    SCOPED_TRACE(fe_element_name(type));
    const Mat3 A = sheared(random);
    FeModel model = layered_element(type, A);
    model.layups[0].plies = {{0, 3.0, 0.0}, {1, 1.0, 0.0}};
    model.elements[0].material = 0;
    const double volume_ = A.determinant() * (is_wedge(type) ? 1.0 : 8.0);
    EXPECT_NEAR(volume(model), volume_, 1e-12 * volume_);
    const double mass = volume_ * (0.75 * fibres_density + 0.25 * 2700.0);
    EXPECT_NEAR(volume_times_density(model), mass, 1e-12 * mass);
    // Stress of constant strain, at nodes and over the volume.
    const ElementKernel& kernel = element_kernel(type);
    const ElementInput in = gather(model, model.elements[0]);
    const Mat3 G = random.matrix(3, 3);
    VecX u(3 * kernel.nodes);
    for (int a = 0; a < kernel.nodes; ++a) u.segment<3>(3 * a) = G * in.p[a];
    Vec6 strain;
    strain << G(0, 0), G(1, 1), G(2, 2), G(0, 1) + G(1, 0), G(1, 2) + G(2, 1), G(2, 0) + G(0, 2);
    const Vec3 n = A.col(0).cross(A.col(1)).normalized(), x = A.col(0).normalized();
    Mat3 R;
    R << x, n.cross(x), n;
    const Mat6 D_0 = turned_elasticity(*ply_material.elasticity, R);
    const Mat6 D_1 = elasticity_matrix(core);
    for (int a = 0; a < kernel.nodes; ++a) {
      const bool upper = natural_nodes(type)[a](2) > 0.5;
      const NodalPly at = kernel.nodal_ply(in, a);
      EXPECT_EQ(at.ply, upper ? 1 : 0);
      EXPECT_LT((at.D - (upper ? D_1 : D_0)).norm(), 1e-12 * D_0.norm());
    }
    if (type == FeElementType::hex8i) continue;  // its thickness strain differs from ply to ply
    std::vector<StressedPoint> points;
    kernel.stressed_points(in, points);
    Vec6 sum = Vec6::Zero();
    for (const StressedPoint& p : points) sum += p.stress * u;
    const Vec6 expected = volume_ * (0.75 * D_0 + 0.25 * D_1) * strain;
    EXPECT_LT((sum - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(Layups, RefusedLayups) {
  const FeModel good = layered_element(FeElementType::hex8, Mat3::Identity());
  const auto error = [&](const auto& change) {
    FeModel model = good;
    change(model);
    return error_of([&] { validate(model); });
  };
  const auto ply = [](FeModel& m) -> ShellPly& { return m.layups[0].plies[1]; };
  EXPECT_EQ(error([](FeModel&) {}), "no error");
  EXPECT_EQ(error([](FeModel& m) { m.layups[0].plies.clear(); }), "wrong_value");
  EXPECT_EQ(error([&](FeModel& m) { ply(m).material = 2; }), "wrong_value");
  EXPECT_EQ(error([&](FeModel& m) {
              m.materials[1] = anisotropic_material(
                  lamina_elasticity({.E1 = 2e9, .E2 = 1e9, .nu12 = 0.3, .G12 = 5e8}), true, 1.0);
            }),
            "wrong_value");
  EXPECT_EQ(error([&](FeModel& m) { ply(m).thickness = 0.0; }), "wrong_value");
  EXPECT_EQ(error([&](FeModel& m) { ply(m).angle = std::nan(""); }), "wrong_value");
  EXPECT_EQ(error([](FeModel& m) { m.elements[0].layup = 1; }), "geometry");
  EXPECT_EQ(error([](FeModel& m) { m.elements[0].type = FeElementType::hex8r; }), "geometry");
  EXPECT_EQ(error([](FeModel& m) {
              m.orientations.emplace_back();
              m.orientations[0].axes << 0, 0, -1, 0, 1, 0, 1, 0, 0;
              m.elements[0].orientation = 0;
            }),
            "geometry");
}

}  // namespace
}  // namespace floatframe::test
