// Force of a program: F(x, v, t), with x the length and v the rate of the line between two points,
// or q and qdot of a joint with one coordinate (port_measures.hpp). In steps and for exact
// derivatives its slopes are those that the function gives, else central differences over
// h = 1e-6 (1 + |x|): their error is h^2 F'''/6 from the curvature and 1e-16 F/h from rounding.
// The switches of a formula are its branches (formula_branches.hpp).
//   rows         F_x g g^T and the damping F_v g g^T, along a line F/s (I - n n^T) too
//   energy       none: its power is that of an actuator
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/formula_branches.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

struct ForceLawSlopes {
  double f = std::numeric_limits<double>::quiet_NaN(), dx = 0.0, dv = 0.0;
};

template <class Number>
Number force_law_formula(const Formula& f, const Number& x, const Number& v, double t,
                         FormulaSwitches& switches, FormulaFault& fault) noexcept {
  const auto operand = [&](int i) -> Number {
    const FormulaReference& r = f.references[i];
    return r.is_time() ? Number(t) : r.name == "x" ? x : v;
  };
  return evaluate_formula<Number>(f, operand, switches, fault);
}

ForceLawSlopes force_law_slopes(const Formula& f, double x, double v, double t,
                                std::int64_t branch) noexcept {
  using Variable = DualNumber<2>;
  FormulaSwitches switches = switches_of_branch(branch);
  FormulaFault fault;
  const Variable y =
      force_law_formula(f, Variable::variable(x, 0), Variable::variable(v, 1), t, switches, fault);
  return {y.v, y.d[0], y.d[1]};
}

/// Of the derivative by x, from f(x +- h).
template <class Function>
double force_law_difference(double x, const Function& f) {
  const double h = 1e-6 * (1.0 + std::abs(x));
  return (f(x + h).force - f(x - h).force) / (2.0 * h);
}

/// The function is called by nobody else. What it throws is kept in `thrown`.
ForceLawSlopes force_law_slopes(const ForceFunction& law, double x, double v, double t,
                                std::exception_ptr& thrown) noexcept {
  ForceLawSlopes y;
  if (!std::isfinite(x) || !std::isfinite(v)) return y;
  try {
    const ForceLawValue now = law(x, v, t);
    if (!std::isfinite(now.force)) return y;
    y.dx = now.dx ? *now.dx : force_law_difference(x, [&](double at) { return law(at, v, t); });
    y.dv = now.dv ? *now.dv : force_law_difference(v, [&](double at) { return law(x, at, t); });
    if (!std::isfinite(y.dx) || !std::isfinite(y.dv))
      throw std::domain_error(fmt::format(
          "found the derivatives {:g} and {:g} by x and v{} at x = {:g}, v = {:g}, expected finite "
          "numbers",
          y.dx, y.dv, now.dx && now.dv ? "" : ", by differences,", x, v));
    y.f = now.force;
  } catch (...) {
    thrown = std::current_exception();
    y = {};
  }
  return y;
}

template <class S>
void force_law_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const auto force = [&](const S& x, const S& v, ForceLawSlopes& y) {
    const ForceFunction& law = in.template keys<ForceLaw>().law;
    const Formula* formula = law.formula().get();
    y = formula ? force_law_slopes(*formula, value_of(x), value_of(v), in.t, in.branch)
                : force_law_slopes(law, value_of(x), value_of(v), in.t, out.thrown);
    return S(chained(y.f, y.dx, x) + chained(0.0, y.dv, v));
  };
  out.thrown = nullptr;
  ForceLawSlopes y;
  if (!in.element.coordinates.empty()) {
    const AxisMeasure<S> m = coordinate_measure(in);
    const S f = force(m.s, m.rate, y);
    pull_back(m, f, y.dx, y.dv, out);
  } else {
    const LineMeasure<S> line = line_measure(in);
    const S f = force(line.length, line.rate, y);
    pull_along(line, f, y.dx, y.dv, out);
  }
}

}  // namespace

FLOATFRAME_LAW(force_law)

