// Every key of couplings by name, one change at a time.
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

/// Two wheels on parallel axes, one on another axis, a slide and a nut.
ModelDescription wheels(ElementKeys keys) {
  ModelDescription d;
  const auto add = [&](const char* name, JointType type, const Vec3& axis) {
    d.bodies.push_back(make_body(name, RigidDescription{1.0, Vec3::Zero(), Mat3::Identity()}));
    d.joints.push_back(make_joint(name, type, "ground", name));
    d.joints.back().axis = axis;
  };
  add("a", JointType::revolute, Vec3::UnitZ());
  add("b", JointType::revolute, Vec3(0.0, 0.001, -1.0));
  add("cross", JointType::revolute, Vec3::UnitX());
  add("slide", JointType::prismatic, Vec3::UnitX());
  add("nut", JointType::cylindrical, Vec3::UnitZ());
  add("plane", JointType::planar, Vec3::UnitZ());
  add("ball", JointType::spherical, Vec3::UnitZ());
  d.couplings = {{"tie", std::move(keys), {}}};
  return d;
}

/// The errors of the coupling with these keys after a change.
template <class Keys, class Change>
std::string errors_after(Keys keys, const Change& change) {
  change(keys);
  return errors(wheels(std::move(keys)));
}

template <class Keys>
struct KeysCase {
  void (*change)(Keys&);
  const char* expected;
};
template <class Keys, std::size_t n>
void expect_coupling_errors(const Keys& keys, const KeysCase<Keys> (&cases)[n]) {
  EXPECT_EQ(errors(wheels(keys)), "no error");
  for (const KeysCase<Keys>& c : cases) EXPECT_EQ(errors_after(keys, c.change), c.expected);
}

TEST(ValidateNamedCouplings, Gears) {
  expect_coupling_errors<Gear>(
      {.driver = {"a"}, .driven = {"b"}, .ratio = 2.0},
      {{[](Gear& g) { g.driver.joint = "x"; }, "couplings.tie.driver: not_found"},
       {[](Gear& g) { g.driver.joint = "slide"; }, "couplings.tie.driver: wrong_value"},
       {[](Gear& g) { g.driven.joint = "ball"; }, "couplings.tie.driven: wrong_value"},
       {[](Gear& g) { g.driven.joint = "a"; }, "couplings.tie.driven: duplicate"},
       {[](Gear& g) {
          g.driven = {"nut", 0};
        },
        "couplings.tie.driven: incomplete"},
       {[](Gear& g) { g.driven.joint = "cross"; }, "geometry"},
       {[](Gear& g) { g.ratio.reset(); }, "couplings.tie: missing"},
       {[](Gear& g) { g.ratio = 0.0; }, "couplings.tie.ratio: out_of_range"},
       {[](Gear& g) {
          g.teeth = MatX{{20.0, 30.0}};
        },
        "couplings.tie.ratio: exclusive"},
       {[](Gear& g) {
          g.ratio.reset();
          g.teeth = MatX{{20.0, 30.5}};
        },
        "couplings.tie.teeth: out_of_range"},
       {[](Gear& g) {
          g.ratio.reset();
          g.teeth = MatX{{20.0}};
        },
        "couplings.tie.teeth: wrong_count"},
       {[](Gear& g) {
          g.ratio.reset();
          g.teeth = MatX{{20.0, 0.0}};
        },
        "couplings.tie.teeth: out_of_range"},
       {[](Gear& g) { g.pressure_angle = 20.0; }, "couplings.tie.pressure_angle: out_of_range"},
       {[](Gear& g) { g.flank = GearFlank::backward; }, "couplings.tie.flank: incomplete"},
       {[](Gear& g) { g.helix_angle = 0.3; }, "couplings.tie.helix_angle: incomplete"},
       {[](Gear& g) { g.flank = static_cast<GearFlank>(7); }, "couplings.tie.flank: out_of_range"},
       {[](Gear& g) { g.pressure_angle = 0.35; }, "geometry"},
       {[](Gear& g) { g.mesh_stiffness = 0.0; }, "couplings.tie.mesh_stiffness: out_of_range"},
       {[](Gear& g) { g.mesh_damping = 1.0; }, "couplings.tie.mesh_damping: incomplete"},
       {[](Gear& g) { g.backlash = 0.01; }, "couplings.tie.backlash: incomplete"},
       {[](Gear& g) {
          g.mesh_stiffness = 1e4;
          g.pressure_angle = 0.35;
        },
        "couplings.tie.mesh_stiffness: exclusive"}});
  expect_coupling_errors<BevelGear>(
      {.driver = {"a"}, .driven = {"cross"}, .ratio = 2.0},
      {{[](BevelGear& g) { g.ratio = -1.0; }, "couplings.tie.ratio: out_of_range"},
       {[](BevelGear& g) {
          g.driver = {"nut", 5};
        },
        "couplings.tie.driver: incomplete"}});
}

