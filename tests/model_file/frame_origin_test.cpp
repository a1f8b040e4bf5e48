// Markers at the origin of the frame of a flexible body that no node sits on: they belong to the
// floating frame itself, in both formulations and for every quantity. A free joint that names a
// node leaves it where it is drawn.
#include <gtest/gtest.h>

#include "floatframe/formats/body_file/body_file.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/completed_run.hpp"
#include "support/descriptions.hpp"
#include "support/fe_parts.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

/// A connecting rod in mean axes, whose only node with a name is its small end; the origin of its
/// frame is in the middle of the other bore.
const ReducedPart& rod() {
  static const ReducedPart part = [] {
    PartOptions options;
    options.interfaces = {test::bore("SMALL_END", Vec3(0.14, 0.0, 0.0))};
    options.interfaces[0].name = "END";
    options.modes = 4;
    options.reference.kind = BodyReference::Kind::mean_axis;
    options.check_free_modes = options.stresses = false;
    return reduce_part(test::steel_part("conrod_coarse_mesh.inp.gz", "mm-t-s"), options);
  }();
  return part;
}

class FrameOrigin : public testing::Test {
 protected:
  ModelDescription read(const std::string& text) {
    return read_model(folder_.write("model.yaml", "floatframe: 1\n" + text));
  }
  static ResultTable go(const ModelDescription& d, Coordinates coordinates) {
    const SimulationDescription options = test::with(d.simulation, coordinates);
    return test::completed_run(build_model(d), options).table;
  }
  /// Column 0 is the time.
  static Vec3 vec(const ResultTable& t, std::size_t row, std::size_t column) {
    return {t.at(row, column), t.at(row, column + 1), t.at(row, column + 2)};
  }
  static Mat3 rotation(const Vec3& angles) {
    return rotation_exp(angles.z() * Vec3::UnitZ()) * rotation_exp(angles.y() * Vec3::UnitY()) *
           rotation_exp(angles.x() * Vec3::UnitX());
  }

  test::TemporaryFolder folder_;
};

TEST_F(FrameOrigin, AllQuantitiesInBothFormulations) {
  BodyFile file;
  file.part = rod();
  write_body_file(folder_ / "rod.ffb", file);
  // It swings about its small end, knocked so that it bends.
  const ModelDescription d = read(
      "bodies: {rod: {part: rod.ffb, position: [0.1, 0.2, 0.3], orientation: [0.2, -0.1, 0.4]}}\n"
      "joints: {eye: {type: spherical, child: rod, child_node: END, velocity: [3, 20, -8]}}\n"
      "forces:\n"
      "  push: {type: force, body: rod, direction: [0.3, 1, 0.2], magnitude: 40}\n"
      "initial:\n  amplitudes: {rod: [1e-5, 0, 2e-6, 0]}\n"
      "outputs:\n"
      "  p: {position: rod}\n"
      "  v: {velocity: {body: rod}}\n"
      "  a: {acceleration: rod}\n"
      "  angles: {rotation: rod}\n"
      "  w: {angular_velocity: rod}\n"
      "  end: {position: {body: rod, node: END}}\n"
      "  y1: {modal_amplitude: rod, mode: 1}\n"
      "  y2: {modal_amplitude: rod, mode: 2}\n"
      "  y3: {modal_amplitude: rod, mode: 3}\n"
      "  y4: {modal_amplitude: rod, mode: 4}\n"
      "simulation: {step: 2e-5, duration: 0.004}\n");
  const Model model = build_model(d);
  ASSERT_EQ(model.bodies[0].modes(), 4);
  ASSERT_EQ(model.bodies[0].data->nodes[0].name, "END");
  ASSERT_GT(model.bodies[0].data->nodes[0].X.norm(), 0.1);  // the node moves in the frame
  const ResultTable absolute = go(d, Coordinates::absolute),
                    relative = go(d, Coordinates::relative);
  ASSERT_EQ(absolute.rows(), 201u);
  ASSERT_EQ(relative.rows(), 201u);
  const Body& body = model.bodies[0];
  const ModalNode& node = body.data->nodes[0];
  for (const ResultTable* t : {&absolute, &relative}) {
    EXPECT_LT((vec(*t, 0, 1) - Vec3(0.1, 0.2, 0.3)).norm(), 1e-4);
    const double h = t->at(1, 0) - t->at(0, 0);
    for (std::size_t row = 1; row + 1 < t->rows(); ++row) {
      // From the position of the node, the rotation and the amplitudes.
      VecX y(4);
      for (int k = 0; k < 4; ++k) y[k] = t->at(row, 19 + static_cast<std::size_t>(k));
      const Mat3 R = rotation(vec(*t, row, 10)) * body.X_WB.R;
      const Vec3 in_body = node.p + node.X * y;
      EXPECT_LT((vec(*t, row, 1) + R * in_body - vec(*t, row, 16)).norm(), 1e-13) << row;
      // Rates against differences of the positions.
      const Vec3 v = (vec(*t, row + 1, 1) - vec(*t, row - 1, 1)) / (2 * h);
      EXPECT_LT((v - vec(*t, row, 4)).norm(), 1e-4 * (1 + v.norm())) << row;
      const Mat3 R_next = rotation(vec(*t, row + 1, 10)), R_last = rotation(vec(*t, row - 1, 10));
      const Vec3 w =
          quaternion_log(Eigen::Quaterniond(Mat3(R_next * R_last.transpose()))) / (2 * h);
      EXPECT_LT((w - vec(*t, row, 13)).norm(), 2e-3 * (1 + w.norm())) << row;
    }
    // Averaged over the record the acceleration is the change of the velocity (trapezoidal rule).
    Vec3 change = Vec3::Zero();
    for (std::size_t row = 0; row + 1 < t->rows(); ++row)
      change += 0.5 * h * (vec(*t, row, 7) + vec(*t, row + 1, 7));
    const Vec3 expected = vec(*t, t->rows() - 1, 4) - vec(*t, 0, 4);
    EXPECT_LT((change - expected).norm(), 1e-3 * expected.norm());
  }
  for (std::size_t row = 0; row < 201; ++row) {
    EXPECT_LT((vec(absolute, row, 1) - vec(relative, row, 1)).norm(), 1e-6) << row;
    EXPECT_LT((vec(absolute, row, 4) - vec(relative, row, 4)).norm(), 1e-2) << row;
    EXPECT_LT((vec(absolute, row, 10) - vec(relative, row, 10)).norm(), 1e-5) << row;
  }
}

