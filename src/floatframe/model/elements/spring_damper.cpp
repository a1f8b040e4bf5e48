// Spring and damper along the line between two points: s = |d|, d = r_b - r_a, n = d/s,
// f = spring(s - target) + damper(sdot - rate of the target) + actuator: with a target a cylinder
// that is driven.
//   wrench       f n on a, -f n on b
//   rows         f_s n n^T + f/s (I - n n^T) and the damping f_sdot n n^T, between the points
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/local_formula.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

template <class S>
void spring_damper_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const LineMeasure<S> line = line_measure(in);
  const TowardTarget<S> x = toward_target(in, line.length, line.rate);
  const LawValue<S> s = spring_of(in, x.stretch), c = damper_of(in, x.rate);
  const ActuatorValue<S> a = actuator_of(in, line.length, line.rate);
  pull_along(line, S(s.f + c.f + a.f), s.df + a.by_measure, c.df + a.by_rate, out);
  out.energy = energy_of(in.element.laws[0], x.stretch);
  out.energy_rate = s.f * (line.rate - x.moves);
  out.damping = c.f * x.rate;
}

}  // namespace

FLOATFRAME_LAW(spring_damper)

namespace {

BranchSide spring_damper_side(const Ports& in) noexcept {
  const LineMeasure<double> line = line_measure(in);
  if (in.element.switched) return local_formula_side(in, line.length, line.rate);
  const TowardTarget<double> x = toward_target(in, line.length, line.rate);
  return spring_side(in, x.stretch, x.rate);
}

constexpr ElementRegime spring_damper_regimes[] = {{.name = "anywhere"},
                                                   {.name = "short"},
                                                   {.name = "points_coincide", .regular = false},
                                                   {.name = "actuated", .conservative = false},
                                                   {.name = "driven", .conservative = false},
                                                   {.name = "formula", .conservative = false}};

ElementExample spring_damper_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  SpringDamper f;
  f.spring = example_spring(numbers);
  f.damper = example_damper(numbers);
  MarkerState a = numbers.marker(), b = numbers.marker();
  if (regime == 1) b.r = a.r + 0.1 * numbers.direction();
  if (regime == 2) b.r = a.r;
  if (regime == 3) f.actuator = x.linked_signal(numbers);
  if (regime == 4) {
    f.target = x.signal(numbers);
    f.target->pieces = PiecewisePolynomial::polynomial({0.1, numbers(-1.0, 1.0)});
    f.target->sines.clear();
    f.target_rate = x.signal(numbers);
    x.inputs[0] *= 0.01;
    x.t = numbers(0.0, 1.0);
  }
  if (regime == 5) f.actuator = x.local_signal(numbers);
  x.markers = {a, b};
  x.keys(f);
  return x;
}

constexpr ElementKey spring_damper_keys[] = {
    place_key("from", "one end", described_by<&SpringDamper::a>),
    place_key("to", "the other end", described_by<&SpringDamper::b>),
    law_key("spring", KeyKind::spring, "of the length", described_by<&SpringDamper::spring>),
    law_key("damper", KeyKind::damper, "of the rate of the length",
            described_by<&SpringDamper::damper>),
    bump_stop_key,
    rebound_stop_key,
    law_key("actuator", KeyKind::load, "tension added to both",
            described_by<&SpringDamper::actuator>),
    law_key("target", KeyKind::target,
            "the length that `spring`, a law of length - target, pulls to",
            described_by<&SpringDamper::target>),
    law_key("target_rate", KeyKind::target_rate, "the rate that `damper` pulls to",
            described_by<&SpringDamper::target_rate>)};

/// Of a file; a spring with a target is a law of the distance from it.
double distance_in_design(const ElementView& values, const ElementKey&) {
  if (values.description().origin.keys.contains("target")) return 0.0;
  return (values.place("from").point - values.place("to").point).norm();
}

void spring_damper_validate(const ElementCheck& check) {
  validate_line(check);
  check.some_law();
  validate_target(check);
  for (const char* stop : {"bump_stop", "rebound_stop"})
    if (check.given("target") && check.given(stop))
      check.error(ErrorCode::exclusive, stop, sentences::stop_with_target());
}

}  // namespace

constinit const ElementKind spring_damper_element = {
    .about = "spring and damper along the line between two points; tension is positive",
    .keys = spring_damper_keys,
    .blank = [] { return ElementKeys(SpringDamper()); },
    .free_value = distance_in_design,
    .validate = spring_damper_validate,
    .build = build_line,
    .along_line = true,
    .local_actuator = true,
    .dual = spring_damper_law<Dual>,
    .side = spring_damper_side,
    .picture = picture_of_line,
    .regimes = spring_damper_regimes};

constinit const ExampleMaker spring_damper_examples = spring_damper_example;

}  // namespace floatframe
