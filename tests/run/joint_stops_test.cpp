// Stops as keys of joints: restitution, a thousand impacts, stops of every kind of coordinate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/stepping/stepping.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"
#include "support/stepping_models.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

/// 0.5 kg on a slide, 0.05 m above its stop, which it approaches with 2 m/s.
std::string buffered(const std::string& stop) {
  return R"(
gravity: [0, 0, 0]
bodies: {ball: {position: [0, 0, 0], rigid: {mass: 0.5, inertia: [0.01, 0.01, 0.01]}}}
joints:
  fall: {type: prismatic, child: ball, at: [0, 0, 0], axis: z, position: 0.05, velocity: -2,
         stops: {)" +
         stop + R"(}}
outputs: {z: {joint_position: fall}, v: {joint_velocity: fall}, f: {force: fall.stops}}
simulation: {step: 1.0e-4, duration: 0.2, locate_edges: true}
)";
}

struct Contact {
  double stiffness, exponent, restitution;
  std::string keys() const {
    return "lower: 0, stiffness: " + std::to_string(stiffness) +
           ", exponent: " + std::to_string(exponent) +
           ", restitution: " + std::to_string(restitution);
  }
  /// c > 0 of c (1 + e) = ln((1 + c) / (1 - c e)).
  double damping() const {
    const double e = restitution;
    const auto f = [e](double c) { return std::log((1.0 + c) / (1.0 - c * e)) - c * (1.0 + e); };
    double low = 1e-6, high = (1.0 - 1e-14) / e;
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (low + high);
      (f(middle) < 0.0 ? low : high) = middle;
    }
    return low;
  }
  /// Of 0.5 kg at 2 m/s, by Runge and Kutta's steps.
  double duration() const {
    const double h = 1e-6, b = damping() / 2.0;
    double d = 0.0, v = 2.0, t = 0.0;
    const auto rate = [&](double x, double w) {
      return -stiffness / 0.5 * std::pow(std::max(x, 0.0), exponent) * (1.0 + b * w);
    };
    do {
      const double a1 = rate(d, v), a2 = rate(d + 0.5 * h * v, v + 0.5 * h * a1);
      const double v3 = v + 0.5 * h * a2, a3 = rate(d + 0.5 * h * (v + 0.5 * h * a1), v3);
      const double v4 = v + h * a3, a4 = rate(d + h * v3, v4);
      d += h / 6.0 * (v + 2.0 * (v + 0.5 * h * a1) + 2.0 * v3 + v4);
      v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
      t += h;
    } while (d > 0.0);
    return t;
  }
};

TEST(JointStops, RestitutionIsThatOfTheKeyWithTwentyStepsInAContact) {
  double worst = 0.0;
  for (const auto& [stiffness, exponent] : {std::pair(1e4, 1.0), std::pair(1e6, 1.5)})
    for (const double e : {0.3, 0.5, 0.7, 0.9}) {
      const Contact contact{stiffness, exponent, e};
      const double lasts = contact.duration();
      const Model model = model_of(buffered(contact.keys()));
      for (const Coordinates c : both_coordinates) {
        Simulation s(model, {.step = lasts / 20.0, .coordinates = c});
        while (s.time() < 0.025 + 1.5 * lasts) ASSERT_TRUE(s.step()) << s.failure();
        EXPECT_EQ(s.output("f"), 0.0);
        EXPECT_NEAR(s.output("v"), 2.0 * e, 0.01 * 2.0 * e) << contact.keys();
        worst = std::max(worst, std::abs(s.output("v") / (2.0 * e) - 1.0));
      }
    }
  figure("error of the restitution with 20 steps in a contact", worst);
}

TEST(JointStops, FewerStepsInAContactAreWarned) {
  const Contact contact{1e4, 1.0, 0.6};
  const Model model = model_of(buffered(contact.keys()));
  for (const Coordinates c : both_coordinates)
    for (const double steps : {6.0, 25.0}) {
      const double h = contact.duration() / steps;
      const RunResult r = completed_run(model, with(model.simulation, c, h, 200.0 * h));
      const auto is_contact = [](const RangeWarning& w) { return w.limit == RangeLimit::contact; };
      EXPECT_EQ(std::ranges::count_if(r.summary.warnings, is_contact), steps < 20.0 ? 1 : 0);
    }
}