TEST(ValidateNamedCouplings, PlanetaryGearsAndDifferentials) {
  PlanetaryGear hub;
  hub.sun = CoordinateTerm{"a"};
  hub.carrier = CoordinateTerm{"b"};
  hub.teeth = MatX{{24.0, 72.0}};
  expect_coupling_errors<PlanetaryGear>(
      hub, {{[](PlanetaryGear& g) { g.sun.reset(); }, "couplings.tie: incomplete"},
            {[](PlanetaryGear& g) { g.carrier = CoordinateTerm{"a"}; },
             "couplings.tie.carrier: duplicate"},
            {[](PlanetaryGear& g) { g.ring = CoordinateTerm{"cross"}; }, "geometry"},
            {[](PlanetaryGear& g) { g.teeth = MatX(); }, "couplings.tie: missing"},
            {[](PlanetaryGear& g) {
               g.teeth = MatX{{72.0, 24.0}};
             },
             "couplings.tie.teeth: out_of_range"}});
  expect_coupling_errors<DifferentialGear>(
      {{"a"}, {"b"}, {"nut"}},
      {{[](DifferentialGear& g) { g.cage = {"cross"}; }, "geometry"},
       {[](DifferentialGear& g) { g.right = {"slide"}; }, "couplings.tie.right: wrong_value"}});
}

TEST(ValidateNamedCouplings, WhatSlides) {
  expect_coupling_errors<RackAndPinion>(
      {.pinion = {"a"}, .rack = {"slide"}, .radius = 0.1},
      {{[](RackAndPinion& g) { g.rack = {"b"}; }, "couplings.tie.rack: wrong_value"},
       {[](RackAndPinion& g) { g.rack = {"plane"}; }, "couplings.tie.rack: incomplete"},
       {[](RackAndPinion& g) { g.radius = 0.0; }, "couplings.tie.radius: out_of_range"}});
  ScrewDrive screw;
  screw.joint = CoordinateTerm{"nut"};
  screw.lead = 0.01;
  expect_coupling_errors<ScrewDrive>(
      screw,
      {{[](ScrewDrive& s) { s.lead = 0.0; }, "couplings.tie.lead: out_of_range"},
       {[](ScrewDrive& s) { s.lead = inf; }, "couplings.tie.lead: out_of_range"},
       {[](ScrewDrive& s) { s.joint = CoordinateTerm{"a"}; }, "couplings.tie.joint: wrong_value"},
       {[](ScrewDrive& s) { s.joint.reset(); }, "couplings.tie: missing"},
       {[](ScrewDrive& s) { s.rotation = CoordinateTerm{"a"}; },
        "couplings.tie.joint: exclusive"}});
  expect_coupling_errors<BeltDrive>(
      {.driver = {"a"}, .driven = {"b"}, .radii = MatX{{0.1, 0.2}}},
      {{[](BeltDrive& b) { b.radii(1) = -0.1; }, "couplings.tie.radii: out_of_range"},
       {[](BeltDrive& b) { b.stiffness = -1.0; }, "couplings.tie.stiffness: out_of_range"},
       {[](BeltDrive& b) { b.damping = 1.0; }, "couplings.tie.damping: incomplete"},
       {[](BeltDrive& b) { b.driven = {"cross"}; }, "geometry"}});
  expect_coupling_errors<Mimic>(
      {{"a"}, {"slide"}, 0.5, 0.0},
      {{[](Mimic& m) { m.factor = 0.0; }, "couplings.tie.factor: out_of_range"},
       {[](Mimic& m) { m.offset = nan; }, "couplings.tie.offset: out_of_range"},
       {[](Mimic& m) { m.follows = {"nut"}; }, "couplings.tie.follows: incomplete"},
       {[](Mimic& m) { m.joint = {"ball"}; }, "couplings.tie.joint: wrong_value"}});
}

}  // namespace
}  // namespace floatframe::test
