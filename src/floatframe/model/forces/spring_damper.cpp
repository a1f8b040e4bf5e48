// Spring and damper along the line between two points: s = |d|, d = r_b - r_a, n = d/s,
// f = spring(s) + damper(sdot) + actuator.
//   wrench       f n on a, -f n on b
//   stiffness    f_s n n^T + f/s (I - n n^T) + f_sdot n (dsdot/dd)^T,  dsdot/dd = (I - n n^T) v / s
//   damping      f_sdot n n^T
// between the points a and b. The first two terms of the stiffness are three rows.
#include "floatframe/model/force_kind.hpp"
#include "floatframe/model/sentences.hpp"

namespace floatframe {

namespace {

/// Points closer than this define no line: the force keeps the direction x, and the tangent only
/// contains the slope of the law [m].
constexpr double coincident = 1e-12;

struct Line {
  Vec3 n;
  double length, rate;
};

Line line_between(const MarkerState& a, const MarkerState& b) noexcept {
  const Vec3 d = b.r - a.r;
  const double length = d.norm();
  const Vec3 n = length > coincident ? Vec3(d / length) : Vec3::UnitX();
  return {n, length, n.dot(b.v - a.v)};
}

}  // namespace

template <>
void force_of<ForceType::spring_damper>(const ForceInput& in, ForceState& out) noexcept {
  const auto [n, length, rate] = line_between(in.a, in.b);
  const PiecewisePolynomial::Value s = spring_of(in, length), c = damper_of(in, rate);
  const Vec3 zero = Vec3::Zero();
  out.length = length;
  out.rate = rate;
  out.force = s.f + c.f + in.actuator();
  const Vec3 pull = out.force * n;
  out.wrench = {pull, zero, -pull, zero};
  out.rows[0] = {{-n, zero, n, zero}, s.df, c.df};
  out.row_count = 1;
  if (length > coincident) {
    Vec3 t1, t2;
    orthonormal_complement(n, t1, t2);
    const double k = out.force / length;
    out.rows[1] = {{-t1, zero, t1, zero}, k, 0.0};
    out.rows[2] = {{-t2, zero, t2, zero}, k, 0.0};
    out.row_count = 3;
  }
  out.energy = law_energy(in.force.spring, length);
  out.energy_rate = s.f * rate;
  out.damping = c.f * rate;
}

template <>
void force_tangent_of<ForceType::spring_damper>(const ForceInput& in, ForceTangent& out) noexcept {
  const auto [n, length, rate] = line_between(in.a, in.b);
  const PiecewisePolynomial::Value s = in.force.spring(length), c = in.force.damper(rate);
  const Mat3 along = n * n.transpose();
  Mat3 K = s.df * along;
  if (length > coincident) {
    const Mat3 across = Mat3::Identity() - along;
    K += (s.f + c.f + in.actuator()) / length * across;
    const Vec3 turn = across * (in.b.v - in.a.v) / length;
    K += c.df * n * turn.transpose();
  }
  const auto spread = [](const Mat3& block, Mat12& whole) {
    using namespace part_of;
    whole.block<3, 3>(r_a, r_a) = whole.block<3, 3>(r_b, r_b) = block;
    whole.block<3, 3>(r_a, r_b) = whole.block<3, 3>(r_b, r_a) = -block;
  };
  spread(K, out.K);
  spread(c.df * along, out.C);
}

namespace {

ForceSide spring_damper_side(const ForceInput& in) noexcept {
  const auto [n, length, rate] = line_between(in.a, in.b);
  return spring_side(in, length, rate);
}

constexpr ForceRegime spring_damper_regimes[] = {{.name = "anywhere"},
                                                 {.name = "short"},
                                                 {.name = "points_coincide", .regular = false},
                                                 {.name = "actuated", .conservative = false}};

ForceExample spring_damper_example(std::size_t regime, ExampleNumbers& numbers) {
  ForceExample x;
  x.force.type = ForceType::spring_damper;
  x.force.spring = example_spring(numbers);
  x.force.damper = example_damper(numbers);
  x.a = numbers.marker();
  x.b = numbers.marker();
  if (regime == 1) x.b.r = x.a.r + 0.1 * numbers.direction();
  if (regime == 2) x.b.r = x.a.r;
  if (regime == 3) add_example_drive(x, numbers);
  return x;
}

using S = SpringDamperDescription;

constexpr ForceKey spring_damper_keys[] = {
    place_key("from", "one end", described_by<&S::a>),
    place_key("to", "the other end", described_by<&S::b>),
    law_key("spring", ForceKeyKind::spring, "of the length", described_by<&S::spring>),
    law_key("damper", ForceKeyKind::damper, "of the rate of the length", described_by<&S::damper>),
    bump_stop_key,
    rebound_stop_key,
    law_key("actuator", ForceKeyKind::load, "tension added to both", described_by<&S::actuator>)};

double distance_in_design(const ForceView& values, const ForceKey&) {
  return (values.place("from").point - values.place("to").point).norm();
}

void spring_damper_validate(const ForceCheck& check) {
  if (check.two_bodies("from", "to")) {
    const AttachmentDescription a = check.place("from"), b = check.place("to");
    if (check.from_file || (!a.node && !b.node))
      if (const auto complaint = sentences::spring_ends(a.point, b.point))
        check.error(ErrorCode::out_of_range, "", *complaint);
  }
  check.some_law();
}

bool spring_damper_build(ForceBuild& b) {
  b.force.a = b.marker("from", false);
  b.force.b = b.marker("to", false);
  b.spring_damper_actuator();
  return b.has_ends();
}

}  // namespace

constinit const ForceKind spring_damper_element = {
    .about = "spring and damper along the line between two points; tension is positive",
    .keys = spring_damper_keys,
    .blank = [] { return ForceDescription::Values(S()); },
    .free_value = distance_in_design,
    .validate = spring_damper_validate,
    .build = spring_damper_build,
    .along_line = true,
    .side = spring_damper_side,
    .regimes = spring_damper_regimes,
    .example = spring_damper_example};

}  // namespace floatframe