// With the keys of an element in `forces` the same bits.
TEST(JointStops, AreTheElement) {
  const std::string keys = "lower: 0, stiffness: 1e4, restitution: 0.6";
  std::string text = buffered(keys);
  const std::string own = ",\n         stops: {" + keys + "}";
  text.replace(text.find(own), own.size(), "");
  text.replace(text.find("fall.stops"), 10, "stop");
  text.insert(text.find("outputs:"),
              "forces: {stop: {type: joint_stop, joint: fall, " + keys + "}}\n");
  for (const Coordinates c : both_coordinates) {
    const Model by_key = model_of(buffered(keys)), by_element = model_of(text);
    const RunResult a = completed_run(by_key, with(by_key.simulation, c)),
                    b = completed_run(by_element, with(by_element.simulation, c));
    EXPECT_TRUE(equal_bits(a.table.data, b.table.data));
  }
}

// A ball on a plate, with e = 1, in a field of 1e5 m/s2, so that a flight lasts about as long as a
// contact. With w^2 = k / m it comes back with the speed v of its touch after the contact
// (2 / w) (pi - atan(v w / g)) and the flight 2 v / g. 200 steps in pi / w: of the trapezoidal rule
// the contact is longer by (w h)^2 / 12, 2e-10 s; short ends of steps at touches raise v by 2e-5.
TEST(JointStops, ThousandImpactsComeAtTheirInstants) {
  const double g = 1e5, v = 1.0, w = std::numbers::pi / 1e-5, h = 1e-5 / 200.0;
  const std::string text = R"(
gravity: [0, 0, -1.0e5]
bodies: {ball: {position: [0, 0, 0], rigid: {mass: 0.5, inertia: [0.01, 0.01, 0.01]}}}
joints:
  fall: {type: prismatic, child: ball, at: [0, 0, 0], axis: z, position: 5.0e-6,
         stops: {lower: 0, stiffness: )" +
                           std::to_string(0.5 * w * w) + R"(}}
outputs: {z: {joint_position: fall}, v: {joint_velocity: fall}}
simulation: {step: 1.0e-7, duration: 1, tolerance: 1.0e-14, locate_edges: true}
)";
  const Model model = model_of(text);
  const double period = 2.0 * v / g + 2.0 / w * (std::numbers::pi - std::atan(v * w / g));
  for (const Coordinates c : both_coordinates) {
    Simulation s(model, {.step = h, .coordinates = c});
    double worst = 0.0;
    bool flies = false;
    for (int k = 0; k < 1000;) {
      ASSERT_TRUE(s.step()) << s.failure();
      const double z = s.output("z"), up = s.output("v");
      if (std::exchange(flies, z > 0.0) || z <= 0.0) continue;
      // The touch at the end of this flight.
      const double touch = s.time() + (up + std::sqrt(up * up + 2.0 * g * z)) / g;
      const double error = std::abs(touch - (v / g + k * period));
      ++k;
      worst = std::max(worst, error / k);
    }
    EXPECT_LT(worst, 1e-9) << name_of(c);
    figure("error of the instants of impacts, each, " + name_of(c), worst);
  }
}

// A puck between two stops: each takes its part of the speed.
TEST(JointStops, ActOnBothSides) {
  const Model model = model_of(buffered("lower: 0, upper: 0.1, stiffness: 1e5, restitution: 0.5"));
  for (const Coordinates c : both_coordinates) {
    Simulation s(model, {.step = 2e-5, .coordinates = c});
    double last = -2.0;
    std::vector<double> speeds{2.0};
    while (speeds.size() < 4) {
      ASSERT_TRUE(s.step()) << s.failure();
      const double f = s.output("f"), v = s.output("v");
      if (f != 0.0 || (v > 0.0) == (last > 0.0)) continue;
      speeds.push_back(std::abs(v));
      last = v;
    }
    for (std::size_t k = 1; k < speeds.size(); ++k)
      EXPECT_NEAR(speeds[k] / speeds[k - 1], 0.5, 2e-3) << k;
  }
}

/// An arm that gravity turns about y, with the angle raised by it.
std::string falling_arm(const std::string& joint) {
  return R"(
bodies: {arm: {position: [0, 0, 0], rigid: {mass: 2, centre_of_mass: [0.5, 0, 0],
  inertia: [0.05, 0.05, 0.05]}}}
joints: {pin: {child: arm, at: [0, 0, 0], )" +
         joint + R"(}}
outputs: {x: {position: {body: arm, at: [1, 0, 0]}, axis: x},
          z: {position: {body: arm, at: [1, 0, 0]}, axis: z}}
simulation: {step: 1.0e-3, duration: 6, spectral_radius: 0.8}
)";
}

