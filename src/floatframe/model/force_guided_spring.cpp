// Spring along an axis e fixed in the body of a (leaf spring): s = e.(r_a - r_b). The reaction acts
// on the body of a at the point r_b. With the gradient g of e.d (axis_measure.hpp) s has -g:
//   stiffness    f_s g g^T + f_sdot g g'^T - f dg/d(motion),   damping   f_sdot g g^T
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/force_kind.hpp"

namespace floatframe {

template <>
void force_of<ForceType::guided_spring>(const ForceInput& in, ForceState& out) noexcept {
  const AxisMeasure m = axis_measure(in.a.R * in.force.axis, in.a, in.b);
  out.length = -m.s;
  out.rate = -m.rate;
  const PiecewisePolynomial::Value s = in.force.spring(out.length), c = in.force.damper(out.rate);
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

constexpr const char* turning = "the turning of the axis with its body";
constexpr ForceRegime regimes[] = {
    {.name = "anywhere", .rows_leave_out = turning},
    {.name = "actuated", .rows_leave_out = turning, .conservative = false}};

ForceExample example(std::size_t regime, ExampleNumbers& numbers) {
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

}  // namespace

const ForceKind guided_spring_kind{ForceType::guided_spring,
                                   "guided_spring",
                                   true,
                                   force_of<ForceType::guided_spring>,
                                   force_tangent_of<ForceType::guided_spring>,
                                   regimes,
                                   example};

}  // namespace floatframe
