// Every field of controllers and of signals between elements, one change at a time.
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

Pid& pid(ModelDescription& d) { return std::get<Pid>(d.controllers[0].kind); }
SignalDescription& load(ModelDescription& d) {
  for (ElementDescription& f : d.forces)
    if (f.name == "load") return std::get<AppliedForce>(f.kind).magnitude;
  throw std::runtime_error("no load");
}

SignalDescription signal_of(SignalSource source, const std::string& element) {
  SignalDescription s;
  s.source = source;
  s.element = element;
  return s;
}

ModelDescription controlled() {
  ModelDescription d = valid_description();
  Pid p;
  p.measured = signal_of(SignalSource::length, "spring");
  p.proportional = 2.0;
  p.integral = 3.0;
  d.controllers = {{"hold", p, {}}};
  load(d) = signal_of(SignalSource::controller, "hold");
  d.outputs.push_back(make_output("u", OutputType::controller, "hold"));
  d.outputs.back().name = "hold.u";
  return d;
}

TEST(ValidateControllers, NamesWhatIsWrong) {
  EXPECT_EQ(errors(controlled()), "no error");
  const std::vector<DescriptionCase> cases{
      {[](D& d) { pid(d).measured.element = "x"; }, "controllers.hold.measured.length: not_found"},
      {[](D& d) { pid(d).measured = signal_of(SignalSource::length, "load"); },
       "controllers.hold.measured: wrong_value"},
      {[](D& d) { pid(d).measured.factor = nan; },
       "controllers.hold.measured.factor: out_of_range"},
      {[](D& d) { pid(d).measured.source = static_cast<SignalSource>(9); },
       "controllers.hold.measured.source: wrong_value"},
      {[](D& d) { pid(d).target = signal_of(SignalSource::controller, "spring"); },
       "controllers.hold.target.controller: not_found"},
      {[](D& d) { pid(d).proportional = pid(d).integral = 0.0; }, "controllers.hold: incomplete"},
      {[](D& d) { pid(d).derivative = 1.0; }, "controllers.hold: incomplete"},
      {[](D& d) { pid(d).filter = 0.0; }, "controllers.hold.filter: out_of_range"},
      {[](D& d) {
         pid(d).proportional = 0.0;
         pid(d).upper = 1.0;
       },
       "controllers.hold: incomplete"},
      {[](D& d) {
         pid(d).lower = 1.0;
         pid(d).upper = 1.0;
       },
       "controllers.hold.lower: out_of_range"},
      {[](D& d) { pid(d).unwind = -1.0; }, "controllers.hold.unwind: out_of_range"},
      {[](D& d) {
         pid(d).filter = 0.1;
         pid(d).rate = signal_of(SignalSource::rate, "spring");
       },
       "controllers.hold.filter: exclusive"},
      {[](D& d) {
         d.controllers.push_back(d.controllers[0]);
         d.controllers[1].name = "spring";  // states have the names of forces and controllers
       },
       "controllers.spring: duplicate"},
      {[](D& d) { d.controllers.push_back(d.controllers[0]); }, "controllers.hold: duplicate"},
      {[](D& d) { d.forces.push_back(d.controllers[0]); },
       "forces.hold.type: wrong_value\ncontrollers.hold: duplicate"},
      {[](D& d) { load(d).element = "x"; }, "forces.load.magnitude.controller: not_found"},
      {[](D& d) { d.outputs.back().entity = "x"; }, "outputs.hold.u.controller: not_found"},
      // Rings without a state.
      {[](D& d) { load(d) = signal_of(SignalSource::force, "load"); }, "contradiction"},
      {[](D& d) {
         pid(d).integral = 0.0;
         pid(d).measured = signal_of(SignalSource::force, "load");
       },
       "contradiction"}};
  for (const DescriptionCase& c : cases) {
    ModelDescription d = controlled();
    c.change(d);
    EXPECT_EQ(errors(d), c.expected);
  }
}

TEST(ValidateControllers, ARingWithAStateIsAllowed) {
  ModelDescription d = controlled();
  pid(d).measured = signal_of(SignalSource::force, "load");
  EXPECT_EQ(errors(d), "no error");
}

}  // namespace
}  // namespace floatframe::test