TEST_F(FrameOrigin, InDescriptionsOfPrograms) {
  ModelDescription d;
  d.bodies = {test::make_body("rod", rod().body, {1, 2, 3})};
  for (const OutputType type :
       {OutputType::position, OutputType::velocity, OutputType::acceleration})
    for (int k = 0; k < 3; ++k) {
      const std::string name = std::to_string(static_cast<int>(type)) + std::to_string(k);
      d.outputs.push_back(test::make_output(name, test::place_on("rod", {1, 2, 3}), k, type));
    }
  d.simulation.duration = 0.0;
  for (const Coordinates c : {Coordinates::absolute, Coordinates::relative}) {
    const ResultTable t = go(d, c);
    EXPECT_LT((vec(t, 0, 1) - Vec3(1, 2, 3)).norm(), 1e-14);
    EXPECT_LT(vec(t, 0, 4).norm(), 1e-14);
    EXPECT_LT((vec(t, 0, 7) - Vec3(0, 0, -9.81)).norm(), 1e-9);
  }
  // Any other place on it must be a node.
  d.outputs[0].at.point = Vec3(1.001, 2, 3);
  EXPECT_THROW(build_model(d), InputError);
}

const char* const bar =
    "points: {a: [1, 0, 0], b: [2, 0, 0], m: [1.5, 0, 0.3]}\n"
    "parameters: {place: a}\n"
    "bodies:\n"
    "  bar:\n"
    "    position: ${place}\n"
    "    flexible:\n"
    "      material: {young: 2e11, poisson: 0.3, density: 7800}\n"
    "      bars: {one: {from: a, to: b, elements: 4, section: {round: 0.02}}}\n"
    "      clamped: [a]\n"
    "      mass_model: hermite\n"
    "      section_inertia: true\n"
    "      normal_modes: 2\n"
    "outputs: {a: {position: {body: bar, at: a}}, b: {position: {body: bar, at: b}}, "
    "frame: {position: bar}}\n"
    "simulation: {duration: 0}\n";

TEST_F(FrameOrigin, FreeJointAtANodeLeavesItWhereItIs) {
  const std::string joint = "joints: {fly: {type: free, child: bar, child_node: b}}\n";
  for (const Coordinates c : {Coordinates::absolute, Coordinates::relative}) {
    const ResultTable t = go(read(bar + joint), c);
    EXPECT_LT((vec(t, 0, 1) - Vec3(1, 0, 0)).norm(), 1e-12);
    EXPECT_LT((vec(t, 0, 4) - Vec3(2, 0, 0)).norm(), 1e-12);
  }
}

TEST_F(FrameOrigin, FreeJointFromANodeOfTheParent) {
  const std::string joint =
      "  ball: {rigid: {mass: 1, centre_of_mass: m, inertia: [1, 1, 1]}}\n"
      "joints:\n"
      "  root: {type: weld, child: bar, at: a}\n"
      "  fly: {type: free, parent: bar, parent_node: b, child: ball, position: [0.1, 0, 0, 0, 0, "
      "0]}\n";
  std::string text = bar;
  text.insert(text.find("outputs:"), joint);
  text.insert(text.find("outputs: {") + 10, "ball: {position: ball}, ");
  for (const Coordinates c : {Coordinates::absolute, Coordinates::relative}) {
    const ResultTable t = go(read(text), c);
    EXPECT_LT((vec(t, 0, 1) - Vec3(1.6, 0, 0.3)).norm(), 1e-12);  // 0.1 from where it is drawn
  }
}

TEST_F(FrameOrigin, FreeJointAndPlacesWithoutANode) {
  std::string text = bar;
  text.replace(text.find("place: a"), 8, "place: m");
  text +=
      "joints: {fly: {type: free, child: bar, position: [0.5, 0, 0, 0, 0, 0]}}\n"
      "forces: {s: {type: spring_damper, from: {body: ground, at: [0, 0, 0]}, to: {body: bar}, "
      "spring: 10}}\n";
  for (const Coordinates c : {Coordinates::absolute, Coordinates::relative}) {
    const ResultTable t = go(read(text), c);
    EXPECT_LT((vec(t, 0, 1) - Vec3(1.5, 0, 0)).norm(), 1e-12);
    EXPECT_LT((vec(t, 0, 4) - Vec3(2.5, 0, 0)).norm(), 1e-12);
    EXPECT_LT((vec(t, 0, 7) - Vec3(2.0, 0, 0.3)).norm(), 1e-12);
  }
  // A place that is written must still be a node.
  text.replace(text.find("to: {body: bar}"), 15, "to: {body: bar, at: m}");
  EXPECT_THROW(read(text), InputError);
}

}  // namespace
}  // namespace floatframe
