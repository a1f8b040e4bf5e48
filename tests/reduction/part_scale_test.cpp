// The same part in any size gives the same report: with lengths times s, frequencies go with 1/s,
// masses with s^3, and what has no unit stays.
#include <gtest/gtest.h>

#include "floatframe/fe/bar_frame.hpp"
#include "reduction/part_beam.hpp"

namespace floatframe::test {
namespace {

void scale(FeModel& model, double s) {
  for (Vec3& p : model.positions) p *= s;
  for (BeamSection& b : model.sections) {
    b.A *= s * s;
    for (double* I : {&b.Iy, &b.Iz, &b.J}) *I *= s * s * s * s;
  }
  for (ShellSection& shell : model.shells) shell.thickness *= s;
  for (PointMass& m : model.masses) {
    m.mass *= s * s * s;
    m.J *= s * s * s * s * s;
  }
}

/// What depends on the units of length by its purpose, or shows a frequency.
bool of_units(const std::string& warning) {
  return warning.find("unusual") != std::string::npos ||
         warning.find("which is unusual for a part") != std::string::npos ||
         warning.find(" Hz ") != std::string::npos;
}

void expect_same_report(const ReducedPart& part, const ReducedPart& unit, double s) {
  const HealthReport &a = part.health, &b = unit.health;
  EXPECT_NEAR(a.from_invariants.mass / (s * s * s), b.from_invariants.mass,
              1e-9 * b.from_invariants.mass);
  EXPECT_LT((a.from_invariants.J_origin / std::pow(s, 5) - b.from_invariants.J_origin).norm(),
            1e-9 * b.from_invariants.J_origin.norm());
  EXPECT_NEAR(a.modal_mass_condition, b.modal_mass_condition, 1e-5 * b.modal_mass_condition);
  EXPECT_LT(a.rigid_residual, 1e-12);
  ASSERT_TRUE(a.rigid_eigenvalues);
  EXPECT_LT(a.rigid_eigenvalues->cwiseAbs().maxCoeff(), 1e-8);
  ASSERT_EQ(a.modes, b.modes);
  ASSERT_EQ(a.free_frequencies.size(), b.free_frequencies.size());
  for (std::size_t k = 0; k < a.free_frequencies.size(); ++k) {
    EXPECT_NEAR(a.free_frequencies[k].full * s, b.free_frequencies[k].full,
                1e-7 * b.free_frequencies[k].full);
    EXPECT_NEAR(a.free_frequencies[k].reduced * s, b.free_frequencies[k].reduced,
                1e-7 * b.free_frequencies[k].reduced);
  }
  const VecX w2 = part.body.K.diagonal() * s * s;
  EXPECT_LT((w2.cwiseQuotient(unit.body.K.diagonal()).array() - 1.0).abs().maxCoeff(), 1e-7);
  ASSERT_EQ(a.interfaces.size(), b.interfaces.size());
  for (std::size_t k = 0; k < a.interfaces.size(); ++k) {
    EXPECT_NEAR(a.interfaces[k].condition, b.interfaces[k].condition,
                1e-6 * b.interfaces[k].condition);
    EXPECT_NEAR(a.interfaces[k].static_error, b.interfaces[k].static_error, 1e-6);
  }
  std::vector<std::string> rest = a.warnings, expected = b.warnings;
  std::erase_if(rest, of_units);
  std::erase_if(expected, of_units);
  EXPECT_EQ(rest, expected);
}

void expect_scaling(const FeModel& model, const PartOptions& options) {
  const ReducedPart unit = reduce_part(model, options);
  for (const double s : {1e-4, 1e-3, 2e-3, 3e-3, 1e-2, 1e2, 1e4}) {
    SCOPED_TRACE(s);
    FeModel small = model;
    scale(small, s);
    PartOptions same = options;
    for (InterfaceDescription& d : same.interfaces)
      if (d.at) *d.at *= s;
    expect_same_report(reduce_part(small, same), unit, s);
  }
}

/// About 1 m large.
TEST(PartScale, Bricks) {
  const FeModel model = brick_beam(8, 2, 2, 1.0, 0.06);
  for (const ModeMethod method :
       {ModeMethod::craig_bampton, ModeMethod::free_free, ModeMethod::craig_chang}) {
    PartOptions options = both_ends(8);
    options.interfaces[1].kind = Spider::Kind::mean;
    options.method = method;
    expect_scaling(model, options);
  }
  PartOptions tangent = both_ends(8);
  tangent.reference = {BodyReference::Kind::node, "A"};
  expect_scaling(model, tangent);
}

/// Rotations carry mass: beams with their sections and a flywheel.
TEST(PartScale, BeamsAndRotaryInertia) {
  BarFrame frame;
  frame.material = {2.1e11, 0.3, 7850.0};
  frame.points = {{"A", {0, 0, 0}}, {"knee", {0.7, 0, 0}}, {"B", {0.7, 0.5, 0.2}}};
  for (const auto& [from, to] : {std::pair{"A", "knee"}, {"knee", "B"}}) {
    Bar bar;
    bar.name = std::string(from) + to;
    bar.from = from;
    bar.to = to;
    bar.elements = 4;
    bar.section = BeamSection::solid_round(0.03);
    frame.bars.push_back(bar);
  }
  FeModel model = build_bar_frame(frame);
  model.masses = {{model.find_node("knee"), 2.0, Vec3(0.004, 0.003, 0.005).asDiagonal()}};
  model.node_sets["A"] = {model.find_node("A")};
  model.node_sets["B"] = {model.find_node("B")};
  model.node_names.clear();
  expect_scaling(model, both_ends(6));
}

/// A real mesh: at 3 mm the condition of its modal mass was once 1e10 times that at 0.4 m.
TEST(PartScale, Wishbone) {
  const FeModel model = steel_part("aarm_coarse_mesh.inp.gz", "mm-t-s");
  PartOptions options;
  options.interfaces = arm_bores();
  options.modes = 10;
  options.stresses = false;
  const ReducedPart unit = reduce_part(model, options);
  FeModel small = model;
  scale(small, 0.01);
  for (InterfaceDescription& d : options.interfaces)
    if (d.at) *d.at *= 0.01;
  expect_same_report(reduce_part(small, options), unit, 0.01);
}

}  // namespace
}  // namespace floatframe::test