namespace {

/// Of a law by a formula, at the present length or coordinate and rate.
void evaluate_force_law(const Ports& in, FormulaSwitches& switches, FormulaFault& fault) noexcept {
  const Formula& f = *in.keys<ForceLaw>().law.formula();
  if (in.element.coordinates.empty()) {
    const LineMeasure<double> line = line_measure(in);
    force_law_formula(f, line.length, line.rate, in.t, switches, fault);
  } else {
    const AxisMeasure<double> m = coordinate_measure(in);
    force_law_formula(f, m.s, m.rate, in.t, switches, fault);
  }
}

BranchSide force_law_side(const Ports& in) noexcept {
  return formula_branch_side(in.branch, [&](FormulaSwitches& switches, FormulaFault& fault) {
    evaluate_force_law(in, switches, fault);
  });
}

std::string force_law_complaint(const Ports& in) {
  const SharedFormula& f = in.keys<ForceLaw>().law.formula();
  if (!f) return "";
  FormulaSwitches switches = switches_of_branch(in.branch);
  FormulaFault fault;
  evaluate_force_law(in, switches, fault);
  return fault_text(*f, fault);
}

constexpr const char* force_law_axis = "the turning of the axis with its body";
constexpr ElementRegime force_law_regimes[] = {
    {.name = "line", .conservative = false},
    {.name = "line_by_differences", .conservative = false, .differences = true},
    {.name = "along", .rows_leave_out = force_law_axis, .conservative = false},
    {.name = "along_by_differences",
     .rows_leave_out = force_law_axis,
     .conservative = false,
     .differences = true},
    {.name = "about_after_turns", .rows_leave_out = force_law_axis, .conservative = false}};

ElementExample force_law_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  const PiecewisePolynomial spring = example_spring(numbers), damper = example_damper(numbers);
  const bool differences = regime == 1 || regime == 3, turns = regime == 4;
  ForceLaw f;
  f.law = [=](double s, double v, double t) -> ForceLawValue {
    const PiecewisePolynomial::Value k = spring(s), c = damper(v);
    const double force = k.f + c.f + 20.0 * t + 5.0 * s * v;
    if (differences) return force;
    return {force, k.df + 5.0 * v, c.df + 5.0 * s};
  };
  const MarkerState a = numbers.marker();
  x.markers = {a, turns ? numbers.marker_on_axis(a) : numbers.marker()};
  x.t = numbers(0.0, 1.0);
  x.keys(f);
  if (regime >= 2) x.element.coordinates.push_back({});
  x.element.rotational = turns;
  if (turns) x.reference_angle = 6.0 * std::numbers::pi;
  return x;
}

constexpr ElementKey force_law_keys[] = {{.name = "from",
                                          .kind = KeyKind::place,
                                          .about = "one end of the line",
                                          .member = described_by<&ForceLaw::a>},
                                         {.name = "to",
                                          .kind = KeyKind::place,
                                          .about = "the other end",
                                          .member = described_by<&ForceLaw::b>},
                                         {.name = "joint",
                                          .kind = KeyKind::joint,
                                          .about = "instead of a line: one with one coordinate q",
                                          .member = described_by<&ForceLaw::joint>},
                                         {.name = "law",
                                          .kind = KeyKind::function,
                                          .about = "of the length or q, its rate and the time",
                                          .required = true,
                                          .axis = ElementAxis::coordinate,
                                          .member = described_by<&ForceLaw::law>}};

void force_law_validate(const ElementCheck& check) {
  const bool from = check.has("from"), to = check.has("to"), joint = check.has("joint");
  if (joint ? from || to : !from || !to) {
    if (check.wrong.empty()) check.error(ErrorCode::incomplete, "", sentences::law_on_what());
    return;
  }
  joint ? validate_coordinate(check) : void(check.two_bodies("from", "to"));
}

bool force_law_build(ElementBuild& b) {
  return b.has("joint") ? build_coordinate(b) : build_line(b);
}

Picture force_law_picture(const Element& element) {
  return element.coordinates.empty() ? picture_of_line(element) : picture_of_coordinate(element);
}

}  // namespace

constinit const ElementKind force_law_element = {
    .about =
        "a function of a program or a formula, F(x, v, t): tension along a line of the length x, "
        "or a force on "
        "a joint against its coordinate x",
    .keys = force_law_keys,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(ForceLaw()); },
    .validate = force_law_validate,
    .build = force_law_build,
    .along_line = true,
    .complaint = force_law_complaint,
    .dual = force_law_law<Dual>,
    .side = force_law_side,
    .picture = force_law_picture,
    .regimes = force_law_regimes};

constinit const ExampleMaker force_law_examples = force_law_example;

}  // namespace floatframe
