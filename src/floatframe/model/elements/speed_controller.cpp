// The force that holds a vehicle at a speed, by the law of path_law.hpp, within its limits; the
// state z, whose rate is 0 while the force is clipped and it would drive it farther beyond.
#include "floatframe/model/limits.hpp"
#include "floatframe/model/linear_block.hpp"
#include "floatframe/model/path_law.hpp"

namespace floatframe {

namespace {

template <class S>
SpeedAnswer<S> speed_controller_answer(const PortsOf<S>& in) noexcept {
  const auto& keys = in.template keys<SpeedControl>();
  const S error = in.signal(1).f - in.signal(0).f;
  return speed_answer({.proportional = keys.proportional, .integral = keys.integral}, keys.mass,
                      error, in.state(0));
}

Limits speed_controller_limits(const SpeedControl& keys) noexcept {
  return {keys.lower, keys.upper};
}

template <class S>
void speed_controller_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const Limits limits = speed_controller_limits(in.template keys<SpeedControl>());
  const SpeedAnswer<S> answer = speed_controller_answer(in);
  const std::int64_t branch = limits.branch(in.branch, value_of(answer.force));
  out.force = limits.clip(branch, answer.force);
  const bool stops =
      branch != Limits::between && (branch == Limits::above) == (value_of(answer.flow) > 0.0);
  if (!stops) out.state_rates[0] = answer.flow;
}

BranchSide speed_controller_side(const Ports& in) noexcept {
  return speed_controller_limits(in.keys<SpeedControl>())
      .side(in.branch, speed_controller_answer(in).force);
}

}  // namespace

FLOATFRAME_LAW(speed_controller)

namespace {

constexpr ElementKey speed_controller_signal(const char* name, KeyKind kind, const char* about,
                                             KeyMember member) {
  return {.name = name,
          .kind = kind,
          .about = about,
          .required = true,
          .axis = ElementAxis::none,
          .member = member};
}

constexpr ElementKey speed_controller_keys[] = {
    speed_controller_signal("measured", KeyKind::load, "the speed",
                            described_by<&SpeedControl::measured>),
    speed_controller_signal("target", KeyKind::target, "what it shall be",
                            described_by<&SpeedControl::target>),
    {.name = "mass",
     .kind = KeyKind::number,
     .about = "of the vehicle",
     .required = true,
     .rule = positive_number("kg"),
     .fallback = 1.0,
     .member = described_by<&SpeedControl::mass>},
    {.name = "proportional",
     .kind = KeyKind::number,
     .about = "k_p, times the error",
     .rule = positive_number("1/s"),
     .fallback = 2.0,
     .member = described_by<&SpeedControl::proportional>},
    {.name = "integral",
     .kind = KeyKind::number,
     .about = "k_i, times its integral, which stops while the force is limited",
     .rule = non_negative_number("1/s²"),
     .fallback = 1.0,
     .member = described_by<&SpeedControl::integral>},
    lower_key(described_by<&SpeedControl::lower>),
    upper_key(described_by<&SpeedControl::upper>)};

ElementExample speed_controller_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  SpeedControl f;
  f.measured = x.linked_signal(numbers);
  f.target = x.linked_signal(numbers);
  f.mass = numbers(1.0, 3.0);
  if (regime == 1) f.lower = -1e-3, f.upper = 1e-3;
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind speed_controller_element = [] {
  auto kind = block_kind<SpeedControl>(
      "the force that holds a vehicle at a speed [N], within limits and without wind-up",
      speed_controller_keys);
  kind.validate = [](const ElementCheck& check) { validate_limits(check); };
  kind.states = [](Element& element) { element.states = 1; };
  kind.dual = speed_controller_law<Dual>;
  kind.side = speed_controller_side;
  kind.resting_branch = Limits::between;
  kind.regimes = limit_regimes;
  return kind;
}();

constinit const ExampleMaker speed_controller_examples = speed_controller_example;

}  // namespace floatframe
