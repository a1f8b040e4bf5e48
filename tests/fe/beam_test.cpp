// The beam against engineering formulas, and frames of bars.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <numbers>

#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/eigenmodes.hpp"
#include "support/error_of.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

FeModel cantilever(int elements, const BeamSection& section, const Vec3& direction,
                   const Vec3& reference) {
  BarFrame frame;
  frame.points = {{"root", Vec3(0.1, 0.2, 0.3)}, {"tip", Vec3(0.1, 0.2, 0.3) + direction}};
  frame.bars.resize(1);
  frame.bars[0] = {"bar", "root", "tip", "", 0.0, elements, section, reference};
  frame.material = {7e10, 0.33, 2700.0};
  return build_bar_frame(frame);
}

TEST(Beam, CantileverTipDeflectionsInAnyDirection) {
  Random random(4);
  const BeamSection section = BeamSection::rectangle(0.02, 0.05);  // 20 mm along y, 50 mm along z
  for (int i = 0; i < 4; ++i) {
    const Vec3 direction = i == 0 ? Vec3(1.5, 0, 0) : Vec3(1.5 * random.vec3().normalized());
    const Vec3 reference = random.vec3();
    const FeModel model = cantilever(4, section, direction, reference);
    const Mat3 T = beam_axes(gather(model, model.elements[0]));
    EXPECT_NEAR(T.col(2).dot(reference), 0.0, 1e-12);
    EXPECT_GT(T.col(1).dot(reference), 0.0);
    const SparseMatrix K = assemble_stiffness(model);
    const int n = static_cast<int>(K.rows());
    const Eigen::SimplicialLDLT<SparseMatrix> solver(
        SparseMatrix(K.bottomRightCorner(n - 6, n - 6)));
    const double L = 1.5, E = 7e10, G = E / 2.66;
    const double expected[6] = {L / (E * section.A),
                                L * L * L / (3 * E * section.Iz),
                                L * L * L / (3 * E * section.Iy),
                                L / (G * section.J),
                                L / (E * section.Iy),
                                L / (E * section.Iz)};
    for (int k = 0; k < 6; ++k) {
      VecX f = VecX::Zero(n - 6);
      f.segment<3>(n - 12 + (k < 3 ? 0 : 3)) = T.col(k % 3);
      const VecX u = solver.solve(f);
      EXPECT_NEAR(T.col(k % 3).dot(u.segment<3>(n - 12 + (k < 3 ? 0 : 3))) / expected[k], 1.0, 1e-9)
          << k;
    }
  }
}

TEST(Beam, CantileverFrequencies) {
  const BeamSection section = BeamSection::hollow_round(0.05, 0.03);
  const FeModel model = cantilever(12, section, Vec3(1.2, 0, 0), Vec3::UnitY());
  const SparseMatrix K = assemble_stiffness(model);
  const int n = static_cast<int>(K.rows()) - 6;
  const auto modes = [&](bool section_inertia) {
    const SparseMatrix M = assemble_mass(model, section_inertia, 6);
    return lowest_modes(K.bottomRightCorner(n, n), M.bottomRightCorner(n, n), 8);
  };
  const double c = std::sqrt(7e10 * section.Iy / (2700.0 * section.A)) / (1.2 * 1.2);
  const double betas[2] = {1.875104068711961, 4.694091132974175};
  const VecX omega = modes(false).omega;
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(omega(i) / (betas[i / 2] * betas[i / 2] * c), 1.0, 2e-5);
  // With section inertia bending is lower, and torsion appears: w = pi/2 sqrt(G J / (rho Ip)) / L.
  const VecX with = modes(true).omega;
  EXPECT_LT(with(2), omega(2));
  const double torsion = std::numbers::pi / 2.0 * std::sqrt(7e10 / 2.66 / 2700.0) / 1.2;
  EXPECT_NEAR((with.array() / torsion - 1.0).abs().minCoeff(), 0.0, 2e-3);
}

