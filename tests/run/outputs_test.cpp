// Every output of the list: both formulations give the same number of a moving system, in the unit
// that the model says. What single outputs measure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "floatframe/model/output_kind.hpp"
#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A flexible arm on a hinge, a puck that flies freely, a spring between them.
const std::string moving = R"(
gravity: [0, 0, -9.81]
points: {hinge: [0, 0, 0.1], tip: [1, 0, 0.2]}
bodies:
  arm:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: hinge, to: tip, elements: 4, section: {round: 0.02}}}
      clamped: [hinge]
      static_modes: [{point: tip, dofs: [x, y, z]}]
  puck: {rigid: {mass: 2, centre_of_mass: [2, 1, 0.5], inertia: [0.1, 0.2, 0.3]}}
  bob: {position: [3, 0.3, 1], rigid: {mass: 1, inertia: [0.1, 0.2, 0.3]}}
  gear: {position: [3, 1, 1], rigid: {mass: 1, inertia: [0.1, 0.2, 0.3]}}
  bead: {position: [5, 0, 0], rigid: {mass: 1, inertia: [0.1, 0.2, 0.3]}}
joints:
  hinge: {type: revolute, child: arm, at: hinge, axis: y, position: 0.4, velocity: 1.5}
  drive: {type: revolute, child: bob, at: [3, 0, 1.2], axis: [0, 1, 1],
      motion: {piecewise: [{polynomial: [0.1, 2, 3]}]}}
  loose: {type: free, child: puck, at: [2, 1, 0.5], velocity: [3, -0.4, 0.5, 1, 2, -3]}
  shaft: {type: revolute, child: gear, at: [3, 1, 1.2], axis: z}
couplings: {mesh: {terms: [{joint: drive}, {joint: shaft, factor: -2}]}}
constraints:
  rail:
    type: slide_along
    from: {body: ground, at: [5, 0, 0]}
    to: {body: bead}
    points: [[0, 0, 0], [1, 0, -0.2], [2, 0.3, 0]]
rods: {tie: {from: {body: ground, at: [1, 2, 1.5]}, to: {body: puck}}}
forces:
  dash: {type: maxwell, from: {body: arm, at: tip}, to: {body: puck}, branches: [[100, 20]]}
  coil: {type: spring_damper, from: {body: arm, at: tip}, to: {body: puck}, spring: 100, damper: 20}
controllers: {hold: {type: pid, measured: {length: coil}, proportional: 3}}
initial:
  amplitudes: {arm: [0.0001, 0.002, -0.003]}
  amplitude_rates: {arm: [0.001, 0.02, 0.03]}
simulation: {step: 1.0e-3, duration: 0}
)";

std::string columns_of_type(OutputType type) {
  // In the order of OutputOf.
  static const char* const references[] = {"{body: arm, at: tip}",
                                           "{from: puck, to: {body: arm, at: tip}}",
                                           "puck",
                                           "model",
                                           "{body: arm, at: tip}",
                                           "loose, coordinate: 5",
                                           "arm, mode: 2",
                                           "coil",
                                           "hinge, in: child",
                                           "tie",
                                           "drive",
                                           "mesh",
                                           "rail",
                                           "hold",
                                           "dash",
                                           "3 * length(coil) + 2",
                                           "t - 0.0025",
                                           "{body: arm, at: tip, toward: [0.3, 1, 0.5]}"};
  static_assert(std::size(references) == index_of(OutputOf::gauge) + 1);
  const std::string word = output_type_name(type);
  std::string what = references[index_of(output_kind(type).of)];
  if (type == OutputType::joint_torque) what += ", about: {body: arm, at: tip}";
  if (type == OutputType::joint_force) what = "{rod: tie}, in: {body: arm}";
  if (type == OutputType::strain) what += ", direction: [1, 2, 0]";
  return "  " + word + ": {" + word + ": " + what + "}\n";
}

ResultTable sampled(const std::string& columns, Coordinates coordinates, double duration) {
  ModelDescription d = description_of(moving + "outputs:\n" + columns);
  d.simulation.coordinates = coordinates;
  d.simulation.duration = duration;
  return completed_run(d).table;
}

TEST(Outputs, OfTheListAreThoseOfEitherFormulation) {
  std::string columns;
  for (const OutputType type : output_types) columns += columns_of_type(type);
  const ResultTable a = sampled(columns, Coordinates::absolute, 0.0);
  const ResultTable b = sampled(columns, Coordinates::relative, 0.0);
  ASSERT_EQ(a.columns.size(), b.columns.size());
  ASSERT_GT(a.columns.size(), std::size(output_types));
  double largest_stress = 0.0;  // the others of the place are its differences
  for (std::size_t k = 1; k < a.columns.size(); ++k)
    if (a.columns[k].name.starts_with("stress."))
      largest_stress = std::max(largest_stress, std::abs(a.at(0, k)));
  for (std::size_t k = 1; k < a.columns.size(); ++k) {
    EXPECT_EQ(a.columns[k].unit, b.columns[k].unit);
    EXPECT_FALSE(a.columns[k].unit.empty());
    const double x = a.at(0, k), y = b.at(0, k);
    if (a.columns[k].name == "first_crossing") {
      EXPECT_TRUE(std::isnan(x) && std::isnan(y));
      continue;
    }
    EXPECT_TRUE(std::isfinite(x)) << a.columns[k].name;
    const double size = a.columns[k].name.starts_with("stress.") ? largest_stress : std::abs(x);
    EXPECT_NEAR(x, y, 1e-8 * (1.0 + size)) << a.columns[k].name;
    // Rotations begin at the design orientation.
    const bool begins_at_zero =
        a.columns[k].name.starts_with("rotation") ||
        a.columns[k].name.starts_with("joint_position") ||
        (a.columns[k].name.starts_with("quaternion") && a.columns[k].name != "quaternion.w") ||
        a.columns[k].name.starts_with("projection_impulse");
    // Across a bar there is no stress.
    if (!a.columns[k].name.starts_with("stress.")) {
      const bool zero = begins_at_zero ? std::abs(x) < 1e-12 : x == 0.0;
      EXPECT_EQ(zero, begins_at_zero) << a.columns[k].name << ' ' << x;
    }
  }
}

TEST(Outputs, DistanceIsThatOfThePositionsOfItsPoints) {
  const std::string columns =
      "  d: {distance: {from: {body: arm, at: tip}, to: puck}}\n"
      "  fixed: {distance: {from: {body: ground, at: [1, 2, 2]}, to: {body: ground, at: [1, -1, "
      "6]}}}\n"
      "  tip: {position: {body: arm, at: tip}}\n"
      "  puck: {position: puck}\n"
      "  coil: {length: coil}\n";
  for (const Coordinates c : {Coordinates::absolute, Coordinates::relative}) {
    const ResultTable t = sampled(columns, c, 0.05);
    ASSERT_EQ(t.columns.size(), 10u);
    EXPECT_EQ(t.columns[1].name + " [" + t.columns[1].unit + "]", "d [m]");
    ASSERT_EQ(t.rows(), 51u);
    for (std::size_t i = 0; i < t.rows(); ++i) {
      const double* x = t.data.data() + i * t.columns.size();
      const Vec3 tip(x[3], x[4], x[5]), puck(x[6], x[7], x[8]);
      EXPECT_NEAR(x[1], (puck - tip).norm(), 1e-14);
      EXPECT_NEAR(x[1], x[9], 1e-14);
      EXPECT_NEAR(x[2], 5.0, 1e-14);
    }
  }
}

}  // namespace
}  // namespace floatframe::test
