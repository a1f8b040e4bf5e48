// The flexible Iltis: counts, rank of the constraint Jacobians, flexible parts, equilibrium, and
// that other meshes, mode counts, sections and interfaces run.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/initial_state.hpp"
#include "support/figures.hpp"
#include "support/iltis.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

TEST(IltisFlexible, Counts) {
  const ModelCounts c = check(build_model(iltis()));
  EXPECT_EQ(c.bodies, 17);
  EXPECT_EQ(c.flexible_bodies, 12);
  EXPECT_EQ(c.joints, 25);
  EXPECT_EQ(c.cut_joints, 8);
  EXPECT_EQ(c.relative.rigid, 34);
  EXPECT_EQ(c.relative.elastic, 64);
  EXPECT_EQ(c.relative.total, 98);
  EXPECT_EQ(c.relative.constraints, 24);
  EXPECT_EQ(c.absolute.rigid, 240);
  EXPECT_EQ(c.absolute.elastic, 64);
  EXPECT_EQ(c.absolute.total, 304);
  EXPECT_EQ(c.absolute.constraints, 230);
  EXPECT_EQ(c.degrees_of_freedom, 74);
  EXPECT_EQ(c.redundant_constraints, 0);
}

/// Rank by singular values above 1e-9 of the largest.
Eigen::Index rank_of(const MatX& J, const std::string& name) {
  const VecX s = singular_values(J).values;
  figure(name + ": smallest singular value / largest", s[s.size() - 1] / s[0]);
  return (s.array() > 1e-9 * s[0]).count();
}

TEST(IltisFlexible, JacobiansHaveFullRank) {
  const Model model = build_model(iltis());
  RelativeFormulation tree(model, InertiaMethod::preprocessing);
  const State start = relative_start(tree, Start::equilibrium);
  tree.positions(0.0, start.q);
  tree.velocities(start.v);
  const MatX J = tree.constraint_jacobian();
  ASSERT_EQ(J.rows(), 24);
  ASSERT_EQ(J.cols(), 98);
  EXPECT_EQ(rank_of(J, "relative"), 24);

  AbsoluteFormulation f(model, InertiaMethod::preprocessing);
  State state;
  f.start_from(tree, start.q, start.v, state.q, state.v);
  f.positions(0.0, state.q);
  f.velocities(state.v);
  const MatX Ja = f.constraint_jacobian();
  ASSERT_EQ(Ja.rows(), 230);
  ASSERT_EQ(Ja.cols(), 304);
  EXPECT_EQ(rank_of(Ja, "absolute"), 230);
}

const FlexibleBody& part(const Model& model, const std::string& name) {
  for (const Body& b : model.bodies)
    if (b.name == name) return *b.data;
  throw std::runtime_error("no body " + name);
}

TEST(IltisFlexible, PartsOfTheModelFile) {
  const Model model = build_model(iltis());
  for (const std::string corner : {"front_left", "front_right", "rear_left", "rear_right"}) {
    const FlexibleBody& arm = part(model, corner + ".arm");
    ASSERT_EQ(arm.modes(), 4);
    expect_digits(corner + ".arm mode 1 [Hz]", arm.fixed_interface_frequencies[0], 862.983, 3);
    expect_digits(corner + ".arm mode 2 [Hz]", arm.fixed_interface_frequencies[1], 1090.467, 3);
    expect_digits(corner + ".arm K11 [1e7 N/m]", 1e-7 * arm.K(0, 0), 2.31883442, 8);
    expect_digits(corner + ".arm K12 [1e7 N/m]", 1e-7 * arm.K(0, 1), -1.51402252, 8);
    expect_digits(corner + ".arm K22 [1e7 N/m]", 1e-7 * arm.K(1, 1), 1.32383235, 8);
    expect_digits(corner + ".arm mass [kg]", arm.invariants.m, 6.0, 3);
    const auto bar = [&](const std::string& name, double statics, double first, double second) {
      const FlexibleBody& b = part(model, corner + "." + name);
      ASSERT_EQ(b.modes(), 6);
      const auto& Sij = b.invariants.Sij;
      const MatX M = Sij[0][0] + Sij[1][1] + Sij[2][2];
      for (int k = 0; k < 6; ++k) {
        const double hertz = std::sqrt(b.K(k, k) / M(k, k)) / (2.0 * std::numbers::pi);
        const double printed = k < 2 ? statics : k < 4 ? first : second;
        expect_digits(corner + "." + name + " mode " + std::to_string(k + 1) + " [Hz]", hertz,
                      printed, k < 4 ? 2 : 1);
      }
    };
    bar("link", 193.83, 846.61, 2815.1);
    bar("rod", 99.19, 433.24, 1440.6);
  }
}

