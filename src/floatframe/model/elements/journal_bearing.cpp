// Journal bearing with clearance: a shaft of the radius r in a bush, whose marker a carries the
// axis z = R_a z, touches it where the eccentricity s of its point b in the plane of the bearing
// exceeds the radial clearance c. With d = r_b - r_a and the part of d across z, s n, t = z x n:
//   s, sdot        those along the axis n that turns with a (axis_measure.hpp)
//   contact        the push P of contact_law.hpp of the compression s - c
//   sliding        v = t.(v_b - v_a) + (w_a x t).d + r z.(w_b - w_a), of the surface of the shaft
//                  over that of the bush in the point of the contact
//   friction       F = P f, f by the bristles of bristle_law.hpp; the state is z of the bristles
//   wrench         -P n on the shaft at its point and -F t at the contact r_b + r n, the opposite
//                  on the bush in the same points: torque -r F about z on the shaft
//   rows           slope and damping of P along n, P/s along t, P f_v of the sliding
// While apart the bristles keep their deflection. What they store counts as dissipated.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/bristle_law.hpp"
#include "floatframe/model/contact_law.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/port_measures.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {

namespace {

/// Branches.
constexpr std::int64_t journal_floats = 0, journal_touches = 1;

struct JournalData {
  ContactSpring contact;
  Bristles bristles;
};

template <class S>
struct JournalMeasure {
  AxisMeasure<S> along;  ///< along n
  WrenchPair<S> across;  ///< gradient along t
  WrenchPair<S> slide;   ///< gradient of the sliding
  S sliding = 0.0;
};

template <class S>
JournalMeasure<S> journal_measure(const PortsOf<S>& in) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const auto &a = in.marker(0), &b = in.marker(1);
  const double r = in.template keys<JournalBearing>().radius;
  const V z = a.R.col(2), d = b.r - a.r;
  const S axial = z.dot(d);
  const V plane = d - axial * z;
  const bool centred = value_of(plane.squaredNorm()) <= coincident_points * coincident_points;
  const V n = centred ? V(a.R.col(0)) : V(plane / S(plane.norm()));
  const V t = z.cross(n), arm = r * z;
  JournalMeasure<S> m;
  m.along = axis_measure(n, a, b);
  const AxisMeasure<S> across = axis_measure(t, a, b);
  m.across = across.g;
  m.slide = across.g;
  m.slide.a.T -= arm;
  m.slide.b.T += arm;
  m.sliding = across.rate + arm.dot(V(b.w - a.w));
  return m;
}

template <class S>
bool journal_in_touch(const PortsOf<S>& in, const S& depth) noexcept {
  return in.branch == free_branch ? value_of(depth) > 0.0 : in.branch == journal_touches;
}

template <class S>
void journal_bearing_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto& keys = in.template keys<JournalBearing>();
  const auto& data = in.template data<JournalData>();
  const JournalMeasure<S> m = journal_measure(in);
  out.length = m.along.s;
  out.rate = m.along.rate;
  const S depth = m.along.s - keys.clearance;
  if (!journal_in_touch(in, depth)) return;
  const int bristles = in.element.states;
  const ContactForce<S> contact =
      contact_force(data.contact, value_of(in.state(bristles)), depth, m.along.rate);
  const S push = contact.push;
  S rub = 0.0;
  double rubs = 0.0;  // slope of the friction over the sliding
  if (bristles > 0) {
    const S z = in.state(0), flow = bristle_flow(data.bristles, in, z, m.sliding);
    out.state_rates[0] = flow;
    rub = push * S(data.bristles.stiffness * z + data.bristles.damping * flow);
    if constexpr (std::is_same_v<S, double>) {
      const BristleSlopes of = bristle_slopes(data.bristles, in, z, m.sliding);
      out.state_slopes[0] = of.of_state;
      rubs = push * of.of_speed;
    }
  }
  out.force = push;
  out.further[0] = -keys.radius * rub;
  out.set_pair(-push, m.along.g);
  if (contact.pushes) {
    out.add_pair_row(m.along.g, contact.slope, contact.damping);
    out.add_pair_row(m.across, value_of(push) / value_of(m.along.s), 0.0);
  }
  if (bristles > 0) {
    out.add_pair(-rub, m.slide);
    out.add_pair_row(m.slide, 0.0, rubs);
  }
  out.energy = contact.energy;
  out.energy_rate = contact.energy_rate;
  out.damping = push * m.along.rate + rub * m.sliding - out.energy_rate;
}

}  // namespace

FLOATFRAME_LAW(journal_bearing)

