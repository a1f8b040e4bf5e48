// Spring along an axis e fixed in the body of a (leaf spring). With d = r_b - r_a and the gradient
// g of e.d (axis_measure.hpp):
//   measure      s = e.(r_a - r_b) = -e.d, gradient -g
//   force        f = spring(s) + damper(sdot) + actuator, tension positive: f e on b, and -f e on
//                the body of a at the point r_b, which is -f e at r_a with the torque f e x d
// The row of the step contains f_s g g^T and the damping f_sdot g g^T.
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/local_formula.hpp"

namespace floatframe {

namespace {

template <class S>
AxisMeasure<S> guided_measure(const PortsOf<S>& in) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const V e = in.marker(0).R * in.template keys<GuidedSpring>().axis.template cast<S>();
  return axis_measure(e, in.marker(0), in.marker(1));
}

template <class S>
void guided_spring_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const AxisMeasure<S> m = guided_measure(in);
  out.length = -m.s;
  out.rate = -m.rate;
  const LawValue<S> s = spring_of(in, out.length), c = damper_of(in, out.rate);
  const ActuatorValue<S> a = actuator_of(in, out.length, out.rate);
  out.force = s.f + c.f + a.f;
  out.set_pair(out.force, m.g);
  out.add_pair_row(m.g, s.df + a.by_measure, c.df + a.by_rate);
  out.energy = energy_of(in.element.laws[0], out.length);
  out.energy_rate = s.f * out.rate;
  out.damping = c.f * out.rate;
}

}  // namespace

FLOATFRAME_LAW(guided_spring)

namespace {

BranchSide guided_spring_side(const Ports& in) noexcept {
  const AxisMeasure<double> m = guided_measure(in);
  if (in.element.switched) return local_formula_side(in, -m.s, -m.rate);
  return spring_side(in, -m.s, -m.rate);
}

constexpr const char* turning_axis = "the turning of the axis with its body";
constexpr ElementRegime guided_spring_regimes[] = {
    {.name = "anywhere", .rows_leave_out = turning_axis},
    {.name = "actuated", .rows_leave_out = turning_axis, .conservative = false},
    {.name = "formula", .rows_leave_out = turning_axis, .conservative = false}};

ElementExample guided_spring_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  GuidedSpring f;
  f.axis = numbers.direction();
  f.spring = example_spring(numbers);
  f.damper = example_damper(numbers);
  x.markers = {numbers.marker(), numbers.marker()};
  if (regime == 1) f.actuator = x.linked_signal(numbers);
  if (regime == 2) f.actuator = x.local_signal(numbers);
  x.keys(f);
  return x;
}

constexpr ElementKey guided_spring_keys[] = {
    place_key("reference", "on the body that carries the axis",
              described_by<&GuidedSpring::reference>),
    place_key("tip", "on the other body", described_by<&GuidedSpring::tip>),
    {.name = "axis",
     .kind = KeyKind::direction,
     .about = "fixed in the body of `reference`",
     .required = true,
     .member = described_by<&GuidedSpring::axis>},
    law_key("spring", KeyKind::spring, "of the length axis · (reference - tip)",
            described_by<&GuidedSpring::spring>),
    law_key("damper", KeyKind::damper, "of the rate of the length",
            described_by<&GuidedSpring::damper>),
    bump_stop_key,
    rebound_stop_key,
    law_key("actuator", KeyKind::load, "tension added to both",
            described_by<&GuidedSpring::actuator>)};

double length_along_axis(const ElementView& values, const ElementKey&) {
  return values.direction("axis").dot(values.place("reference").point - values.place("tip").point);
}

void guided_spring_validate(const ElementCheck& check) {
  check.two_bodies("reference", "tip");
  check.some_law();
}

bool guided_spring_build(ElementBuild& b) {
  auto& axis = b.keys<GuidedSpring>().axis;
  axis = axis.stableNormalized();
  const bool reference = b.connect("reference", true), tip = b.connect("tip", false);
  return reference && tip;
}

Picture guided_spring_picture(const Element& element) {
  return {.symbol = Picture::Symbol::spring,
          .a = element.markers[0],
          .b = element.markers[1],
          .axis = std::get<GuidedSpring>(*element.keys).axis,
          .axis_of = element.markers[0]};
}

}  // namespace

constinit const ElementKind guided_spring_element = {
    .about =
        "spring and damper along an axis fixed in a body, between the tip and the point of that "
        "body that slides with it (leaf spring); tension pulls the tip along +axis",
    .keys = guided_spring_keys,
    .blank = [] { return ElementKeys(GuidedSpring()); },
    .free_value = length_along_axis,
    .validate = guided_spring_validate,
    .build = guided_spring_build,
    .local_actuator = true,
    .dual = guided_spring_law<Dual>,
    .side = guided_spring_side,
    .picture = guided_spring_picture,
    .regimes = guided_spring_regimes};

constinit const ExampleMaker guided_spring_examples = guided_spring_example;

}  // namespace floatframe
