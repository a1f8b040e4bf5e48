// Friction on a coordinate of a joint by the bristles of bristle_law.hpp, which give f and zdot,
// with the normal force N as a factor:
//   F = N f + viscous v,  -F acts on the coordinate
//   N = radius max(0, normal + preload); radius without both
// z is measured along the coordinate.
//   row          c = N f_v + viscous, f_v with z following
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/bristle_law.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

Bristles bristles_of(const BristleFriction& keys) noexcept {
  return {keys.breakaway, keys.kinetic.value_or(keys.breakaway),
          keys.stribeck,  keys.stiffness,
          keys.damping,   keys.elastic};
}

/// N
template <class S>
S normal_of_bristles(const BristleFriction& keys, const PortsOf<S>& in) noexcept {
  const bool clamped = in.element.signals[0].given;
  if (!clamped && !keys.preload) return keys.radius;
  const S normal = in.signal(0).f + keys.preload.value_or(0.0);
  return value_of(normal) > 0.0 ? S(keys.radius * normal) : S(0.0);
}

template <class S>
void bristle_friction_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto& keys = in.template keys<BristleFriction>();
  const AxisMeasure<S> m = coordinate_measure(in, in.template data<MeasuredCoordinate>());
  const bool clamped = in.element.signals[0].given;
  const S normal = normal_of_bristles(keys, in);
  const Bristles bristles = bristles_of(keys);
  const S z = in.state(0), v = m.rate, flow = bristle_rate(bristles, z, v);
  out.state_rates[0] = flow;
  double slope = 0.0;
  if constexpr (std::is_same_v<S, double>) {
    const BristleSlopes of = bristle_slopes(bristles, in, z, v);
    out.state_slopes[0] = of.of_state;
    slope = value_of(normal) * of.of_speed + keys.viscous;
  }
  pull_back(m, S(normal * S(keys.stiffness * z + keys.damping * flow) + keys.viscous * v), 0.0,
            slope, out);
  // What a clamp that varies stores in the bristles counts as dissipated.
  if (!clamped) {
    out.energy = 0.5 * keys.stiffness * normal * z * z;
    out.energy_rate = keys.stiffness * normal * z * flow;
  }
  out.damping = out.force * v - out.energy_rate;
}

}  // namespace

FLOATFRAME_LAW(bristle_friction)

