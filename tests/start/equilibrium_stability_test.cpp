// Equilibria that the smallest push leaves are said to be unstable, with the time in which what
// leaves grows by e in closed form; those that are stable or neutral are not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/statics.hpp"
#include "support/coordinates.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

using Notes = std::vector<std::string>;

Notes notes_of(const std::string& text) { return statics(model_of(text)).notes; }

/// Of a sentence "... by e in 0.247 s; ...".
double growth_time(const std::string& note) {
  const std::string before = "by e in ";
  const std::size_t at = note.find(before);
  return at == std::string::npos ? 0.0 : std::stod(note.substr(at + before.size()));
}

std::string head_pendulum(double height, const std::string& forces = "") {
  return "points: {o: [0, 0, 0], c: [0, 0, " + std::to_string(height) +
         "]}\nbodies: {rod: {rigid: {mass: 2, centre_of_mass: c, inertia: [0.1, 0.1, 0.001]}}}\n"
         "joints: {hinge: {type: revolute, child: rod, at: o, axis: y}}\n" +
         forces;
}

TEST(Stability, PendulumOnItsHead) {
  const Notes up = notes_of(head_pendulum(0.5));
  ASSERT_EQ(up.size(), 1u);
  EXPECT_EQ(up[0].substr(0, 59), "the equilibrium is unstable: body 'rod' would leave it at t");
  EXPECT_NEAR(growth_time(up[0]), std::sqrt((0.1 + 2.0 * 0.25) / (2.0 * 9.81 * 0.5)), 5e-4);
  EXPECT_EQ(notes_of(head_pendulum(-0.5)), Notes{});
}

// A spring of m g l holds it: a little less does not.
TEST(Stability, HeldByASpring) {
  const auto held = [](double k) {
    return notes_of(head_pendulum(0.5, "forces: {s: {type: joint_spring, joint: hinge, spring: " +
                                           std::to_string(k) + "}}\n"));
  };
  EXPECT_EQ(held(9.9), Notes{});
  const Notes less = held(9.8);
  ASSERT_EQ(less.size(), 1u);
  EXPECT_NEAR(growth_time(less[0]), std::sqrt(0.6 / 0.01), 0.05);
}

// Beside fifty that hang, which the tangent of steps knows to be softer than the one on its head.
TEST(Stability, OneOfManySoftMotions) {
  const auto notes = [](double k) {
    std::string bodies = "bodies:\n", joints = "joints:\n";
    for (int i = 0; i <= 50; ++i) {
      const std::string n = std::to_string(i), y = "[0, " + n + ", ";
      bodies += "  b" + n + ": {rigid: {mass: 2, centre_of_mass: " + y +
                (i == 37 ? "0.5" : "-0.5") + "], inertia: [0.1, 0.1, 0.001]}}\n";
      joints += "  j" + n + ": {type: revolute, child: b" + n + ", at: " + y + "0], axis: y}\n";
    }
    return notes_of(bodies + joints + "forces: {s: {type: joint_spring, joint: j37, spring: " +
                    std::to_string(k) + "}}\n");
  };
  EXPECT_EQ(notes(9.9), Notes{});
  const Notes less = notes(9.7);
  ASSERT_EQ(less.size(), 1u);
  EXPECT_NE(less[0].find("'b37'"), std::string::npos) << less[0];
}

TEST(Stability, NeutralIsNotUnstable) {
  EXPECT_EQ(
      notes_of("gravity: [0, 0, 0]\n"
               "bodies: {m: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 2, 3]}}}\n"),
      Notes{});
  EXPECT_EQ(notes_of("points: {o: [0, 0, 0]}\n"
                     "bodies: {m: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 2, 3]}}}\n"
                     "joints: {p: {type: planar, child: m, at: o, axis: z, axis_2: x}}\n"),
            Notes{});
}

/// A column of 1 m with a square section.
std::string square_column(int elements, double side, int modes, const std::string& more) {
  return fmt::format(R"(
points: {{o: [0, 0, 0], e: [0, 0, 1]}}
bodies:
  column:
    flexible:
      material: {{young: 2.1e11, poisson: 0.3, density: 7850}}
      bars:
        a: {{from: o, to: e, elements: {0}, section: {{rectangle: [{1}, {1}]}}, reference: x}}
      clamped: [o]
      static_modes: [{{point: e, dofs: [x, y, z]}}]
      normal_modes: {2}
      mass_model: hermite
)",
                     elements, side, modes) +
         more;
}

