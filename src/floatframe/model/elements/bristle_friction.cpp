// Friction on a coordinate of a joint by the bristles of bristle_law.hpp, which give f and zdot,
// with the normal force N as a factor:
//   F = N f + viscous v,  -F acts on the coordinate
//   N = radius max(0, normal + preload); radius without both
// With `reaction` N = radius max(0, normal + preload) + the load of the joint (joint_load.hpp), the
// kept number, constant in the derivatives of the law.
// z is measured along the coordinate.
//   row          c = N f_v + viscous, f_v with z following
// At rest z follows the coordinate from where it was: k = N sigma_0 while it sticks, 0 beyond.
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/bristle_law.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
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
  if (!clamped && !keys.preload && !keys.reaction) return keys.radius;
  const S normal = in.signal(0).f + keys.preload.value_or(0.0);
  const double load = keys.reaction ? value_of(in.state(1)) : 0.0;
  return value_of(normal) > 0.0 ? S(keys.radius * normal + load) : S(load);
}

template <class S>
void bristle_friction_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto& keys = in.template keys<BristleFriction>();
  const AxisMeasure<S> m = coordinate_measure(in, in.template data<MeasuredCoordinate>());
  const bool clamped = in.element.signals[0].given;
  const S normal = normal_of_bristles(keys, in);
  const Bristles bristles = bristles_of(keys);
  const S z = in.state(0), v = m.rate, flow = bristle_flow(bristles, in, z, v);
  out.state_rates[0] = flow;
  double slope = 0.0, of_place = 0.0;
  if constexpr (std::is_same_v<S, double>) {
    const BristleSlopes of = bristle_slopes(bristles, in, z, v);
    out.state_slopes[0] = of.of_state;
    slope = value_of(normal) * of.of_speed + keys.viscous;
    of_place = value_of(normal) * of.of_place;
  }
  pull_back(m, S(normal * S(keys.stiffness * z + keys.damping * flow) + keys.viscous * v), of_place,
            slope, out);
  // What a normal force that varies stores in the bristles counts as dissipated.
  if (!clamped && !keys.reaction) {
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
               positive_number("m"), 1.0, described_by<&BristleFriction::radius>),
    {.name = "reaction",
     .kind = KeyKind::flag,
     .about = "what the bearing of the joint carries is a part of the normal force",
     .member = described_by<&BristleFriction::reaction>},
    number_key("bearing_radius", "of the pin: lever arm of the reaction across the axis",
               positive_number("m"), no_number, described_by<&BristleFriction::bearing_radius>),
    number_key("axial_radius",
               "of the shoulder, or the mean one of a thread: lever arm of that along the axis",
               positive_number("m"), no_number, described_by<&BristleFriction::axial_radius>),
    number_key("bearing_length",
               "at whose ends the bearing carries moments; without it it has none",
               positive_number("m"), no_number, described_by<&BristleFriction::bearing_length>)};

/// All coordinates are along or about the axis, so that nothing that moves is a reaction.
bool bears_by_its_axis(JointType type) {
  bool axial = joint_velocities(type) > 0;
  for (int k = 0; k < joint_velocities(type); ++k) {
    const auto axis = coordinate_axis(type, Vec3::UnitX(), k);
    axial = axial && axis && axis->direction.head<2>().isZero(0.0);
  }
  return axial;
}

constexpr const char* keys_of_bearings[] = {"bearing_radius", "axial_radius", "bearing_length"};

void validate_reaction(const ElementCheck& check) {
  if (check.wrong.contains("reaction")) return;
  if (!check.flag("reaction")) {
    for (const char* key : keys_of_bearings)
      if (check.good(key))
        check.error(ErrorCode::incomplete, key,
                    sentences::is_for("friction with 'reaction: true'"));
    return;
  }
  if (!check.good("joint") || check.wrong.contains("coordinate")) return;
  const CoordinateTerm of = check.coordinates().front();
  const auto type = check.joint_type(of.joint);
  const int k = std::max(0, of.coordinate);
  if (!type || k >= joint_velocities(*type)) return;
  if (!bears_by_its_axis(*type)) {
    check.error(ErrorCode::unsupported, "reaction", sentences::reaction_of(joint_type_name(*type)));
    return;
  }
  const auto said = [&](const char* key) { return check.has(key) || check.wrong.contains(key); };
  if (joint_unit(*type, k) != JointUnit::rad) {
    for (const char* key : {"bearing_radius", "axial_radius"})
      if (check.good(key)) check.error(ErrorCode::wrong_value, key, sentences::is_for("angles"));
  } else if (!said("bearing_radius") && !said("axial_radius")) {
    check.error(ErrorCode::incomplete, "reaction",
                "of an angle needs a lever arm, expected 'bearing_radius' or 'axial_radius'");
  } else if (check.good("bearing_length") && !said("bearing_radius")) {
    check.error(ErrorCode::incomplete, "bearing_length",
                sentences::is_for("bearings with a 'bearing_radius'"));
  }
}

void bristle_friction_validate(const ElementCheck& check) {
  validate_any_coordinate(check);
  validate_reaction(check);
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
  const auto& keys = build.keys<BristleFriction>();
  if (!keys.reaction) return true;
  LoadPort& load = build.element.load;
  load.joint = build.element.coordinates[0].joint;
  load.across = build.element.rotational ? keys.bearing_radius.value_or(0.0) : 1.0;
  load.along = keys.axial_radius.value_or(0.0);
  load.length = keys.bearing_length.value_or(0.0);
  return true;
}

void bristle_friction_states(Element& element) {
  element.states = 1;
  element.kept = std::get<BristleFriction>(*element.keys).reaction ? 1 : 0;
}

void bristle_friction_start(const Ports& in, double* states) noexcept {
  states[0] = bristle_start(bristles_of(in.keys<BristleFriction>()),
                            coordinate_measure(in, in.data<MeasuredCoordinate>()).rate);
}

Deflection deflection_of_bristles(const Ports& in, int) noexcept {
  return {coordinate_measure(in, in.data<MeasuredCoordinate>()).s,
          largest_deflection(bristles_of(in.keys<BristleFriction>()), 0.0)};
}

std::string bristle_friction_linear_note(const Element& element) {
  if (element.load.joint < 0) return "";
  return element_name(element) +
         " takes its normal force from the reaction of its joint: the linear system holds that of "
         "its state";
}

constexpr const char* turning_axis_of_friction = "the turning of the axis with its body";
constexpr ElementRegime bristle_friction_regimes[] = {
    {.name = "sticks", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "slides_about", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "lugre_along", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "about_first_axis", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "clamped", .rows_leave_out = turning_axis_of_friction, .conservative = false},
    {.name = "by_reaction", .rows_leave_out = turning_axis_of_friction, .conservative = false}};

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
  f.reaction = regime == 5;
  x.keys(f);
  x.element.rotational = about || first;
  x.element.data = std::make_shared<const MeasuredCoordinate>(on);
  const double part = regime == 1 ? numbers(0.6, 0.9) : numbers(-0.3, 0.3);
  x.states = {part * *f.kinetic / f.stiffness};
  if (f.reaction) x.states.push_back(numbers(3.0, 5.0));
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
    .states = bristle_friction_states,
    .start = bristle_friction_start,
    .deflection = deflection_of_bristles,
    .dual = bristle_friction_law<Dual>,
    .picture = picture_of_coordinate,
    .linear_note = bristle_friction_linear_note,
    .regimes = bristle_friction_regimes};

constinit const ExampleMaker bristle_friction_examples = bristle_friction_example;

}  // namespace floatframe
