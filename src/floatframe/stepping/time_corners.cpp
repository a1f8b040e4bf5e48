#include "floatframe/stepping/time_corners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/description/sentences.hpp"
#include "floatframe/formulas/formula_corners.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {
namespace {

/// Number of corners within two steps up to which they are located nevertheless.
constexpr std::size_t max_located_corners = 4;
constexpr double near_steps = 2.0;

bool has_corners(const Formula& f) {
  return std::ranges::any_of(f.kinks, [](const FormulaKink& k) { return k.between_pieces(); });
}

/// Just before and at a corner.
struct FormulaSides {
  PiecewisePolynomial::Value left, right;
};
FormulaSides sides_of(const Formula& f, double at) noexcept {
  constexpr double just = 4.0 * std::numeric_limits<double>::epsilon();
  return {formula_at(f, at - just * (1.0 + std::abs(at))), formula_at(f, at)};
}

bool near(double a, double b) noexcept { return std::abs(b - a) <= 1e-9 * (1.0 + std::abs(a)); }

/// One instant of a function of time.
struct Kink {
  double at = 0.0;
  bool jump = false;  ///< of its value
};

struct Kinks {
  std::vector<Kink> located;  ///< or dense
  double velocity_at = 0.0, velocity_jump = 0.0;
  std::size_t velocity_jumps = 0;  ///< of a motion
  bool all = true;                 ///< false: of a function that repeats, up to `until`
  double until = 0.0;              ///< [s]
};

/// Largest magnitudes of value and derivatives at the breaks, and of slopes between them (at the
/// breaks all of them may vanish).
PiecewisePolynomial::Value largest_at_breaks(const PiecewisePolynomial& f) {
  PiecewisePolynomial::Value most;
  const std::vector<double>& breaks = f.breaks();
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    if (k > 0 && breaks[k] > breaks[k - 1])
      most.df = std::max(
          most.df, std::abs(f.piece_value(k, breaks[k]).f - f.piece_value(k, breaks[k - 1]).f) /
                       (breaks[k] - breaks[k - 1]));
    for (const std::size_t piece : {k, k + 1}) {
      const PiecewisePolynomial::Value v = f.piece_value(piece, breaks[k]);
      most.f = std::max(most.f, std::abs(v.f));
      most.df = std::max(most.df, std::abs(v.df));
      most.ddf = std::max(most.ddf, std::abs(v.ddf));
    }
  }
  return most;
}

/// The break k is an end of a piece of less than two steps.
bool ends_a_short_piece(const std::vector<double>& breaks, std::size_t k, double step) {
  const double near = near_steps * step;
  return (k > 0 && breaks[k] - breaks[k - 1] < near) ||
         (k + 1 < breaks.size() && breaks[k + 1] - breaks[k] < near);
}

/// Of the instants in (begin, end].
Kinks kinks_of(const Forcing& forcing, double begin, double end, double step) {
  constexpr double rounding = 1e-9;  // of the largest value, slope or curvature
  const TimeFunction& function = *forcing.function;
  const PiecewisePolynomial f =
      repeated(function.pieces, function.period, begin, end, most_repeated_pieces);
  const std::vector<double>& breaks = f.breaks();
  Kinks out;
  for (const SineTerm& s : function.sines)
    for (const double at : {s.start, s.start + s.duration})
      if (s.rate != 0.0 && (forcing.rate || forcing.kind == Forcing::Kind::motion) && at > begin &&
          at <= end)
        out.located.push_back({at, false});
  if (breaks.empty()) return out;
  out.until = breaks.back();
  out.all = function.period == 0.0 || !(out.until + function.period < end);
  const PiecewisePolynomial::Value most = largest_at_breaks(f);
  for (std::size_t k = 0; k < breaks.size();) {
    const double at = breaks[k];
    std::size_t next = k + 1;  // the piece right of this break and of those equal to it
    while (next < breaks.size() && breaks[next] == at) ++next;
    const PiecewisePolynomial::Value left = f.piece_value(k, at), right = f.piece_value(next, at);
    const std::size_t here = k;
    k = next;
    if (!(at > begin) || at > end) continue;
    const bool jump = std::abs(right.f - left.f) > rounding * most.f;
    const bool corner = std::abs(right.df - left.df) > rounding * most.df;
    const bool bend = std::abs(right.ddf - left.ddf) > rounding * most.ddf;
    if (forcing.kind != Forcing::Kind::motion) {
      const bool bend_counts = forcing.rate || ends_a_short_piece(breaks, here, step);
      if (jump || corner || (bend && bend_counts)) out.located.push_back({at, jump});
    } else if (corner) {
      ++out.velocity_jumps;
      if (std::abs(right.df - left.df) <= std::abs(out.velocity_jump)) continue;
      out.velocity_jump = right.df - left.df;
      out.velocity_at = at;
    } else if (bend) {
      out.located.push_back({at, false});
    }
  }
  std::sort(out.located.begin(), out.located.end(),
            [](const Kink& a, const Kink& b) { return a.at < b.at; });
  return out;
}

