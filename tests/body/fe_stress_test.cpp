// Stress from displacement fields against fields whose stress is known.
#include "floatframe/body/fe_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/section_points.hpp"
#include "floatframe/fe/surface.hpp"
#include "floatframe/math/so3.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

// Pure bending of a brick, u = (x z, 0, -x^2/2) / R with nu = 0: stress xx = E z / R. The quadratic
// elements hold it exactly.
TEST(FeStress, BendingOfSolids) {
  for (const char* name : {"beam_c3d20", "beam_c3d20r"}) {
    FeModel model = read_fe_file(fe_data(std::string(name) + "_free.inp"));
    for (Material& m : model.materials) m.poisson = 0.0;
    const double R = 2.0, E = model.materials[0].young;
    StressFields fields;
    fields.displacements.U.resize(3 * model.nodes(), 2);
    fields.displacements.Theta = MatX::Zero(3 * model.nodes(), 2);
    for (int k = 0; k < model.nodes(); ++k) {
      const Vec3 p = model.positions[k];
      fields.displacements.U.block<3, 1>(3 * k, 0) << p(0) * p(2) / R, 0, -0.5 * p(0) * p(0) / R;
      fields.displacements.U.block<3, 1>(3 * k, 1) = Vec3(p(0), 0, 0);
    }
    const Surface s = outer_surface(model);
    const StressRecovery recovery(model, s.nodes);
    const MatX stress = recovery.recover(fields).places;
    ASSERT_EQ(recovery.layout().places.size(), s.nodes.size());
    double bending = 0.0, rest = 0.0, tension = 0.0;
    for (const StressPlace& place : recovery.layout().places) {
      const Eigen::Index row = 6 * (&place - recovery.layout().places.data());
      EXPECT_EQ(place.node, s.nodes[place.point]);
      EXPECT_EQ(place.layer, StressPlace::Layer::solid);
      bending = std::max(bending, std::abs(stress(row, 0) - E * place.p(2) / R));
      rest = std::max(rest, stress.block<5, 1>(row + 1, 0).cwiseAbs().maxCoeff());
      tension = std::max(tension, std::abs(stress(row, 1) - E));
    }
    EXPECT_LT(bending, 1e-9 * E * 0.01 / R) << name;
    EXPECT_LT(rest, 1e-9 * E * 0.01 / R) << name;
    EXPECT_LT(tension, 1e-9 * E) << name;
  }
}

/// Bricks of two materials side by side, stretched alike: the shared nodes have a place of each.
TEST(FeStress, MaterialsAreNotMixed) {
  FeModel model = brick_beam(2, 1, 1, 2.0, 1.0);
  model.materials.push_back({.young = 1e11, .poisson = 0.0, .density = 1000.0});
  model.materials[0].poisson = 0.0;
  model.material_names = {"STEEL", "SOFT"};
  model.elements[1].material = 1;
  StressFields fields;
  fields.displacements.U = MatX::Zero(3 * model.nodes(), 1);
  fields.displacements.Theta = fields.displacements.U;
  for (int k = 0; k < model.nodes(); ++k)
    fields.displacements.U(3 * k) = 1e-3 * model.positions[k](0);
  const StressRecovery recovery(model, outer_surface(model).nodes);
  const BodyStress& layout = recovery.layout();
  ASSERT_EQ(layout.groups.size(), 2u);
  EXPECT_EQ(layout.groups[1].name, "SOFT");
  ASSERT_EQ(layout.places.size(), 16u);
  const MatX stress = recovery.recover(fields).places;
  for (std::size_t k = 0; k < 16; ++k) {
    const double E = layout.groups[layout.places[k].group].young;
    EXPECT_NEAR(stress(6 * static_cast<Eigen::Index>(k), 0), 1e-3 * E, 1e-9 * E);
  }
}

/// A plate of 2 x 2 quadrilaterals or 8 triangles in the axes R, distorted inside; some elements
/// are numbered the other way round.
FeModel plate(FeElementType type, const Mat3& R, bool turned) {
  FeModel model;
  model.materials = {{.young = 2e11, .poisson = 0.3, .density = 7800.0}};
  model.shells = {{.thickness = 0.02}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Vec3 p(0.5 * i, 0.5 * j, 0.0);
      if (i == 1 && j == 1) p += Vec3(0.07, -0.05, 0.0);
      model.positions.emplace_back(R * p);
    }
  const auto add = [&](std::vector<int> nodes) {
    FeElement e;
    e.type = type;
    if (turned && model.elements.size() % 2 == 1) std::reverse(nodes.begin(), nodes.end());
    std::copy(nodes.begin(), nodes.end(), e.nodes.begin());
    model.elements.push_back(e);
  };
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const int a = 3 * i + j, b = a + 3, c = a + 4, d = a + 1;
      if (type == FeElementType::quad4) {
        add({a, b, c, d});
      } else {
        add({a, b, c});
        add({a, c, d});
      }
    }
  return model;
}

