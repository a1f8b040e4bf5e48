// Laminated shells against classical laminate theory, which is written down here a second time: the
// stiffness of a ply turned as a tensor of fourth order, integrals through the thickness by Gauss.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/model_checks.hpp"
#include "support/error_of.hpp"
#include "support/random_body.hpp"
#include "support/shell_sheets.hpp"

namespace floatframe::test {
namespace {

constexpr FeElementType shell_types[] = {FeElementType::tri3, FeElementType::quad4};
constexpr double degree = std::numbers::pi / 180.0;

/// Carbon and epoxy.
constexpr EngineeringConstants carbon{
    .E1 = 1.4e11, .E2 = 1e10, .nu12 = 0.3, .G12 = 5e9, .G13 = 5e9, .G23 = 3e9};

/// Q of a ply at an angle: Q'_abcd = R_ai R_bj R_ck R_dl Q_ijkl in two dimensions.
Mat3 turned_ply(const EngineeringConstants& c, double angle) {
  const double nu21 = c.nu12 * c.E2 / c.E1, d = 1.0 - c.nu12 * nu21;
  double Q[2][2][2][2] = {};
  Q[0][0][0][0] = c.E1 / d;
  Q[1][1][1][1] = c.E2 / d;
  Q[0][0][1][1] = Q[1][1][0][0] = nu21 * c.E1 / d;
  Q[0][1][0][1] = Q[0][1][1][0] = Q[1][0][0][1] = Q[1][0][1][0] = c.G12;
  const double R[2][2] = {{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
  constexpr int at[3][2] = {{0, 0}, {1, 1}, {0, 1}};
  Mat3 out = Mat3::Zero();
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s)
      for (int n = 0; n < 16; ++n) {
        const int i = n & 1, j = n >> 1 & 1, k = n >> 2 & 1, l = n >> 3 & 1;
        out(r, s) +=
            R[at[r][0]][i] * R[at[r][1]][j] * R[at[s][0]][k] * R[at[s][1]][l] * Q[i][j][k][l];
      }
  return out;
}

struct Layer {
  double thickness, angle;
};

/// N, M from the strains of the nodes' surface and the curvatures, which lies `below` the middle.
Mat6 theory(const std::vector<Layer>& layers, double below) {
  double total = 0.0;
  for (const Layer& layer : layers) total += layer.thickness;
  double z = below - 0.5 * total;
  Mat6 out = Mat6::Zero();
  for (const Layer& layer : layers) {
    const Mat3 Q = turned_ply(carbon, layer.angle);
    for (const double x : {-1.0 / std::sqrt(3.0), 1.0 / std::sqrt(3.0)}) {
      const double at = z + 0.5 * layer.thickness * (1.0 + x), w = 0.5 * layer.thickness;
      out.topLeftCorner<3, 3>() += w * Q;
      out.topRightCorner<3, 3>() += w * at * Q;
      out.bottomRightCorner<3, 3>() += w * at * at * Q;
    }
    z += layer.thickness;
  }
  out.bottomLeftCorner<3, 3>() = out.topRightCorner<3, 3>();
  return out;
}

ShellSection section_of(const std::vector<Layer>& layers, double offset) {
  ShellSection section;
  section.offset = offset;
  for (const Layer& layer : layers) {
    section.plies.push_back({0, layer.thickness, layer.angle});
    section.thickness += layer.thickness;
  }
  return section;
}

/// A strip in the xy plane with an uneven mesh, whose axis 1 is turned from x.
FeModel strip(FeElementType type, const ShellSection& section, double axis, Random& random) {
  FeModel model = sheet(
      type, 4, 3, [](double x, double y) { return Vec3(0.4 * x, 0.1 * y, 0); },
      anisotropic_material(lamina_elasticity(carbon), true, 1600.0), 0.001);
  for (const int inner : {6, 7, 8, 11, 12, 13}) {
    const Vec3 shift = random.vec3(0.01);
    model.positions[inner] += Vec3(shift(0), shift(1), 0);
  }
  model.shells[0] = section;
  Orientation o;
  o.axes = Eigen::AngleAxisd(axis, Vec3::UnitZ()).toRotationMatrix();
  model.orientations = {o};
  for (FeElement& e : model.elements) e.orientation = 0;
  return model;
}

/// Displacements with constant strains and curvatures.
VecX constant_field(const FeModel& model, const Vec6& ek) {
  VecX u(6 * model.nodes());
  for (int k = 0; k < model.nodes(); ++k) {
    const double x = model.positions[k](0), y = model.positions[k](1);
    const double w = -0.5 * (ek(3) * x * x + ek(4) * y * y + ek(5) * x * y);
    const double w_x = -ek(3) * x - 0.5 * ek(5) * y, w_y = -ek(4) * y - 0.5 * ek(5) * x;
    u.segment<6>(6 * k) << ek(0) * x + 0.5 * ek(2) * y, ek(1) * y + 0.5 * ek(2) * x, w, w_y, -w_x,
        0.0;
  }
  return u;
}

struct Case {
  const char* name;
  std::vector<Layer> layers;
  double offset;
};

std::vector<Case> cases() {
  const double t = 0.001;
  return {{"one layer", {{2 * t, 0.0}}, 0.0},
          {"one layer at 30 degrees", {{2 * t, 30 * degree}}, 0.0},
          {"[0/90]", {{t, 0.0}, {t, 90 * degree}}, 0.0},
          {"[45/-45]", {{t, 45 * degree}, {t, -45 * degree}}, 0.0},
          {"[0/45/-45/90] of unlike plies",
           {{t, 0.0}, {2 * t, 45 * degree}, {0.5 * t, -45 * degree}, {t, 90 * degree}},
           0.0},
          {"[0/90] on a surface", {{t, 0.0}, {t, 90 * degree}}, 0.7 * t}};
}

// A strip under one force or moment over its width: the strains and curvatures that laminate theory
// gives need no forces but at the ends, whose resultants are those of the theory, and the loads of
// the ends give them back.
TEST(Laminates, StripsUnderTensionBendingAndTwist) {
  Random random(5);
  for (const FeElementType type : shell_types)
    for (const Case& c : cases())
      for (int load = 0; load < 6; ++load) {
        SCOPED_TRACE(std::string(fe_element_name(type)) + ", " + c.name + ", load " +
                     std::to_string(load));
        const double axis = 0.3;
        FeModel model = strip(type, section_of(c.layers, c.offset), axis, random);
        std::vector<Layer> layers = c.layers;
        for (Layer& layer : layers) layer.angle += axis;
        const Mat6 abd = theory(layers, c.offset);
        const double t = model.shells[0].thickness;
        Vec6 force = Vec6::Zero();
        force(load) = load < 3 ? 1e5 : 1e5 * t;
        const Vec6 ek = abd.fullPivLu().solve(force);
        const VecX u = constant_field(model, ek);
        const VecX f = assemble(model).K * u;
        Vec3 sum = Vec3::Zero(), turning = Vec3::Zero();  // of the end x = 0.4
        for (int k = 0; k < model.nodes(); ++k) {
          const int i = k % 5, j = k / 5;
          const Vec6 here = f.segment<6>(6 * k);
          if (i > 0 && i < 4 && j > 0 && j < 3) {
            EXPECT_LT(here.head<3>().norm(), 1e-9 * f.norm()) << k;
          }
          if (i != 4) continue;
          sum += here.head<3>();
          turning +=
              here.tail<3>() + Vec3(0, model.positions[k](1) - 0.05, 0).cross(Vec3(here.head<3>()));
        }
        EXPECT_NEAR(sum(0), 0.1 * force(0), 1e-6 * 1e4);
        EXPECT_NEAR(sum(1), 0.1 * force(2), 1e-6 * 1e4);
        EXPECT_NEAR(turning(1), 0.1 * force(3), 1e-6 * 1e4 * t);
        EXPECT_NEAR(u.dot(f), 0.04 * ek.dot(force), 1e-9 * std::abs(ek.dot(force)));
        // One corner held, a second against turning about it.
        const VecX back = solve(model, {{0, 63u}}, f);
        const VecX expected = u;
        EXPECT_LT((back - expected).norm(), 1e-6 * expected.norm());
      }
}

// Stress of the outer plies from the same fields.
TEST(Laminates, StressOfTheOuterPlies) {
  Random random(6);
  for (const FeElementType type : shell_types)
    for (const Case& c : cases()) {
      SCOPED_TRACE(std::string(fe_element_name(type)) + ", " + c.name);
      const double axis = -0.4;
      const FeModel model = strip(type, section_of(c.layers, c.offset), axis, random);
      const Vec6 ek = random.matrix(6, 1);
      const VecX u = constant_field(model, ek);
      const double t = model.shells[0].thickness;
      for (const FeElement& e : model.elements) {
        const ElementKernel& kernel = element_kernel(e.type);
        MatX S;
        kernel.layer_stresses(gather(model, e), S);
        VecX q(6 * kernel.nodes);
        for (int a = 0; a < kernel.nodes; ++a) q.segment<6>(6 * a) = u.segment<6>(6 * e.nodes[a]);
        const VecX stress = S * q;
        for (int a = 0; a < kernel.nodes; ++a)
          for (const bool top : {true, false}) {
            const double z = c.offset + (top ? 0.5 : -0.5) * t;
            const double angle = axis + (top ? c.layers.back() : c.layers.front()).angle;
            const Vec3 expected = turned_ply(carbon, angle) * (ek.head<3>() + z * ek.tail<3>());
            const Vec6 found = stress.segment<6>(12 * a + (top ? 0 : 6));
            EXPECT_LT((Vec3(found(0), found(1), found(3)) - expected).norm(),
                      1e-9 * expected.norm());
            EXPECT_LT(std::abs(found(2)) + std::abs(found(4)) + std::abs(found(5)),
                      1e-9 * expected.norm());
          }
      }
    }
}

// Rigid motions of an offset laminate: no force, and the mass of its plies where they are.
TEST(Laminates, RigidMotionsAndMass) {
  Random random(7);
  const double t = 0.01, offset = 0.02, nonstructural = 3.0;
  for (const FeElementType type : shell_types) {
    FeModel model = strip(type, section_of({{t, 0.1}, {t, 0.7}}, offset), 0.2, random);
    model.materials.push_back(model.materials[0]);
    model.materials[1].density = 4000.0;
    model.shells[0].plies[1].material = 1;
    model.shells[0].mass = nonstructural;
    const double area = 0.04, mass = area * (t * 5600.0 + nonstructural);
    EXPECT_NEAR(volume_times_density(model), mass, 1e-12 * mass);
    EXPECT_NEAR(volume(model), area * 2 * t, 1e-15);
    // Masses of the two plies at their heights, by their own inertia, and the rest in the middle.
    double first = nonstructural * offset, second = nonstructural * offset * offset;
    for (const auto& [rho, z] : {std::pair{1600.0, offset - t / 2}, {4000.0, offset + t / 2}}) {
      first += rho * t * z;
      second += rho * t * (z * z + t * t / 12.0);
    }
    const Mat3 R = random.rotation();
    for (Vec3& p : model.positions) p = R * p;
    for (Orientation& o : model.orientations) o.axes = R * o.axes;
    const FeSystem system = assemble(model);
    MatX rigid(6 * model.nodes(), 6);
    for (int k = 0; k < model.nodes(); ++k)
      for (int axis = 0; axis < 3; ++axis) {
        rigid.col(axis).segment<6>(6 * k) << Vec3::Unit(axis), Vec3::Zero();
        rigid.col(3 + axis).segment<6>(6 * k) << R.col(axis).cross(model.positions[k]), R.col(axis);
      }
    EXPECT_LT((system.K * rigid).cwiseAbs().maxCoeff(),
              2e-11 * system.K.coeffs().cwiseAbs().maxCoeff());
    const MatX M = rigid.transpose() * (system.M * rigid);
    EXPECT_NEAR(M(0, 0), mass, 1e-12 * mass);
    // Turning about x: int y^2 dm of the plane (linear in each triangle) and the heights.
    const double y2 = area * (t * 5600.0 + nonstructural) * 0.01 / 3.0;
    EXPECT_NEAR(M(3, 3), y2 + area * second, 1e-10 * y2);
    // Speed along R y while turning about R x: -int z dm.
    const Vec3 along = M.block<3, 1>(0, 3);
    EXPECT_NEAR(R.col(1).dot(along), -area * first, 1e-10);
    // The inertia integrals are made of points that must say the same.
    const PointModel points = point_model(model, system);
    EXPECT_LT(points.anisotropy, 1e-12);
    double sum = 0.0;
    Vec3 weighed = Vec3::Zero();
    for (int r = 0; r < points.M_s.rows(); ++r)
      for (SparseRows::InnerIterator it(points.M_s, r); it; ++it) {
        sum += it.value();
        weighed += it.value() * points.p.col(r);
      }
    EXPECT_NEAR(sum, mass, 1e-11 * mass);
    EXPECT_NEAR(R.col(2).dot(weighed), area * first, 1e-10);
  }
}

// Plies of one isotropic material are that material; so are Nastran's materials of bending and
// membrane if they are one.
TEST(Laminates, OfOneMaterialAreThatMaterial) {
  Random random(8);
  const Material alloy{7e10, 0.33, 2700.0};
  for (const FeElementType type : shell_types) {
    FeModel one = strip(type, {.thickness = 0.004}, 0.0, random);
    one.materials = {alloy};
    FeModel many = one, named = one, matrix = one;
    many.shells[0].plies = {{0, 0.001, 0.3}, {0, 0.003, -1.2}};
    named.materials.push_back(alloy);
    named.shells[0].bending = 1;
    matrix.materials = {anisotropic_material(elasticity_matrix(alloy), false, 2700.0)};
    EXPECT_NEAR(matrix.materials[0].young, 7e10, 1.0);
    EXPECT_NEAR(matrix.materials[0].poisson, 0.33, 1e-12);
    const FeSystem expected = assemble(one);
    for (const FeModel& model : {many, named, matrix}) {
      validate(model);
      const FeSystem found = assemble(model);
      EXPECT_LT((found.K - expected.K).norm(), 1e-12 * expected.K.norm());
      EXPECT_LT((found.M - expected.M).norm(), 1e-12 * expected.M.norm());
    }
    named.shells[0].bending_factor = 3.0;
    named.shells[0].mass = 5.0;
    EXPECT_NEAR(volume_times_density(named) / volume_times_density(one),
                (2700.0 * 0.004 + 5.0) / (2700.0 * 0.004), 1e-12);
  }
}

// In-plane bending of a strip of rectangles along axis 1 is exact in the elements' mean: the
// weight of the higher-order strains follows from the Poisson's ratios of both directions.
TEST(Laminates, BendInTheirPlaneWithoutLocking) {
  const double L = 1.0, b = 0.05, t = 0.004;
  Random random(9);
  FeModel model = sheet(
      FeElementType::quad4, 10, 1, [&](double x, double y) { return Vec3(L * x, b * y, 0); },
      anisotropic_material(lamina_elasticity(carbon), true, 1600.0), t);
  VecX f = VecX::Zero(6 * model.nodes());
  f(6 * 10) = 100.0 / b;  // a couple
  f(6 * 21) = -100.0 / b;
  const VecX u = solve(model, {{0, 63u}, {11, 1u | 4u}}, f);
  const double expected = -100.0 * L * L / (2.0 * carbon.E1 * t * b * b * b / 12.0);
  EXPECT_NEAR(0.5 * (u(6 * 10 + 1) + u(6 * 21 + 1)) / expected, -1.0, 0.03);
}

TEST(Laminates, FaultySections) {
  Random random(10);
  const auto error = [&](const auto& change) {
    FeModel model = strip(FeElementType::quad4, section_of({{0.001, 0}, {0.001, 1}}, 0), 0, random);
    change(model);
    return error_of([&] { validate(model); });
  };
  EXPECT_EQ(error([](FeModel& m) { m.shells[0].plies[1].thickness = 0.0; }), "wrong_value");
  EXPECT_EQ(error([](FeModel& m) { m.shells[0].plies[0].material = 4; }), "wrong_value");
  EXPECT_EQ(error([](FeModel& m) { m.shells[0].thickness = 0.003; }), "wrong_value");
  EXPECT_EQ(error([](FeModel& m) { m.shells[0].mass = -1.0; }), "wrong_value");
  EXPECT_EQ(error([](FeModel& m) { m.orientations[0].axes << 0, 0, 1, 0, 1, 0, 1, 0, 0; }),
            "geometry\ngeometry\ngeometry\ngeometry\ngeometry\ngeometry\ngeometry\ngeometry\ngeomet"
            "ry\ngeometry\ngeometry\ngeometry");
  EXPECT_EQ(error([](FeModel& m) { (*m.materials[0].elasticity)(0, 1) = 1e12; }), "wrong_value");
  EXPECT_EQ(error([](FeModel& m) { (*m.materials[0].elasticity)(3, 3) = -1.0; }), "wrong_value");
  EXPECT_EQ(error([](FeModel& m) { m.elements[0].orientation = 7; }), "geometry");
}

}  // namespace
}  // namespace floatframe::test
