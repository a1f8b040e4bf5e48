#include "floatframe/run/forcing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/math/frequency.hpp"
#include "floatframe/math/piecewise_build.hpp"

namespace floatframe {
namespace {

/// A value of a table between the ends of a step that cannot be inferred from them or from the
/// values between.
struct Passed {
  double part = 0.0;  ///< of the range of the table
  double at = 0.0, value = 0.0, before = 0.0, after = 0.0, gap = 0.0;
};

/// True if steps are divided there.
bool is_located(std::span<const TimeCorner> located, double t) {
  const auto c = std::lower_bound(located.begin(), located.end(), t,
                                  [](const TimeCorner& x, double at) { return x.to < at; });
  return c != located.end() && !(c->from > t);
}

Passed passed_value(const PiecewisePolynomial& table, double step, double begin, double duration,
                    std::span<const TimeCorner> located) {
  Passed worst;
  const std::vector<double>& breaks = table.breaks();
  const double end = begin + duration;
  const auto first = std::upper_bound(breaks.begin(), breaks.end(), begin);
  const auto last = std::lower_bound(breaks.begin(), breaks.end(), end);
  if (first >= last) return worst;
  double low = std::min(table(begin).f, table(end).f),
         high = std::max(table(begin).f, table(end).f);
  for (auto b = first; b != last; ++b)
    for (const double f :
         {table(*b).f, table.piece_value(static_cast<std::size_t>(b - breaks.begin()), *b).f}) {
      low = std::min(low, f);
      high = std::max(high, f);
    }
  if (!(high > low)) return worst;
  for (auto b = first; b != last; ++b) {
    const double steps = std::floor((*b - begin) / step);
    const double from = begin + steps * step, to = std::min(from + step, end);
    if (std::min(*b - from, to - *b) < 1e-6 * step) continue;  // the end of a step
    if (is_located(located, *b)) continue;
    const double before = table(from).f, after = table(to).f;
    // Both sides of a jump.
    const std::size_t k = b - breaks.begin();
    for (const double f : {table.piece_value(k, *b).f, table(*b).f}) {
      const double part =
          std::max(f - std::max(before, after), std::min(before, after) - f) / (high - low);
      if (part <= worst.part) continue;
      double gap = step;
      if (b != breaks.begin() && *b > *(b - 1)) gap = std::min(gap, *b - *(b - 1));
      if (b + 1 != breaks.end() && *(b + 1) > *b) gap = std::min(gap, *(b + 1) - *b);
      worst = {part, *b, f, before, after, gap};
    }
  }
  return worst;
}

/// Of sines and of the two ends of chirps [Hz].
double highest_frequency(const TimeFunction& f) {
  double most = 0.0;
  for (const SineTerm& s : f.sines)
    if (s.amplitude != 0.0)
      most = std::max({most, std::abs(s.frequency), std::abs(s.frequency + s.rate * s.duration)});
  return most;
}

std::string subject(const Forcing& worst, int others) {
  return others == 0 ? worst.name : fmt::format("{} (and {} more)", worst.name, others);
}

}  // namespace

std::vector<RangeWarning> unresolved_forcing(const Model& model, double step, double begin,
                                             double duration, std::span<const TimeCorner> located,
                                             const ForcingLimits& limits) {
  std::vector<RangeWarning> out;
  const std::vector<Forcing> all = all_forcing(model);
  const Forcing* worst = nullptr;
  double phase = limits.phase, highest = 0.0;
  int count = 0;
  for (const Forcing& f : all) {
    const double frequency = highest_frequency(*f.function);
    const double x = omega_of(frequency) * step;
    if (!(x > limits.phase)) continue;
    ++count;
    if (x > phase) {
      phase = x;
      highest = frequency;
      worst = &f;
    }
  }
  if (worst)
    out.push_back(
        {RangeLimit::sine,
         fmt::format(
             "the step of {:g} s is too long for {}: its sine of {:g} Hz goes through {:.3g} rad "
             "of phase in each step (limit {:g} rad), {:.2g} steps per period; take a step of at "
             "most {:.2g} s",
             step, subject(*worst, count - 1), highest, phase, limits.phase,
             2.0 * std::numbers::pi / phase, step * limits.phase / phase)});
  worst = nullptr;
  count = 0;
  Passed most;
  for (const Forcing& f : all) {
    const TimeFunction& function = *f.function;
    const Passed p = passed_value(
        repeated(function.pieces, function.period, begin, begin + duration, most_repeated_pieces),
        step, begin, duration, located);
    if (!(p.part > limits.passed)) continue;
    ++count;
    if (p.part > most.part) {
      most = p;
      worst = &f;
    }
  }
  if (worst)
    out.push_back({RangeLimit::table,
                   fmt::format("the step of {:g} s passes over values in the table of {}: it has "
                               "{:.4g} at t = {:.6g} s but {:.4g} and {:.4g} at the ends of the "
                               "step there (limit {:g} % of its range); take a step of at most "
                               "{:.2g} s, the distance of its entries there",
                               step, subject(*worst, count - 1), most.value, most.at, most.before,
                               most.after, 100.0 * limits.passed, most.gap)});
  return out;
}

}  // namespace floatframe
