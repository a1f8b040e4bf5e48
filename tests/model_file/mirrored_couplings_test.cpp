// Couplings by name in mirrored subsystems: what they hold is the mirror image.
#include <gtest/gtest.h>

#include <numbers>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/start/statics.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

/// The factors of each coupling, in the order of the file.
std::vector<std::vector<double>> factors_of_couplings(const Model& model) {
  std::vector<std::vector<double>> all;
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    std::vector<ConstraintPart> parts;
    append_element_parts(model, static_cast<int>(k), parts);
    std::vector<double>& factors = all.emplace_back();
    for (const ConstraintPart& part : parts) factors.push_back(part.c);
  }
  return all;
}

// A mirror reverses the angle of a cylindrical joint and no other coordinate of these. A screw
// becomes one of the other hand; of gears the axes say it, whichever way they point.
TEST(MirroredCouplings, HoldTheMirrorImage) {
  const test::TemporaryFolder folder;
  folder.write("drive.yaml", R"(floatframe: 1
bodies:
  nut: {position: [0, 1, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  wheel: {position: [0, 1.5, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  box: {position: [0, 2, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  nut: {type: cylindrical, child: nut, at: [0, 1, 0], axis: z}
  wheel: {type: revolute, child: wheel, at: [0, 1.5, 0], axis: z}
  slide: {type: prismatic, child: box, at: [0, 2, 0], axis: y}
couplings:
  screw: {type: screw, joint: nut, lead: 0.02}
  gear: {type: gear, driver: wheel, driven: nut, ratio: 3}
  rack: {type: rack_and_pinion, rack: slide, pinion: nut, radius: 0.1}
  finger: {type: mimic, joint: {joint: nut, coordinate: angle}, follows: wheel, factor: 2}
)");
  const Model model = build_model(read_model(folder.write("model.yaml", R"(floatframe: 1
subsystems:
  left: {file: drive.yaml}
  right: {file: drive.yaml, mirror: [{normal: y}]}
)")));
  const auto factors = factors_of_couplings(model);
  ASSERT_EQ(factors.size(), 8u);
  const double slope = 0.02 / (2.0 * std::numbers::pi);
  using Factors = std::vector<double>;
  EXPECT_EQ(factors[0], (Factors{1.0, -slope}));
  EXPECT_EQ(factors[4], (Factors{1.0, slope}));
  EXPECT_EQ(factors[1], (Factors{1.0, 3.0}));
  EXPECT_EQ(factors[5], (Factors{1.0, -3.0}));
  EXPECT_EQ(factors[2], (Factors{1.0, -0.1}));
  EXPECT_EQ(factors[6], (Factors{1.0, 0.1}));
  EXPECT_EQ(factors[3], (Factors{1.0, -2.0}));
  EXPECT_EQ(factors[7], (Factors{-1.0, -2.0}));
}

// The force of the teeth is the mirror image: right-hand teeth become left-hand ones.
TEST(MirroredCouplings, ReverseTheHandOfTeeth) {
  const test::TemporaryFolder folder;
  folder.write("drive.yaml", R"(floatframe: 1
bodies:
  pinion: {position: [0, 1, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  wheel: {position: [0.2, 1.3, 0.1], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  pinion: {type: revolute, child: pinion, at: [0, 1, 0], axis: z}
  wheel: {type: revolute, child: wheel, at: [0.2, 1.3, 0.1], axis: z, motion: 0}
couplings:
  gear:
    {type: gear, driver: pinion, driven: wheel, ratio: 3, pressure_angle: 0.35, helix_angle: 0.2}
forces:
  motor: {type: torque, body: pinion, direction: z, magnitude: 6}
)");
  const StaticsResult s = statics(build_model(read_model(folder.write("model.yaml", R"(floatframe: 1
gravity: [0, 0, 0]
subsystems:
  left: {file: drive.yaml}
  right: {file: drive.yaml, mirror: [{normal: y}]}
simulation: {step: 1.0e-3, duration: 1}
)"))));
  ASSERT_EQ(s.joints.size(), 4u);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 &left = s.joints[k].force, &right = s.joints[k + 2].force;
    EXPECT_GT(left.cwiseAbs().minCoeff(), 1.0);
    EXPECT_LT((Vec3(left.x(), -left.y(), left.z()) - right).norm(), 1e-9 * left.norm());
  }
}

}  // namespace
}  // namespace floatframe