// Membrane strains and curvatures that are constant, and bending in the plane of rectangles.
TEST(FeStress, SidesOfShells) {
  const Mat3 R = rotation_exp(Vec3(0.3, -0.7, 0.5));
  for (const FeElementType type : {FeElementType::tri3, FeElementType::quad4})
    for (const bool turned : {false, true}) {
      const FeModel model = plate(type, R, turned);
      StressFields fields;
      fields.displacements.U = MatX::Zero(3 * model.nodes(), 2);
      fields.displacements.Theta = fields.displacements.U;
      const double exx = 1e-4, eyy = -2e-4, gxy = 3e-4, kxx = 0.02, kyy = -0.01, kxy = 0.015;
      for (int k = 0; k < model.nodes(); ++k) {
        const Vec3 p = R.transpose() * model.positions[k];
        const double x = p(0), y = p(1);
        // In the plane the drilling rotation is the mean rotation, zero here.
        fields.displacements.U.block<3, 1>(3 * k, 0) =
            R * Vec3(exx * x + 0.5 * gxy * y, 0.5 * gxy * x + eyy * y, 0.0);
        // w = -1/2 (kxx x^2 + kyy y^2 + kxy x y): strain xx = kxx z. rx = w_y, ry = -w_x.
        fields.displacements.U.block<3, 1>(3 * k, 1) =
            R * Vec3(0.0, 0.0, -0.5 * (kxx * x * x + kyy * y * y + kxy * x * y));
        fields.displacements.Theta.block<3, 1>(3 * k, 1) =
            R * Vec3(-kyy * y - 0.5 * kxy * x, kxx * x + 0.5 * kxy * y, 0.0);
      }
      const StressRecovery recovery(model, outer_surface(model).nodes);
      const BodyStress& layout = recovery.layout();
      ASSERT_EQ(layout.places.size(), 18u);
      const MatX stress = recovery.recover(fields).places;
      const double c = 2e11 / (1.0 - 0.09), G = 2e11 / 2.6, z = 0.01;
      for (std::size_t k = 0; k < 18; ++k) {
        const StressPlace& place = layout.places[k];
        const double height = (R.transpose() * place.p)(2);
        EXPECT_NEAR(std::abs(height), z, 1e-12);
        if (!turned) {
          EXPECT_EQ(height > 0.0, place.layer == StressPlace::Layer::top);
        }
        const double side = height > 0.0 ? z : -z;
        const auto tensor = [&](double xx, double yy, double xy) {
          Mat3 s = Mat3::Zero();
          s(0, 0) = c * (xx + 0.3 * yy);
          s(1, 1) = c * (yy + 0.3 * xx);
          s(0, 1) = s(1, 0) = G * xy;
          s = (R * s * R.transpose()).eval();
          return Vec6(s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0));
        };
        const Eigen::Index row = 6 * static_cast<Eigen::Index>(k);
        EXPECT_LT((stress.block<6, 1>(row, 0) - tensor(exx, eyy, gxy)).norm(), 1e-6 * c * exx);
        EXPECT_LT((stress.block<6, 1>(row, 1) - tensor(kxx * side, kyy * side, kxy * side)).norm(),
                  1e-6 * c * kxx * z);
      }
    }
}

/// Two plates that meet at a right angle: nothing is averaged over the edge.
TEST(FeStress, EdgesOfShellsAreKept) {
  FeModel model = plate(FeElementType::quad4, Mat3::Identity(), false);
  for (int j = 0; j < 3; ++j) model.positions.emplace_back(1.0, 0.5 * j, 0.5);
  for (int j = 0; j < 2; ++j) {
    FeElement e;
    e.type = FeElementType::quad4;
    const std::array<int, 4> nodes{6 + j, 9 + j, 10 + j, 7 + j};
    std::copy(nodes.begin(), nodes.end(), e.nodes.begin());
    model.elements.push_back(e);
  }
  const StressRecovery recovery(model, outer_surface(model).nodes);
  EXPECT_EQ(recovery.layout().places.size(), 2u * (12 + 3));
}

