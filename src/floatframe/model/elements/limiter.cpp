// y = clip(u, lower, upper)
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/limits.hpp"
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

Limits clipping_of(const Limiter& keys) noexcept { return {keys.lower, keys.upper}; }

template <class S>
void limiter_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const Limits limits = clipping_of(in.template keys<Limiter>());
  const S u = in.signal(0).f;
  out.force = limits.clip(limits.branch(in.branch, value_of(u)), u);
}

}  // namespace

FLOATFRAME_LAW(limiter)

namespace {

constexpr ElementKey limiter_keys[] = {input_key(described_by<&Limiter::input>),
                                       lower_key(described_by<&Limiter::lower>),
                                       upper_key(described_by<&Limiter::upper>)};

void limiter_validate(const ElementCheck& check) {
  if (!check.given("lower") && !check.given("upper"))
    check.error(ErrorCode::incomplete, "", sentences::none_given({"lower", "upper"}));
  validate_limits(check);
}

ElementExample limiter_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  Limiter f;
  f.input = x.linked_signal(numbers);
  if (regime == 0) f.upper = 1e3;
  if (regime == 1) f.lower = -1e-3, f.upper = 1e-3;
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind limiter_element = [] {
  auto kind =
      block_kind<Limiter>("its input, a sum of terms for example, within limits", limiter_keys);
  kind.validate = limiter_validate;
  kind.dual = limiter_law<Dual>;
  kind.side = [](const Ports& in) noexcept {
    return clipping_of(in.keys<Limiter>()).side(in.branch, in.signal(0).f);
  };
  kind.resting_branch = Limits::between;
  kind.regimes = limit_regimes;
  return kind;
}();

constinit const ExampleMaker limiter_examples = limiter_example;

}  // namespace floatframe
