// A spring with damping that pushes two points apart while they are closer than L: compression
// d = L - s, ddot = -sdot (Hunt and Crossley 1975),
//   f = -k d^n (1 + b ddot), not tensile, in touch;  0 apart; d^n odd in d on a held branch
//   wrench       f n on a, -f n on b
//   rows         k n d^(n-1) (1 + b ddot) n n^T, f/s (I - n n^T) and the damping k d^n b n n^T
// b makes the restitution exact: of m d'' = -k d^n (1 + b d') from the speed v to -e v the
// integrals of u du / (1 + b u) are equal on the way in and out: with c = b v
//   c (1 + e) = ln((1 + c) / (1 - c e))                                                        (1)
// v is the speed of the touch: a kept number, the speed at the end of the last step apart, which is
// the touch where edges are located.
#include <algorithm>
#include <cmath>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

/// Branches.
constexpr std::int64_t apart = 0, in_touch = 1;

template <class S>
bool touches(const PortsOf<S>& in, const S& d) noexcept {
  return in.branch == free_branch ? value_of(d) > 0.0 : in.branch == in_touch;
}

template <class S>
void unilateral_spring_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  using std::abs;
  using std::pow;
  const auto& keys = in.template keys<UnilateralSpring>();
  const LineMeasure<S> line = line_measure(in);
  const S rate = out.rate = line.rate, d = keys.length - line.length;
  out.length = line.length;
  if (!touches(in, d) || value_of(d) == 0.0) return;
  const double speed = std::max(value_of(in.state(0)), keys.least_speed);
  const double b = in.template data<double>() / speed, k = keys.stiffness, e = keys.exponent;
  const S size = abs(d), slope = k * pow(size, e - 1.0), push = slope * d, factor = 1.0 - b * rate;
  const bool pushes = value_of(factor) > 0.0;
  out.energy = slope * d * d / (e + 1.0);
  out.energy_rate = -push * rate;
  if (pushes)
    pull_along(line, S(-push * factor), value_of(e * slope * factor), value_of(push * b), out);
  out.damping = out.force * rate - out.energy_rate;
}

}  // namespace

FLOATFRAME_LAW(unilateral_spring)

namespace {

BranchSide unilateral_spring_side(const Ports& in) noexcept {
  const double d = in.keys<UnilateralSpring>().length - line_measure(in).length;
  if (in.branch == free_branch) return {-1.0, d > 0.0 ? in_touch : apart};
  return in.branch == in_touch ? BranchSide{-d, apart} : BranchSide{d, in_touch};
}

void keep_touch_speed(const Ports& in, double* kept) noexcept {
  const LineMeasure<double> line = line_measure(in);
  if (!touches(in, in.keys<UnilateralSpring>().length - line.length)) *kept = -line.rate;
}

/// c of (1).
double damping_of_restitution(double e) {
  if (!(e < 1.0)) return 0.0;
  double low = 0.0, high = 1.0 / e;
  for (int k = 0; k < 200; ++k) {
    const double c = 0.5 * (low + high);
    (c * (1.0 + e) > std::log1p(c) - std::log1p(-c * e) ? low : high) = c;
  }
  return 0.5 * (low + high);
}

bool unilateral_spring_build(ElementBuild& build) {
  build.element.data = std::make_shared<const double>(
      damping_of_restitution(build.keys<UnilateralSpring>().restitution));
  return build_line(build);
}

constexpr ElementKey contact_number(const char* name, const char* about, NumberRule rule,
                                    KeyMember member, double fallback = 0.0) {
  return {.name = name,
          .kind = KeyKind::number,
          .about = about,
          .required = fallback == 0.0,
          .rule = rule,
          .fallback = fallback,
          .member = member};
}
constexpr NumberRule restitutions = {"a number above 0 and up to 1", "", 0.0, 1.0, true};
constexpr ElementKey unilateral_spring_keys[] = {
    place_key("from", "one end", described_by<&UnilateralSpring::a>),
    place_key("to", "the other end", described_by<&UnilateralSpring::b>),
    contact_number("length", "below which it acts", positive_number("m"),
                   described_by<&UnilateralSpring::length>),
    contact_number("stiffness", "force per compression to the power of `exponent`",
                   positive_number("N/m^exponent"), described_by<&UnilateralSpring::stiffness>),
    contact_number("exponent", "of the compression; 1.5: Hertz", {"a number >= 1", "", 1.0},
                   described_by<&UnilateralSpring::exponent>, 1.0),
    contact_number("restitution",
                   "of a touch: the speed apart over the speed together, if nothing else acts",
                   restitutions, described_by<&UnilateralSpring::restitution>, 1.0),
    contact_number("least_speed", "slower touches are damped as one at this speed",
                   positive_number("m/s"), described_by<&UnilateralSpring::least_speed>, 0.01)};

constexpr ElementRegime unilateral_spring_regimes[] = {
    {.name = "linear"}, {.name = "hertz"}, {.name = "apart", .acts = false}};

ElementExample unilateral_spring_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  UnilateralSpring f;
  const MarkerState a = numbers.marker(), b = numbers.marker();
  const double distance = (b.r - a.r).norm();
  f.length = regime == 2 ? 0.9 * distance : distance + numbers(0.2, 0.5);
  f.stiffness = numbers(50.0, 90.0);
  f.exponent = regime == 1 ? 1.5 : 1.0;
  f.restitution = numbers(0.5, 0.9);
  x.markers = {a, b};
  x.keys(f);
  x.element.data = std::make_shared<const double>(damping_of_restitution(f.restitution));
  x.states = {numbers(30.0, 50.0)};
  return x;
}

}  // namespace

constinit const ElementKind unilateral_spring_element = {
    .about =
        "contact of two points that are closer than a length: a spring, linear or of Hertz, "
        "with the damping of a given restitution",
    .keys = unilateral_spring_keys,
    .blank = [] { return ElementKeys(UnilateralSpring()); },
    .validate = validate_line,
    .build = unilateral_spring_build,
    .states = [](Element& element) { element.kept = 1; },
    .after_step = keep_touch_speed,
    .along_line = true,
    .dual = unilateral_spring_law<Dual>,
    .side = unilateral_spring_side,
    .picture = picture_of_line,
    .regimes = unilateral_spring_regimes,
    .example = unilateral_spring_example};

}  // namespace floatframe
