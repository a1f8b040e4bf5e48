// Spring along an axis e fixed in the body of a (leaf spring). With d = r_b - r_a and the gradient
// g of e.d (axis_measure.hpp):
//   measure      s = e.(r_a - r_b) = -e.d, gradient -g
//   force        f = spring(s) + damper(sdot) + actuator, tension positive: f e on b, and -f e on
//                the body of a at the point r_b, which is -f e at r_a with the torque f e x d
//   stiffness    f_s g g^T + f_sdot g g'^T - f dg/d(motion),   damping   f_sdot g g^T
// The row of the step contains f_s g g^T and the damping.
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/force_kind.hpp"

namespace floatframe {

template <>
void force_of<ForceType::guided_spring>(const ForceInput& in, ForceState& out) noexcept {
  const AxisMeasure m = axis_measure(in.a.R * in.force.axis, in.a, in.b);
  out.length = -m.s;
  out.rate = -m.rate;
  const PiecewisePolynomial::Value s = spring_of(in, out.length), c = damper_of(in, out.rate);
  out.force = s.f + c.f + in.actuator();
  out.wrench = {out.force * m.g.Fa, out.force * m.g.Ta, out.force * m.g.Fb, Vec3::Zero()};
  out.rows[0] = {{-m.g.Fa, -m.g.Ta, -m.g.Fb, Vec3::Zero()}, s.df, c.df};
  out.row_count = 1;
  out.energy = law_energy(in.force.spring, out.length);
  out.energy_rate = s.f * out.rate;
  out.damping = c.f * out.rate;
}

template <>
void force_tangent_of<ForceType::guided_spring>(const ForceInput& in, ForceTangent& out) noexcept {
  const Vec3 e = in.a.R * in.force.axis;
  const AxisMeasure m = axis_measure(e, in.a, in.b);
  const PiecewisePolynomial::Value s = in.force.spring(-m.s), c = in.force.damper(-m.rate);
  const Vec12 g = stacked(m.g);
  out.K.noalias() = s.df * g * g.transpose();
  out.K.noalias() += c.df * g * axis_rate_gradient(e, in.a, in.b).transpose();
  add_axis_curvature(e, in.a, in.b, -(s.f + c.f + in.actuator()), out.K);
  out.C.noalias() = c.df * g * g.transpose();
}

namespace {

ForceSide guided_spring_side(const ForceInput& in) noexcept {
  const AxisMeasure m = axis_measure(in.a.R * in.force.axis, in.a, in.b);
  return spring_side(in, -m.s, -m.rate);
}

constexpr const char* turning_axis = "the turning of the axis with its body";
constexpr ForceRegime guided_spring_regimes[] = {
    {.name = "anywhere", .rows_leave_out = turning_axis},
    {.name = "actuated", .rows_leave_out = turning_axis, .conservative = false}};

ForceExample guided_spring_example(std::size_t regime, ExampleNumbers& numbers) {
  ForceExample x;
  x.force.type = ForceType::guided_spring;
  x.force.axis = numbers.direction();
  x.force.spring = example_spring(numbers);
  x.force.damper = example_damper(numbers);
  x.a = numbers.marker();
  x.b = numbers.marker();
  if (regime == 1) add_example_drive(x, numbers);
  return x;
}

using G = GuidedSpringDescription;

constexpr ForceKey guided_spring_keys[] = {
    place_key("reference", "on the body that carries the axis", described_by<&G::reference>),
    place_key("tip", "on the other body", described_by<&G::tip>),
    {.name = "axis",
     .kind = ForceKeyKind::direction,
     .about = "fixed in the body of `reference`",
     .required = true,
     .member = described_by<&G::axis>},
    law_key("spring", ForceKeyKind::spring, "of the length axis · (reference - tip)",
            described_by<&G::spring>),
    law_key("damper", ForceKeyKind::damper, "of the rate of the length", described_by<&G::damper>),
    bump_stop_key,
    rebound_stop_key,
    law_key("actuator", ForceKeyKind::load, "tension added to both", described_by<&G::actuator>)};

double length_along_axis(const ForceView& values, const ForceKey&) {
  return values.direction("axis").dot(values.place("reference").point - values.place("tip").point);
}

void guided_spring_validate(const ForceCheck& check) {
  check.two_bodies("reference", "tip");
  check.some_law();
}

bool guided_spring_build(ForceBuild& b) {
  b.force.a = b.marker("reference", true);
  b.force.b = b.marker("tip", false);
  b.force.axis = b.unit_direction("axis");
  b.spring_damper_actuator();
  return b.has_ends();
}

}  // namespace

constinit const ForceKind guided_spring_element = {
    .about =
        "spring and damper along an axis fixed in a body, between the tip and the point of that "
        "body that slides with it (leaf spring); tension pulls the tip along +axis",
    .keys = guided_spring_keys,
    .blank = [] { return ForceDescription::Values(G()); },
    .free_value = length_along_axis,
    .validate = guided_spring_validate,
    .build = guided_spring_build,
    .side = guided_spring_side,
    .regimes = guided_spring_regimes,
    .example = guided_spring_example};

}  // namespace floatframe
