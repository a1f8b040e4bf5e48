// Every field of joints, rods and outputs, one change at a time.
#include <gtest/gtest.h>

#include "floatframe/core/number_rule.hpp"
#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

TEST(Validate, Joints) {
  check({
      {[](D& d) {
         d.joints[1].name = "slide";
         d.outputs.clear();
       },
       "joints.slide: the name is taken, expected a name used once"},
      {[](D& d) { d.joints[1].type = static_cast<JointType>(99); },
       "joints.pin.type: found 99, expected " + alternatives(joint_words)},
      {[](D& d) { d.joints[1].parent.body = "blok"; },
       "joints.pin.parent: unknown body 'blok', did you mean 'block'?"},
      {[](D& d) { d.joints[1].child.body = "x"; }, "joints.pin.child: unknown body 'x'"},
      {[](D& d) { d.joints[1].child.body = "ground"; },
       "joints.pin.child: found ground, expected a body (the ground may be the parent)"},
      {[](D& d) { d.joints[1].parent.body = "arm"; },
       "joints.pin.child: found the same body as the parent, expected another"},
      {[](D& d) { d.joints[1].parent.point.x() = nan; },
       "joints.pin.at[1]: found nan, expected a number [m] (numbers must be finite)"},
      {[](D& d) { d.joints[1].axis.setZero(); },
       "joints.pin.axis: found a vector of length zero, expected a direction"},
      {[](D& d) { d.joints[1].axis.y() = inf; },
       "joints.pin.axis[2]: found inf, expected a number (numbers must be finite)"},
      {[](D& d) { d.joints[1].axis_2 = -2.0 * d.joints[1].axis; },
       "joints.pin.axis_2: found a direction parallel to 'axis', expected another"},
      {[](D& d) { d.joints[1].position = {1.0}; },
       "joints.pin.position: found a list of 1, expected a list of 2 numbers for a universal "
       "joint"},
      {[](D& d) {
         d.joints[1].velocity = {1.0, nan};
       },
       "joints.pin.velocity[2]: found nan, expected a number (numbers must be finite)"},
      {[](D& d) { d.joints[0].position = {1.0}; },
       "joints.slide.position: found with a prescribed motion, which decides it; remove this key"},
      {[](D& d) {
         d.joints[0].motion.reset();
         d.joints[0].velocity = {1.0, 2.0};
       },
       "joints.slide.velocity: found a list of 2, expected a number"},
      {[](D& d) { d.joints[1].motion.emplace(); },
       "joints.pin.motion: is not used by a universal joint; remove this key"},
      {[](D& d) { d.joints[0].motion->amplitude = 1.0; },
       "joints.slide.motion.sine.frequency: found 0, expected a positive number [Hz]"},
      {[](D& d) { d.joints[0].motion->phase = nan; },
       "joints.slide.motion.sine.phase: found nan, expected a number [rad] (numbers must be "
       "finite)"},
      {[](D& d) {
         d.joints[0].motion->pieces = PiecewisePolynomial::polynomial({0.0, nan});
       },
       "joints.slide.motion.polynomial[2]: found nan, expected a number (numbers must be finite)"},
      {[](D& d) {
         d.joints[1].type = JointType::weld;
         d.outputs.clear();
       },
       "joints.pin.position: a weld has no coordinates; remove this key"},
      {[](D& d) { d.joints[2].keep = true; },
       "joints.ball.keep: found without 'position' and 'velocity', expected one of them to keep"},
      {[](D& d) { d.rods[0].length = 0.0; },
       "rods.rod.length: found 0, expected a positive number [m]"},
      {[](D& d) { d.rods[0].a.body = "block"; },
       "rods.rod: found both ends on 'block', expected two bodies"},
      {[](D& d) {
         d.rods[0].length.reset();
         d.rods[0].a.point = d.rods[0].b.point;
       },
       "rods.rod: found length 0, expected two points apart"},
      {[](D& d) { d.rods[0].a.body = "x"; }, "rods.rod.from.body: unknown body 'x'"},
      {[](D& d) { d.rods[0].a.node = "n0"; },
       "rods.rod.from.node: found a node on the ground, expected a flexible body"},
      // Nodes are known when the bodies are reduced; the sentences are those of model files.
      {[](D& d) { d.joints[2].child.node = "n9"; },
       "joints.ball.child_node: the flexible body 'part' has no node 'n9', did you mean 'n0'?"},
      {[](D& d) { d.rods[0].b.node = "n0"; },
       "rods.rod.to.node: found a node on the rigid body 'block', expected a flexible body"},
      {[](D& d) {
         d.bodies[2].rigid = true;
         d.amplitudes.clear();
         d.amplitude_rates.clear();
         d.outputs.clear();
         d.joints[2].child.node = "end";
       },
       "joints.ball.child_node: the body 'part' has no node 'end'"},
      {[](D& d) {
         d.joints[2].child.node.reset();
         d.joints[2].child.point = d.joints[2].parent.point = Vec3(0.4, 0, 0);
       },
       "joints.ball.at: found the point [0.4, 0, 0] on the flexible body 'part', expected one of "
       "its nodes; the nearest is at [0.5, 0, 0]"},
      {[](D& d) { kind<GuidedSpringDescription>(d, 1).tip.point.x() = 0.6; },
       "forces.guide.tip.at: found the point [0.6, 0, 0] on the flexible body 'part', expected one "
       "of its nodes; the nearest is at [0.5, 0, 0]"},
      {[](D& d) { kind<AppliedLoadDescription>(d, 4).at.node = "n0"; },
       "forces.load.node: found a node on the rigid body 'block', expected a flexible body"},
      {[](D& d) {
         d.outputs[0].at.body = "part";
         d.outputs[0].at.point = Vec3(0.7, 0, 0);
       },
       "outputs.z.position.at: found the point [0.7, 0, 0] on the flexible body 'part', expected "
       "one of its nodes; the nearest is at [0.5, 0, 0]"},
      {[](D& d) { d.rods[0].b.point.z() = nan; },
       "rods.rod.to.at[3]: found nan, expected a number [m] (numbers must be finite)"},
  });
}

