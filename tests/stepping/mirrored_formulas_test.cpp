// Controlled mechanisms and their mirror images: both move as mirror images, whatever formulas read
// of them.
#include <gtest/gtest.h>

#include "floatframe/model_file/load_model.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/contains.hpp"
#include "support/coordinates.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

/// A jib that slews and luffs, a screw in it, and a free stone, with a formula for each force.
const std::string controlled_jib = R"(floatframe: 1
bodies:
  tower: {rigid: {mass: 20, centre_of_mass: [0, 0.4, 1], inertia: [3, 3, 1]}}
  jib: {rigid: {mass: 5, centre_of_mass: [1, 0.5, 2], inertia: [0.1, 2, 2]}}
  screw: {rigid: {mass: 1, centre_of_mass: [2, 0.5, 2], inertia: [0.01, 0.02, 0.02]}}
  stone: {position: [3, 1, 1], rigid: {mass: 2, inertia: [0.1, 0.2, 0.25]}}
joints:
  slew: {type: revolute, child: tower, at: [0, 0.4, 0], axis: z, velocity: 0.3}
  luff: {type: revolute, parent: tower, child: jib, at: [0, 0.5, 2], axis: [0, 1, 0.2],
    position: 0.2}
  thread: {type: cylindrical, parent: jib, child: screw, at: [2, 0.5, 2], axis: x,
    velocity: [0.1, 2]}
  loose: {type: free, child: stone, velocity: [0.2, 0.5, 1, 2, -1, 0.5]}
measures:
  tip: {position: {body: jib, at: [2, 0.5, 2]}}
  pull: {joint_force: luff}
  twist: {joint_torque: luff}
  mass: {centre_of_mass: stone}
  spin: {angular_momentum: stone, about: {body: stone, at: [3, 1, 1]}}
  turn: {quaternion: stone}
forces:
  sideways: {type: force, body: jib, at: [2, 0.5, 2], direction: [0, 1, 0.3],
    magnitude: {formula: '-30 * (tip.y - 0.7) - 5 * velocity(jib, y) + 0.01 * pull.y
      + acceleration(stone, y)'}}
  slewing: {type: torque, body: tower, direction: [0.1, 0, 1],
    magnitude: {formula: '-9 * rotation(tower, yaw) - 4 * angular_velocity(jib, z)
      + 0.02 * twist.z + spin.x'}}
  luffing: {type: joint_spring, joint: luff,
    actuator: {formula: '60 - 80 * delay(angle(luff), 0.02) - 9 * rate(luff)
      + mass.y * angle(thread, 2)'}}
  blown: {type: force, body: stone, at: [3, 1, 1], direction: [1, 1, 0],
    magnitude: {formula: '-8 * angle(loose, 2) - angle(loose, 4) + 3 * turn.z - rate(thread, 2)'}}
)";

Model two_cranes(const TemporaryFolder& folder, const std::string& jib, const std::string& mirror) {
  folder.write("jib.yaml", jib);
  const auto outputs = [](const std::string& side) {
    std::string text;
    for (const char* body : {"jib", "screw", "stone"})
      text += "  " + side + "." + body + ": {position: {body: " + side + "." + body + "}}\n  " +
              side + "." + body + "_w: {angular_velocity: " + side + "." + body + "}\n";
    return text;
  };
  return load_model(folder.write("model.yaml", R"(floatframe: 1
subsystems:
  left: {file: jib.yaml, position: [0.3, 0.2, 0]}
  right: {file: jib.yaml, position: [0.3, 0.2, 0], mirror: )" +
                                                   mirror + R"(}
outputs:
)" + outputs("left") + outputs("right") + R"(
simulation: {step: 0.002, duration: 1}
)"));
}

void expect_images(const Model& model, const Vec3& P, const Vec3& t) {
  for (const Coordinates c : both_coordinates) {
    Simulation s(model, {.coordinates = c});
    const double det = P.prod();
    for (int k = 0; k < 250; ++k) {
      ASSERT_TRUE(s.step()) << s.failure();
      if (k % 50 != 49) continue;
      for (const char* body : {"jib", "screw", "stone"})
        for (int i = 0; i < 3; ++i) {
          const std::string axis = std::string(body) + "." + "xyz"[i],
                            spin = std::string(body) + "_w." + "xyz"[i];
          EXPECT_NEAR(s.output("right." + axis), P[i] * s.output("left." + axis) + t[i], 1e-8)
              << axis << " " << k;
          EXPECT_NEAR(s.output("right." + spin), det * P[i] * s.output("left." + spin), 1e-7)
              << spin << " " << k;
        }
    }
  }
}

TEST(MirroredFormulas, ControlTheMirrorImage) {
  const TemporaryFolder folder;
  const std::string& jib = controlled_jib;
  expect_images(two_cranes(folder, jib, "[{normal: y}]"), {1.0, -1.0, 1.0}, Vec3::Zero());
  expect_images(two_cranes(folder, jib, "[{normal: y, at: 0.35}]"), {1.0, -1.0, 1.0},
                {0.0, 0.7, 0.0});
  expect_images(two_cranes(folder, jib, "[{normal: x}, {normal: y, at: 3}]"), {-1.0, -1.0, 1.0},
                {0.0, 6.0, 0.0});
}

// About the origin of the world an angular momentum has no image in another plane.
TEST(MirroredFormulas, RefuseWhatDependsOnThePlane) {
  const TemporaryFolder folder;
  std::string jib = controlled_jib;
  const std::string about = ", about: {body: stone, at: [3, 1, 1]}";
  jib.erase(jib.find(about), about.size());
  expect_images(two_cranes(folder, jib, "[{normal: y}]"), {1.0, -1.0, 1.0}, Vec3::Zero());
  EXPECT_TRUE(
      contains(error_of([&] { two_cranes(folder, jib, "[{normal: y, at: 1}]"); }), "unsupported"));
}

}  // namespace
}  // namespace floatframe::test
