// Every field of a bearing with clearance, one change at a time.
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

JournalBearing& journal(ModelDescription& d) { return std::get<JournalBearing>(d.forces[0].kind); }

ModelDescription with_journal() {
  ModelDescription d = valid_description();
  d.forces.clear();
  d.outputs.clear();
  JournalBearing keys;
  keys.from = place_on("ground", {0, 0, 0});
  keys.to = place_on("block", {0, 0, 1});
  keys.radius = 0.01;
  keys.clearance = 1e-4;
  keys.stiffness = 1e6;
  keys.friction = 0.2;
  keys.kinetic = 0.1;
  d.forces.push_back({"pin", keys, {}});
  d.outputs.push_back(make_output("T", OutputType::force, "pin"));
  d.outputs.back().name = "T";
  d.outputs.back().value = "friction_torque";
  return d;
}

TEST(ValidateJournal, NamesWhatIsWrong) {
  using D = ModelDescription;
  EXPECT_EQ(errors(with_journal()), "no error");
  const std::vector<DescriptionCase> cases{
      {[](D& d) { journal(d).to.body = "x"; }, "forces.pin.to.body: not_found"},
      {[](D& d) { journal(d).from.body = "block"; }, "forces.pin: geometry"},
      {[](D& d) { journal(d).axis.setZero(); }, "forces.pin.axis: out_of_range"},
      {[](D& d) { journal(d).radius = 0.0; }, "forces.pin.radius: out_of_range"},
      {[](D& d) { journal(d).clearance = -1.0; }, "forces.pin.clearance: out_of_range"},
      {[](D& d) { journal(d).stiffness = nan; }, "forces.pin.stiffness: out_of_range"},
      {[](D& d) { journal(d).exponent = 0.5; }, "forces.pin.exponent: out_of_range"},
      {[](D& d) { journal(d).restitution = 1.5; }, "forces.pin.restitution: out_of_range"},
      {[](D& d) { journal(d).least_speed = 0.0; }, "forces.pin.least_speed: out_of_range"},
      {[](D& d) { journal(d).friction = 0.0; }, "forces.pin.friction: out_of_range"},
      {[](D& d) { journal(d).kinetic = 0.3; }, "forces.pin.kinetic: out_of_range"},
      {[](D& d) { journal(d).stribeck = -1.0; }, "forces.pin.stribeck: out_of_range"},
      {[](D& d) { journal(d).deflection = 0.0; }, "forces.pin.deflection: out_of_range"},
      {[](D& d) { journal(d).bristle_damping = -1.0; }, "forces.pin.bristle_damping: out_of_range"},
      {[](D& d) { journal(d).elastic = 1.0; }, "forces.pin.elastic: out_of_range"},
      {[](D& d) { d.outputs[0].value = "3"; }, "not_found"}};
  for (const DescriptionCase& c : cases) {
    ModelDescription d = with_journal();
    c.change(d);
    EXPECT_EQ(errors(d), c.expected);
  }
}

}  // namespace
}  // namespace floatframe::test
