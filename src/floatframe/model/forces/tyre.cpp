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
// Derivatives, with dsigma = kappa dx, dh = dz - sigma dx, dq = -sigma q^3 dsigma,
// dn = -q^2 tau dsigma, tau = q (1, 0, sigma) along the road:
//   df = q (-k dh + c v_x dsigma) + f dq/q - q c (dv_z - sigma dv_x)
//   d(torque) = d(arm) x f n + arm x d(f n)
// Branches: the segments of the road between its edges, each with and without contact. Without it,
// contact begins when both R - h and f are positive; it ends when f, which is then negative on this
// branch, vanishes. f jumps only at the beginning of contact, by -c hdot. On a straight road -df =
// k n.dr of a radial tyre: one row. The terms that the row omits do not change the number of
// iterations of a vehicle on stairs.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/model/force_kind.hpp"
#include "floatframe/model/rules.hpp"

namespace floatframe {

namespace {

struct TyreBranch {
  std::int64_t held;
  static std::int64_t of(std::size_t stretch, bool touches) noexcept {
    return static_cast<std::int64_t>(2 * stretch + (touches ? 1 : 0));
  }
  std::size_t stretch() const noexcept { return static_cast<std::size_t>(held / 2); }
  bool touches() const noexcept { return held % 2 != 0; }
};

struct Contact {
  bool touches = false;
  double x;  ///< of the centre
  RoadPoint road;
  double h, rate, q, f;
  Vec3 n;
};

Contact contact(const ForceInput& in) noexcept {
  const Force& t = in.force;
  const Vec3 centre = in.b.r + in.origin;
  const Road& road = in.model.roads[t.road];
  Contact c;
  c.x = centre.x();
  c.road = in.branch == free_branch ? road_at(road, c.x)
                                    : road_at(road, TyreBranch{in.branch}.stretch(), c.x);
  c.h = centre.z() - c.road.z;
  c.rate = in.b.v.z() - c.road.slope * in.b.v.x();
  if (t.targeted) {
    const PiecewisePolynomial::Value lift = evaluate(t.target.function, in.t);
    c.h -= lift.f;
    c.rate -= lift.df;
  }
  const bool radial = t.law == TyreLaw::radial;
  c.q = radial ? 1.0 / std::sqrt(1.0 + c.road.slope * c.road.slope) : 1.0;
  c.n = radial ? Vec3(-c.road.slope * c.q, 0.0, c.q) : Vec3::UnitZ();
  c.f = (t.stiffness * (t.radius - c.h) - t.damping * c.rate) * c.q;
  c.touches =
      in.branch == free_branch ? c.h < t.radius && c.f > 0.0 : TyreBranch{in.branch}.touches();
  return c;
}

/// The branch of a position on a segment of the road.
std::int64_t tyre_branch(const ForceInput& in, std::size_t stretch) noexcept {
  ForceInput there = in;
  there.branch = TyreBranch::of(stretch, false);
  const Contact c = contact(there);
  return TyreBranch::of(stretch, c.h < in.force.radius && c.f > 0.0);
}

ForceSide tyre_side(const ForceInput& in) noexcept {
  const Force& t = in.force;
  const PiecewisePolynomial& road = in.model.roads[t.road].pieces;
  const Contact c = contact(in);
  if (in.branch == free_branch) return {-1.0, tyre_branch(in, road.stretch_index(c.x))};
  const TyreBranch held{in.branch};
  const StretchSide s = stretch_side(road, held.stretch(), c.x);
  // The force expressed as a depth.
  const double push = c.f / (t.stiffness > 0.0 ? t.stiffness : 1.0);
  const double touch = held.touches() ? -push : std::min(t.radius - c.h, push);
  if (s.beyond > touch) return {s.beyond, tyre_branch(in, s.next)};
  return {touch, TyreBranch::of(held.stretch(), !held.touches())};
}

struct Wheel {
  Vec3 axis, e_x, e_z;
  double sine;  ///< |axis x n|
  double r_w;
};

/// False for a wheel that lies flat on the road: it has no contact point below its centre. At 1e-6
/// rad from there e_x is a quotient of small numbers and r_w is far longer than the radius.
bool upright(const ForceInput& in, const Contact& c, Wheel& w) noexcept {
  w.axis = in.b.R * in.force.axis;
  const Vec3 u = w.axis.cross(c.n);
  w.sine = u.norm();
  if (w.sine < 1e-6) return false;
  w.e_x = u / w.sine;
  w.e_z = w.e_x.cross(w.axis);
  if (std::abs(w.e_z.z()) < 1e-6) return false;
  w.r_w = c.h * c.q * c.q / w.e_z.z();
  return true;
}

}  // namespace

template <>
void force_of<ForceType::tyre>(const ForceInput& in, ForceState& out) noexcept {
  const Contact c = contact(in);
  out.length = c.h;
  out.rate = c.rate;
  if (!c.touches) return;
  const Force& t = in.force;
  const double spring = t.radius - c.h;
  const Vec3 zero = Vec3::Zero();
  out.force = c.f;
  out.wrench.Fb = c.f * c.n;
  out.rows[0] = {{zero, zero, c.n, zero}, t.stiffness, t.damping};
  out.row_count = 1;
  out.energy = 0.5 * t.stiffness * spring * spring * c.q * c.q;
  Wheel w;
  if (t.law == TyreLaw::vertical || !upright(in, c, w)) return;
  out.wrench.Tb = -w.r_w * w.e_z.cross(out.wrench.Fb);
}

template <>
void force_tangent_of<ForceType::tyre>(const ForceInput& in, ForceTangent& out) noexcept {
  using namespace part_of;
  const Contact c = contact(in);
  if (!c.touches) return;
  const Force& t = in.force;
  const double sigma = c.road.slope, q = c.q;
  const Vec3 height_gradient(-sigma, 0.0, 1.0);  // dh/dr = dhdot/dv
  const bool radial = t.law == TyreLaw::radial;
  const double kappa = c.road.curvature;
  const Vec3 x = Vec3::UnitX();
  // Along dr: df = f_r.dr, dn = n_x dx, dq = q_x dx.
  const double q_x = radial ? -sigma * q * q * q * kappa : 0.0;
  const Vec3 n_x = radial ? Vec3(-q * q * q * kappa * Vec3(1.0, 0.0, sigma)) : Vec3::Zero();
  const Vec3 f_r =
      -q * t.stiffness * height_gradient + (q * t.damping * in.b.v.x() * kappa + c.f * q_x / q) * x;
  const Vec3 f_v = -q * t.damping * height_gradient;
  const Mat3 force_r = c.n * f_r.transpose() + c.f * n_x * x.transpose();
  out.K.block<3, 3>(r_b, r_b) = -force_r;
  out.C.block<3, 3>(r_b, r_b) = -c.n * f_v.transpose();
  Wheel w;
  if (!radial || !upright(in, c, w)) return;
  const Vec3 arm = -w.r_w * w.e_z, push = c.f * c.n;
  const Mat3 arm_cross = skew(arm);
  out.C.block<3, 3>(pi_b, r_b) = arm_cross * out.C.block<3, 3>(r_b, r_b);
  // d(arm) for given dh q^2 + 2 h q dq, d(axis), dn.
  const auto arm_change = [&](double drop, const Vec3& axis_change, const Vec3& n_change) {
    const Vec3 u = axis_change.cross(c.n) + w.axis.cross(n_change);
    const Vec3 e_x = (u - w.e_x.dot(u) * w.e_x) / w.sine;
    const Vec3 e_z = e_x.cross(w.axis) + w.e_x.cross(axis_change);
    const double r_w = (drop - w.r_w * e_z.z()) / w.e_z.z();
    return Vec3(-r_w * w.e_z - w.r_w * e_z);
  };
  for (int k = 0; k < 3; ++k) {
    const double dx = k == 0 ? 1.0 : 0.0;
    const double drop = q * q * height_gradient[k] + 2.0 * c.h * q * q_x * dx;
    out.K.block<3, 1>(pi_b, r_b + k) =
        -(arm_change(drop, Vec3::Zero(), dx * n_x).cross(push) + arm_cross * force_r.col(k));
    out.K.block<3, 1>(pi_b, pi_b + k) =
        -arm_change(0.0, Vec3::Unit(k).cross(w.axis), Vec3::Zero()).cross(push);
  }
}

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
constexpr ForceRegime tyre_regimes[] = {
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

ForceExample tyre_example(std::size_t regime, ExampleNumbers& numbers) {
  const bool vertical = regime <= vertical_bump;
  const bool bump =
      regime == vertical_bump || regime == radial_bump || regime == radial_heeling_on_bump;
  const bool sloping =
      bump || regime == vertical_slope || regime == radial_slope || regime == radial_heeling;
  const bool heeling = regime == radial_heeling || regime == radial_heeling_on_bump;
  ForceExample x;
  Road road;
  if (sloping)
    road.pieces = PiecewisePolynomial::polynomial({numbers(-1.0, 1.0), numbers(-0.6, 0.6)});
  if (bump) road.bumps.push_back({-3.0, 6.0, numbers(0.2, 0.8)});
  x.model.roads.push_back(road);
  Force& f = x.force;
  f.type = ForceType::tyre;
  f.law = vertical ? TyreLaw::vertical : TyreLaw::radial;
  f.road = 0;
  f.radius = numbers(0.3, 0.5);
  f.stiffness = numbers(800.0, 2000.0);
  f.damping = numbers(1.0, 5.0);
  f.axis = Vec3::UnitY();
  x.origin = numbers.vector(1.0);
  MarkerState& b = x.b;
  b = numbers.marker();
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
  x.a = b;
  return x;
}

using T = TyreDescription;

constexpr ForceKey tyre_keys[] = {
    {.name = "body",
     .kind = ForceKeyKind::own_place,
     .about = "the wheel centre",
     .required = true,
     .member = described_by<&T::centre>},
    {.name = "radius",
     .kind = ForceKeyKind::number,
     .about = "unloaded radius R",
     .required = true,
     .rule = rules::tyre_radius,
     .fallback = 1.0,
     .member = described_by<&T::radius>},
    {.name = "stiffness",
     .kind = ForceKeyKind::number,
     .about = "k",
     .required = true,
     .rule = rules::tyre_stiffness,
     .fallback = 1.0,
     .member = described_by<&T::stiffness>},
    {.name = "damping",
     .kind = ForceKeyKind::number,
     .about = "c",
     .rule = rules::tyre_damping,
     .member = described_by<&T::damping>},
    {.name = "law",
     .kind = ForceKeyKind::word,
     .about = "along the vertical or normal to the road",
     .words = rules::tyre_laws,
     .member = described_by<&T::law>},
    {.name = "axis",
     .kind = ForceKeyKind::direction,
     .about = "the wheel axis",
     .vector = {0.0, 1.0, 0.0},
     .member = described_by<&T::axis>},  // a line: its sense does not matter
    {.name = "road",
     .kind = ForceKeyKind::road,
     .about = "what it rolls on",
     .required = true,
     .member = described_by<&T::road>},
};

bool tyre_build(ForceBuild& b) {
  Force& f = b.force;
  f.law = static_cast<TyreLaw>(b.word("law"));
  f.b = b.marker("body", f.law == TyreLaw::radial);
  f.radius = b.number("radius");
  f.stiffness = b.number("stiffness");
  f.damping = b.number("damping");
  f.axis = b.unit_direction("axis");
  f.road = b.road("road");
  return f.b >= 0;
}

}  // namespace

constinit const ForceKind tyre_element = {
    .about = "penalty tyre on the profile of a road; it pushes or does nothing",
    .keys = tyre_keys,
    .markers = ForceMarkers::one,
    .energy = EnergyCategory::tyres,
    .blank = [] { return ForceDescription::Values(T()); },
    .build = tyre_build,
    .side = tyre_side,
    .regimes = tyre_regimes,
    .example = tyre_example};

}  // namespace floatframe
