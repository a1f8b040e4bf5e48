#include "floatframe/formulas/formula_corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "floatframe/formulas/formula_evaluation.hpp"

namespace floatframe {
namespace {

constexpr double most_intervals = 10'000.0;
constexpr std::size_t most_slopes = 1000;
/// Of the range of values or slopes, and of the largest one: smaller jumps are rounding.
constexpr double smallest_of_range = 1e-6, smallest_of_size = 1e-9;

/// A value, its derivative and a bound of the one behind that, at an instant.
struct Instant {
  double t = 0.0, f = 0.0, df = 0.0, ddf = 0.0;
  bool finite() const noexcept {
    return std::isfinite(f) && std::isfinite(df) && std::isfinite(ddf);
  }
};

/// What of the change between two instants is not that of the slopes.
double unexplained(const Instant& a, const Instant& b) {
  return std::abs(b.f - a.f - 0.5 * (b.t - a.t) * (a.df + b.df));
}
/// (1)
bool may_jump(const Instant& a, const Instant& b, double rounding) {
  const double h = b.t - a.t;
  return unexplained(a, b) >
         h * std::abs(b.df - a.df) + h * h * (std::abs(a.ddf) + std::abs(b.ddf)) + rounding;
}

/// Halves the interval at whose ends `at` has been evaluated.
template <class At>
std::optional<FormulaCorner> located(Instant a, Instant b, double rounding, const At& at) {
  for (;;) {
    const double middle = a.t + 0.5 * (b.t - a.t);
    if (!(middle > a.t && middle < b.t)) break;
    const Instant m = at(middle);
    if (!m.finite()) return std::nullopt;
    (unexplained(a, m) > unexplained(m, b) ? b : a) = m;
  }
  constexpr double steepest = 10.0;  // a change of a smooth function is one of its slope
  const double change = b.f - a.f, smooth = (b.t - a.t) * std::max(std::abs(a.df), std::abs(b.df));
  if (!(std::abs(change) > std::max(steepest * smooth, rounding))) return std::nullopt;
  return FormulaCorner{b.t, change};
}

/// Its slope is continuous whatever its arguments are.
bool has_slope(const FormulaStep& s) {
  using Op = FormulaOp;
  switch (s.op) {
    case Op::number:
    case Op::reference:
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::add_number:
    case Op::multiply_number:
    case Op::small_power:
    case Op::negative:
    case Op::chirp:
    case Op::smoothstep:
      return true;
    case Op::unary:
      return std::ranges::any_of(
          std::initializer_list<std::string_view>{"sin", "cos", "exp", "tanh", "atan"},
          [&](std::string_view smooth) { return s.function->name == smooth; });
    default:
      return false;
  }
}

/// What is rounding among these numbers.
class Rounding {
 public:
  void see(double x) {
    low_ = std::min(low_, x);
    high_ = std::max(high_, x);
  }
  double size() const {
    return std::max(smallest_of_range * (high_ - low_),
                    smallest_of_size * std::max(std::abs(low_), std::abs(high_)));
  }

 private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

}  // namespace

FormulaCorners formula_corners(const Formula& f, double begin, double end, double step) {
  FormulaCorners out;
  if (!(step > 0.0) || !(end > begin) || std::ranges::all_of(f.steps, has_slope)) return out;
  if (!std::isfinite(end)) end = begin + most_intervals * step;
  const double count = std::clamp(std::ceil((end - begin) / step), 1.0, most_intervals);
  const auto value = [&](double t) -> Instant {
    const PiecewisePolynomial::Value v = formula_at(f, t);
    return {t, v.f, v.df, v.ddf};
  };
  const auto slope_of = [](const Instant& x) -> Instant { return {x.t, x.df, x.ddf, 0.0}; };
  std::vector<Instant> row;
  Rounding values, slopes;
  for (double k = 0.0; k <= count; k += 1.0) {
    row.push_back(value(begin + (end - begin) * (k / count)));
    if (!row.back().finite()) continue;
    values.see(row.back().f);
    slopes.see(row.back().df);
  }
  for (std::size_t k = 1; k < row.size() && out.slopes < most_slopes; ++k) {
    const Instant &a = row[k - 1], &b = row[k];
    if (!a.finite() || !b.finite()) continue;
    if (may_jump(a, b, values.size())) out.jump = located(a, b, values.size(), value);
    if (out.jump) break;
    const Instant before = slope_of(a), after = slope_of(b);
    const double bends = (b.t - a.t) * (std::abs(a.ddf) + std::abs(b.ddf));
    if (!(unexplained(before, after) > bends + slopes.size())) continue;
    const auto corner = located(before, after, slopes.size(),
                                [&](double t) -> Instant { return slope_of(value(t)); });
    if (!corner) continue;
    ++out.slopes;
    if (!out.slope || std::abs(corner->size) > std::abs(out.slope->size)) out.slope = corner;
  }
  return out;
}

}  // namespace floatframe