namespace {

double journal_depth(const Ports& in, const JournalMeasure<double>& m) noexcept {
  return m.along.s - in.keys<JournalBearing>().clearance;
}

BranchSide journal_bearing_side(const Ports& in) noexcept {
  const double depth = journal_depth(in, journal_measure(in));
  if (in.branch == free_branch) return {-1.0, depth > 0.0 ? journal_touches : journal_floats};
  return in.branch == journal_touches ? BranchSide{-depth, journal_floats}
                                      : BranchSide{depth, journal_touches};
}

void journal_bearing_start(const Ports& in, double* states) noexcept {
  if (in.element.states == 0) return;
  const JournalMeasure<double> m = journal_measure(in);
  if (journal_in_touch(in, journal_depth(in, m)))
    states[0] = bristle_start(in.data<JournalData>().bristles, m.sliding);
}

void keep_journal_speed(const Ports& in, double* states) noexcept {
  const JournalMeasure<double> m = journal_measure(in);
  if (!journal_in_touch(in, journal_depth(in, m))) states[in.element.states] = m.along.rate;
}

void journal_bearing_validate(const ElementCheck& check) {
  check.two_bodies("from", "to");
  const bool friction = check.has("friction") || check.wrong.contains("friction");
  for (const char* key : {"kinetic", "stribeck", "deflection", "bristle_damping", "elastic"})
    if (!friction && check.description().origin.keys.contains(key))
      check.error(ErrorCode::incomplete, key, "found without 'friction', which it is of");
  if (!check.good("kinetic") || !check.good("friction")) return;
  if (const auto complaint =
          sentences::kinetic_friction(check.number("kinetic"), check.number("friction")))
    check.error(ErrorCode::out_of_range, "kinetic", *complaint);
}

std::shared_ptr<const JournalData> journal_data(const JournalBearing& keys) {
  JournalData data;
  data.contact = contact_spring(keys);
  if (keys.friction)
    data.bristles = {*keys.friction,       keys.kinetic.value_or(*keys.friction),
                     keys.stribeck,        *keys.friction / keys.deflection,
                     keys.bristle_damping, keys.elastic};
  return std::make_shared<const JournalData>(data);
}

bool journal_bearing_build(ElementBuild& build) {
  const Mat3 R = frame_with_z(build.direction("axis").stableNormalized());
  build.element.data = journal_data(build.keys<JournalBearing>());
  const bool from = build.connect("from", true, R), to = build.connect("to", true, R);
  return from && to;
}

/// A shaft deep in its bush: more than the clearance again.
void journal_bearing_note(const Element& element, const SystemMotion& start,
                          std::vector<std::string>& notes) {
  const auto& keys = std::get<JournalBearing>(*element.keys);
  const Vec3 d = start.place(element.markers[1]) - start.place(element.markers[0]);
  const Vec3 z = start.marker(element.markers[0]).R.col(2);
  const double eccentricity = d.cross(z).norm(), depth = eccentricity - keys.clearance;
  if (!(depth > keys.clearance)) return;
  notes.push_back(fmt::format(
      "journal_bearing '{}': the shaft is {:.4g} m off the centre of its bush, whose clearance is "
      "{:.4g} m, so that at the start it is pushed back with {:.4g} N",
      element.name, eccentricity, keys.clearance, keys.stiffness * std::pow(depth, keys.exponent)));
}

Picture journal_bearing_picture(const Element& element) {
  return {.symbol = Picture::Symbol::bearing,
          .a = element.markers[0],
          .b = element.markers[1],
          .axis = Vec3::UnitZ(),
          .axis_of = element.markers[0],
          .radius = std::get<JournalBearing>(*element.keys).radius};
}

using JournalKeys = ContactKeys<JournalBearing>;
/// Of the friction, which may be absent.
constexpr ElementKey journal_number(const char* name, const char* about, NumberRule rule,
                                    KeyMember member, double fallback = no_number) {
  return {.name = name,
          .kind = KeyKind::number,
          .about = about,
          .rule = rule,
          .fallback = fallback,
          .member = member};
}
constexpr ElementKey journal_bearing_keys[] = {
    place_key("from", "the centre of the bush, on the body that carries the axis",
              described_by<&JournalBearing::from>),
    place_key("to", "the centre of the shaft", described_by<&JournalBearing::to>),
    {.name = "axis",
     .kind = KeyKind::direction,
     .about = "of the bush",
     .member = described_by<&JournalBearing::axis>},
    JournalKeys::number("radius", "of the shaft", positive_number("m"),
                        described_by<&JournalBearing::radius>),
    JournalKeys::number("clearance", "radius of the bush less that of the shaft",
                        positive_number("m"), described_by<&JournalBearing::clearance>),
    JournalKeys::stiffness("N/m^exponent"),
    JournalKeys::exponent,
    JournalKeys::restitution,
    JournalKeys::least_speed("m/s"),
    journal_number("friction", "coefficient at which the surfaces begin to slide; none without it",
                   positive_number(""), described_by<&JournalBearing::friction>),
    journal_number("kinetic", "the same while they slide; without it `friction`",
                   positive_number(""), described_by<&JournalBearing::kinetic>),
    journal_number("stribeck", "speed of the fall from `friction` to `kinetic`",
                   non_negative_number("m/s"), described_by<&JournalBearing::stribeck>, 0.0),
    journal_number("deflection", "of the bristles of the surfaces at which they slide",
                   positive_number("m"), described_by<&JournalBearing::deflection>, 1e-5),
    journal_number("bristle_damping", "of the bristles, times the normal force",
                   non_negative_number("s/m"), described_by<&JournalBearing::bristle_damping>, 0.0),
    journal_number("elastic",
                   "part of the deflection up to which nothing slides; 0: the LuGre model",
                   {"a number from 0 to 0.999", "", 0.0, 0.999},
                   described_by<&JournalBearing::elastic>, 0.95)};

constexpr const char* turning_axis_of_bush = "the turning of the axis with the bush";
constexpr ElementRegime journal_bearing_regimes[] = {
    {.name = "linear", .rows_leave_out = turning_axis_of_bush},
    {.name = "hertz", .rows_leave_out = turning_axis_of_bush},
    {.name = "sticks", .rows_leave_out = turning_axis_of_bush, .conservative = false},
    {.name = "slides", .rows_leave_out = turning_axis_of_bush, .conservative = false},
    {.name = "lugre", .rows_leave_out = turning_axis_of_bush, .conservative = false},
    {.name = "floats", .acts = false}};

ElementExample journal_bearing_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  JournalBearing f;
  x.markers = {numbers.marker(), numbers.marker()};
  const Vec3 z = x.markers[0].R.col(2);
  // Away from the centre.
  Vec3 d = x.markers[1].r - x.markers[0].r;
  if (d.cross(z).norm() < 0.4) x.markers[1].r += x.markers[0].R.col(0);
  d = x.markers[1].r - x.markers[0].r;
  const double eccentricity = (d - z.dot(d) * z).norm();
  const bool floats = regime == 5;
  f.radius = numbers(0.2, 0.6);
  f.clearance = floats ? eccentricity + 0.2 : eccentricity * numbers(0.3, 0.6);
  f.stiffness = numbers(50.0, 90.0);
  f.exponent = regime == 1 ? 1.5 : 1.0;
  f.restitution = numbers(0.5, 0.9);
  if (regime >= 2) {
    f.friction = numbers(0.4, 0.6);
    f.kinetic = numbers(0.2, 0.4);
    f.stribeck = numbers(0.5, 1.0);
    f.deflection = numbers(0.5, 1.0);
    f.bristle_damping = numbers(0.05, 0.2);
    f.elastic = regime == 4 ? 0.0 : regime == 3 ? 0.2 : 0.9;
  }
  x.keys(f);
  x.element.data = journal_data(f);
  if (regime >= 2) {
    const double part = regime == 3 ? numbers(0.6, 0.9) : numbers(-0.3, 0.3);
    x.states = {part * *f.kinetic / *f.friction * f.deflection};
    x.state_weight = numbers(0.5, 200.0);
  }
  x.states.push_back(numbers(30.0, 50.0));
  return x;
}

}  // namespace

constinit const ElementKind journal_bearing_element = {
    .about =
        "a shaft in a bush with clearance: where it touches, a contact with the damping of a given "
        "restitution and, if it is given, friction that sticks. Results: `force` the normal force, "
        "or by `output: friction_torque` the torque of friction on the shaft about the axis "
        "[N m]; `length` the eccentricity",
    .keys = journal_bearing_keys,
    .blank = [] { return ElementKeys(JournalBearing()); },
    .validate = journal_bearing_validate,
    .build = journal_bearing_build,
    .states =
        [](Element& element) {
          element.states = std::get<JournalBearing>(*element.keys).friction ? 1 : 0;
          element.kept = 1;
        },
    .values = [](const ElementKeys&) -> std::vector<ElementValue> {
      return {{"force", "N"}, {"friction_torque", "N m"}};
    },
    .start = journal_bearing_start,
    .left_out_at_rest = "friction",
    .after_step = keep_journal_speed,
    .contact = true,
    .dual = journal_bearing_law<Dual>,
    .side = journal_bearing_side,
    .picture = journal_bearing_picture,
    .note = journal_bearing_note,
    .regimes = journal_bearing_regimes};

constinit const ExampleMaker journal_bearing_examples = journal_bearing_example;

}  // namespace floatframe
