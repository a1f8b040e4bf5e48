// A value y that follows the input u no faster than its limits: ydot = clip((u - y) / time,
// -falling, rising). Within them it is a filter of first order: it lags a ramp by `time`.
#include "floatframe/model/limits.hpp"
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

Limits rates_of(const RateLimiter& keys) noexcept {
  return {-keys.falling.value_or(keys.rising), keys.rising};
}

template <class S>
S wanted_rate(const PortsOf<S>& in) noexcept {
  return (in.signal(0).f - in.state(0)) / in.template keys<RateLimiter>().time;
}

template <class S>
void rate_limiter_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto& keys = in.template keys<RateLimiter>();
  const S wanted = wanted_rate(in);
  const Limits limits = rates_of(keys);
  const std::int64_t branch = limits.branch(in.branch, value_of(wanted));
  out.force = in.state(0);
  out.state_rates[0] = limits.clip(branch, wanted);
  out.state_slopes[0] = branch == Limits::between ? -1.0 / keys.time : 0.0;
}

}  // namespace

FLOATFRAME_LAW(rate_limiter)

namespace {

constexpr ElementKey rate_key(const char* name, const char* about, const char* unit,
                              double fallback, KeyMember member, bool required = false) {
  return {.name = name,
          .kind = KeyKind::number,
          .about = about,
          .required = required,
          .rule = positive_number(unit),
          .fallback = fallback,
          .member = member};
}
constexpr ElementKey rate_limiter_keys[] = {
    input_key(described_by<&RateLimiter::input>),
    rate_key("rising", "largest rate, per second", "", 0.0, described_by<&RateLimiter::rising>,
             true),
    rate_key("falling", "the same downwards; without it `rising`", "", no_number,
             described_by<&RateLimiter::falling>),
    rate_key("time", "time constant with which it follows within the limits", "s", 1e-3,
             described_by<&RateLimiter::time>)};

ElementExample rate_limiter_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  RateLimiter f;
  f.input = x.linked_signal(numbers);
  f.time = numbers(0.1, 1.0);
  f.rising = regime == 0 ? 1e4 : 1e-3;
  if (regime == 1) f.falling = 2e-3;
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind rate_limiter_element = [] {
  auto kind = block_kind<RateLimiter>("its input, with a limited rate", rate_limiter_keys);
  kind.states = [](Element& element) { element.states = 1; };
  kind.start = [](const Ports& in, double* y) noexcept { *y = in.signal(0).f; };
  kind.dual = rate_limiter_law<Dual>;
  kind.side = [](const Ports& in) noexcept {
    return rates_of(in.keys<RateLimiter>()).side(in.branch, wanted_rate(in));
  };
  kind.resting_branch = Limits::between;
  kind.regimes = limit_regimes;
  return kind;
}();

constinit const ExampleMaker rate_limiter_examples = rate_limiter_example;

}  // namespace floatframe
