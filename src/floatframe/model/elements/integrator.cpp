// The integral z of the input u within limits, its value y = clip(z):
//   zdot = u                                                                                   (1)
//   zdot = 0 at a limit, as long as u points beyond it                                         (2)
//   zdot = u + (y - z) / unwind beyond a limit                                                 (3)
// (2) is the law on the branch of a limit. Steps that do not locate edges may end beyond a limit;
// (3) is continuous there, and z stays within u unwind of the limit.
#include <algorithm>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/limits.hpp"
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

template <class S>
void integrator_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto& keys = in.template keys<LimitedIntegral>();
  const Limits limits{keys.lower, keys.upper};
  const S z = in.state(0), u = in.signal(0).f;
  const std::int64_t branch = limits.branch(in.branch, value_of(z));
  out.force = limits.clip(branch, z);
  const bool limited = branch != Limits::between;
  if (limited && in.branch != free_branch) return;  // (2)
  out.state_rates[0] = u;                           // (1)
  if (!limited) return;
  out.state_rates[0] += (out.force - z) / keys.unwind;  // (3)
  out.state_slopes[0] = -1.0 / keys.unwind;
}

}  // namespace

FLOATFRAME_LAW(integrator)

namespace {

BranchSide integrator_side(const Ports& in) noexcept {
  const auto& keys = in.keys<LimitedIntegral>();
  const Limits limits{keys.lower, keys.upper};
  const double z = in.state(0), ahead = in.signal(0).f * keys.unwind;  // in the unit of z
  const double under = std::min(limits.under(z), -ahead), over = std::min(limits.over(z), ahead);
  if (in.branch == free_branch) {
    if (limits.over(z) >= 0.0 && ahead > 0.0) return {-1.0, Limits::above};
    if (limits.under(z) >= 0.0 && ahead < 0.0) return {-1.0, Limits::below};
    return {-1.0, Limits::between};
  }
  if (in.branch == Limits::below) return {ahead, Limits::between};
  if (in.branch == Limits::above) return {-ahead, Limits::between};
  return under > over ? BranchSide{under, Limits::below} : BranchSide{over, Limits::above};
}

constexpr ElementKey integrator_keys[] = {
    input_key(described_by<&LimitedIntegral::input>),
    {.name = "initial",
     .kind = KeyKind::number,
     .about = "value at the start",
     .member = described_by<&LimitedIntegral::initial>},
    lower_key(described_by<&LimitedIntegral::lower>),
    upper_key(described_by<&LimitedIntegral::upper>),
    {.name = "unwind",
     .kind = KeyKind::number,
     .about = "time constant of the return to a limit that a step has crossed",
     .rule = positive_number("s"),
     .fallback = 1e-3,
     .member = described_by<&LimitedIntegral::unwind>}};

void integrator_validate(const ElementCheck& check) {
  validate_limits(check);
  if (!check.good("initial") ||
      (check.good("lower") && check.good("upper") && check.number("lower") > check.number("upper")))
    return;
  const double initial = check.number("initial");
  if ((check.good("lower") && initial < check.number("lower")) ||
      (check.good("upper") && initial > check.number("upper")))
    check.error(ErrorCode::out_of_range, check.given("initial") ? "initial" : "",
                sentences::initial_beyond_limits(initial));
}

ElementExample integrator_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  LimitedIntegral f;
  f.input = x.linked_signal(numbers);
  f.unwind = numbers(0.1, 1.0);
  if (regime == 1) f.lower = -1e-3, f.upper = 1e-3;
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind integrator_element = [] {
  auto kind = block_kind<LimitedIntegral>(
      "the integral of its input, which stops at its limits and leaves them at once",
      integrator_keys);
  kind.validate = integrator_validate;
  kind.states = [](Element& element) { element.states = 1; };
  kind.start = [](const Ports& in, double* z) noexcept { *z = in.keys<LimitedIntegral>().initial; };
  kind.dual = integrator_law<Dual>;
  kind.side = integrator_side;
  kind.resting_branch = Limits::between;
  kind.regimes = limit_regimes;
  return kind;
}();

constinit const ExampleMaker integrator_examples = integrator_example;

}  // namespace floatframe
