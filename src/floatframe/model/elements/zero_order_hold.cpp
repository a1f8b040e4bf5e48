// The input, sampled and held (model/sampling.hpp).
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

template <class S>
void zero_order_hold_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  out.force = in.state(0);
}

}  // namespace

FLOATFRAME_LAW(zero_order_hold)

namespace {

constexpr auto zero_order_hold_sampling = sampling_keys<ZeroOrderHold>(true);
constexpr ElementKey zero_order_hold_keys[] = {input_key(described_by<&ZeroOrderHold::input>),
                                               {.name = "initial",
                                                .kind = KeyKind::number,
                                                .about = "value until the first sample acts",
                                                .member = described_by<&ZeroOrderHold::initial>},
                                               zero_order_hold_sampling[0],
                                               zero_order_hold_sampling[1],
                                               zero_order_hold_sampling[2]};

ElementExample zero_order_hold_example(std::size_t, ExampleNumbers& numbers) {
  ElementExample x;
  ZeroOrderHold f;
  f.input = x.linked_signal(numbers);
  f.period = 0.1;
  f.delay = 0.25;
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind zero_order_hold_element = [] {
  auto kind = block_kind<ZeroOrderHold>("its input, sampled at instants and held between them",
                                        zero_order_hold_keys);
  kind.validate = validate_sampling;
  kind.states = [](Element& element) {
    take_clock(element, *std::get_if<ZeroOrderHold>(element.keys.get()));
  };
  kind.start = [](const Ports& in, double* kept) noexcept {
    std::fill_n(kept, in.element.kept, in.keys<ZeroOrderHold>().initial);
  };
  kind.sample = [](const Ports& in, double*, double* y) noexcept { *y = in.signal(0).f; };
  kind.dual = zero_order_hold_law<Dual>;
  return kind;
}();

constinit const ExampleMaker zero_order_hold_examples = zero_order_hold_example;

}  // namespace floatframe
