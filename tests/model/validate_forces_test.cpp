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
      {[](D& d) { d.forces[1].name = "spring"; },
       "forces.spring: the name is taken, expected a name used once"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).a.body = "block"; },
       "forces.spring: found both ends on 'block', expected two bodies"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).a.point = Vec3(0, 0, 1); },
       "forces.spring: found both ends at the same point, expected two points apart"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).spring = two_pieces(nan, 1.0, 1.0); },
       "forces.spring.spring.piecewise[1].below: found nan, expected a number (numbers must be "
       "finite)\n"
       "forces.spring.spring.piecewise[2].about: found nan, expected a number (numbers must be "
       "finite)"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).spring = two_pieces(1.0, 1.0, 2.0); },
       "forces.spring.spring.piecewise[1]: the law jumps from 1 to 2 at 1, expected pieces that "
       "meet within 1e-6 of the range of the law"},
      {[](D& d) {
         kind<SpringDamperDescription>(d, 0).damper =
             PiecewisePolynomial({2.0, 1.0}, {{0.0, {0.0}}, {0.0, {0.0}}, {0.0, {0.0}}});
       },
       "forces.spring.damper.piecewise[2].below: found 1, expected a number above the previous "
       "one, 2"},
      {[](D& d) {
         kind<SpringDamperDescription>(d, 0).damper = PiecewisePolynomial({1.0}, {{0.0, {0.0}}});
       },
       "forces.spring.damper: found 1 pieces and 1 breaks between them, expected one piece more "
       "than breaks"},
      {[](D& d) {
         kind<SpringDamperDescription>(d, 0).damper = PiecewisePolynomial::polynomial({});
       },
       "forces.spring.damper.polynomial: found a list of 0, expected a list of 1 to 20 "
       "coefficients [c0, c1, ...]"},
      {[](D& d) { kind<SpringDamperDescription>(d, 0).actuator->input = "pull"; },
       "forces.spring.actuator.input: unknown input 'pull'"},
      {[](D& d) { kind<GuidedSpringDescription>(d, 1).axis.setZero(); },
       "forces.guide.axis: found a vector of length zero, expected a direction"},
      {[](D& d) { kind<GuidedSpringDescription>(d, 1).tip.body = "block"; },
       "forces.guide: found both ends on 'block', expected two bodies"},
      {[](D& d) { kind<JointSpringDescription>(d, 2).joint = "slid"; },
       "forces.motor.joint: unknown joint 'slid', did you mean 'slide'?"},
      {[](D& d) { kind<JointSpringDescription>(d, 2).joint = "ball"; },
       "forces.motor.joint: found 'ball', expected a revolute or prismatic joint"},
      {[](D& d) { kind<JointSpringDescription>(d, 2).spring = {}; },
       "forces.motor.target: found without spring and damper, expected a law that pulls to the "
       "target"},
      {[](D& d) {
         kind<JointSpringDescription>(d, 2).spring = {};
         kind<JointSpringDescription>(d, 2).target.reset();
       },
       "forces.motor: found no law, expected spring, damper or actuator"},
      {[](D& d) { kind<GuidedSpringDescription>(d, 1).damper = {}; },
       "forces.guide: found no law, expected spring, damper, bump_stop, rebound_stop or actuator"},
      {[](D& d) { kind<TyreDescription>(d, 3).radius = 0.0; },
       "forces.tyre.radius: found 0, expected a positive number [m]"},
      {[](D& d) { kind<TyreDescription>(d, 3).stiffness = -1.0; },
       "forces.tyre.stiffness: found -1, expected a positive number [N/m]"},
      {[](D& d) { kind<TyreDescription>(d, 3).damping = nan; },
       "forces.tyre.damping: found nan, expected a number >= 0 [N s/m] (numbers must be finite)"},
      {[](D& d) { kind<TyreDescription>(d, 3).law = static_cast<TyreLaw>(9); },
       "forces.tyre.law: found 9, expected vertical or radial"},
      {[](D& d) { kind<TyreDescription>(d, 3).axis.setZero(); },
       "forces.tyre.axis: found a vector of length zero, expected a direction"},
      {[](D& d) { kind<TyreDescription>(d, 3).road = "trak"; },
       "forces.tyre.road: unknown road 'trak', did you mean 'track'?"},
      {[](D& d) { kind<TyreDescription>(d, 3).centre.body = "ground"; },
       "forces.tyre.body: found ground, expected a body"},
      {[](D& d) { kind<AppliedLoadDescription>(d, 4).direction.setZero(); },
       "forces.load.direction: found a vector of length zero, expected a direction"},
      {[](D& d) { kind<AppliedLoadDescription>(d, 4).magnitude.amplitude = inf; },
       "forces.load.magnitude.sine.amplitude: found inf, expected a number (numbers must be "
       "finite)\n"
       "forces.load.magnitude.sine.frequency: found 0, expected a positive number [Hz]"},
      // By the keys of model files.
      {[](D& d) {
         d.forces[0].kind = ForceValues{static_cast<ForceType>(99), {}};
       },
       "forces.spring.type: found 99, expected " + alternatives(force_words)},
      {[](D& d) { d.forces[3].kind = by_key({}); },
       "forces.tyre: missing key 'body'\nforces.tyre: missing key 'radius'\n"
       "forces.tyre: missing key 'stiffness'\nforces.tyre: missing key 'road'"},
      {[](D& d) {
         d.forces[3].kind = by_key({{"radius", -1}, {"law", "radial"}, {"wide", 0.2}});
       },
       "forces.tyre: unknown key 'wide'\nforces.tyre: missing key 'body'\n"
       "forces.tyre.radius: found -1, expected a positive number [m]\n"
       "forces.tyre: missing key 'stiffness'\nforces.tyre: missing key 'road'"},
      {[](D& d) {
         d.forces[3].kind = by_key({{"body", AttachmentDescription{"block", Vec3(0, 0, 1), {}, {}}},
                                    {"radius", "0.3"},
                                    {"stiffness", 1e5},
                                    {"law", "round"},
                                    {"road", "track"}});
       },
       "forces.tyre.radius: found a value of another type, expected a number\n"
       "forces.tyre.law: found 'round', expected vertical or radial"},
      {[](D& d) { d.roads[0].bumps[0].length = 0.0; },
       "roads.track.bumps[1].length: found 0, expected a positive number [m]"},
      {[](D& d) { d.roads[0].bumps[0].height = nan; },
       "roads.track.bumps[1].height: found nan, expected a number [m] (numbers must be finite)"},
      {[](D& d) {
         d.roads[0].pieces =
             PiecewisePolynomial({2.0, 1.0}, {{0.0, {0.0}}, {0.0, {0.0}}, {0.0, {0.0}}});
       },
       "roads.track.profile.piecewise[2].below: found 1, expected a number above the previous "
       "one, 2"},
      {[](D& d) { d.inputs[0].initial = nan; },
       "inputs.push.initial: found nan, expected a number [N] (numbers must be finite)"},
      {[](D& d) { d.inputs[0].initial = 2.0; },
       "inputs.push.initial: found 2, expected a number not above max, 1"},
      {[](D& d) { d.inputs[0].high = -1.0; },
       "inputs.push.max: found -1, expected a number above min, -1"},
      {[](D& d) { d.inputs[0].low = nan; },
       "inputs.push.min: found nan, expected a number [N] (numbers must be finite)"},
      {[](D& d) { d.inputs[0].unit = "N,m"; },
       "inputs.push.unit: found 'N,m', expected a unit of at most 20 characters without commas, "
       "quotes and brackets"},
      {[](D& d) {
         d.inputs[0].clamp = true;
         d.inputs[0].low.reset();
         d.inputs[0].high.reset();
       },
       "inputs.push.clamp: found true without limits, expected min, max or both beside it"},
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
