// Every field of forces, roads and inputs, one change at a time.
#include <gtest/gtest.h>

#include "floatframe/model/force_keys.hpp"
#include "floatframe/model/model_hash.hpp"
#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

ForceValues by_key(std::map<std::string, ForceValue> values) {
  return {ForceType::tyre, std::move(values)};
}

TEST(Validate, ForcesRoadsInputs) {
  check({
      {[](D& d) { d.forces[1].name = "spring"; }, "forces.spring: duplicate"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).a.body = "block"; },
       "forces.spring: geometry"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).a.point = Vec3(0, 0, 1); },
       "forces.spring: out_of_range"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).spring = two_pieces(nan, 1.0, 1.0); },
       "forces.spring.spring.piecewise[1].below: "
       "out_of_range\nforces.spring.spring.piecewise[2].about: out_of_range"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).spring = two_pieces(1.0, 1.0, 2.0); },
       "forces.spring.spring.piecewise[1]: contradiction"},
      {[](D& d) {
         kind<SpringDamperDescription>(d, 0).damper =
             PiecewisePolynomial({2.0, 1.0}, {{0.0, {0.0}}, {0.0, {0.0}}, {0.0, {0.0}}});
       },
       "forces.spring.damper.piecewise[2].below: out_of_range"},
      {[](D& d) {
         kind<SpringDamperDescription>(d, 0).damper = PiecewisePolynomial({1.0}, {{0.0, {0.0}}});
       },
       "forces.spring.damper: wrong_count"},
      {[](D& d) {
         kind<SpringDamperDescription>(d, 0).damper = PiecewisePolynomial::polynomial({});
       },
       "forces.spring.damper.polynomial: wrong_count"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).actuator->input = "pull"; },
       "forces.spring.actuator.input: not_found"},
      {[](D& d) { kind<GuidedSpringDescription>(d, 1).axis.setZero(); },
       "forces.guide.axis: out_of_range"},
      {[](D& d) { kind<GuidedSpringDescription>(d, 1).tip.body = "block"; },
       "forces.guide: geometry"},
      {[](D& d) { kind<JointSpringDescription>(d, 2).joint = "slid"; },
       "forces.motor.joint: not_found"},
      {[](D& d) { kind<JointSpringDescription>(d, 2).joint = "ball"; },
       "forces.motor.joint: wrong_value"},
      {[](D& d) { kind<JointSpringDescription>(d, 2).spring = {}; },
       "forces.motor.target: incomplete"},
      {[](D& d) {
         kind<JointSpringDescription>(d, 2).spring = {};
         kind<JointSpringDescription>(d, 2).target.reset();
       },
       "forces.motor: missing"},
      {[](D& d) { kind<GuidedSpringDescription>(d, 1).damper = {}; }, "forces.guide: missing"},
      {[](D& d) { kind<TyreDescription>(d, 3).radius = 0.0; }, "forces.tyre.radius: out_of_range"},
      {[](D& d) { kind<TyreDescription>(d, 3).stiffness = -1.0; },
       "forces.tyre.stiffness: out_of_range"},
      {[](D& d) { kind<TyreDescription>(d, 3).damping = nan; },
       "forces.tyre.damping: out_of_range"},
      {[](D& d) { kind<TyreDescription>(d, 3).law = static_cast<TyreLaw>(9); },
       "forces.tyre.law: out_of_range"},
      {[](D& d) { kind<TyreDescription>(d, 3).axis.setZero(); }, "forces.tyre.axis: out_of_range"},
      {[](D& d) { kind<TyreDescription>(d, 3).road = "trak"; }, "forces.tyre.road: not_found"},
      {[](D& d) { kind<TyreDescription>(d, 3).centre.body = "ground"; },
       "forces.tyre.body: wrong_value"},
      {[](D& d) { kind<AppliedLoadDescription>(d, 4).direction.setZero(); },
       "forces.load.direction: out_of_range"},
      {[](D& d) { kind<AppliedLoadDescription>(d, 4).magnitude.amplitude = inf; },
       "forces.load.magnitude.sine.amplitude: out_of_range\nforces.load.magnitude.sine.frequency: "
       "out_of_range"},
      // By the keys of model files.
      {[](D& d) {
         d.forces[0].kind = ForceValues{static_cast<ForceType>(99), {}};
       },
       "forces.spring.type: wrong_value"},
      {[](D& d) { d.forces[3].kind = by_key({}); },
       "forces.tyre: missing\nforces.tyre: missing\nforces.tyre: missing\nforces.tyre: missing"},
      {[](D& d) {
         d.forces[3].kind = by_key({{"radius", -1}, {"law", "radial"}, {"wide", 0.2}});
       },
       "forces.tyre: unknown_key\nforces.tyre: missing\nforces.tyre.radius: "
       "out_of_range\nforces.tyre: missing\nforces.tyre: missing"},
      {[](D& d) {
         d.forces[3].kind = by_key({{"body", AttachmentDescription{"block", Vec3(0, 0, 1), {}, {}}},
                                    {"radius", "0.3"},
                                    {"stiffness", 1e5},
                                    {"law", "round"},
                                    {"road", "track"}});
       },
       "forces.tyre.radius: wrong_value\nforces.tyre.law: out_of_range"},
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

// A struct and the same values by key give the same element.
TEST(Validate, ValuesByKeyAreThoseOfTheStructs) {
  const ModelDescription structs = valid_description();
  ModelDescription keys = structs;
  for (ForceDescription& f : keys.forces) {
    ForceValues values{f.type(), {}};
    for (const ForceKey& key : force_keys(f.type()))
      if (const auto value = force_value(f, key)) values.values[key.name] = *value;
    f.kind = std::move(values);
  }
  EXPECT_EQ(model_hash(build_model(keys)), model_hash(build_model(structs)));
  auto& tyre = std::get<ForceValues>(keys.forces[3].kind).values;
  tyre["law"] = "radial";
  tyre["radius"] = 1;
  const Model changed = build_model(keys);
  EXPECT_EQ(changed.forces[3].law, TyreLaw::radial);
  EXPECT_EQ(changed.forces[3].radius, 1.0);
}

}  // namespace
}  // namespace floatframe
