// Geometric stiffening that linear analyses count in: what counts, what is said of it, keys that
// are obeyed.
#include "floatframe/linear/counted_stiffening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/linear/linearize.hpp"
#include "floatframe/linear/operating_point.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A flat bar of 1 m whose tip is pulled along it.
std::string pulled(double N, const std::string& key, const std::string& mass = "hermite",
                   const std::string& simulation = "") {
  return "gravity: [0, 0, 0]\n"
         "points: {o: [0, 0, 0], t: [1, 0, 0]}\n"
         "bodies:\n"
         "  b:\n"
         "    flexible:\n"
         "      material: {young: 7e10, poisson: 0, density: 2700}\n"
         "      bars: {b: {from: o, to: t, elements: 20, section: {rectangle: [0.06, 0.006]},\n"
         "                 reference: y}}\n"
         "      clamped: [o]\n"
         "      static_modes: [{point: t, dofs: all}]\n"
         "      normal_modes: 16\n"
         "      mass_model: " +
         mass + "\n" + (mass == "hermite" ? "      section_inertia: true\n" : "") + key +
         "joints: {j: {type: weld, child: b, at: o}}\n"
         "forces: {N: {type: force, body: b, at: t, direction: [1, 0, 0], magnitude: " +
         std::to_string(N) +
         "}}\n"
         "simulation: {step: 0.001, duration: 1" +
         simulation + "}\n";
}
const std::string key_is_false = "    geometric_stiffening: false\n",
                  key_is_true = "    geometric_stiffening: true\n";

std::vector<double> frequencies(const Model& model, const std::string& at = "equilibrium") {
  std::vector<double> f;
  for (const LinearMode& m : linear_modes(linear_system(at_operating_point(model, at))))
    f.push_back(m.damped());
  return f;
}
double nearest_counted(const std::vector<double>& f, double x) {
  double best = 1e300;
  for (const double v : f)
    if (std::abs(v - x) < std::abs(best - x)) best = v;
  return best;
}

TEST(CountedStiffening, TensionStiffensTorsion) {
  // Torsion of a bar under N: (GJ + N Ip/A) phi'' = rho Ip phi'', clamped and free.
  const double N = 20000.0;
  const Model model = model_of(pulled(N, ""));
  const BeamSection s = BeamSection::rectangle(0.06, 0.006);
  const double Ip = s.Iy + s.Iz, G = 3.5e10;
  const auto torsion = [&](double tension) {
    return std::sqrt((G * s.J + tension * Ip / s.A) / (2700.0 * Ip)) / 4.0;
  };
  EXPECT_NEAR(torsion(N), 177.1, 0.1);
  EXPECT_NEAR(nearest_counted(frequencies(model), torsion(N)) / torsion(N), 1.0, 1e-3);
  const LinearSystem system = linear_system(at_operating_point(model, "equilibrium"));
  EXPECT_EQ(system.stiffened, std::vector<std::string>{"b"});
  expect_in(system.stiffening, "body 'b'");
  expect_in(system.stiffening, "'run' leaves it out unless the model sets geometric_stiffening");
  // The keys are obeyed; the other one is said.
  const Model off = model_of(pulled(N, key_is_false)), on = model_of(pulled(N, key_is_true));
  EXPECT_EQ(linear_system(on).stiffened.size(), 0U);
  EXPECT_NEAR(nearest_counted(frequencies(on), torsion(N)) / torsion(N), 1.0, 1e-3);
  EXPECT_NEAR(nearest_counted(frequencies(off), torsion(0.0)) / torsion(0.0), 1.0, 1e-3);
  const LinearSystem left_out = linear_system(off);
  ASSERT_FALSE(left_out.notes.empty());
  expect_in(left_out.notes[0], "loads change the stiffness of body 'b'");
  expect_in(left_out.notes[0], "geometric_stiffening: true counts it in");
  // Bending: as with the key.
  const std::vector<double> a = frequencies(model), b = frequencies(on);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-9 * b[k]);
}

TEST(CountedStiffening, NothingWhereNothingPulls) {
  const Model model = model_of(pulled(0.0, "")), off = model_of(pulled(0.0, key_is_false));
  const CountedStiffening counted = counted_stiffening(model);
  EXPECT_TRUE(counted.bodies.empty());
  EXPECT_TRUE(counted.sentence.empty());
  EXPECT_TRUE(counted.notes.empty());
  EXPECT_FALSE(counted.model.bodies[0].geometric_stiffening);
  EXPECT_EQ(linear_system(model).A, linear_system(off).A);
}