/// Jumps and corners of the formula of a motion.
void add_formula(const Forcing& f, double end, const TimeCornerOptions& o, Kinks& kinks,
                 TimeCorners& out) {
  const FormulaCorners found = formula_corners(*f.function->formula, o.begin, end, o.step);
  if (found.jump)
    out.jumps.push_back(f.name + ": " + sentences::formula_jumps(found.jump->size, found.jump->at));
  kinks.velocity_jumps += found.slopes;
  if (!found.slope || std::abs(found.slope->size) <= std::abs(kinks.velocity_jump)) return;
  kinks.velocity_jump = found.slope->size;
  kinks.velocity_at = found.slope->at;
}

/// Those of a formula that are located, at the beginning of a run: for notes only.
std::vector<Kink> kinks_of_formula(const Forcing& forcing, double begin, double end, double step) {
  constexpr int most_steps = 20'000;
  std::vector<Kink> out;
  const Formula* formula = forcing.function->formula.get();
  if (!formula || !has_corners(*formula)) return out;
  double t = begin + time_corner_width * step;
  for (int k = 0; k < most_steps && t < end; ++k) {
    const double to = std::min(t + step, end), at = piece_change(*formula, t, to);
    t = std::min(at, to);
    if (std::isinf(at)) continue;
    const FormulaSides side = sides_of(*formula, at);
    if (forcing.kind != Forcing::Kind::motion || near(side.left.df, side.right.df))
      out.push_back({at, !near(side.left.f, side.right.f)});
  }
  return out;
}

bool ends_a_step(double at, const TimeCornerOptions& o) {
  const double steps = (at - o.begin) / o.step;
  return std::abs(steps - std::round(steps)) < time_corner_width;
}

/// Keeps the corners to be located; returns the number of those that are too dense.
std::size_t thin_out(std::vector<Kink>& kinks, const TimeCornerOptions& o) {
  const double near = near_steps * o.step * (1.0 + time_corner_width);
  std::vector<Kink> located;
  std::size_t dense = 0;
  for (std::size_t from = 0; from < kinks.size();) {
    std::size_t to = from + 1;
    while (to < kinks.size() && kinks[to].at - kinks[to - 1].at <= near) ++to;
    for (std::size_t k = from; k < to; ++k) {
      if (to - from <= max_located_corners || kinks[k].jump)
        located.push_back(kinks[k]);
      else if (!ends_a_step(kinks[k].at, o))
        ++dense;
    }
    from = to;
  }
  kinks.swap(located);
  return dense;
}

std::string velocity_note(const Forcing& f, const Kinks& k) {
  const std::string more = k.velocity_jumps == 1 ? ""
                           : k.velocity_jumps == 2
                               ? " (and at 1 more instant)"
                               : fmt::format(" (and at {} more instants)", k.velocity_jumps - 1);
  return fmt::format(
      "{} jumps in its velocity, by {:.4g} {} at t = {:.6g} s{}: an impulse, whose force and "
      "energy are those of the step, not of the model; round it over some steps, or write a table "
      "with interpolation: cubic",
      f.name, k.velocity_jump, f.unit, k.velocity_at, more);
}

std::string with_others(const std::string& name, std::size_t functions) {
  return functions < 2 ? name : fmt::format("{} (and {} more)", name, functions - 1);
}

std::vector<TimeCorner> merged(std::vector<double> times, double width) {
  std::sort(times.begin(), times.end());
  std::vector<TimeCorner> out;
  for (const double t : times) {
    if (!out.empty() && t - out.back().from < width)
      out.back().to = t;
    else
      out.push_back({t, t});
  }
  return out;
}

}  // namespace

