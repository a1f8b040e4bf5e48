// Controller of the error e = target - measured, its value
//   u = clip(raw, lower, upper),  raw = proportional e + i + d                                 (1)
//   idot = integral e + (u - raw) / unwind                                                     (2)
//   d = derivative (rate of the target - rate), or behind a filter of first order             (3)
//   d = derivative xdot,  xdot = (e - x) / filter                                              (4)
// with the states i, if it integrates, and x, if it filters. (2) pulls i back while u is clipped.
// Sampled with the period T (sampling.hpp), by the backward Euler rule (4) is
//   d = derivative (e - x) / (filter + T),  then x += T (e - x) / (filter + T)                (5)
// and i grows by T integral e before (1), and by min(T / unwind, 1) (u - raw) after it.      (6)
#include <algorithm>
#include <cmath>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/limits.hpp"
#include "floatframe/model/sampling_keys.hpp"

namespace floatframe {

namespace {

/// Ports of its signals.
constexpr std::size_t measured_port = 0, target_port = 1, rate_port = 2;

bool integrates(const Pid& keys) noexcept { return keys.integral != 0.0; }
bool filters(const Element& element, const Pid& keys) noexcept {
  return keys.derivative != 0.0 && !element.signals[rate_port].given;
}
double unwinding_time(const Pid& keys) noexcept {
  return keys.unwind.value_or(std::abs(keys.proportional / keys.integral));
}

/// (1) before it is clipped, and what belongs to it.
template <class S>
struct PidTerms {
  S error, filtered, raw;
};

template <class S>
PidTerms<S> pid_terms(const PortsOf<S>& in) noexcept {
  const Pid& keys = in.template keys<Pid>();
  const SignalValue<S> target = in.signal(target_port);
  PidTerms<S> out;
  out.error = target.f - in.signal(measured_port).f;
  out.raw = keys.proportional * out.error;
  if (integrates(keys)) out.raw += in.state(0);
  if (filters(in.element, keys)) {
    out.filtered = (out.error - in.state(integrates(keys) ? 1 : 0)) / *keys.filter;  // (4)
    out.raw += keys.derivative * out.filtered;
  } else if (keys.derivative != 0.0) {
    out.raw += keys.derivative * (target.df - in.signal(rate_port).f);  // (3)
  }
  return out;
}

Limits limits_of(const Pid& keys) noexcept { return {keys.lower, keys.upper}; }

template <class S>
void pid_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  if (holds_value(in, out)) return;
  const Pid& keys = in.template keys<Pid>();
  const PidTerms<S> x = pid_terms(in);
  const Limits limits = limits_of(keys);
  const std::int64_t branch = limits.branch(in.branch, value_of(x.raw));
  const bool clipped = branch != Limits::between;
  const S u = limits.clip(branch, x.raw);
  out.force = u;
  const int count = in.element.states;
  if (integrates(keys)) {
    S flow = keys.integral * x.error;  // (2)
    if (clipped) flow += (u - x.raw) / unwinding_time(keys);
    out.state_rates[0] = flow;
    if (clipped) out.state_slopes[0] = -1.0 / unwinding_time(keys);
  }
  if (!filters(in.element, keys)) return;
  out.state_rates[count - 1] = x.filtered;
  out.state_slopes[count * count - 1] = -1.0 / *keys.filter;
  if (count > 1 && clipped)
    out.state_slopes[1] = keys.derivative / *keys.filter / unwinding_time(keys);
}

BranchSide pid_side(const Ports& in) noexcept {
  if (in.element.clock.ticks()) return {-1.0, Limits::between};
  return limits_of(in.keys<Pid>()).side(in.branch, pid_terms(in).raw);
}

}  // namespace

FLOATFRAME_LAW(pid)