TEST(Beam, Sections) {
  const BeamSection round = BeamSection::solid_round(0.03);
  EXPECT_NEAR(round.A, 7.06858347e-4, 1e-12);
  EXPECT_NEAR(round.Iy, 3.9760782e-8, 1e-16);
  EXPECT_EQ(round.J, 2.0 * round.Iz);
  const BeamSection square = BeamSection::rectangle(0.1, 0.1);
  EXPECT_NEAR(square.J / (0.1406 * 1e-4), 1.0, 2e-3);  // Roark
  const BeamSection flat = BeamSection::rectangle(0.01, 0.04);
  EXPECT_GT(flat.Iy, flat.Iz);
  EXPECT_NEAR(flat.J / (0.281 * 0.04 * 1e-6), 1.0, 3e-3);
}

TEST(BarFrames, SharedNodesAndNames) {
  BarFrame frame;
  frame.points = {
      {"a", Vec3(0, 0, 0)}, {"b", Vec3(1, 0, 0)}, {"c", Vec3(1, 1, 0)}, {"d", Vec3(0.5, 0, 1)}};
  frame.material = {2e11, 0.3, 7500};
  const BeamSection s = BeamSection::solid_round(0.02);
  frame.bars = {{"first", "a", "b", "", 0.0, 4, s, Vec3::UnitZ()},
                {"second", "b", "c", "", 0.0, 2, s, Vec3::UnitZ()},
                {"stub", "", "d", "first", 0.5, 1, s, Vec3::UnitX()}};
  frame.masses = {{"d", 0.4}};
  const FeModel model = build_bar_frame(frame);
  EXPECT_EQ(model.nodes(), 5 + 2 + 1);
  EXPECT_EQ(model.elements.size(), 7u);
  EXPECT_EQ(model.find_node("b"), 4);
  EXPECT_EQ(model.elements[6].nodes[0], 2);
  EXPECT_EQ(model.find_node("d"), 7);
  EXPECT_TRUE(model.positions[2].isApprox(Vec3(0.5, 0, 0)));
  EXPECT_NEAR(assemble_scalar_mass(model).sum(), 7500 * s.A * (2.0 + 1.0) + 0.4, 1e-10);
}

TEST(BarFrames, Errors) {
  BarFrame good;
  good.points = {{"a", Vec3(0, 0, 0)}, {"b", Vec3(1, 0, 0)}, {"c", Vec3(1, 1, 0)}};
  good.material = {2e11, 0.3, 7500};
  const BeamSection s = BeamSection::solid_round(0.02);
  good.bars = {{"one", "a", "b", "", 0.0, 7, s, Vec3::UnitZ()}};
  const auto error = [&](const std::function<void(BarFrame&)>& change) {
    BarFrame frame = good;
    change(frame);
    return error_of([&] { build_bar_frame(frame); });
  };
  EXPECT_EQ(error([](BarFrame&) {}), "no error");
  EXPECT_EQ(error([&](BarFrame& f) {
              f.bars.push_back({"stub", "", "c", "one", 0.2, 1, s, Vec3::UnitZ()});
            }),
            "not_found");
  EXPECT_EQ(error([](BarFrame& f) { f.bars[0].to = "x"; }), "not_found");
  EXPECT_EQ(error([](BarFrame& f) { f.bars[0].to = "a"; }), "geometry");
  EXPECT_EQ(
      error([](BarFrame& f) { f.bars[0].reference = Vec3(-2, 0, 0), f.bars[0].elements = 1; }),
      "geometry");
  EXPECT_EQ(error([](BarFrame& f) { f.bars[0].elements = 0; }), "out_of_range");
  EXPECT_EQ(error([](BarFrame& f) { f.bars[0].section.Iy = -1.0, f.bars[0].elements = 1; }),
            "geometry");
  EXPECT_EQ(error([](BarFrame& f) { f.material.young = 0.0; }), "out_of_range");
  EXPECT_EQ(error([](BarFrame& f) { f.masses = {{"b", -1.0}}; }), "not_finite");
}

}  // namespace
}  // namespace floatframe::test