TEST(IltisFlexible, Equilibrium) {
  const StaticsResult s = statics(build_model(iltis()));
  const StaticsBody& chassis = body_of(s, "chassis");
  expect_digits("flexible chassis z [m]", chassis.position.z(), 0.5629377531, 10);
  expect_digits("flexible chassis dz [mm]", 1e3 * (chassis.position.z() - 0.57), -7.062247, 6);
  expect_digits("flexible pitch [deg]", chassis.roll_pitch_yaw[1] * 180.0 / std::numbers::pi,
                0.145797, 6);
  for (const std::string side : {"left", "right"}) {
    const auto check = [&](const std::string& name, double front, double rear) {
      expect_digits("flexible front_" + side + "." + name + " [N]",
                    force_of(s, "front_" + side + "." + name).force, front, 4);
      expect_digits("flexible rear_" + side + "." + name + " [N]",
                    force_of(s, "rear_" + side + "." + name).force, rear, 4);
    };
    check("tyre", 3830.8172, 3592.4098);
    check("leaf", -3067.4654, -2885.2018);
    check("shock", -334.5390, -241.1422);
  }
  const StaticsResult heavy = statics(build_model(iltis({{"compensated", "false"}})));
  expect_digits("flexible, rod masses added: dz [mm]",
                1e3 * (body_of(heavy, "chassis").position.z() - 0.57), -7.405, 3);
}

TEST(IltisFlexible, MeshesOfTheTableRun) {
  for (const char* ne : {"5", "50", "100"}) {
    const ModelDescription d = iltis({{"ne", ne}});
    const Model model = build_model(d);
    for (const Combination& c : combinations) {
      const RunResult r = completed_run(model, with(d.simulation, c, 0.01, 1.0));
      const double z = r.table.at(r.table.rows() - 1, column(r.table, "chassis.z"));
      figure(std::string("ne ") + ne + " " + c.name() + " chassis z at 1 s [m]", z);
      EXPECT_NEAR(z, 0.647, 2e-3);
    }
  }
}

TEST(IltisFlexible, OtherMassModelsRun) {
  for (const std::string mass : {"six_dof", "hermite"}) {
    const ModelDescription d = iltis({{"mass_model", mass}});
    const Model model = build_model(d);
    for (const Combination& c : combinations) {
      if ((c.inertia == InertiaMethod::projection) != (mass == "six_dof")) continue;
      const RunResult r = completed_run(model, with(d.simulation, c, 0.01, 1.0));
      const double z = r.table.at(r.table.rows() - 1, column(r.table, "chassis.z"));
      figure(mass + " " + c.name() + " chassis z at 1 s [m]", z);
      EXPECT_NEAR(z, 0.647, 2e-3);
    }
  }
}

/// A copy of the example's folder with one text of suspension.yaml replaced.
ModelDescription changed_suspension(
    const std::vector<std::pair<std::string, std::string>>& changes) {
  namespace fs = std::filesystem;
  const fs::path from = fs::path(FLOATFRAME_EXAMPLES) / "iltis";
  const TemporaryFolder to;
  for (const char* name : {"iltis.yaml", "body.obj"}) fs::copy_file(from / name, to / name);
  std::stringstream text;
  text << std::ifstream(from / "suspension.yaml").rdbuf();
  std::string s = text.str();
  for (const auto& [old, now] : changes) {
    EXPECT_NE(s.find(old), std::string::npos) << old;
    for (std::size_t at = 0; (at = s.find(old, at)) != std::string::npos; at += now.size())
      s.replace(at, old.size(), now);
  }
  to.write("suspension.yaml", s);
  return read_model(to.file("iltis.yaml"));
}

void runs(const std::string& name, const ModelDescription& d, int elastic) {
  const Model model = build_model(d);
  const ModelCounts c = check(model);
  EXPECT_EQ(c.relative.elastic, elastic) << name;
  EXPECT_EQ(c.redundant_constraints, 0) << name;
  for (const Coordinates coordinates : both_coordinates) {
    const Combination combination{coordinates, InertiaMethod::preprocessing};
    const RunResult r = completed_run(model, with(d.simulation, combination, 0.01, 1.0));
    const double z = r.table.at(r.table.rows() - 1, column(r.table, "chassis.z"));
    figure(name + " " + combination.name() + " chassis z at 1 s [m]", z);
    EXPECT_NEAR(z, 0.647, 0.01) << name;
  }
}

TEST(IltisFlexible, OtherBarsSectionsInterfacesAndModesRun) {
  runs("more modes",
       changed_suspension({{"normal_modes: 2", "normal_modes: 6"},
                           {"dynamic_per_plane: 2", "dynamic_per_plane: 3"}}),
       4 * (8 + 8 + 8));
  runs("static modes alone",
       changed_suspension({{"normal_modes: 2", "normal_modes: 0"},
                           {"dynamic_per_plane: 2", "dynamic_per_plane: 0"}}),
       4 * (2 + 2 + 2));
  runs("hollow arm, flat link",
       changed_suspension({{"{round: 0.03737837}", "{tube: [0.045, 0.025]}"},
                           {"section: {round: 0.03}", "section: {rectangle: [0.05, 0.02]}"}}),
       64);
  runs("all translations as interfaces",
       changed_suspension({{"point: shock_lower, dofs: [z]", "point: shock_lower, dofs: [x, y, z]"},
                           {"point: arm_ball, dofs: [z]", "point: arm_ball, dofs: [x, y, z]"}}),
       4 * (8 + 6 + 6));
  runs("finite-element modes of the bars",
       changed_suspension(
           {{"analytic: {dynamic_per_plane: 2}\n      mass_model: ${mass_model}\n\n  rod:",
             "clamped: [link_hinge]\n      static_modes: [{point: link_ball, dofs: [y, z]}]\n"
             "      normal_modes: 4\n      mass_model: ${mass_model}\n\n  rod:"}}),
       4 * (4 + 6 + 6));
}

}  // namespace
}  // namespace floatframe::test
