// Spring on the coordinate of a prismatic or revolute joint, z the axis of marker a:
// f = spring(s - target) + damper(sdot - rate of the target) - actuator, and -f acts on the
// coordinate; with a target it is a motor.
// The row of the step contains f_s g g^T and the damping f_sdot g g^T (port_measures.hpp), with an
// actuator that is a formula of s and sdot (local_formula.hpp).
#include <numbers>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/local_formula.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

template <class S>
void joint_spring_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const AxisMeasure<S> m = coordinate_measure(in);
  const TowardTarget<S> x = toward_target(in, m.s, m.rate);
  const LawValue<S> s = spring_of(in, x.stretch), c = damper_of(in, x.rate);
  const ActuatorValue<S> a = actuator_of(in, m.s, m.rate);
  pull_back(m, S(s.f + c.f - a.f), s.df - a.by_measure, c.df - a.by_rate, out);
  out.energy = energy_of(in.element.laws[0], x.stretch);
  out.energy_rate = s.f * (m.rate - x.moves);
  out.damping = c.f * x.rate;
}

BranchSide joint_spring_side(const Ports& in) noexcept {
  const AxisMeasure<double> m = coordinate_measure(in);
  if (in.element.switched) return local_formula_side(in, m.s, m.rate);
  const TowardTarget<double> x = toward_target(in, m.s, m.rate);
  return spring_side(in, x.stretch, x.rate);
}

}  // namespace

FLOATFRAME_LAW(joint_spring)

namespace {

constexpr const char* turning_joint_axis = "the turning of the axis with its body";
constexpr ElementRegime joint_spring_regimes[] = {
    {.name = "along", .rows_leave_out = turning_joint_axis},
    {.name = "about", .rows_leave_out = turning_joint_axis},
    {.name = "about_after_turns", .rows_leave_out = turning_joint_axis},
    {.name = "motor_along", .rows_leave_out = turning_joint_axis, .conservative = false},
    {.name = "motor_about", .rows_leave_out = turning_joint_axis, .conservative = false},
    {.name = "formula_along", .rows_leave_out = turning_joint_axis, .conservative = false},
    {.name = "formula_about", .rows_leave_out = turning_joint_axis, .conservative = false}};

ElementExample joint_spring_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  JointSpring f;
  f.spring = example_spring(numbers);
  f.damper = example_damper(numbers);
  const bool turns = regime == 1 || regime == 2 || regime == 4 || regime == 6;
  const MarkerState a = numbers.marker();
  x.markers = {a, turns ? numbers.marker_on_axis(a) : numbers.marker()};
  if (regime >= 5) f.actuator = x.local_signal(numbers);
  if (regime == 3 || regime == 4) {
    f.actuator = x.linked_signal(numbers);
    f.target = x.signal(numbers);
    f.target->pieces = PiecewisePolynomial::polynomial({0.1, numbers(-1.0, 1.0)});
    f.target->sines.clear();
    f.target_rate = x.signal(numbers);
    x.inputs[1] *= 0.01;
    x.t = numbers(0.0, 1.0);
  }
  x.keys(f);
  x.element.rotational = turns;
  if (regime == 2) x.reference_angle = 6.0 * std::numbers::pi;
  return x;
}

constexpr ElementAxis on_q = ElementAxis::coordinate;
constexpr ElementKey joint_spring_keys[] = {
    {.name = "joint",
     .kind = KeyKind::joint,
     .about = "one with one coordinate q",
     .required = true,
     .member = described_by<&JointSpring::joint>},
    law_key("spring", KeyKind::spring, "of q - target", described_by<&JointSpring::spring>, on_q),
    law_key("damper", KeyKind::damper, "of q̇ - rate of the target",
            described_by<&JointSpring::damper>, on_q),
    law_key("actuator", KeyKind::load, "added to the force on q, which it raises",
            described_by<&JointSpring::actuator>, on_q),
    law_key("target", KeyKind::target, "the place that `spring` pulls to",
            described_by<&JointSpring::target>, on_q),
    law_key("target_rate", KeyKind::target_rate, "the rate that `damper` pulls to",
            described_by<&JointSpring::target_rate>, on_q)};

void joint_spring_validate(const ElementCheck& check) {
  validate_coordinate(check);
  if (!check.given("target") && !check.given("target_rate")) check.some_law();
  validate_target(check);
}

}  // namespace

constinit const ElementKind joint_spring_element = {
    .about =
        "spring, damper and motor on the coordinate of a joint: the force on it is actuator - "
        "spring(q - target) - damper(q̇ - rate)",
    .keys = joint_spring_keys,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(JointSpring()); },
    .validate = joint_spring_validate,
    .build = build_coordinate,
    .local_actuator = true,
    .dual = joint_spring_law<Dual>,
    .side = joint_spring_side,
    .picture = picture_of_coordinate,
    .regimes = joint_spring_regimes};

constinit const ExampleMaker joint_spring_examples = joint_spring_example;

}  // namespace floatframe
