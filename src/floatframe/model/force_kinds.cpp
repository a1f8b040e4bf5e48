// The list of force elements at work: facts for load time, direct calls for step time.
#include <utility>

#include "floatframe/model/force_kind.hpp"

namespace floatframe {

namespace {

#define FLOATFRAME_KIND(name) &name##_element,
constexpr const ForceKind* force_list[] = {FLOATFRAME_FORCES(FLOATFRAME_KIND)};
#undef FLOATFRAME_KIND

/// Calls f<type> of the force's type: a chain of comparisons with direct calls.
template <std::size_t... I>
void evaluate_of(std::index_sequence<I...>, const ForceInput& in, ForceState& out) noexcept {
  ((in.force.type == static_cast<ForceType>(I) ? force_of<static_cast<ForceType>(I)>(in, out)
                                               : void()),
   ...);
}

using Types = std::make_index_sequence<std::size(force_types)>;

}  // namespace

const ForceKind& force_kind(ForceType type) noexcept { return *force_list[index_of(type)]; }

ForceAccount force_account(ForceType type) noexcept { return force_kind(type).account; }

bool force_has(ForceType type, ForceQuantity quantity) noexcept {
  return quantity == ForceQuantity::force || force_kind(type).measured;
}

const char* force_output_unit(const Force& force, ForceQuantity quantity) noexcept {
  if (!force_has(force.type, quantity)) return "";
  const ForceAxis axis = force_kind(force.type).axis;
  const ForceAxisUnits units = force_axis_units(
      axis == ForceAxis::about || (axis == ForceAxis::coordinate && force.rotational));
  const char* of[] = {units.force, units.displacement, units.rate};
  return of[index_of(quantity)];
}

void evaluate_force(const Model& model, const Force& force, const MarkerState& a,
                    const MarkerState& b, const Vec3& origin, double t, double reference_angle,
                    ForceState& out, std::span<const double> inputs) noexcept {
  const Vec3 zero = Vec3::Zero();
  out.wrench = {zero, zero, zero, zero};
  out.row_count = 0;
  out.force = out.length = out.rate = 0.0;
  out.energy = out.energy_rate = out.damping = 0.0;
  evaluate_of(Types{}, {model, force, a, b, origin, t, reference_angle, inputs}, out);
}

void add_example_drive(ForceExample& example, ExampleNumbers& numbers) {
  TimeFunction& f = example.force.magnitude;
  f.pieces = PiecewisePolynomial::polynomial({numbers(-5.0, 5.0), numbers(1.0, 3.0)});
  f.amplitude = numbers(1.0, 3.0);
  f.frequency = 2.0;
  example.force.driven = true;
  example.force.input = static_cast<int>(example.inputs.size());
  example.inputs.push_back(numbers(-50.0, 50.0));
  example.t = numbers(0.0, 1.0);
}

ForceExample example_load(ForceType type, bool follows, ExampleNumbers& numbers) {
  ForceExample x;
  x.force.type = type;
  x.force.follows = follows;
  x.force.axis = numbers.vector(2.0);
  add_example_drive(x, numbers);
  x.a = x.b = numbers.marker();
  return x;
}

PiecewisePolynomial example_spring(ExampleNumbers& numbers) {
  return PiecewisePolynomial::polynomial(
      {numbers(-80.0, 80.0), numbers(100.0, 400.0), numbers(-60.0, 60.0), numbers(10.0, 90.0)});
}

PiecewisePolynomial example_damper(ExampleNumbers& numbers) {
  return PiecewisePolynomial::polynomial({0.0, numbers(10.0, 50.0), numbers(-4.0, 4.0), 1.5});
}

}  // namespace floatframe
