// Penalty tyre on a road profile of slope sigma and curvature kappa below the wheel centre, at the
// height h above the road; it can only push.
//   vertical   f = k (R - h) - c hdot upwards at the centre, hdot = v_z - sigma v_x
//   radial     f = q (k (R - h) - c hdot), q = 1/sqrt(1 + sigma^2), along the normal
//              n = q (-sigma, 0, 1) of the straight line through the road point below the centre.
//              It acts at the contact point, r_w below the centre in the plane of the wheel:
//              e_x = axis x n / |axis x n|, e_z = e_x x axis, arm = -r_w e_z, r_w = h q^2 / e_z.z
//   energy     k/2 (q (R - h))^2 while it touches
// A road that is lifted as a whole by the target of the element (in linearisations, not in model
// files) has h and hdot reduced by the lift and its rate.
// Branches: the segments of the road between its edges, each with and without contact. Without it,
// contact begins when both R - h and f are positive; it ends when f, which is then negative on this
// branch, vanishes. f jumps only at the beginning of contact, by -c hdot. On a straight road -df =
// k n.dr of a radial tyre: one row. The terms that the row omits do not change the number of
// iterations of a vehicle on stairs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/description/rules.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/rolling_contact.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {

namespace {

/// Its signal: the height of a road that is lifted as a whole.
constexpr std::size_t road_lift = 0;

template <class S>
struct Contact {
  bool touches = false;
  double x;  ///< of the centre
  S h, rate, q, f;
  Eigen::Matrix<S, 3, 1> n;
};

template <class S>
Contact<S> contact(const PortsOf<S>& in) noexcept {
  using std::sqrt;
  const Tyre& t = in.template keys<Tyre>();
  const auto& centre = in.marker(0);
  const S x = centre.r.x() + in.origin.x();
  const Road& road = in.model.roads[in.element.road];
  Contact<S> c;
  c.x = value_of(x);
  const RoadPoint p = in.branch == free_branch
                          ? road_at(road, c.x)
                          : road_at(road, RollingBranch{in.branch}.stretch(), c.x);
  const S slope = chained(p.slope, p.curvature, x);
  c.h = centre.r.z() + in.origin.z() - chained(p.z, p.slope, x);
  c.rate = centre.v.z() - slope * centre.v.x();
  const SignalValue<S> lift = in.signal(road_lift);
  c.h -= lift.f;
  c.rate -= lift.df;
  const bool radial = t.law == TyreLaw::radial;
  const S one = 1.0, zero = 0.0;
  c.q = radial ? S(one / sqrt(S(one + slope * slope))) : one;
  c.n = {radial ? S(-slope * c.q) : zero, zero, radial ? c.q : one};
  c.f = (t.stiffness * (t.radius - c.h) - t.damping * c.rate) * c.q;
  c.touches =
      in.branch == free_branch ? c.h < t.radius && c.f > 0.0 : RollingBranch{in.branch}.touches();
  return c;
}

/// The branch of a position on a segment of the road.
std::int64_t tyre_branch(const Ports& in, std::size_t stretch) noexcept {
  Ports there = in;
  there.branch = RollingBranch::of(stretch, false);
  const Contact<double> c = contact(there);
  return RollingBranch::of(stretch, c.h < in.keys<Tyre>().radius && c.f > 0.0);
}

BranchSide tyre_side(const Ports& in) noexcept {
  const Tyre& t = in.keys<Tyre>();
  const PiecewisePolynomial& road = in.model.roads[in.element.road].pieces;
  const Contact<double> c = contact(in);
  if (in.branch == free_branch) return {-1.0, tyre_branch(in, road.stretch_index(c.x))};
  const RollingBranch held{in.branch};
  const StretchSide s = stretch_side(road, held.stretch(), c.x);
  // The force expressed as a depth.
  const double push = c.f / (t.stiffness > 0.0 ? t.stiffness : 1.0);
  const double touch = held.touches() ? -push : std::min(t.radius - c.h, push);
  if (s.beyond > touch) return {s.beyond, tyre_branch(in, s.next)};
  return {touch, RollingBranch::of(held.stretch(), !held.touches())};
}

/// The contact point is r_w below the centre along e_z. None for a wheel that lies flat on the
/// road: at 1e-6 rad from there e_x is a quotient of small numbers and r_w is far longer than the
/// radius.
template <class S>
bool contact_point(const PortsOf<S>& in, const Contact<S>& c, Eigen::Matrix<S, 3, 1>& e_z,
                   S& r_w) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const V axis = in.marker(0).R * in.template keys<Tyre>().axis.template cast<S>();
  const V u = axis.cross(c.n);
  if (!(value_of(u.squaredNorm()) > 1e-12)) return false;
  const V e_x = u / S(u.norm());
  e_z = e_x.cross(axis);
  if (std::abs(value_of(e_z.z())) < 1e-6) return false;
  r_w = c.h * c.q * c.q / e_z.z();
  return true;
}

