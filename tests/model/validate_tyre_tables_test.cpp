// The tables of TMeasy tyres, the coefficients of Calspan tyres and loads of the air, one change at
// a time.
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

template <class Keys>
Keys& only_force(D& d) {
  return std::get<Keys>(d.forces[0].kind);
}
template <class Keys>
D with_only(Keys keys) {
  D d = valid_description();
  d.forces.clear();
  d.outputs.clear();
  if constexpr (std::is_base_of_v<RollingTyre, Keys>) {
    keys.centre = place_on("block", {0, 0, 1});
    keys.road = d.roads[0].name;
  } else {
    keys.at = place_on("block", {0, 0, 1});
  }
  d.forces.push_back({"t", keys, {}});
  return d;
}
template <class Keys>
void expect_table_errors(const Keys& keys, const std::vector<DescriptionCase>& cases) {
  EXPECT_EQ(errors(with_only(keys)), "no error");
  for (const DescriptionCase& c : cases) {
    D d = with_only(keys);
    c.change(d);
    EXPECT_NE(errors(d).find(c.expected), std::string::npos) << errors(d) << "\n" << c.expected;
  }
}

TEST(ValidateTmeasyTyre, NamesWhatIsWrong) {
  TmeasyTyre keys;
  keys.radius = 0.376;
  keys.nominal_load = 1900.0;
  keys.stiffness = MatX{{1e5, 1.1e5}};
  keys.longitudinal =
      MatX{{34911.0, 2145.5, 0.139, 1522.8, 0.667}, {73974.0, 4140.6, 0.139, 2922.8, 0.667}};
  keys.lateral =
      MatX{{30367.0, 1901.7, 0.149, 1583.8, 0.965}, {48834.0, 3472.0, 0.185, 2938.8, 1.071}};
  keys.trail = MatX{{0.178, 0.163, 0.965}, {0.19, 0.204, 1.071}};
  keys.longitudinal_stiffness = 1.2e5;
  keys.lateral_stiffness = 8e4;
  const auto t = [](D& d) -> TmeasyTyre& { return only_force<TmeasyTyre>(d); };
  expect_table_errors(
      keys,
      {{[&](D& d) { t(d).radius = 0.0; }, "forces.t.radius: out_of_range"},
       {[&](D& d) { t(d).nominal_load = 0.0; }, "forces.t.nominal_load: out_of_range"},
       {[&](D& d) { t(d).max_load = 1000.0; }, "forces.t.max_load: wrong_value"},
       {[&](D& d) { t(d).max_load = 2e4; }, "forces.t.lateral: wrong_value"},
       {[&](D& d) { t(d).stiffness(1) = 0.9e5; }, "forces.t.stiffness: wrong_value"},
       {[&](D& d) { t(d).stiffness(1) = 1.5e5; }, "forces.t.stiffness: wrong_value"},
       {[&](D& d) { t(d).longitudinal = MatX::Ones(3, 5); }, "forces.t.longitudinal: "},
       {[&](D& d) { t(d).longitudinal(0, 3) = 2200.0; }, "forces.t.longitudinal: wrong_value"},
       {[&](D& d) { t(d).lateral(1, 4) = 0.185; }, "forces.t.lateral: wrong_value"},
       {[&](D& d) { t(d).lateral(0, 0) = 5000.0; }, "forces.t.lateral: wrong_value"},
       {[&](D& d) { t(d).trail(1, 0) = 0.4; }, "forces.t.trail: wrong_value"},
       {[&](D& d) { t(d).trail(0, 1) = -0.1; }, "forces.t.trail: out_of_range"},
       {[&](D& d) { t(d).lateral_stiffness = 0.0; }, "forces.t.lateral_stiffness: out_of_range"},
       {[&](D& d) { t(d).rolling_radius = 1.5; }, "forces.t.rolling_radius: out_of_range"},
       {[&](D& d) { t(d).friction = 0.0; }, "forces.t.friction: out_of_range"}});
}

TEST(ValidateCalspanTyre, NamesWhatIsWrong) {
  CalspanTyre keys;
  keys.radius = 0.364;
  keys.stiffness = 4.6e5;
  keys.cornering = MatX{{2625.0, 14.47, 12930.0}};
  keys.camber = MatX{{2.29, 18175.0}};
  keys.friction = MatX{{-4.64e-5, 1.216, 2.18e-11}};
  const auto t = [](D& d) -> CalspanTyre& { return only_force<CalspanTyre>(d); };
  expect_table_errors(
      keys, {{[&](D& d) { t(d).cornering(2) = 0.0; }, "forces.t.cornering: wrong_value"},
             {[&](D& d) { t(d).cornering(0) = -1.0; }, "forces.t.cornering: wrong_value"},
             {[&](D& d) { t(d).camber(1) = -1.0; }, "forces.t.camber: wrong_value"},
             {[&](D& d) { t(d).camber.resize(1, 3); }, "forces.t.camber: wrong_count"},
             {[&](D& d) { t(d).load_limit = 0.0; }, "forces.t.load_limit: out_of_range"},
             {[&](D& d) { t(d).skid_number = 0.0; }, "forces.t.skid_number: out_of_range"},
             {[&](D& d) { t(d).relaxation_y = 0.0; }, "forces.t.relaxation_y: out_of_range"}});
}

TEST(ValidateAerodynamicLoad, NamesWhatIsWrong) {
  AerodynamicLoad keys;
  keys.area = 2.0;
  keys.drag = 0.3;
  const auto t = [](D& d) -> AerodynamicLoad& { return only_force<AerodynamicLoad>(d); };
  expect_table_errors(
      keys, {{[&](D& d) { t(d).area = 0.0; }, "forces.t.area: out_of_range"},
             {[&](D& d) { t(d).drag = -0.1; }, "forces.t.drag: out_of_range"},
             {[&](D& d) { t(d).drag = 0.0; }, "incomplete"},
             {[&](D& d) { t(d).density = 0.0; }, "forces.t.density: out_of_range"},
             {[&](D& d) { t(d).axis_2 = Vec3::UnitZ(); }, "forces.t.axis_2: geometry"},
             {[&](D& d) { t(d).wind_direction.setZero(); }, "forces.t.wind_direction: "}});
}

}  // namespace
}  // namespace floatframe::test