namespace {

constexpr ElementKey number_key(const char* name, const char* about, NumberRule rule,
                                double fallback, KeyMember member, bool required = false) {
  return {.name = name,
          .kind = KeyKind::number,
          .about = about,
          .required = required,
          .rule = rule,
          .fallback = fallback,
          .member = member};
}
constexpr ElementKey bristle_friction_keys[] = {
    joint_key(described_by<&BristleFriction::joint>),
    coordinate_key(described_by<&BristleFriction::coordinate>),
    number_key("breakaway", "friction at which it begins to slide, times `normal`",
               positive_number("N or N m"), 0.0, described_by<&BristleFriction::breakaway>, true),
    number_key("kinetic", "the same while it slides; without it `breakaway`",
               positive_number("N or N m"), no_number, described_by<&BristleFriction::kinetic>),
    number_key("stribeck", "speed of the fall from `breakaway` to `kinetic`",
               non_negative_number("m/s or rad/s"), 0.0, described_by<&BristleFriction::stribeck>),
    number_key("stiffness", "of the bristles, times `normal`", positive_number("N/m or N m/rad"),
               0.0, described_by<&BristleFriction::stiffness>, true),
    number_key("damping", "of the bristles, times `normal`",
               non_negative_number("N s/m or N m s/rad"), 0.0,
               described_by<&BristleFriction::damping>),
    number_key("viscous", "added, times q̇", non_negative_number("N s/m or N m s/rad"), 0.0,
               described_by<&BristleFriction::viscous>),
    number_key("elastic",
               "part of the largest deflection up to which nothing slides; 0: the LuGre model, "
               "which creeps under loads that vary",
               {"a number from 0 to 0.999", "", 0.0, 0.999}, 0.95,
               described_by<&BristleFriction::elastic>),
    law_key("normal", KeyKind::load,
            "a factor of the friction, not negative: a normal or clamping force [N]",
            described_by<&BristleFriction::normal>, ElementAxis::along),
    number_key("preload", "added to `normal`", non_negative_number("N"), no_number,
               described_by<&BristleFriction::preload>),
    number_key("radius", "a factor of `normal`: the lever arm of a brake or clutch",
               positive_number("m"), 1.0, described_by<&BristleFriction::radius>)};

void bristle_friction_validate(const ElementCheck& check) {
  validate_any_coordinate(check);
  if (const auto normal = check.good("normal") ? check.signal("normal") : std::nullopt)
    if (const auto complaint = sentences::normal_force(*normal))
      check.error(ErrorCode::out_of_range, "normal", *complaint);
  if (!check.good("kinetic") || !check.good("breakaway")) return;
  if (const auto complaint =
          sentences::kinetic_friction(check.number("kinetic"), check.number("breakaway")))
    check.error(ErrorCode::out_of_range, "kinetic", *complaint);
}

bool bristle_friction_build(ElementBuild& build) {
  const auto coordinate = build_any_coordinate(build);
  if (!coordinate) return false;
  build.element.data = std::make_shared<const MeasuredCoordinate>(*coordinate);
  return true;
}

void bristle_friction_start(const Ports& in, double* states) noexcept {
  states[0] = bristle_start(bristles_of(in.keys<BristleFriction>()),
                            coordinate_measure(in, in.data<MeasuredCoordinate>()).rate);
}

constexpr const char* turning_axis_of_friction = "the turning of the axis with its body";
constexpr ElementRegime bristle_friction_regimes[] = {
    {.name = "sticks", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "slides_about", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "lugre_along", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "about_first_axis", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "clamped", .rows_leave_out = turning_axis_of_friction, .conservative = false}};

ElementExample bristle_friction_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  BristleFriction f;
  f.breakaway = numbers(2.0, 3.0);
  f.kinetic = numbers(1.0, 2.0);
  f.stribeck = numbers(0.5, 1.0);
  f.stiffness = numbers(1.0, 3.0);
  f.damping = numbers(0.1, 0.5);
  f.viscous = numbers(0.1, 0.5);
  f.elastic = regime == 2 ? 0.0 : regime == 1 ? 0.2 : 0.9;
  const bool about = regime == 1, first = regime == 3;
  const MarkerState a = numbers.marker();
  x.markers = {a, about ? numbers.marker_on_axis(a) : numbers.marker()};
  MeasuredCoordinate on;
  if (!about) on = {MeasuredCoordinate::Of::displacement, numbers.direction(), Vec3::UnitX()};
  if (first) on = {MeasuredCoordinate::Of::first_angle, Vec3::UnitZ(), Vec3(0.96, 0.0, 0.28)};
  if (regime == 4) f.normal = x.linked_signal(numbers);
  if (regime >= 3) f.preload = numbers(60.0, 80.0);
  if (regime >= 3) f.radius = numbers(0.01, 0.02);
  x.keys(f);
  x.element.rotational = about || first;
  x.element.data = std::make_shared<const MeasuredCoordinate>(on);
  const double part = regime == 1 ? numbers(0.6, 0.9) : numbers(-0.3, 0.3);
  x.states = {part * *f.kinetic / f.stiffness};
  x.state_weight = numbers(0.5, 200.0);
  return x;
}

}  // namespace

constinit const ElementKind bristle_friction_element = {
    .about =
        "friction on a coordinate of a joint that sticks: bristles bend up to the breakaway "
        "force without creeping",
    .keys = bristle_friction_keys,
    .joint_word = "friction",
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(BristleFriction()); },
    .validate = bristle_friction_validate,
    .build = bristle_friction_build,
    .states = [](Element& element) { element.states = 1; },
    .start = bristle_friction_start,
    .dual = bristle_friction_law<Dual>,
    .picture = picture_of_coordinate,
    .regimes = bristle_friction_regimes,
    .example = bristle_friction_example};

}  // namespace floatframe