/// A turned beam of one element with linear displacements: stretch, twist and two bendings.
TEST(FeStress, SectionForcesAndOuterPointsOfBeams) {
  const Mat3 R = rotation_exp(Vec3(-0.4, 0.2, 0.9));
  FeModel model;
  model.materials = {{.young = 2e11, .poisson = 0.25, .density = 7800.0}};
  model.sections = {BeamSection::rectangle(0.03, 0.05)};
  const double L = 0.8, E = 2e11, G = 8e10;
  model.positions = {Vec3::Zero(), R * Vec3(L, 0, 0)};
  FeElement e;
  e.type = FeElementType::beam2;
  e.nodes = {0, 1};
  e.reference = R * Vec3(0.3, 1.0, 0.0);
  model.elements = {e};
  // Tip: stretch, twist; bending moments alone: v = k x^2 / 2, rz = k x; w = -m x^2 / 2, ry = m x.
  const double stretch = 1e-3, twist = 0.02, k = 0.04, m = -0.03;
  StressFields fields;
  fields.displacements.U = MatX::Zero(6, 1);
  fields.displacements.Theta = MatX::Zero(6, 1);
  fields.displacements.U.bottomRows<3>() = R * Vec3(stretch * L, 0.5 * k * L * L, -0.5 * m * L * L);
  fields.displacements.Theta.bottomRows<3>() = R * Vec3(twist * L, m * L, k * L);
  const StressRecovery recovery(model, {});
  const BodyStress& layout = recovery.layout();
  ASSERT_EQ(layout.sections.size(), 2u);
  ASSERT_EQ(layout.places.size(), 16u);
  EXPECT_EQ(layout.first_place, (std::vector<int>{0, 8, 16}));
  const auto found = recovery.recover(fields);
  const BeamSection& s = model.sections[0];
  Vec6 expected;
  expected << E * s.A * stretch, 0, 0, G * s.J * twist, E * s.Iy * m, E * s.Iz * k;
  for (int end = 0; end < 2; ++end)
    EXPECT_LT((found.sections.block<6, 1>(6 * end, 0) - expected).norm(), 1e-9 * expected.norm());
  for (std::size_t i = 0; i < 16; ++i) {
    const StressPlace& place = layout.places[i];
    const Vec3 p = R.transpose() * place.p;
    const Vec6 v = found.places.block<6, 1>(6 * static_cast<Eigen::Index>(i), 0);
    Mat3 S;
    S << v(0), v(3), v(5), v(3), v(1), v(4), v(5), v(4), v(2);
    S = (R.transpose() * S * R).eval();
    EXPECT_NEAR(S(0, 0), E * (stretch + m * p(2) - k * p(1)), 1e-6 * E * stretch);
    EXPECT_NEAR(S(1, 1), 0.0, 1e-6 * E * stretch);
    const bool corner = std::abs(p(1)) > 1e-9 && std::abs(p(2)) > 1e-9;
    if (corner) {
      EXPECT_NEAR(S.col(0).tail<2>().norm(), 0.0, 1e-6 * E * stretch);
    } else {
      // Turning about x: tau points along x cross r.
      EXPECT_GT(-S(0, 1) * p(2) + S(0, 2) * p(1), 0.0);
    }
  }
}

// Timoshenko, Goodier, section 94: largest shear T / (k2 a b^2) of a rectangle a >= b.
TEST(FeStress, TorsionOfRectangles) {
  for (const auto& [ratio, k1, k2] : {std::tuple{1.0, 0.1406, 0.208},
                                      {2.0, 0.229, 0.246},
                                      {4.0, 0.281, 0.282},
                                      {10.0, 0.312, 0.312}}) {
    const double b = 0.02, a = ratio * b;
    for (const bool lying : {false, true}) {
      BeamSection s = lying ? BeamSection::rectangle(a, b) : BeamSection::rectangle(b, a);
      s.J = k1 * a * b * b * b;
      double largest = 0.0, at = 0.0;
      for (const SectionPoint& p : section_points(s))
        if (const double tau = std::hypot(p.S(1, 3), p.S(2, 3)); tau > largest) {
          largest = tau;
          at = lying ? std::abs(p.y) : std::abs(p.z);
        }
      EXPECT_NEAR(largest * k2 * a * b * b, 1.0, 4e-3) << ratio;
      if (ratio > 1.0) {
        EXPECT_EQ(at, 0.0) << ratio;  // the middle of the long side
      }
    }
  }
}

TEST(FeStress, RoundSections) {
  const BeamSection s = BeamSection::hollow_round(0.06, 0.04);
  Vec6 forces;
  forces << 100.0, 20.0, -30.0, 5.0, 7.0, -9.0;
  double tau = 0.0, shear = 0.0;
  for (const SectionPoint& p : section_points(s)) {
    EXPECT_NEAR(std::hypot(p.y, p.z), 0.03, 1e-15);
    const Vec3 v = p.S * forces;
    EXPECT_NEAR(v(0), 100.0 / s.A + 7.0 * p.z / s.Iy + 9.0 * p.y / s.Iz, 1e-9 * v.norm());
    // Torsion alone along the circle; shear in the middle.
    tau = std::max(tau, std::abs((p.S(2, 3) * p.y - p.S(1, 3) * p.z) / 0.03 - 0.03 / s.J));
    if (std::abs(p.y) < 1e-12) shear = p.S(1, 1);
  }
  EXPECT_LT(tau, 1e-9 * 0.03 / s.J);
  const double k = 4.0 / 3.0 * (9.0 + 6.0 + 4.0) / (9.0 + 4.0);
  EXPECT_NEAR(shear, k / s.A, 1e-9 / s.A);
}

}  // namespace
}  // namespace floatframe::test
