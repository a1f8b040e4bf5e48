// Lines of Campbell diagrams that end, kinds of modes, what unbalance excites, the axis of a rotor
// on a free joint, and what makes a rotor unsymmetric.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floatframe/model_file/load_model.hpp"
#include "floatframe/rotors/campbell.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/rotor_models.hpp"

namespace floatframe::test {
namespace {

CampbellOptions over(const std::string& joint, double from, double to, double step) {
  CampbellOptions o;
  o.joint = joint;
  o.from = from;
  o.to = to;
  o.step = step;
  return o;
}

std::string rotor_error_of(const std::string& model, const CampbellOptions& o) {
  return sentences_of([&] { campbell(model_of(model), o); });
}

// Without stiffening the lag of the blade has w^2 = w_0^2 - W^2: it diverges at the speed w_0 of
// its own frequency at rest, sqrt(3.516^2 E I / (rho A L^4)).
TEST(CampbellLines, LagThatDivergesIsReported) {
  const CampbellDiagram d = campbell(model_of(blade("false")), over("hub", 0.0, 40.0, 5.0));
  const double EI = 7e10 * 0.05 * std::pow(0.2, 3) / 12.0, mass = 2700.0 * 0.2 * 0.05;
  const double lag = 1.8751040687 * 1.8751040687 * std::sqrt(EI / (mass * 1e4));
  const auto flap = std::count_if(d.lines.begin(), d.lines.end(),
                                  [](const CampbellLine& l) { return l.kind == "bending"; });
  EXPECT_GE(flap, 3);
  std::printf("[ figure ] lag_diverges at %.4f rad/s, %.1e, %d speeds between\n",
              d.unstable.empty() ? 0.0 : d.unstable[0].speed,
              d.unstable.empty() ? 0.0 : d.unstable[0].speed / lag - 1.0, d.extra_speeds);
  ASSERT_EQ(d.unstable.size(), 1u);
  EXPECT_NEAR(d.unstable[0].speed, lag, 2e-3 * lag);
  EXPECT_EQ(d.unstable[0].frequency, 0.0);
  ASSERT_GE(d.unstable[0].line, 0);
  const CampbellLine& line = d.lines[static_cast<std::size_t>(d.unstable[0].line)];
  EXPECT_EQ(line.kind, "bending");
  EXPECT_TRUE(line.points.front().known());
  EXPECT_FALSE(line.points.back().known());
  const std::string name = "mode " + std::to_string(d.unstable[0].line + 1) + " (bending) ends at";
  EXPECT_TRUE(std::any_of(d.notes.begin(), d.notes.end(), [&](const std::string& n) {
    return n.find(name) != std::string::npos && n.find("diverges") != std::string::npos;
  }));
  EXPECT_TRUE(d.critical.empty());  // no axis moves
}

// The same blade with stiffening: all lines are there at all speeds, nothing diverges.
TEST(CampbellLines, StiffenedBladeKeepsItsLines) {
  const CampbellDiagram d = campbell(model_of(blade("true")), over("hub", 0.0, 40.0, 5.0));
  EXPECT_TRUE(d.unstable.empty());
  for (const CampbellLine& line : d.lines)
    for (const CampbellPoint& p : line.points) EXPECT_TRUE(p.known());
  // Flap, the lowest at rest: of a uniform blade near sqrt(w_0^2 + 1.19 W^2), above W.
  EXPECT_EQ(d.lines[0].kind, "bending");
  EXPECT_GT(d.lines[0].points.back().frequency(), 40.0);
  EXPECT_LT(d.lines[0].points.back().frequency(), 46.0);
}

// In round bearings unbalance excites forward whirl alone; in bearings that are not round backward
// whirl has a part that goes with the rotor.
TEST(CampbellLines, CriticalSpeedsAreThoseOfUnbalance) {
  const auto kinds = [](double k2, const auto& list_of) {
    const CampbellDiagram d = campbell(
        model_of(disc_in_bearing("stiffness: [[8e4, 0, 0, 0, 0, 0], [0, " + std::to_string(k2) +
                                 ", 0, 0, 0, 0], [0, 0, 9e4, 0, 0, 0], [0, 0, 0, 900, 0, 0], "
                                 "[0, 0, 0, 0, 600, 0], [0, 0, 0, 0, 0, 0]]")),
        over("motor", 0.0, 400.0, 25.0));
    std::vector<double> speeds;
    for (const CriticalSpeed& c : list_of(d)) speeds.push_back(c.speed);
    return speeds;
  };
  const auto critical = [](const CampbellDiagram& d) { return d.critical; };
  const auto crossings = [](const CampbellDiagram& d) { return d.crossings; };
  // x and y uncoupled, both at lines: critical at sqrt(k / m). Tilts in a moment field that is not
  // round: J_t w^2 with gyroscopic moment, backward and forward mixed. Axial never.
  const std::vector<double> round = kinds(8e4, critical), flat = kinds(5e4, critical);
  const double kx = std::sqrt(8e4 / 2.0), ky = std::sqrt(5e4 / 2.0), axial = std::sqrt(9e4 / 2.0);
  const auto has = [](const std::vector<double>& list, double speed) {
    return std::any_of(list.begin(), list.end(),
                       [&](double x) { return std::abs(x - speed) < 1e-6 * speed; });
  };
  EXPECT_TRUE(has(round, kx));
  EXPECT_TRUE(has(flat, kx));
  EXPECT_TRUE(has(flat, ky));
  EXPECT_FALSE(has(round, axial) || has(flat, axial));
  EXPECT_TRUE(has(kinds(8e4, crossings), axial));
}

TEST(CampbellLines, BackwardWhirlInRoundBearingsIsNotCritical) {
  const CampbellDiagram d = campbell(model_of(two_discs(9)), over("spin", 0.0, 400.0, 50.0));
  ASSERT_FALSE(d.critical.empty());
  for (const CriticalSpeed& c : d.critical) EXPECT_GT(c.whirl, 0.99);
  ASSERT_FALSE(d.crossings.empty());
  for (const CriticalSpeed& c : d.crossings) EXPECT_LT(c.whirl, 0.1);
  EXPECT_TRUE(d.notes.empty());
  // Orders other than 1 say nothing of the direction of what excites.
  CampbellOptions half = over("spin", 0.0, 400.0, 50.0);
  half.orders = {2.0};
  const CampbellDiagram twice = campbell(model_of(two_discs(9)), half);
  EXPECT_TRUE(twice.crossings.empty());
  EXPECT_TRUE(std::any_of(twice.critical.begin(), twice.critical.end(),
                          [](const CriticalSpeed& c) { return c.whirl < -0.9; }));
}

// Veering and crossing lines: at a coarse step speeds between are added until shapes are alike.
TEST(CampbellLines, CoarseStepsAreRefined) {
  const Model model = model_of(disc_in_bearing(
      "stiffness: [[8e4, 0, 0, 0, -2e3, 0], [0, 5e4, 0, 1.5e3, 0, 0], [0, 0, 9e4, 0, 0, 0], "
      "[0, 1.5e3, 0, 900, 0, 0], [-2e3, 0, 0, 0, 600, 0], [0, 0, 0, 0, 0, 0]]"));
  const CampbellDiagram fine = campbell(model, over("motor", 0.0, 1200.0, 10.0)),
                        coarse = campbell(model, over("motor", 0.0, 1200.0, 600.0));
  EXPECT_GT(coarse.extra_speeds, 0);
  ASSERT_EQ(fine.lines.size(), coarse.lines.size());
  for (std::size_t k = 0; k < fine.lines.size(); ++k) {
    const double a = fine.lines[k].points.back().frequency(),
                 b = coarse.lines[k].points.back().frequency();
    EXPECT_NEAR(b, a, 1e-6 * a) << k;
  }
  ASSERT_EQ(fine.critical.size(), coarse.critical.size());
  for (std::size_t k = 0; k < fine.critical.size(); ++k)
    EXPECT_NEAR(coarse.critical[k].speed, fine.critical[k].speed, 1e-6 * fine.critical[k].speed);
  EXPECT_TRUE(coarse.notes.empty());
}

TEST(CampbellLines, AxisOfAFreeJointIsFound) {
  const Model rotor = load_model(FLOATFRAME_EXAMPLES "/rotor/rotor.yaml");
  CampbellOptions named = over("motor", 0.0, 200.0, 100.0), found = named;
  named.axis = Vec3::UnitX();
  const CampbellDiagram a = campbell(rotor, named), b = campbell(rotor, found);
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (std::size_t k = 0; k < a.lines.size(); ++k)
    EXPECT_EQ(a.lines[k].points.back().lambda, b.lines[k].points.back().lambda);
  const auto free_body = [](const char* inertia) {
    return model_of(std::string("gravity: [0, 0, 0]\nbodies: {b: {position: [0, 0, 0], rigid: "
                                "{mass: 1, inertia: ") +
                    inertia +
                    "}}}\njoints: {motor: {type: free, child: b, at: [0, 0, 0]}}\nsimulation: "
                    "{step: 0.001, duration: 1}\n");
  };
  const auto error = [&](const char* inertia) {
    return error_of([&] { campbell(free_body(inertia), over("motor", 0.0, 100.0, 50.0)); });
  };
  EXPECT_EQ(error("[1, 1.8, 1]"), "no error");
  EXPECT_EQ(error("[1, 1, 1]"), "unsupported");
  EXPECT_EQ(error("[1, 1.2, 1.4]"), "unsupported");
}

TEST(CampbellLines, CutPairIsNamed) {
  // Bending of the three equal spans: groups of four, between them pairs of the shaft as a whole.
  const auto error = [](int n) {
    return rotor_error_of(two_discs(n), over("spin", 0.0, 1000.0, 500.0));
  };
  const auto names = [&](int n, const std::string& cuts, const std::string& take) {
    const std::string text = error(n),
                      expected =
                          "body 'shaft': normal_modes: " + std::to_string(n) + " cuts a " + cuts;
    EXPECT_TRUE(contains(text, expected));
    EXPECT_TRUE(contains(text, take));
  };
  names(6, "pair of modes of equal frequency", "take 5 or 7");
  for (const int n : {10, 11, 12}) names(n, "group of 4 modes of equal frequency", "take 9 or 13");
  for (const int n : {5, 7, 9, 13}) EXPECT_EQ(error(n), "no error") << n;
}

TEST(CampbellLines, MassOffTheAxisIsNamed) {
  const std::string text = R"(
gravity: [0, 0, 0]
points: {c: [0, 0, 0], u: [0.24, 0, 0]}
bodies:
  tub: {rigid: {mass: 45, centre_of_mass: c, inertia: [2.0, 2.2, 2.4]}}
  drum: {rigid: {mass: 12, centre_of_mass: c, inertia: [0.45, 0.45, 0.6]}}
  unb: {rigid: {mass: 0.5, centre_of_mass: u}}
joints:
  spin: {type: revolute, parent: tub, child: drum, at: c, axis: z, motion: {polynomial: [0, 100]}}
  unb: {type: weld, parent: drum, child: unb, at: u}
forces:
  feet: {type: bushing, from: {body: ground, at: c}, to: {body: tub, at: c}, spring_x: 5000,
    spring_y: 9000, spring_z: 7000, spring_rx: 300, spring_ry: 200, spring_rz: 400}
simulation: {step: 0.0005, duration: 1}
)";
  const std::string error = rotor_error_of(text, over("spin", 0.0, 125.0, 25.0));
  EXPECT_TRUE(
      contains(error, "the mass of body 'unb' (0.5 kg) is 0.24 m off the axis (0.12 kg m)"));
  EXPECT_TRUE(contains(error, "--unbalance"));
}

}  // namespace
}  // namespace floatframe::test
