// Dispatch of the force elements: data for load time, direct calls for step time.
#include <algorithm>
#include <limits>
#include <utility>

#include "floatframe/model/force_kind.hpp"
#include "floatframe/model/sentences.hpp"

namespace floatframe {

namespace {

#define FLOATFRAME_KIND(name) &name##_element,
constexpr const ForceKind* force_list[] = {FLOATFRAME_FORCES(FLOATFRAME_KIND)};
#undef FLOATFRAME_KIND

/// Calls f<type> for the force's type: a chain of comparisons with direct calls, up to the
/// match.
template <std::size_t... I>
void evaluate_of(std::index_sequence<I...>, const ForceInput& in, ForceState& out) noexcept {
  (void)((in.force.type == static_cast<ForceType>(I) &&
          (force_of<static_cast<ForceType>(I)>(in, out), true)) ||
         ...);
}

using Types = std::make_index_sequence<std::size(force_types)>;

}  // namespace

const ForceKind& force_kind(ForceType type) noexcept { return *force_list[index_of(type)]; }

EnergyCategory energy_category(ForceType type) noexcept { return force_kind(type).energy; }

bool ends_at_half_turn(const Force& force) noexcept {
  const auto ends = force_kind(force.type).ends_at_half_turn;
  return ends != nullptr && ends(force);
}

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
                    ForceState& out, std::span<const double> inputs, std::int64_t branch) noexcept {
  const Vec3 zero = Vec3::Zero();
  out.wrench = {zero, zero, zero, zero};
  out.row_count = 0;
  out.force = out.length = out.rate = 0.0;
  out.energy = out.energy_rate = out.damping = 0.0;
  evaluate_of(Types{}, {model, force, a, b, origin, t, reference_angle, inputs, branch}, out);
}

bool has_branches(const Force& force) noexcept {
  if (force_kind(force.type).side == nullptr) return false;
  return force.road >= 0 || !force.spring.edges().empty() || !force.damper.edges().empty();
}

ForceSide force_side(const Model& model, const Force& force, const MarkerState& a,
                     const MarkerState& b, const Vec3& origin, double t, double reference_angle,
                     std::span<const double> inputs, std::int64_t branch) noexcept {
  return force_kind(force.type)
      .side({model, force, a, b, origin, t, reference_angle, inputs, branch});
}

Mat3 element_axes(const ForceView& values) {
  const Vec3 z = values.direction("axis").stableNormalized(),
             v = values.direction("axis_2").stableNormalized();
  Mat3 R;
  R.col(2) = z;
  R.col(0) = (v - z.dot(v) * z).normalized();
  R.col(1) = z.cross(R.col(0));
  return R;
}

void validate_framed(const ForceCheck& check) {
  check.two_bodies("from", "to");
  if (!check.wrong.contains("axis") && !check.wrong.contains("axis_2"))
    if (const auto complaint =
            sentences::second_axis(check.direction("axis"), check.direction("axis_2")))
      check.error(ErrorCode::geometry, "axis_2", *complaint);
  check.some_law();
}

StretchSide stretch_side(const PiecewisePolynomial& f, std::size_t k, double x) noexcept {
  const std::vector<double>& edges = f.edges();
  constexpr double nowhere = -std::numeric_limits<double>::max();
  k = std::min(k, edges.size());
  const double left = k > 0 ? edges[k - 1] - x : nowhere;
  const double right = k < edges.size() ? x - edges[k] : nowhere;
  if (left > right) return {left, k - 1};
  return {right, std::min(k + 1, edges.size())};
}

ForceSide spring_side(const ForceInput& in, double x, double rate) noexcept {
  const PiecewisePolynomial &spring = in.force.spring, &damper = in.force.damper;
  if (in.branch == free_branch)
    return {-1.0, SpringBranch::of(spring.stretch_index(x), damper.stretch_index(rate))};
  const SpringBranch held{in.branch};
  const StretchSide s = stretch_side(spring, held.spring(), x);
  const StretchSide d = stretch_side(damper, held.damper(), rate);
  if (s.beyond > d.beyond) return {s.beyond, SpringBranch::of(s.next, held.damper())};
  return {d.beyond, SpringBranch::of(held.spring(), d.next)};
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
