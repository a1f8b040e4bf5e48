// Low pass with T = time = 1 / (2 pi frequency), of first or second order:
//   T ydot = u - y                                                                             (1)
//   T ydot = x,  T xdot = u - y - 2 damping x                                                  (2)
#include <numbers>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

template <class S>
void filter_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  linear_block_law(in, out);
}

}  // namespace

FLOATFRAME_LAW(filter)

namespace {

constexpr ElementKey low_pass_number(const char* name, const char* about, const char* unit,
                                     KeyMember member) {
  return {.name = name,
          .kind = KeyKind::number,
          .about = about,
          .rule = positive_number(unit),
          .fallback = no_number,
          .member = member};
}
constexpr ElementKey filter_keys[] = {
    input_key(described_by<&LowPass::input>),
    low_pass_number("time", "time constant T; or ...", "s", described_by<&LowPass::time>),
    low_pass_number("frequency", "... 1/(2π T)", "Hz", described_by<&LowPass::frequency>),
    low_pass_number("damping", "ratio of a filter of second order; without it the first order", "",
                    described_by<&LowPass::damping>),
    block_start_key(described_by<&LowPass::initial>)};

void filter_validate(const ElementCheck& check) {
  const bool time = check.given("time"), frequency = check.given("frequency");
  if (time && frequency)
    check.error(ErrorCode::exclusive, "frequency", sentences::excludes("time"));
  if (!time && !frequency)
    check.error(ErrorCode::incomplete, "", sentences::none_given({"time", "frequency"}));
}

void filter_states(Element& element) {
  const auto& keys = *std::get_if<LowPass>(element.keys.get());
  const double w = keys.time ? 1.0 / *keys.time : 2.0 * std::numbers::pi * *keys.frequency;
  LinearBlock block{MatX{{-w}}, MatX{{w}}, MatX{{1.0}}, MatX{{0.0}}, {}};
  if (keys.damping) {
    block.A = MatX{{0.0, w}, {-w, -2.0 * *keys.damping * w}};
    block.B = MatX{{0.0}, {w}};
    block.C = MatX{{1.0, 0.0}};
  }
  take_linear_block(element, std::move(block), keys.initial);
}

constexpr ElementRegime filter_regimes[] = {
    {.name = "first_order", .conservative = false, .acts = false},
    {.name = "second_order", .conservative = false, .acts = false}};

ElementExample filter_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  LowPass f;
  f.input = x.linked_signal(numbers);
  if (regime == 0) f.time = numbers(0.1, 0.5);
  if (regime == 1) f.frequency = numbers(0.5, 2.0), f.damping = numbers(0.3, 1.0);
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind filter_element = [] {
  auto kind = block_kind<LowPass>("a low pass of first or second order", filter_keys);
  kind.validate = filter_validate;
  kind.states = filter_states;
  kind.start = start_linear_block;
  kind.dual = filter_law<Dual>;
  kind.regimes = filter_regimes;
  return kind;
}();

constinit const ExampleMaker filter_examples = filter_example;

}  // namespace floatframe