std::vector<Forcing> all_forcing(const Model& model) {
  using Kind = Forcing::Kind;
  std::vector<Forcing> out;
  for (const Joint& j : model.joints)
    for (int k = 0; k < joint_velocities(j.type); ++k)
      if (const TimeFunction* motion = model.motion_of(j, k))
        out.push_back({Kind::motion, "the motion of joint '" + j.name + "'", motion, false,
                       joint_unit_name(j.type, k, true)});
  for (const Element& e : model.elements)
    for (const ElementSignal& s : signals_of(e)) {
      if (e.holds && element_kind(e.type).list != ElementList::motions)
        out.push_back({Kind::motion,
                       "the " + s.what + " of " + element_type_name(e.type) + " '" + e.name + "'",
                       &s.signal->function, false, element_output_unit(e, ElementQuantity::rate)});
      if (!e.acts) continue;
      const bool load = energy_category(e.type) == EnergyCategory::loads;
      out.push_back({s.target ? Kind::target : Kind::load,
                     (load ? "the load '" : "the " + s.what + " of '") + e.name + "'",
                     &s.signal->function, s.signal->differentiated});
    }
  return out;
}

std::vector<FormulaOfTime> formulas_of_time(const Model& model) {
  std::vector<FormulaOfTime> out;
  const auto has_formula = [](const Element& e) {
    return std::any_of(e.signals.begin(), e.signals.end(),
                       [](const Signal& s) { return s.function.formula != nullptr; });
  };
  if (std::none_of(model.elements.begin(), model.elements.end(), has_formula)) return out;
  for (const Forcing& f : all_forcing(model))
    if (f.function->formula && has_corners(*f.function->formula))
      out.push_back({f.function->formula, f.kind == Forcing::Kind::motion});
  return out;
}

double formula_corner(const FormulaOfTime& f, double from, double to) noexcept {
  const double at = piece_change(*f.formula, from, to);
  if (!f.motion || std::isinf(at)) return at;
  const FormulaSides side = sides_of(*f.formula, at);
  const bool smooth = near(side.left.f, side.right.f) && near(side.left.df, side.right.df);
  return smooth ? at : std::numeric_limits<double>::infinity();
}

TimeCorners time_corners(const Model& model, const TimeCornerOptions& o) {
  TimeCorners out;
  std::vector<double> times;
  std::size_t dense_functions = 0, functions = 0;
  std::string densest, earliest;
  double first = 0.0;
  std::size_t most = 0;
  const double end = o.begin + o.duration + time_corner_width * o.step;
  for (const Forcing& f : all_forcing(model)) {
    Kinks k = kinks_of(f, o.begin, end, o.step);
    if (!k.all)
      out.dense.push_back(
          fmt::format("{} repeats too often: steps are divided at its corners up "
                      "to t = {:.6g} s, after that it is sampled at their ends",
                      f.name, k.until));
    if (f.kind == Forcing::Kind::motion && f.function->formula) add_formula(f, end, o, k, out);
    if (k.velocity_jumps > 0) out.velocity_jumps.push_back(velocity_note(f, k));
    const std::size_t dense = o.all ? 0 : thin_out(k.located, o);
    if (dense > 0) {
      ++dense_functions;
      if (dense > most) densest = f.name;
      most = std::max(most, dense);
    }
    for (const std::vector<Kink>& list : {k.located, kinks_of_formula(f, o.begin, end, o.step)}) {
      const auto missed = std::find_if(
          list.begin(), list.end(), [&](const Kink& x) { return x.jump || !ends_a_step(x.at, o); });
      if (missed != list.end() && (++functions == 1 || missed->at < first)) {
        first = missed->at;
        earliest = f.name;
      }
    }
    // Steps treat corners at most a rounding error after the beginning as before it.
    const double first_step = o.begin + 2.0 * time_corner_width * o.step;
    for (const Kink& kink : k.located) times.push_back(std::max(kink.at, first_step));
  }
  if (dense_functions > 0)
    out.dense.push_back(
        fmt::format("{} is sampled at the ends of steps: {} of its corners follow one another "
                    "within two steps; locate_edges: true divides steps there, too",
                    with_others(densest, dense_functions), most));
  if (functions > 0)
    out.passed.push_back(
        fmt::format("{} jumps or has a corner within a step, the first at t = {:.6g} s: steps are "
                    "not divided here, so it acts from one end of that step to the other",
                    with_others(earliest, functions), first));
  out.located = merged(std::move(times), time_corner_width * o.step);
  return out;
}

}  // namespace floatframe
