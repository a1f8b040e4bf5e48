// Stops of a coordinate q of a joint: the contact of contact_law.hpp below `lower`, with the
// compression d = lower - q, and above `upper`, with d = q - upper, ddot = -qdot or qdot.
// f = -push below and push above; -f acts on the coordinate.
//   rows         slope g g^T and the damping b k d^n g g^T (port_measures.hpp)
// The kept number is the speed |qdot| at the end of the last step apart.
#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/contact_law.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

/// Branches.
constexpr std::int64_t joint_apart = 0, at_lower = 1, at_upper = 2;

struct JointStopData {
  MeasuredCoordinate coordinate;
  ContactSpring contact;
};

/// How far q is below the lower and above the upper stop.
struct StopSides {
  static constexpr double endless = std::numeric_limits<double>::max();
  double below, above;
  StopSides(const JointStop& keys, double q) noexcept
      : below(keys.lower ? *keys.lower - q : -endless),
        above(keys.upper ? q - *keys.upper : -endless) {}
  std::int64_t branch(std::int64_t held) const noexcept {
    if (held != free_branch) return held;
    return below > 0.0 ? at_lower : above > 0.0 ? at_upper : joint_apart;
  }
};

template <class S>
void joint_stop_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto& keys = in.template keys<JointStop>();
  const auto& data = in.template data<JointStopData>();
  const AxisMeasure<S> m = coordinate_measure(in, data.coordinate);
  out.length = m.s;
  out.rate = m.rate;
  const std::int64_t branch = StopSides(keys, value_of(m.s)).branch(in.branch);
  if (branch == joint_apart) return;
  const bool lower = branch == at_lower;
  const S d = lower ? S(*keys.lower - m.s) : S(m.s - *keys.upper);
  const ContactForce<S> contact =
      contact_force(data.contact, value_of(in.state(0)), d, lower ? S(-m.rate) : m.rate);
  if (contact.pushes)
    pull_back(m, lower ? S(-contact.push) : contact.push, contact.slope, contact.damping, out);
  out.energy = contact.energy;
  out.energy_rate = contact.energy_rate;
  out.damping = out.force * m.rate - out.energy_rate;
}

}  // namespace

FLOATFRAME_LAW(joint_stop)

