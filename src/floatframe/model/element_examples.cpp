// Examples of elements for the tests that run over all kinds.
#include <string>

#include "floatframe/model/element_kind.hpp"

namespace floatframe {
namespace {

#define FLOATFRAME_KIND(name, Keys) &name##_examples,
constexpr const ExampleMaker* makers[] = {FLOATFRAME_ELEMENTS(FLOATFRAME_KIND)};
#undef FLOATFRAME_KIND

}  // namespace

ElementExample element_example(ElementType type, std::size_t regime, ExampleNumbers& numbers) {
  return (*makers[index_of(type)])(regime, numbers);
}

SignalDescription ElementExample::signal(ExampleNumbers& numbers) {
  SignalDescription s;
  s.pieces = PiecewisePolynomial::polynomial({numbers(-5.0, 5.0), numbers(1.0, 3.0)});
  s.sines = {{.amplitude = numbers(1.0, 3.0), .frequency = 2.0}};
  s.input = "u" + std::to_string(inputs.size());
  model.inputs.emplace_back().name = s.input;
  inputs.push_back(numbers(-50.0, 50.0));
  return s;
}

SignalDescription ElementExample::linked_signal(ExampleNumbers& numbers) {
  SignalDescription s = signal(numbers);
  s.source = SignalSource::force;
  links.push_back(numbers(-5.0, 5.0));
  return s;
}

void ElementExample::link_signals() {
  int link = 0;
  const std::vector<std::optional<SignalDescription>> values =
      signal_values({element.name, *element.keys, {}});
  model.links.resize(links.size());
  for (std::size_t port = 0; port < values.size(); ++port)
    if (values[port] && values[port]->source != SignalSource::none)
      element.signals[port].link = link++;
}

PiecewisePolynomial example_spring(ExampleNumbers& numbers) {
  return PiecewisePolynomial::polynomial(
      {numbers(-80.0, 80.0), numbers(100.0, 400.0), numbers(-60.0, 60.0), numbers(10.0, 90.0)});
}

PiecewisePolynomial example_damper(ExampleNumbers& numbers) {
  return PiecewisePolynomial::polynomial({0.0, numbers(10.0, 50.0), numbers(-4.0, 4.0), 1.5});
}

}  // namespace floatframe
