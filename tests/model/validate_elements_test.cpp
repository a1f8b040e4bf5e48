// Every field of forces, roads and inputs, one change at a time.
#include <gtest/gtest.h>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/model_hash.hpp"
#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

TEST(Validate, ForcesRoadsInputs) {
  check({
      {[](D& d) { d.forces[1].name = "spring"; }, "forces.spring: duplicate"},
      {[](D& d) { kind<SpringDamper>(d, 0).a.body = "block"; }, "forces.spring: geometry"},
      {[](D& d) { kind<SpringDamper>(d, 0).a.point = Vec3(0, 0, 1); },
       "forces.spring: out_of_range"},
      {[](D& d) { kind<SpringDamper>(d, 0).spring = two_pieces(nan, 1.0, 1.0); },
       "forces.spring.spring.piecewise[1].below: "
       "out_of_range\nforces.spring.spring.piecewise[2].about: out_of_range"},
      {[](D& d) { kind<SpringDamper>(d, 0).spring = two_pieces(1.0, 1.0, 2.0); },
       "forces.spring.spring.piecewise[1]: contradiction"},
      {[](D& d) {
         kind<SpringDamper>(d, 0).damper =
             PiecewisePolynomial({2.0, 1.0}, {{0.0, {0.0}}, {0.0, {0.0}}, {0.0, {0.0}}});
       },
       "forces.spring.damper.piecewise[2].below: out_of_range"},
      {[](D& d) {
         kind<SpringDamper>(d, 0).damper = PiecewisePolynomial({1.0}, {{0.0, {0.0}}});
       },
       "forces.spring.damper: wrong_count"},
      {[](D& d) { kind<SpringDamper>(d, 0).damper = PiecewisePolynomial::polynomial({}); },
       "forces.spring.damper.polynomial: wrong_count"},
      {[](D& d) { kind<SpringDamper>(d, 0).actuator->input = "pull"; },
       "forces.spring.actuator.input: not_found"},
      {[](D& d) { kind<GuidedSpring>(d, 1).axis.setZero(); }, "forces.guide.axis: out_of_range"},
      {[](D& d) { kind<GuidedSpring>(d, 1).tip.body = "block"; }, "forces.guide: geometry"},
      {[](D& d) { kind<JointSpring>(d, 2).joint = "slid"; }, "forces.motor.joint: not_found"},
      {[](D& d) { kind<JointSpring>(d, 2).joint = "ball"; }, "forces.motor.joint: wrong_value"},
      {[](D& d) { kind<JointSpring>(d, 2).spring = {}; }, "forces.motor.target: incomplete"},
      {[](D& d) {
         kind<JointSpring>(d, 2).spring = {};
         kind<JointSpring>(d, 2).target.reset();
       },
       "forces.motor: missing"},
      {[](D& d) { kind<GuidedSpring>(d, 1).damper = {}; }, "forces.guide: missing"},
      {[](D& d) { kind<Tyre>(d, 3).radius = 0.0; }, "forces.tyre.radius: out_of_range"},
      {[](D& d) { kind<Tyre>(d, 3).stiffness = -1.0; }, "forces.tyre.stiffness: out_of_range"},
      {[](D& d) { kind<Tyre>(d, 3).damping = nan; }, "forces.tyre.damping: out_of_range"},
      {[](D& d) { kind<Tyre>(d, 3).law = static_cast<TyreLaw>(9); },
       "forces.tyre.law: out_of_range"},
      {[](D& d) { kind<Tyre>(d, 3).axis.setZero(); }, "forces.tyre.axis: out_of_range"},
      {[](D& d) { kind<Tyre>(d, 3).road = "trak"; }, "forces.tyre.road: not_found"},
      {[](D& d) { kind<Tyre>(d, 3).centre.body = "ground"; }, "forces.tyre.body: wrong_value"},
      {[](D& d) { kind<AppliedForce>(d, 4).direction.setZero(); },
       "forces.load.direction: out_of_range"},
      {[](D& d) { kind<AppliedForce>(d, 4).magnitude.sines = {{.amplitude = inf}}; },
       "forces.load.magnitude.sine.amplitude: out_of_range\nforces.load.magnitude.sine.frequency: "
       "out_of_range"},
      {[](D& d) { d.roads[0].bumps[0].length = 0.0; }, "roads.track.bumps[1].length: out_of_range"},
      {[](D& d) { d.roads[0].bumps[0].height = nan; }, "roads.track.bumps[1].height: out_of_range"},
      {[](D& d) {
         d.roads[0].pieces =
             PiecewisePolynomial({2.0, 1.0}, {{0.0, {0.0}}, {0.0, {0.0}}, {0.0, {0.0}}});
       },
       "roads.track.profile.piecewise[2].below: out_of_range"},
      {[](D& d) { d.inputs[0].initial = nan; }, "inputs.push.initial: out_of_range"},
      {[](D& d) { d.inputs[0].initial = 2.0; }, "inputs.push.initial: out_of_range"},
      {[](D& d) { d.inputs[0].high = -1.0; }, "inputs.push.max: contradiction"},
      {[](D& d) { d.inputs[0].low = nan; }, "inputs.push.min: out_of_range"},
      {[](D& d) { d.inputs[0].unit = "N,m"; }, "inputs.push.unit: wrong_value"},
      {[](D& d) {
         d.inputs[0].clamp = true;
         d.inputs[0].low.reset();
         d.inputs[0].high.reset();
       },
       "inputs.push.clamp: out_of_range"},
  });
}

TEST(Validate, ForceLaws) {
  const auto with = [](const auto& change) {
    return [=](ModelDescription& d) {
      ForceLaw f;
      f.law = [](double x, double, double) { return x; };
      change(f);
      d.forces.push_back({"law", f, {}});
    };
  };
  const auto place = [](const char* body) {
    AttachmentDescription at;
    at.body = body;
    return at;
  };
  check({
      {with([&](ForceLaw& f) { f.joint = "ball"; }), "forces.law.joint: wrong_value"},
      {with([&](ForceLaw& f) { f.joint = "slid"; }), "forces.law.joint: not_found"},
      {with([&](ForceLaw&) {}), "forces.law: incomplete"},
      {with([&](ForceLaw& f) { f.a = place("block"); }), "forces.law: incomplete"},
      {with([&](ForceLaw& f) { f.a = f.b = place("block"); }), "forces.law: geometry"},
      {with([&](ForceLaw& f) {
         f.a = place("block");
         f.joint = "slide";
       }),
       "forces.law: incomplete"},
      {with([&](ForceLaw& f) {
         f.joint = "slide";
         f.law = ForceFunction::named("contact");
       }),
       "forces.law.law: unsupported"},
  });
}

// What keys say is what the struct holds, and the other way round.
TEST(Validate, KeysReflectTheStructs) {
  const ModelDescription structs = valid_description();
  ModelDescription keys = structs;
  for (ElementDescription& f : keys.forces) {
    ElementDescription copy{f.name, element_kind(f.type()).blank(), f.origin};
    for (const ElementKey& key : element_keys(f.type()))
      if (const auto value = key_value(f, key)) set_key_value(copy, key, *value);
    f = std::move(copy);
  }
  EXPECT_EQ(model_hash(build_model(keys)), model_hash(build_model(structs)));
  kind<Tyre>(keys, 3).radius += 0.1;
  EXPECT_NE(model_hash(build_model(keys)), model_hash(build_model(structs)));
}

}  // namespace
}  // namespace floatframe
