#include "floatframe/run/step_differences.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace floatframe {
namespace {

constexpr double least_order = 0.5, largest_order = 3.5;
/// Rounding, relative to the range of an output, and to the largest output of the same unit. With a
/// range below `least_range`, relative to the latter, the whole output is rounding.
constexpr double rounding_of_range = 1e-10, rounding_of_unit = 1e-12, least_range = 1e-8;

double apart(double a, double b) noexcept {
  if (std::isfinite(a) && std::isfinite(b)) return std::abs(a - b);
  return a == b || (std::isnan(a) && std::isnan(b)) ? 0.0 : std::numeric_limits<double>::infinity();
}

}  // namespace

NextRow rows_of(const ResultTable& table) {
  return [&table, k = std::size_t{0}]() mutable {
    return k < table.rows() ? table.data.data() + table.columns.size() * k++ : nullptr;
  };
}

StepDifferences::StepDifferences(NextRow run, const ResultTable& half, double close,
                                 std::vector<char> latched)
    : run_(std::move(run)), half_(half), close_(close), now_(run_()) {
  outputs_.resize(half.columns.size() - 1);
  for (std::size_t k = 0; k < latched.size() && k < outputs_.size(); ++k)
    outputs_[k].latched = latched[k];
}

/// `apart`, of a latched output only where both have a number.
double StepDifferences::difference(bool latched, double a, double b, double t,
                                   double& missing) noexcept {
  const bool waits = latched && std::isnan(a) != std::isnan(b);
  missing = waits ? std::min(missing, t) : no_time;
  return waits ? 0.0 : apart(a, b);
}

/// Compares the current row of the run and advances to the next.
void StepDifferences::row(const double* quarter) {
  const std::size_t width = half_.columns.size();
  const double t = now_[0];
  while (half_row_ < half_.rows() && before(half_.at(half_row_, 0), t)) ++half_row_;
  const bool common = half_row_ < half_.rows() && !before(t, half_.at(half_row_, 0));
  if (common) {
    if (found_.instants++ == 0) found_.from = t;
    found_.to = t;
  }
  for (std::size_t k = 0; k + 1 < width; ++k) {
    Gathered& g = outputs_[k];
    const double x = now_[k + 1];
    g.low = std::min(g.low, x);
    g.high = std::max(g.high, x);
    if (!common) continue;
    const double y = half_.at(half_row_, k + 1), d = difference(g.latched, x, y, t, g.missing);
    if (d > g.largest) {
      g.largest = d;
      g.at = t;
    }
    if (!quarter) continue;
    const double second = difference(g.latched, y, quarter[k + 1], t, g.missing_second);
    if (g.latched && std::isnan(x + y + quarter[k + 1])) continue;
    g.first = std::max(g.first, d);
    g.second = std::max(g.second, second);
  }
  now_ = run_();
}

void StepDifferences::take(std::span<const double> rows) {
  const std::size_t width = half_.columns.size();
  for (std::size_t k = 0; k + width <= rows.size(); k += width) {
    const double* quarter = rows.data() + k;
    while (now_ && before(now_[0], quarter[0])) row(nullptr);
    if (now_ && !before(quarter[0], now_[0])) {
      ++of_three_;
      row(quarter);
    }
  }
}

Verification StepDifferences::result() {
  while (now_) row(nullptr);
  std::map<std::string, double> largest;  // by unit
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    Gathered& g = outputs_[k];
    if (g.missing < no_time) {
      g.largest = g.first = std::numeric_limits<double>::infinity();
      g.at = g.missing;
    }
    if (g.missing_second < no_time) g.second = std::numeric_limits<double>::infinity();
    const Column& column = half_.columns[k + 1];
    const bool some = g.low <= g.high;  // numbers
    const double magnitude = some ? std::max(std::abs(g.low), std::abs(g.high)) : 0.0;
    const double range = some ? g.high - g.low : 0.0;
    found_.outputs.push_back({column, g.largest, g.at, g.first, g.second, range, magnitude,
                              of_three_ > 1 ? Convergence::regular : Convergence::unknown});
    largest[column.unit] = std::max(largest[column.unit], magnitude);
  }
  for (VerifiedOutput& o : found_.outputs) {
    const double unit = largest[o.column.unit];
    estimate(o, std::max(rounding_of_range * o.range,
                         (o.range < least_range * unit ? least_range : rounding_of_unit) * unit));
  }
  return std::move(found_);
}

void estimate(VerifiedOutput& o, double noise) noexcept {
  o.error = o.largest;
  if (o.largest <= noise) o.convergence = Convergence::round_off;
  if (o.convergence != Convergence::regular) return;
  const double p = std::log2(o.first / o.second);
  if (p > largest_order && std::isfinite(o.first))
    o.convergence = Convergence::too_coarse;
  else if (!(p >= least_order) || !std::isfinite(o.first))
    o.convergence = Convergence::none;
  if (o.convergence == Convergence::none) o.error = std::max(o.largest, o.second);
  if (o.convergence != Convergence::regular) return;
  o.order = p;
  o.error = o.largest * std::exp2(p) / (std::exp2(p) - 1.0);
}

}  // namespace floatframe
