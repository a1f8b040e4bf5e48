// Every field of joints, rods and outputs, one change at a time.
#include <gtest/gtest.h>

#include "floatframe/core/number_rule.hpp"
#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

Rod& rod(ModelDescription& d) { return std::get<Rod>(d.rods[0].kind); }

TEST(Validate, Joints) {
  check({
      {[](D& d) {
         d.joints[1].name = "slide";
         d.outputs.clear();
       },
       "joints.slide: duplicate"},
      {[](D& d) { d.joints[1].type = static_cast<JointType>(99); }, "joints.pin.type: wrong_value"},
      {[](D& d) { d.joints[1].parent.body = "blok"; }, "joints.pin.parent: not_found"},
      {[](D& d) { d.joints[1].child.body = "x"; }, "joints.pin.child: not_found"},
      {[](D& d) { d.joints[1].child.body = "ground"; }, "joints.pin.child: wrong_value"},
      {[](D& d) { d.joints[1].parent.body = "arm"; }, "joints.pin.child: wrong_value"},
      {[](D& d) { d.joints[1].parent.point.x() = nan; }, "joints.pin.at[1]: out_of_range"},
      {[](D& d) { d.joints[1].axis.setZero(); }, "joints.pin.axis: out_of_range"},
      {[](D& d) { d.joints[1].axis.y() = inf; }, "joints.pin.axis[2]: out_of_range"},
      {[](D& d) { d.joints[1].axis_2 = -2.0 * d.joints[1].axis; }, "joints.pin.axis_2: geometry"},
      {[](D& d) { d.joints[1].position = {1.0}; }, "joints.pin.position: wrong_count"},
      {[](D& d) {
         d.joints[1].velocity = {1.0, nan};
       },
       "joints.pin.velocity[2]: out_of_range"},
      {[](D& d) { d.joints[0].position = {1.0}; }, "joints.slide.position: exclusive"},
      {[](D& d) {
         d.joints[0].motion.reset();
         d.joints[0].velocity = {1.0, 2.0};
       },
       "joints.slide.velocity: wrong_count"},
      {[](D& d) { d.joints[1].motion.emplace(); }, "joints.pin.motion: wrong_value"},
      {[](D& d) { d.joints[0].motion->sines = {{.amplitude = 1.0}}; },
       "joints.slide.motion.sine.frequency: out_of_range"},
      {[](D& d) { d.joints[0].motion->sines = {{.phase = nan}}; },
       "joints.slide.motion.sine.phase: out_of_range"},
      {[](D& d) {
         d.joints[0].motion->pieces = PiecewisePolynomial::polynomial({0.0, nan});
       },
       "joints.slide.motion.polynomial[2]: out_of_range"},
      {[](D& d) {
         d.joints[1].type = JointType::weld;
         d.outputs.clear();
       },
       "joints.pin.position: wrong_value"},
      {[](D& d) { d.joints[2].keep = true; }, "joints.ball.keep: incomplete"},
      {[](D& d) { rod(d).length = 0.0; }, "rods.rod.length: out_of_range"},
      {[](D& d) { rod(d).a.body = "block"; }, "rods.rod: geometry"},
      {[](D& d) { d.rods.push_back(d.forces[0]); }, "rods.spring.type: wrong_value"},
      {[](D& d) { d.forces.push_back(d.rods[0]); }, "forces.rod.type: wrong_value"},
      {[](D& d) {
         rod(d).length.reset();
         rod(d).a.point = rod(d).b.point;
       },
       "rods.rod: geometry"},
      {[](D& d) { rod(d).a.body = "x"; }, "rods.rod.from.body: not_found"},
      {[](D& d) { rod(d).a.node = "n0"; }, "rods.rod.from.node: incomplete"},
      // Nodes are known when the bodies are reduced; the errors are those of model files.
      {[](D& d) { d.joints[2].child.node = "n9"; }, "not_found"},
      {[](D& d) { rod(d).b.node = "n0"; }, "not_found"},
      {[](D& d) {
         d.bodies[2].rigid = true;
         d.amplitudes.clear();
         d.amplitude_rates.clear();
         d.outputs.clear();
         d.joints[2].child.node = "end";
       },
       "not_found"},
      {[](D& d) {
         d.joints[2].child.node.reset();
         d.joints[2].child.point = d.joints[2].parent.point = Vec3(0.4, 0, 0);
       },
       "not_found"},
      {[](D& d) { kind<GuidedSpring>(d, 1).tip.point.x() = 0.6; }, "not_found"},
      {[](D& d) { kind<AppliedForce>(d, 4).at.node = "n0"; }, "not_found"},
      {[](D& d) {
         d.outputs[0].at.body = "part";
         d.outputs[0].at.point = Vec3(0.7, 0, 0);
       },
       "not_found"},
      {[](D& d) { rod(d).b.point.z() = nan; }, "rods.rod.to.at[3]: out_of_range"},
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

const std::string long_name = "outputs." + std::string(201, 'n') + ": wrong_value";

TEST(Validate, Outputs) {
  check({
      {[](D& d) { d.outputs[0].name = "a,b"; }, "outputs.a,b: wrong_value"},
      {[](D& d) { d.outputs[0].name = "a\tb"; }, "outputs.a\\tb: wrong_value"},
      {[](D& d) { d.outputs[0].name = std::string("a\0b", 3); }, "outputs.a\\x00b: wrong_value"},
      {[](D& d) { d.outputs[0].name = ""; }, "outputs.: wrong_value"},
      {[](D& d) { d.outputs[0].name = std::string(201, 'n'); }, long_name},
      {[](D& d) { d.outputs[0].name = "time"; }, "duplicate"},
      {[](D& d) { d.outputs[1].name = "z"; }, "duplicate"},
      {[](D& d) { d.outputs[0].type = static_cast<OutputType>(99); }, "outputs.z: wrong_value"},
      {[](D& d) { d.outputs[0].component = 7; }, "outputs.z.axis: wrong_value"},
      {[](D& d) { d.outputs[0].component = -1; }, "outputs.z.axis: wrong_value"},
      {[](D& d) { d.outputs[1].component = 3; }, "outputs.yaw.angle: wrong_value"},
      {[](D& d) { d.outputs[2].component = 2; }, "outputs.q.component: out_of_range"},
      {[](D& d) { d.outputs[2].component = std::numeric_limits<int>::max(); },
       "outputs.q.component: out_of_range"},
      {[](D& d) { d.outputs[3].component = 7; }, "out_of_range"},
      {[](D& d) { d.outputs[0].at.body = "x"; }, "outputs.z.position.body: not_found"},
      {[](D& d) { d.outputs[0].at.point.x() = nan; }, "outputs.z.position.at[1]: out_of_range"},
      {[](D& d) { d.outputs[1].at.body = "ground"; }, "outputs.yaw.rotation: wrong_value"},
      {[](D& d) { d.outputs[0].relative.emplace().body = "x"; },
       "outputs.z.relative_to: not_found"},
      {[](D& d) { d.outputs[0].axes.emplace().body = "x"; }, "outputs.z.in: not_found"},
      {[](D& d) {
         d.outputs[0].axes.emplace().place = true;
         d.outputs[0].axes->body = "x";
       },
       "outputs.z.in.body: not_found"},
      {[](D& d) { d.outputs[2].relative.emplace(); }, "outputs.q.relative_to: wrong_value"},
      {[](D& d) { d.outputs[2].axes.emplace(); }, "outputs.q.in: wrong_value"},
      {[](D& d) { d.outputs[0].unit = "deg"; }, "wrong_value"},
      {[](D& d) { d.outputs[0].about = true; }, "outputs.z.about: incomplete"},
      {[](D& d) { d.measures = {d.outputs[0]}; }, "duplicate"},
      {[](D& d) {
         d.measures = {d.outputs[0]};
         d.measures[0].name = "m";
         d.measures[0].at.body = "x";
       },
       "measures.m.position.body: not_found"},
      {[](D& d) { d.outputs[4].type = OutputType::state; }, "wrong_value"},
      {[](D& d) { d.outputs[2].entity = "pins"; }, "outputs.q.joint_position: not_found"},
      {[](D& d) { d.outputs[4].entity = "lod"; }, "outputs.F.force: not_found"},
      {[](D& d) { d.outputs[5].entity = "load"; }, "outputs.L.length: wrong_value"},
      {[](D& d) {
         d.outputs[0].type = OutputType::distance;
         d.outputs[0].to.body = "blok";
       },
       "outputs.z.distance.to.body: not_found"},
      {[](D& d) {
         d.outputs[0].type = OutputType::distance;
         d.outputs[0].to.body = "arm";
         d.outputs[0].to.node = "none";
       },
       "not_found"},
  });
}

}  // namespace
}  // namespace floatframe
