// A spring with damping that pushes two points apart while they are closer than L: the contact of
// contact_law.hpp of the compression d = L - s, ddot = -sdot, with the force f = -push
//   wrench       f n on a, -f n on b
//   rows         slope n n^T, f/s (I - n n^T) and the damping b k d^n n n^T
#include "floatframe/model/contact_law.hpp"
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
  const LineMeasure<S> line = line_measure(in);
  const S d = in.template keys<UnilateralSpring>().length - line.length;
  out.rate = line.rate;
  out.length = line.length;
  if (!touches(in, d)) return;
  const ContactForce<S> contact =
      contact_force(in.template data<ContactSpring>(), value_of(in.state(0)), d, S(-line.rate));
  if (contact.pushes) pull_along(line, S(-contact.push), contact.slope, contact.damping, out);
  out.energy = contact.energy;
  out.energy_rate = contact.energy_rate;
  out.damping = out.force * line.rate - out.energy_rate;
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

bool unilateral_spring_build(ElementBuild& build) {
  build.element.data =
      std::make_shared<const ContactSpring>(contact_spring(build.keys<UnilateralSpring>()));
  return build_line(build);
}

using UnilateralKeys = ContactKeys<UnilateralSpring>;
constexpr ElementKey unilateral_spring_keys[] = {
    place_key("from", "one end", described_by<&UnilateralSpring::a>),
    place_key("to", "the other end", described_by<&UnilateralSpring::b>),
    UnilateralKeys::number("length", "below which it acts", positive_number("m"),
                           described_by<&UnilateralSpring::length>),
    UnilateralKeys::stiffness("N/m^exponent"),
    UnilateralKeys::exponent,
    UnilateralKeys::restitution,
    UnilateralKeys::least_speed("m/s")};

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
  x.element.data = std::make_shared<const ContactSpring>(contact_spring(f));
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
    .contact = true,
    .dual = unilateral_spring_law<Dual>,
    .side = unilateral_spring_side,
    .picture = picture_of_line,
    .regimes = unilateral_spring_regimes};

constinit const ExampleMaker unilateral_spring_examples = unilateral_spring_example;

}  // namespace floatframe