namespace {

AxisMeasure<double> stopped_coordinate(const Ports& in) noexcept {
  return coordinate_measure(in, in.data<JointStopData>().coordinate);
}

BranchSide joint_stop_side(const Ports& in) noexcept {
  const StopSides x(in.keys<JointStop>(), stopped_coordinate(in).s);
  if (in.branch == free_branch) return {-1.0, x.branch(free_branch)};
  if (in.branch == at_lower) return {-x.below, joint_apart};
  if (in.branch == at_upper) return {-x.above, joint_apart};
  return x.below > x.above ? BranchSide{x.below, at_lower} : BranchSide{x.above, at_upper};
}

void keep_stop_speed(const Ports& in, double* kept) noexcept {
  const AxisMeasure<double> m = stopped_coordinate(in);
  if (StopSides(in.keys<JointStop>(), m.s).branch(in.branch) == joint_apart)
    *kept = std::abs(m.rate);
}

void joint_stop_validate(const ElementCheck& check) {
  validate_any_coordinate(check);
  if (check.wrong.contains("lower") || check.wrong.contains("upper")) return;
  const bool lower = check.has("lower"), upper = check.has("upper");
  if (!lower && !upper)
    check.error(ErrorCode::missing, "", sentences::no_stop());
  else if (lower && upper && !(check.number("lower") < check.number("upper")))
    check.error(ErrorCode::out_of_range, "upper",
                sentences::stops_ascend(check.number("lower"), check.number("upper")));
}

bool joint_stop_build(ElementBuild& build) {
  const auto coordinate = build_any_coordinate(build);
  if (!coordinate) return false;
  build.element.data = std::make_shared<const JointStopData>(
      JointStopData{*coordinate, contact_spring(build.keys<JointStop>())});
  return true;
}

void joint_stop_reverse(ElementDescription& element) {
  auto& keys = std::get<JointStop>(element.kind);
  std::swap(keys.lower, keys.upper);
  for (std::optional<double>* stop : {&keys.lower, &keys.upper})
    if (*stop) **stop = -**stop;
}

using StopKeys = ContactKeys<JointStop>;
constexpr ElementKey joint_stop_keys[] = {
    joint_key(described_by<&JointStop::joint>),
    coordinate_key(described_by<&JointStop::coordinate>),
    StopKeys::number("lower", "below which it acts", any_number("m or rad"),
                     described_by<&JointStop::lower>, no_number),
    StopKeys::number("upper", "above which it acts", any_number("m or rad"),
                     described_by<&JointStop::upper>, no_number),
    StopKeys::stiffness("N/m^exponent or N m/rad^exponent"),
    StopKeys::exponent,
    StopKeys::restitution,
    StopKeys::least_speed("m/s or rad/s")};

constexpr const char* turning_axis_of_stop = "the turning of the axis with its body";
constexpr ElementRegime joint_stop_regimes[] = {
    {.name = "lower_along", .rows_leave_out = turning_axis_of_stop},
    {.name = "upper_hertz", .rows_leave_out = turning_axis_of_stop},
    {.name = "upper_about", .rows_leave_out = turning_axis_of_stop},
    {.name = "lower_after_turns", .rows_leave_out = turning_axis_of_stop},
    {.name = "about_first_axis", .rows_leave_out = turning_axis_of_stop},
    {.name = "about_second_axis", .rows_leave_out = turning_axis_of_stop},
    {.name = "apart", .acts = false}};

ElementExample joint_stop_example(std::size_t regime, ExampleNumbers& numbers) {
  using Of = MeasuredCoordinate::Of;
  ElementExample x;
  JointStop f;
  JointStopData data;
  const MarkerState a = numbers.marker();
  const bool common = regime == 2 || regime == 3, turns = regime >= 2 && regime <= 5;
  x.markers = {a, common ? numbers.marker_on_axis(a) : numbers.marker()};
  data.coordinate = {Of::displacement, numbers.direction(), Vec3::UnitX()};
  if (common) data.coordinate = {};
  if (turns && !common) {
    data.coordinate = {regime == 4 ? Of::first_angle : Of::second_angle, Vec3::UnitZ(),
                       Vec3(0.96, 0.0, 0.28)};
    x.markers[1].R = a.R * rotation_exp(numbers(-2.5, 2.5) * Vec3::UnitZ()) *
                     rotation_exp(numbers(-2.5, 2.5) * data.coordinate.n);
  }
  if (regime == 3) x.reference_angle = 6.0 * std::numbers::pi;
  const double q =
      coordinate_measure<double>(data.coordinate, x.markers[0], x.markers[1], x.reference_angle).s;
  const bool below = regime == 0 || regime == 3 || regime == 5;
  const double depth = regime == 6 ? -0.5 : numbers(0.2, 0.5);
  if (below || regime == 6) f.lower = q + depth;
  if (!below) f.upper = q - depth;
  f.stiffness = numbers(50.0, 90.0);
  f.exponent = regime == 1 ? 1.5 : 1.0;
  f.restitution = numbers(0.5, 0.9);
  x.keys(f);
  x.element.rotational = turns;
  data.contact = contact_spring(f);
  x.element.data = std::make_shared<const JointStopData>(data);
  x.states = {numbers(30.0, 50.0)};
  return x;
}

}  // namespace

constinit const ElementKind joint_stop_element = {
    .about =
        "stops of a coordinate of a joint: beyond them a spring, linear or of Hertz, with the "
        "damping of a given restitution",
    .keys = joint_stop_keys,
    .joint_word = "stops",
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(JointStop()); },
    .validate = joint_stop_validate,
    .build = joint_stop_build,
    .reverse = joint_stop_reverse,
    .states = [](Element& element) { element.kept = 1; },
    .after_step = keep_stop_speed,
    .contact = true,
    .dual = joint_stop_law<Dual>,
    .side = joint_stop_side,
    .picture = picture_of_coordinate,
    .regimes = joint_stop_regimes};

constinit const ExampleMaker joint_stop_examples = joint_stop_example;

}  // namespace floatframe