// It comes to rest where the stop carries its weight: k (q - 0.3) = m g L cos q.
TEST(JointStops, HoldEveryAngle) {
  double rest = 0.3;
  for (int k = 0; k < 50; ++k) rest = 0.3 + 2.0 * 9.81 * 0.5 * std::cos(rest) / 2000.0;
  const std::string stop = "{upper: 0.3, stiffness: 2000, restitution: 0.3, least_speed: 0.2}";
  for (const std::string& joint :
       {"type: revolute, axis: y, stops: " + stop,
        "type: cylindrical, axis: y, stops: {angle: " + stop + "}",
        "type: universal, axis: y, axis_2: z, stops: {angle about axis: " + stop + "}",
        "type: universal, axis: x, axis_2: y, stops: {angle about axis_2: " + stop + "}"}) {
    const Model model = model_of(falling_arm(joint));
    for (const Coordinates c : both_coordinates) {
      const RunResult r = completed_run(model, with(model.simulation, c));
      const auto row = r.table.data.end() - 3;
      EXPECT_NEAR(row[1], std::cos(rest), 1e-5) << joint;
      EXPECT_NEAR(row[2], -std::sin(rest), 1e-5) << joint;
    }
  }
}

/// A box that gravity pulls along x.
std::string falling_box(const std::string& joint) {
  return R"(
gravity: [9.81, 0, 0]
bodies: {box: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.05, 0.05, 0.05]}}}
joints: {pin: {child: box, at: [0, 0, 0], )" +
         joint + R"(}}
outputs: {x: {position: {body: box, at: [0, 0, 0]}, axis: x}}
simulation: {step: 1.0e-3, duration: 4, spectral_radius: 0.8}
)";
}

TEST(JointStops, HoldEveryDisplacement) {
  const std::string stop = "stiffness: 20000, restitution: 0.3, least_speed: 0.2}";
  for (const std::string& joint :
       {"type: cylindrical, axis: x, stops: {displacement: {upper: 0.2, " + stop + "}",
        "type: planar, axis: z, axis_2: x, stops: {first displacement: {upper: 0.2, " + stop + "}",
        "type: planar, axis: z, axis_2: y, stops: {second displacement: {lower: -0.2, " + stop +
            "}",
        "type: free, stops: {displacement x: {upper: 0.2, " + stop + "}"}) {
    const Model model = model_of(falling_box(joint));
    for (const Coordinates c : both_coordinates) {
      const RunResult r = completed_run(model, with(model.simulation, c));
      EXPECT_NEAR(r.table.data.back(), 0.2 + 2.0 * 9.81 / 20000.0, 1e-6) << joint;
    }
  }
}

// Coordinates whose sign changes in a mirror image have the stops of the other side.
TEST(JointStops, AreMirrored) {
  const TemporaryFolder folder;
  folder.write("half.yaml", R"(floatframe: 1
bodies: {pin: {position: [0.1, 0.2, 0.3], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}}
joints:
  hole: {type: cylindrical, child: pin, at: [0.1, 0.2, 0.3], axis: [1, 2, 0.5],
    stops: {displacement: {lower: -0.1, upper: 0.3, stiffness: 1e4},
            angle: {upper: 0.7, stiffness: 50}},
    friction: {angle: {breakaway: 0.2, stiffness: 100}}}
)");
  const ModelDescription d = read_model(folder.write("both.yaml", R"(floatframe: 1
subsystems: {left: {file: half.yaml}, right: {file: half.yaml, mirror: [{normal: y, at: 0}]}}
outputs: {f: {force: right.hole.angle.stops}, b: {force: left.hole.angle.friction}}
simulation: {step: 0.001, duration: 0.1}
)"));
  ASSERT_EQ(d.forces.size(), 6u);
  int changed = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto* stop = std::get_if<JointStop>(&d.forces[k].kind);
    const std::string& name = d.forces[k].name;
    if (!stop) continue;
    const bool along = stop->coordinate == 0;
    const double from = stop->lower.value_or(-1.0), to = stop->upper.value_or(-1.0);
    const double given[] = {along ? -0.1 : -1.0, along ? 0.3 : 0.7};
    const bool same = from == given[0] && to == given[1],
               other = along ? from == -0.3 && to == 0.1 : from == -0.7 && to == -1.0;
    EXPECT_TRUE(same || other) << name;
    EXPECT_TRUE(name.starts_with("right.") || same) << name;
    changed += other;
  }
  EXPECT_EQ(changed, 1);
}

}  // namespace
}  // namespace floatframe::test