// Squares of such components are zero.
TEST(Validate, AxesOfTinyNumbersAreDirections) {
  for (const Vec3& axis : {Vec3(1e-300, 1e-300, 0), Vec3(5e-324, 0, 0), Vec3(1e300, 0, -1e300)}) {
    ModelDescription d = valid_description();
    d.joints[0].axis = axis;
    const Model model = build_model(d);
    const std::size_t frame = model.joints[0].frame_F;
    const Vec3 z = model.markers[frame].X_NM.R.col(2);
    EXPECT_LT((z - (axis / axis.cwiseAbs().maxCoeff()).normalized()).norm(), 1e-15);
  }
}

const std::string long_name =
    "outputs." + std::string(201, 'n') + ": found a name of 201 characters, expected at most 200";

TEST(Validate, Outputs) {
  check({
      {[](D& d) { d.outputs[0].name = "a,b"; },
       "outputs.a,b: expected a column name without commas, quotes, brackets and control "
       "characters"},
      {[](D& d) { d.outputs[0].name = "a\tb"; },
       "outputs.a\\tb: expected a column name without commas, quotes, brackets and control "
       "characters"},
      {[](D& d) { d.outputs[0].name = std::string("a\0b", 3); },
       "outputs.a\\x00b: expected a column name without commas, quotes, brackets and control "
       "characters"},
      {[](D& d) { d.outputs[0].name = ""; },
       "outputs.: found an empty name, expected a column name"},
      {[](D& d) { d.outputs[0].name = std::string(201, 'n'); }, long_name},
      {[](D& d) { d.outputs[0].name = "time"; },
       "outputs: found the column 'time', the name of the first column, expected another"},
      {[](D& d) { d.outputs[1].name = "z"; }, "outputs: the column 'z' exists already"},
      {[](D& d) { d.outputs[0].type = static_cast<OutputType>(99); },
       "outputs.z: found 99, expected " + alternatives(output_words)},
      {[](D& d) { d.outputs[0].component = 7; }, "outputs.z.axis: found 7, expected x, y or z"},
      {[](D& d) { d.outputs[0].component = -1; }, "outputs.z.axis: found -1, expected x, y or z"},
      {[](D& d) { d.outputs[1].component = 3; },
       "outputs.yaw.angle: found 3, expected roll, pitch or yaw"},
      {[](D& d) { d.outputs[2].component = 2; },
       "outputs.q.component: found 2, expected the number of a coordinate (a whole number from 0 "
       "to 1)"},
      {[](D& d) { d.outputs[2].component = std::numeric_limits<int>::max(); },
       "outputs.q.component: found 2147483647, expected the number of a coordinate (a whole "
       "number from 0 to 1)"},
      {[](D& d) { d.outputs[3].component = 7; },
       "outputs.y1.component: found 7, expected the number of a mode (a whole number from 0 to "
       "0)"},
      {[](D& d) { d.outputs[0].at.body = "x"; }, "outputs.z.position.body: unknown body 'x'"},
      {[](D& d) { d.outputs[0].at.point.x() = nan; },
       "outputs.z.position.at[1]: found nan, expected a number [m] (numbers must be finite)"},
      {[](D& d) { d.outputs[1].at.body = "ground"; },
       "outputs.yaw.rotation: found ground, expected a body"},
      {[](D& d) { d.outputs[2].entity = "pins"; },
       "outputs.q.joint_position: unknown joint 'pins', did you mean 'pin'?"},
      {[](D& d) { d.outputs[4].entity = "lod"; },
       "outputs.F.force: unknown force 'lod', did you mean 'load'?"},
      {[](D& d) { d.outputs[5].entity = "load"; },
       "outputs.L.length: a force has no length, expected another force element"},
      {[](D& d) {
         d.outputs[0].type = OutputType::distance;
         d.outputs[0].to.body = "blok";
       },
       "outputs.z.distance.to.body: unknown body 'blok', did you mean 'block'?"},
      {[](D& d) {
         d.outputs[0].type = OutputType::distance;
         d.outputs[0].to.body = "arm";
         d.outputs[0].to.node = "none";
       },
       "outputs.z.distance.to.node: the flexible body 'arm' has no node 'none'"},
  });
}

}  // namespace
}  // namespace floatframe