TEST(CountedStiffening, ProjectionGivesWayToPreprocessing) {
  const Model model = model_of(pulled(20000.0, "", "isoparametric", ", inertia: projection"));
  const CountedStiffening counted = counted_stiffening(at_operating_point(model, "equilibrium"));
  EXPECT_EQ(counted.bodies.size(), 1U);
  EXPECT_EQ(counted.model.simulation.inertia, InertiaMethod::preprocessing);
  const std::vector<double> a = frequencies(model);
  const std::vector<double> b =
      frequencies(model_of(pulled(20000.0, key_is_true, "isoparametric")));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(a[k] / b[k], 1.0, 1e-9);
}

TEST(CountedStiffening, AsManyAsAreNamed) {
  // Of bodies that an analysis makes spin; a key is obeyed.
  const Model model = model_of(pulled(0.0, ""));
  EXPECT_EQ(counted_stiffening(model, {0}).bodies.size(), 1U);
  EXPECT_TRUE(counted_stiffening(model, {0}).model.bodies[0].stiffens());
  EXPECT_TRUE(counted_stiffening(model_of(pulled(0.0, key_is_false)), {0}).bodies.empty());
}

std::string blade(const std::string& key, const std::string& mass = "hermite",
                  const std::string& simulation = "") {
  return "gravity: [0, 0, 0]\n"
         "points: {h: [0, 0, 0], t: [10, 0, 0]}\n"
         "bodies:\n"
         "  blade:\n"
         "    flexible:\n"
         "      material: {young: 7e10, poisson: 0.3, density: 2700}\n"
         "      bars: {b: {from: h, to: t, elements: 20, section: {rectangle: [0.2, 0.05]},\n"
         "                 reference: y}}\n"
         "      clamped: [h]\n"
         "      static_modes: [{point: t, dofs: [x, y, z]}]\n"
         "      normal_modes: 6\n"
         "      mass_model: " +
         mass + "\n      section_inertia: true\n" + key +
         "joints: {hub: {type: revolute, child: blade, at: h, axis: z,\n"
         "               motion: {polynomial: [0, 40]}}}\n"
         "simulation: {step: 0.001, duration: 1" +
         simulation + "}\n";
}

TEST(CountedStiffening, ABladeThatSpins) {
  const Model model = model_of(blade(""));
  const std::vector<double> counted = frequencies(model, "start");
  const std::vector<double> on = frequencies(model_of(blade(key_is_true)), "start");
  ASSERT_EQ(counted.size(), on.size());
  for (std::size_t k = 0; k < on.size(); ++k) EXPECT_NEAR(counted[k], on[k], 1e-9 * on[k]);
  // Flap at 40 rad/s.
  EXPECT_NEAR(2.0 * std::numbers::pi * nearest_counted(on, 41.14 / (2.0 * std::numbers::pi)), 41.14,
              0.02);
  const LinearSystem off = linear_system(model_of(blade(key_is_false)));
  ASSERT_FALSE(off.notes.empty());
  expect_in(off.notes[0], "body 'blade' spins too fast for its stiffness: at 40 rad/s");
  expect_in(off.notes[0], "geometric_stiffening: true counts it in");
  EXPECT_TRUE(off.stiffened.empty());
  // A matrix of the absolute formulation is of the same system.
  EXPECT_EQ(linearize(model).stiffened.size(), 1U);
}

TEST(CountedStiffening, SixDofIsReportedWithoutIt) {
  const LinearSystem system =
      linear_system(model_of(blade("", "six_dof", ", inertia: projection")));
  EXPECT_TRUE(system.stiffened.empty());
  ASSERT_FALSE(system.notes.empty());
  expect_in(system.notes[0], "mass_model six_dof has no second order of its turning sections");
}

TEST(CountedStiffening, ReportsBeginWithIt) {
  const Model model = model_of(pulled(20000.0, ""));
  for (const Analysis& analysis : {modes_analysis(), linearize_analysis(), response_analysis()}) {
    SCOPED_TRACE(analysis.name);
    const AnalysisReport report = analysis.run(model);
    EXPECT_EQ(report.text.rfind("Geometric stiffening by loads and spin is counted in here (body "
                                "'b')",
                                0),
              0U);
    const auto json = nlohmann::json::parse(report.json);
    EXPECT_EQ(json["stiffening_counted_in"], nlohmann::json({"b"}));
    EXPECT_EQ(
        nlohmann::json::parse(
            analysis.run(model_of(pulled(20000.0, key_is_true))).json)["stiffening_counted_in"]
            .size(),
        0U);
  }
}

}  // namespace
}  // namespace floatframe::test
