// Every field of a tyre that rolls, one change at a time.
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

LinearTyre& rolling_tyre(ModelDescription& d) { return std::get<LinearTyre>(d.forces[0].kind); }

ModelDescription with_rolling_tyre() {
  ModelDescription d = valid_description();
  d.forces.clear();
  d.outputs.clear();
  LinearTyre keys;
  keys.centre = place_on("block", {0, 0, 1});
  keys.road = d.roads[0].name;
  keys.radius = 0.3;
  keys.stiffness = 2e5;
  keys.slip_stiffness = keys.cornering_stiffness = 5e4;
  keys.relaxation_x = keys.relaxation_y = 0.4;
  d.forces.push_back({"t", keys, {}});
  d.outputs.push_back(make_output("F", OutputType::force, "t"));
  d.outputs.back().name = "F";
  d.outputs.back().value = "lateral_force";
  return d;
}

TEST(ValidateRollingTyre, NamesWhatIsWrong) {
  using D = ModelDescription;
  EXPECT_EQ(errors(with_rolling_tyre()), "no error");
  const std::vector<DescriptionCase> cases{
      {[](D& d) { rolling_tyre(d).centre.body = "ground"; }, "forces.t.body: wrong_value"},
      {[](D& d) { rolling_tyre(d).axis.setZero(); }, "forces.t.axis: out_of_range"},
      {[](D& d) { rolling_tyre(d).road = "trak"; }, "forces.t.road: not_found"},
      {[](D& d) { rolling_tyre(d).radius = 0.0; }, "forces.t.radius: out_of_range"},
      {[](D& d) { rolling_tyre(d).stiffness = -1.0; }, "forces.t.stiffness: out_of_range"},
      {[](D& d) { rolling_tyre(d).slip_stiffness = 0.0; }, "forces.t.slip_stiffness: out_of_range"},
      {[](D& d) { rolling_tyre(d).cornering_stiffness = nan; },
       "forces.t.cornering_stiffness: out_of_range"},
      {[](D& d) { rolling_tyre(d).camber_stiffness = -1.0; },
       "forces.t.camber_stiffness: out_of_range"},
      {[](D& d) { rolling_tyre(d).nominal_load = 0.0; }, "forces.t.nominal_load: out_of_range"},
      {[](D& d) { rolling_tyre(d).trail = -0.1; }, "forces.t.trail: out_of_range"},
      {[](D& d) { rolling_tyre(d).friction = 0.0; }, "forces.t.friction: out_of_range"},
      {[](D& d) { rolling_tyre(d).relaxation_x = 0.0; }, "forces.t.relaxation_x: out_of_range"},
      {[](D& d) { rolling_tyre(d).relaxation_y = 0.0; }, "forces.t.relaxation_y: out_of_range"},
      {[](D& d) { rolling_tyre(d).rolling_resistance = -1.0; },
       "forces.t.rolling_resistance: out_of_range"},
      {[](D& d) { rolling_tyre(d).damping = -1.0; }, "forces.t.damping: out_of_range"},
      {[](D& d) { rolling_tyre(d).rest_damping = -1.0; }, "forces.t.rest_damping: out_of_range"},
      {[](D& d) { rolling_tyre(d).damping_speed = 0.0; }, "forces.t.damping_speed: out_of_range"},
      {[](D& d) { rolling_tyre(d).patch_width = 0.1; }, "forces.t.patch_width: incomplete"},
      {[](D& d) {
         rolling_tyre(d).contact = TyreContact::patch;
         rolling_tyre(d).patch_length = 0.0;
       },
       "forces.t.patch_length: out_of_range"},
      {[](D& d) { d.outputs[0].value = "side_force"; }, "not_found"}};
  for (const DescriptionCase& c : cases) {
    ModelDescription d = with_rolling_tyre();
    c.change(d);
    EXPECT_EQ(errors(d), c.expected);
  }
}

}  // namespace
}  // namespace floatframe::test
