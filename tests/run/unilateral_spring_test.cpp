// Contact in one direction: exact restitution, energy, rest.
#include <gtest/gtest.h>

#include <cmath>

#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::string ball(const std::string& contact, const std::string& options) {
  return R"(
bodies: {ball: {position: [0, 0, 0], rigid: {mass: 0.5, inertia: [0.01, 0.01, 0.01]}}}
joints: {fall: {type: prismatic, child: ball, at: [0, 0, 0], axis: z, velocity: -2}}
gravity: [0, 0, 0]
forces:
  c: {type: unilateral_spring, from: {body: ground, at: [0, 0, -1]},
      to: {body: ball, at: [0, 0, 0]}, length: 0.9, )" +
         contact + R"(}
outputs: {z: {joint_position: fall}, v: {joint_velocity: fall}, f: {force: c}}
simulation: {step: 1.0e-4, duration: 0.2, )" +
         options + "}\n";
}

double rebound(const std::string& contact, Coordinates c, double step, bool located) {
  const Model model = model_of(ball(contact, located ? "locate_edges: true" : ""));
  const RunResult r = completed_run(model, with(model.simulation, c, step, 0.2));
  return (r.table.data.end() - 4)[2];
}

TEST(UnilateralSpring, RestitutionIsExact) {
  for (const Coordinates c : both_coordinates)
    for (const char* law : {"stiffness: 1e4", "stiffness: 1e6, exponent: 1.5"})
      for (const double e : {1.0, 0.8, 0.3}) {
        const std::string contact = std::string(law) + ", restitution: " + std::to_string(e);
        EXPECT_NEAR(rebound(contact, c, 1e-4, true), 2.0 * e, 2e-4) << contact;
      }
}

// With the touch located the error falls with the square of the step.
TEST(UnilateralSpring, ConvergesWithOrderTwo) {
  const std::string contact = "stiffness: 1e4, restitution: 0.6";
  const double coarse = rebound(contact, Coordinates::relative, 1e-3, true) - 1.2,
               fine = rebound(contact, Coordinates::relative, 2.5e-4, true) - 1.2;
  EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 4.0, 0.5);
  EXPECT_NEAR(rebound(contact, Coordinates::relative, 1e-4, false), 1.2, 5e-3);
}

TEST(UnilateralSpring, EnergyIsClosed) {
  const Model model = model_of(ball("stiffness: 1e4, restitution: 0.5", "locate_edges: true"));
  const RunResult r = completed_run(model, model.simulation);
  EXPECT_LT(r.summary.energy.largest_remainder, 1e-3 * r.summary.energy.exchanged);
  EXPECT_NEAR(r.summary.energy.total_end / r.summary.energy.total_start, 0.25, 1e-3);
}

// A ball that comes to rest on the ground, in steps of a millisecond.
TEST(UnilateralSpring, ComesToRest) {
  std::string text = ball("stiffness: 1e4, restitution: 0.5", "");
  text.replace(text.find("[0, 0, 0]\nforces"), 9, "[0, 0, -9.81]");
  const Model model = model_of(text);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, c, 1e-3, 4.0));
    const auto row = r.table.data.end() - 4;
    EXPECT_NEAR(row[1], -0.1 - 0.5 * 9.81 / 1e4, 1e-6);
    EXPECT_NEAR(row[3], -0.5 * 9.81, 1e-2);
  }
}

}  // namespace
}  // namespace floatframe::test