namespace {

constexpr ElementAxis bare = ElementAxis::none;
constexpr ElementKey gain_key(const char* name, const char* about, KeyMember member) {
  return {.name = name, .kind = KeyKind::number, .about = about, .member = member};
}
constexpr auto pid_keys = with_sampling<Pid>(
    {{.name = "measured",
      .kind = KeyKind::load,
      .about = "what is controlled",
      .required = true,
      .axis = bare,
      .member = described_by<&Pid::measured>},
     law_key("target", KeyKind::target, "what it shall be; without it 0",
             described_by<&Pid::target>, bare),
     law_key("rate", KeyKind::load, "the rate of `measured`; without it that of the filtered error",
             described_by<&Pid::rate>, bare),
     gain_key("proportional", "times the error, target - measured",
              described_by<&Pid::proportional>),
     gain_key("integral", "times the integral of the error", described_by<&Pid::integral>),
     gain_key("derivative", "times the rate of the error", described_by<&Pid::derivative>),
     {.name = "filter",
      .kind = KeyKind::number,
      .about = "time constant of the rate of the error, needed for a `derivative` without `rate` "
               "that is not sampled, not allowed with it",
      .rule = positive_number("s"),
      .fallback = no_number,
      .member = described_by<&Pid::filter>},
     lower_key(described_by<&Pid::lower>),
     upper_key(described_by<&Pid::upper>),
     {.name = "unwind",
      .kind = KeyKind::number,
      .about = "time in which the integral returns while the value is limited; without it "
               "`proportional` / `integral`",
      .rule = positive_number("s"),
      .fallback = no_number,
      .member = described_by<&Pid::unwind>}});

void pid_validate(const ElementCheck& check) {
  validate_sampling(check);
  const auto number = [&](const char* key) { return check.good(key) ? check.number(key) : 0.0; };
  const auto required = [&](const char* key, const char* why) {
    check.error(ErrorCode::incomplete, "", sentences::controller_needs(key, why));
  };
  if (check.wrong.empty() && number("proportional") == 0.0 && number("integral") == 0.0 &&
      number("derivative") == 0.0)
    check.error(ErrorCode::incomplete, "", sentences::controller_without_gain());
  const auto unused = [&](const char* key, const char* without) {
    if (check.given(key) && !check.wrong.contains(key))
      check.error(ErrorCode::incomplete, key, sentences::unused_without(without));
  };
  if (check.given("filter") && check.given("rate")) {
    check.error(ErrorCode::exclusive, "filter", sentences::filter_and_rate());
  } else if (!check.wrong.contains("derivative")) {
    if (number("derivative") == 0.0) {
      unused("filter", "'derivative'");
      unused("rate", "'derivative'");
    } else if (!check.given("rate") && !check.given("filter") && !check.given("period")) {
      required("filter", "'derivative' without 'rate'");
    }
  }
  const bool limited = check.given("lower") || check.given("upper");
  if (!limited)
    unused("unwind", "'lower' or 'upper'");
  else if (!check.wrong.contains("integral") && number("integral") == 0.0)
    unused("unwind", "'integral'");
  else if (number("integral") != 0.0 && number("proportional") == 0.0 && !check.given("unwind") &&
           !check.wrong.contains("proportional"))
    required("unwind", "limits of 'integral' without 'proportional'");
  validate_limits(check);
}

void pid_states(Element& element) {
  const Pid& keys = *std::get_if<Pid>(element.keys.get());
  take_clock(element, keys, 2);
  if (!keys.period) element.states = integrates(keys) + filters(element, keys);
}

/// (5), (6); own: i, x.
void pid_sample(const Ports& in, double* own, double* y) noexcept {
  const Pid& keys = in.keys<Pid>();
  const double T = in.element.clock.period;
  const SignalValue<double> target = in.signal(target_port);
  const double error = target.f - in.signal(measured_port).f;
  own[0] += T * keys.integral * error;
  double raw = keys.proportional * error + own[0];
  if (filters(in.element, keys)) {
    const double turn = (error - own[1]) / (keys.filter.value_or(0.0) + T);
    raw += keys.derivative * turn;
    own[1] += T * turn;
  } else if (keys.derivative != 0.0) {
    raw += keys.derivative * (target.df - in.signal(rate_port).f);
  }
  const Limits limits = limits_of(keys);
  const double u = limits.clip(limits.branch(free_branch, raw), raw);
  if (u != raw && integrates(keys)) own[0] += std::min(T / unwinding_time(keys), 1.0) * (u - raw);
  *y = u;
}

/// The filter begins at the error.
void pid_start(const Ports& in, double* states) noexcept {
  const Pid& keys = in.keys<Pid>();
  for (int i = 0; i < in.element.states; ++i) states[i] = 0.0;
  const double error = in.signal(target_port).f - in.signal(measured_port).f;
  if (in.element.clock.ticks())
    own_numbers(in.element, states)[1] = error;
  else if (filters(in.element, keys))
    states[in.element.states - 1] = error;
}

constexpr ElementRegime pid_regimes[] = {
    {.name = "between", .conservative = false, .acts = false},
    {.name = "clipped", .conservative = false, .acts = false},
    {.name = "rate_is_measured", .conservative = false, .acts = false},
    {.name = "sampled", .conservative = false, .acts = false}};

ElementExample pid_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  Pid c;
  c.measured = x.linked_signal(numbers);
  c.target = x.signal(numbers);
  c.proportional = numbers(1.0, 3.0);
  c.integral = numbers(1.0, 3.0);
  c.derivative = numbers(0.1, 0.3);
  c.filter = numbers(0.01, 0.1);
  if (regime == 1) c.lower = -1e-3, c.upper = 1e-3;
  if (regime == 2) c.rate = x.linked_signal(numbers);
  if (regime == 3) c.period = 0.02;
  x.keys(c);
  x.t = numbers(0.0, 1.0);
  for (int i = 0; i < x.element.states + x.element.kept; ++i)
    x.states.push_back(numbers(-2.0, 2.0));
  x.state_weight = numbers(0.5, 200.0);
  return x;
}

}  // namespace

constinit const ElementKind pid_element = {
    .about =
        "proportional, integral and derivative terms of target - measured, with limits; the "
        "integral does not wind up",
    .keys = pid_keys,
    .list = ElementList::controllers,
    .energy = EnergyCategory::loads,
    .axis = ElementAxis::none,
    .measured = false,
    .blank = [] { return ElementKeys(Pid()); },
    .validate = pid_validate,
    .build = [](ElementBuild&) { return true; },
    .states = pid_states,
    .start = pid_start,
    .sample = pid_sample,
    .dual = pid_law<Dual>,
    .side = pid_side,
    .resting_branch = Limits::between,
    .regimes = pid_regimes};

constinit const ExampleMaker pid_examples = pid_example;

}  // namespace floatframe