template <class S>
void tyre_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const Contact<S> c = contact(in);
  out.length = c.h;
  out.rate = c.rate;
  if (!c.touches) return;
  const Tyre& t = in.template keys<Tyre>();
  const S spring = t.radius - c.h;
  out.force = c.f;
  out.wrench[0].F = c.f * c.n;
  if constexpr (std::is_same_v<S, double>)
    *out.add_row(t.stiffness, t.damping) = {c.n, Vec3::Zero()};
  out.energy = 0.5 * t.stiffness * spring * spring * c.q * c.q;
  V e_z;
  S r_w;
  if (t.law == TyreLaw::vertical || !contact_point(in, c, e_z, r_w)) return;
  out.wrench[0].T = -r_w * e_z.cross(out.wrench[0].F);
}

}  // namespace

FLOATFRAME_LAW(tyre)

namespace {

constexpr const char* slope = "that a vertical force changes along a slope";
constexpr const char* heel = "the torque of a wheel that heels";

enum Regime : std::size_t {
  vertical_flat,
  vertical_slope,
  vertical_bump,
  radial_flat,
  radial_slope,
  radial_bump,
  radial_heeling,
  radial_heeling_on_bump,
  airborne,
  held_by_damper,
  lying
};
constexpr ElementRegime tyre_regimes[] = {
    {.name = "vertical_flat"},
    {.name = "vertical_slope", .rows_leave_out = slope, .conservative = false},
    {.name = "vertical_bump", .rows_leave_out = slope, .conservative = false},
    {.name = "radial_flat", .rows_leave_out = heel},
    {.name = "radial_slope", .rows_leave_out = heel},
    {.name = "radial_bump", .rows_leave_out = heel, .conservative = false},
    {.name = "radial_heeling", .rows_leave_out = heel, .conservative = false},
    {.name = "radial_heeling_on_bump", .rows_leave_out = heel, .conservative = false},
    {.name = "airborne", .acts = false},
    {.name = "held_by_damper", .rows_leave_out = heel, .acts = false},
    {.name = "lying", .regular = false}};

ElementExample tyre_example(std::size_t regime, ExampleNumbers& numbers) {
  const bool vertical = regime <= vertical_bump;
  const bool bump =
      regime == vertical_bump || regime == radial_bump || regime == radial_heeling_on_bump;
  const bool sloping =
      bump || regime == vertical_slope || regime == radial_slope || regime == radial_heeling;
  const bool heeling = regime == radial_heeling || regime == radial_heeling_on_bump;
  ElementExample x;
  Road road;
  if (sloping)
    road.pieces = PiecewisePolynomial::polynomial({numbers(-1.0, 1.0), numbers(-0.6, 0.6)});
  if (bump) road.bumps.push_back({-3.0, 6.0, numbers(0.2, 0.8)});
  x.model.roads.push_back(road);
  Tyre f;
  f.law = vertical ? TyreLaw::vertical : TyreLaw::radial;
  f.radius = numbers(0.3, 0.5);
  f.stiffness = numbers(800.0, 2000.0);
  f.damping = numbers(1.0, 5.0);
  x.origin = numbers.vector(1.0);
  MarkerState b = numbers.marker();
  // A steered wheel, rotated about its axis; upright across the road unless it is cambered.
  const Vec3 place = b.r + x.origin;
  const RoadPoint below = road_at(road, place.x());
  const Vec3 normal = Vec3(-below.slope, 0.0, 1.0).normalized();
  Mat3 R = rotation_exp(std::atan2(normal.x(), normal.z()) * Vec3::UnitY()) *
           rotation_exp(numbers(-0.7, 0.7) * Vec3::UnitZ());
  if (heeling) R = R * rotation_exp(numbers(0.2, 0.6) * Vec3::UnitX());
  if (regime == lying) R = rotation_exp(0.5 * std::numbers::pi * Vec3::UnitX());
  b.R = R * rotation_exp(numbers(-3.0, 3.0) * Vec3::UnitY());
  const double depth = regime == airborne ? -0.1 : numbers(0.05, 0.12);
  b.r.z() = below.z + f.radius - depth - x.origin.z();
  if (regime == held_by_damper) {
    f.damping = 500.0;
    b.v.z() = below.slope * b.v.x() + 3.0;
  }
  x.markers = {b};
  x.keys(f);
  x.element.road = 0;
  return x;
}

constexpr ElementKey tyre_keys[] = {
    {.name = "body",
     .kind = KeyKind::own_place,
     .about = "the wheel centre",
     .required = true,
     .member = described_by<&Tyre::centre>},
    {.name = "radius",
     .kind = KeyKind::number,
     .about = "unloaded radius R",
     .required = true,
     .rule = rules::tyre_radius,
     .fallback = 1.0,
     .member = described_by<&Tyre::radius>},
    {.name = "stiffness",
     .kind = KeyKind::number,
     .about = "k",
     .required = true,
     .rule = rules::tyre_stiffness,
     .fallback = 1.0,
     .member = described_by<&Tyre::stiffness>},
    {.name = "damping",
     .kind = KeyKind::number,
     .about = "c",
     .rule = rules::tyre_damping,
     .member = described_by<&Tyre::damping>},
    {.name = "law",
     .kind = KeyKind::word,
     .about = "along the vertical or normal to the road",
     .words = rules::tyre_laws,
     .member = described_by<&Tyre::law>},
    {.name = "axis",
     .kind = KeyKind::direction,
     .about = "the wheel axis",
     .vector = {0.0, 1.0, 0.0},
     .member = described_by<&Tyre::axis>},  // a line: its sense does not matter
    {.name = "road",
     .kind = KeyKind::road,
     .about = "what it rolls on",
     .required = true,
     .member = described_by<&Tyre::road>},
};

bool tyre_build(ElementBuild& b) {
  Tyre& t = b.keys<Tyre>();
  t.axis = t.axis.stableNormalized();
  b.element.road = b.road("road");
  return b.connect("body", t.law == TyreLaw::radial);
}

/// The model does not give the width; this one is typical of a car's wheel.
Picture tyre_picture(const Element& element) {
  const Tyre& t = std::get<Tyre>(*element.keys);
  return {.symbol = Picture::Symbol::wheel,
          .a = element.markers[0],
          .axis = t.axis,
          .axis_of = element.markers[0],
          .radius = t.radius,
          .width = 0.4 * t.radius};
}

/// A wheel far above its road or deep in it.
void tyre_note(const Element& element, const SystemMotion& start, std::vector<std::string>& notes) {
  constexpr double high = 3.0, low = 0.6;  // relative to the radius
  const Tyre& t = std::get<Tyre>(*element.keys);
  const Vec3 centre = start.place(element.markers[0]);
  const Road& road = start.model.roads[element.road];
  const double height = centre.z() - road_at(road, centre.x()).z;
  if (height > low * t.radius && height < high * t.radius) return;
  const double gap = height - t.radius;
  notes.push_back(
      fmt::format("tyre '{}': its wheel centre is {:.4g} m above the road and its radius is "
                  "{:.4g} m, so that at the start {}",
                  element.name, height, t.radius,
                  gap > 0.0 ? fmt::format("the wheel hangs {:.4g} m in the air", gap)
                            : fmt::format("the road presses {:.4g} m into it with {:.4g} N", -gap,
                                          -gap * t.stiffness)));
}

}  // namespace

constinit const ElementKind tyre_element = {
    .about = "penalty tyre on the profile of a road; it pushes or does nothing",
    .keys = tyre_keys,
    .energy = EnergyCategory::tyres,
    .blank = [] { return ElementKeys(Tyre()); },
    .build = tyre_build,
    .profile_only = true,
    .lifted = "road",
    .dual = tyre_law<Dual>,
    .side = tyre_side,
    .picture = tyre_picture,
    .note = tyre_note,
    .regimes = tyre_regimes};

constinit const ExampleMaker tyre_examples = tyre_example;

}  // namespace floatframe