// Beside modes of 100 kHz, whose stiffnesses are 1e12 times that of the fall.
TEST(Stability, StiffColumnOnAHinge) {
  const Notes notes = notes_of(square_column(
      8, 0.05, 8, "joints: {hinge: {type: revolute, child: column, at: o, axis: y}}\n"));
  ASSERT_EQ(notes.size(), 1u);
  // A rod: s^2 = (m g L/2) / (m L^2/3), its bending and section leave 1e-3.
  EXPECT_NEAR(growth_time(notes[0]), std::sqrt(2.0 / 3.0 / 9.81), 1e-3);
}

// A bar that is clamped at its foot buckles at pi^2 E I / (4 L^2), by the geometric stiffness of
// its load, which the tangent of steps holds.
TEST(Stability, EulersColumn) {
  const double a = 0.02,
               load = std::numbers::pi * std::numbers::pi * 2.1e11 * std::pow(a, 4) / 12.0 / 4.0;
  const auto notes = [&](double part) {
    return notes_of(square_column(10, a, 4,
                                  R"(gravity: [0, 0, 0]
joints: {foot: {type: weld, child: column, at: o}}
forces: {p: {type: force, body: column, node: e, direction: [0, 0, -1], magnitude: )" +
                                      std::to_string(part * load) +
                                      "}}\nsimulation: {geometric_stiffening: true}\n"));
  };
  EXPECT_EQ(notes(0.99), Notes{});
  EXPECT_EQ(notes(1.01).size(), 1u);
}

// Loops: the crank up or down, at every start angle.
TEST(Stability, SliderCrank) {
  int unstable = 0;
  for (double angle = -3.1; angle < 3.2; angle += 0.4) {
    const StaticsResult s =
        statics(build_model(read_model(FLOATFRAME_EXAMPLES "/slider_crank/slider_crank.yaml",
                                       {{"angle", std::to_string(angle)}})));
    const bool up = s.bodies.at(1).position.y() > 0.0;  // of the rod, at the pin
    EXPECT_EQ(s.notes.size(), up ? 1u : 0u) << angle;
    unstable += up ? 1 : 0;
  }
  EXPECT_GT(unstable, 0);
}

// Ziegler's double pendulum under a force that follows its end: its stiffness is not symmetric, and
// below the flutter load nothing diverges though the symmetric part is indefinite. A weight of the
// same size lets it fall.
TEST(Stability, LoadsThatFollow) {
  const auto ziegler = [](const char* follows) {
    return notes_of(std::string(R"(
gravity: [0, 0, 0]
points: {a: [0, 0, 0], b: [0, 0, 1], c: [0, 0, 2]}
bodies:
  one: {rigid: {mass: 2, centre_of_mass: b, inertia: [0.001, 0.001, 0.001]}}
  two: {rigid: {mass: 1, centre_of_mass: c, inertia: [0.001, 0.001, 0.001]}}
joints:
  one: {type: revolute, child: one, at: a, axis: y}
  two: {type: revolute, parent: one, child: two, at: b, axis: y}
forces:
  k1: {type: joint_spring, joint: one, spring: 1}
  k2: {type: joint_spring, joint: two, spring: 1}
  load: {type: force, body: two, at: c, direction: -z, magnitude: 2, follows: )") +
                    follows + "}\n");
  };
  EXPECT_EQ(ziegler("true"), Notes{});
  EXPECT_EQ(ziegler("false").size(), 1u);
}

TEST(Stability, IsReportedOfStartsToo) {
  ModelDescription d = read_model(FLOATFRAME_TEST_DATA "/hints/inverted.yaml");
  const Model model = build_model(d);
  for (const Coordinates c : both_coordinates) {
    d.simulation.coordinates = c;
    const Notes notes = run(model, d.simulation).summary.start.notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0].substr(0, 28), "the equilibrium is unstable:");
  }
  EXPECT_EQ(check(model).start.notes.size(), 1u);
  d.simulation.start = Start::given;
  EXPECT_EQ(check(build_model(d)).start.notes, Notes{});
  EXPECT_EQ(run(model, d.simulation).summary.start.notes, Notes{});
}

}  // namespace
}  // namespace floatframe::test
