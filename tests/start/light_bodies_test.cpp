// Bodies that are lighter than others by up to a million millions: absolute coordinates move them
// as relative ones do, apart by what the step leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

/// A rigid body with its centre of mass at x, z.
std::string body(const std::string& name, double mass, double x, double z) {
  return "  " + name + ": {rigid: {mass: " + number(mass) + ", centre_of_mass: [" + number(x) +
         ", 0, " + number(z) + "], inertia: [" + number(0.01 * mass) + ", " + number(0.1 * mass) +
         ", " + number(0.1 * mass) + "]}}\n";
}

std::string hinge(const std::string& parent, const std::string& child, double x, double z,
                  const std::string& more = "") {
  return "  " + parent + "_" + child + ": {type: revolute, parent: " + parent +
         ", child: " + child + ", at: [" + number(x) + ", 0, " + number(z) + "], axis: y" + more +
         "}\n";
}

/// Hinged links of these masses, level at the start.
std::string chain(const std::vector<double>& masses) {
  std::string bodies = "bodies:\n", joints = "joints:\n", before = "ground";
  for (std::size_t k = 0; k < masses.size(); ++k) {
    const std::string name(1, static_cast<char>('a' + k));
    bodies += body(name, masses[k], static_cast<double>(k) + 0.5, 0.0);
    joints += hinge(before, name, static_cast<double>(k), 0.0);
    before = name;
  }
  return bodies + joints + "outputs: {p: {position: " + before + "}}\n";
}

/// Crank, coupler and rocker.
std::string light_four_bar(double crank, double coupler) {
  return "bodies:\n" + body("a", crank, 0.0, 0.5) + body("b", coupler, 1.0, 1.0) +
         body("c", 1.0, 2.0, 0.4) + "joints:\n" + hinge("ground", "a", 0.0, 0.0, ", velocity: 1") +
         hinge("a", "b", 0.0, 1.0) + hinge("b", "c", 2.0, 1.0) + hinge("ground", "c", 2.0, -0.2) +
         "outputs: {p: {position: b}}\n";
}

/// The largest distance of the two formulations within a second [m].
double formulations_apart(const std::string& text, double step) {
  SimulationDescription o;
  o.step = step;
  o.duration = 1.0;
  o.spectral_radius = 0.9;
  o.output_interval = 0.01;
  ResultTable tables[2];
  for (const Coordinates c : both_coordinates) {
    o.coordinates = c;
    const RunResult result = completed_run(model_of(text), o);
    tables[c == Coordinates::absolute] = result.table;
  }
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(tables[0].rows(), tables[1].rows()); ++i)
    for (std::size_t k = 1; k < tables[0].columns.size(); ++k)
      most = std::max(most, std::abs(tables[0].at(i, k) - tables[1].at(i, k)));
  return most;
}

TEST(LightBodies, AbsoluteAsRelativeCoordinates) {
  for (const double light : {1e-6, 1e-9, 1e-12})
    for (const std::string& text : {chain({1.0, light}), chain({1.0, light, light, light}),
                                    chain({1.0, light, light * light}), chain({1.0, light, 1.0}),
                                    light_four_bar(1.0, light), light_four_bar(light, 1.0)}) {
      const double coarse = formulations_apart(text, 1e-3), fine = formulations_apart(text, 2.5e-4);
      EXPECT_LT(coarse, 2e-3) << light << '\n' << text;
      EXPECT_LT(fine, coarse / 6.0) << light << '\n' << text;  // of order 2, mostly a 16th
    }
}

}  // namespace
}  // namespace floatframe::test
