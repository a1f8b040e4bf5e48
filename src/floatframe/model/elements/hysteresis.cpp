// A relay: `above` after the input has reached the upper threshold, `below` after it has reached
// the lower one. Its side is a kept number, which changes at the end of a step; on a held branch it
// is the branch, and steps end at the threshold.
#include "floatframe/model/limits.hpp"
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

template <class S>
void hysteresis_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto& keys = in.template keys<Hysteresis>();
  const bool above = in.branch == free_branch ? in.state(0) > 0.5 : in.branch > 0;
  out.force = above ? keys.above : keys.below;
}

/// True above, coming from a side to an input.
bool is_above(const Hysteresis& keys, bool was, double u) noexcept {
  return u >= keys.upper || (was && u > keys.lower);
}

}  // namespace

FLOATFRAME_LAW(hysteresis)

namespace {

void hysteresis_after_step(const Ports& in, double* side) noexcept {
  const auto& keys = in.keys<Hysteresis>();
  *side = in.branch == free_branch ? is_above(keys, *side > 0.5, in.signal(0).f) : in.branch > 0;
}

BranchSide hysteresis_side(const Ports& in) noexcept {
  const auto& keys = in.keys<Hysteresis>();
  const double u = in.signal(0).f;
  if (in.branch == free_branch) return {-1.0, is_above(keys, in.state(0) > 0.5, u)};
  return in.branch > 0 ? BranchSide{keys.lower - u, 0} : BranchSide{u - keys.upper, 1};
}

void hysteresis_start(const Ports& in, double* side) noexcept {
  const auto& keys = in.keys<Hysteresis>();
  *side = is_above(keys, keys.initial == RelaySide::above, in.signal(0).f);
}

constexpr const char* relay_words[] = {"below", "above"};
constexpr ElementKey relay_number(const char* name, const char* about, KeyMember member,
                                  double fallback, bool required = false) {
  return {.name = name,
          .kind = KeyKind::number,
          .about = about,
          .required = required,
          .fallback = fallback,
          .member = member};
}
constexpr ElementKey hysteresis_keys[] = {
    input_key(described_by<&Hysteresis::input>),
    relay_number("lower", "threshold on the way down", described_by<&Hysteresis::lower>, 0.0, true),
    relay_number("upper", "threshold on the way up", described_by<&Hysteresis::upper>, 0.0, true),
    relay_number("below", "value after the input has reached `lower`",
                 described_by<&Hysteresis::below>, 0.0),
    relay_number("above", "value after it has reached `upper`", described_by<&Hysteresis::above>,
                 1.0),
    {.name = "initial",
     .kind = KeyKind::word,
     .about = "which of both it is at a start between the thresholds",
     .words = relay_words,
     .member = described_by<&Hysteresis::initial>}};

ElementExample hysteresis_example(std::size_t, ExampleNumbers& numbers) {
  ElementExample x;
  Hysteresis f;
  f.input = x.linked_signal(numbers);
  f.lower = -1.0;
  f.upper = 1.0;
  x.states = {numbers(0.0, 1.0) > 0.5 ? 1.0 : 0.0};
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind hysteresis_element = [] {
  auto kind = block_kind<Hysteresis>("a relay with two thresholds", hysteresis_keys);
  kind.validate = validate_limits;
  kind.states = [](Element& element) { element.kept = 1; };
  kind.start = hysteresis_start;
  kind.after_step = hysteresis_after_step;
  kind.dual = hysteresis_law<Dual>;
  kind.side = hysteresis_side;
  return kind;
}();

constinit const ExampleMaker hysteresis_examples = hysteresis_example;

}  // namespace floatframe
