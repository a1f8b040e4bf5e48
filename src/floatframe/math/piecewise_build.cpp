#include "floatframe/math/piecewise_build.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

/// Three-point end slope that keeps the shape (one-sided, limited).
double end_slope(double h0, double h1, double d0, double d1) {
  const double s = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (s * d0 <= 0.0) return 0.0;
  if (d0 * d1 <= 0.0 && std::abs(s) > 3.0 * std::abs(d0)) return 3.0 * d0;
  return s;
}

/// Between intervals of lengths h and slopes d; turning points are preserved.
double inner_slope(double h0, double h1, double d0, double d1) {
  if (d0 * d1 <= 0.0) return 0.0;
  const double w1 = 2.0 * h1 + h0, w2 = h1 + 2.0 * h0;
  return (w1 + w2) / (w1 / d0 + w2 / d1);
}

std::vector<double> pchip_slopes(const std::vector<TablePoint>& p) {
  const std::size_t n = p.size();
  std::vector<double> h(n - 1), d(n - 1), s(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = p[i + 1].x - p[i].x;
    d[i] = (p[i + 1].f - p[i].f) / h[i];
  }
  if (n == 2) return {d[0], d[0]};
  s[0] = end_slope(h[0], h[1], d[0], d[1]);
  s[n - 1] = end_slope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  for (std::size_t i = 1; i + 1 < n; ++i) s[i] = inner_slope(h[i - 1], h[i], d[i - 1], d[i]);
  return s;
}

/// Coefficients about `centre` of a piece given about another centre (Taylor shift).
std::vector<double> shifted(const PiecewisePolynomial::Piece& piece, double centre) {
  std::vector<double> c = piece.coefficients;
  const double t = centre - piece.centre;
  if (t == 0.0) return c;
  for (std::size_t j = 0; j + 1 < c.size(); ++j)
    for (std::size_t k = c.size() - 1; k-- > j;) c[k] += t * c[k + 1];
  return c;
}

}  // namespace

namespace {

/// `jumps`: two points may have the same x.
void require_ascending(const std::vector<TablePoint>& p, std::size_t least, bool jumps) {
  if (p.size() < least)
    throw InputError(ErrorCode::out_of_range, "found " + std::to_string(p.size()) +
                                                  " points of a table, expected at least " +
                                                  std::to_string(least));
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!std::isfinite(p[i].x) || !std::isfinite(p[i].f))
      throw InputError(ErrorCode::not_finite, "point " + std::to_string(i + 1) +
                                                  " of a table: found a number that is not finite");
    if (i > 0 && !(jumps ? p[i].x >= p[i - 1].x : p[i].x > p[i - 1].x))
      throw InputError(ErrorCode::contradiction, "point " + std::to_string(i + 1) +
                                                     " of a table: found an x that is " +
                                                     (jumps ? "below" : "not above") +
                                                     " the one before it, expected ascending x");
  }
}

/// At the joint of two periods: as between two intervals.
double slope_across(const std::vector<TablePoint>& p) {
  const std::size_t n = p.size();
  const double h0 = p[n - 1].x - p[n - 2].x, h1 = p[1].x - p[0].x;
  return inner_slope(h0, h1, (p[n - 1].f - p[n - 2].f) / h0, (p[1].f - p[0].f) / h1);
}

/// Slopes at points with x ascending; zero at the ends of a table with constant ends. Zero for a
/// single point.
std::vector<double> table_slopes(const std::vector<TablePoint>& p, bool flat_begin, bool flat_end) {
  std::vector<double> s = p.size() > 1 ? pchip_slopes(p) : std::vector<double>{0.0};
  if (flat_begin) s.front() = 0.0;
  if (flat_end) s.back() = 0.0;
  return s;
}

/// The pieces between points with x ascending, none for a single point. `slopes` of cubic pieces;
/// empty: straight lines.
void append_pieces(const std::vector<TablePoint>& p, const std::vector<double>& slopes,
                   std::vector<PiecewisePolynomial::Piece>& pieces) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const double h = p[i + 1].x - p[i].x, d = (p[i + 1].f - p[i].f) / h;
    if (slopes.empty())
      pieces.push_back({p[i].x, {p[i].f, d}});
    else
      pieces.push_back({p[i].x,
                        {p[i].f, slopes[i], (3.0 * d - 2.0 * slopes[i] - slopes[i + 1]) / h,
                         (slopes[i] + slopes[i + 1] - 2.0 * d) / (h * h)}});
  }
}

}  // namespace

PiecewisePolynomial table_function(const std::vector<TablePoint>& p, Interpolation interpolation,
                                   Beyond beyond) {
  require_ascending(p, 2, false);
  std::vector<double> breaks, slopes;
  for (const TablePoint& q : p) breaks.push_back(q.x);
  const bool hold = beyond == Beyond::hold;
  if (interpolation == Interpolation::cubic) slopes = table_slopes(p, hold, hold);
  std::vector<PiecewisePolynomial::Piece> pieces(1);
  append_pieces(p, slopes, pieces);
  double first = 0.0, last = 0.0;
  if (!hold) {
    first = slopes.empty() ? pieces[1].coefficients[1] : slopes.front();
    last = slopes.empty() ? pieces.back().coefficients[1] : slopes.back();
  }
  pieces.front() = {p.front().x, {p.front().f, first}};
  pieces.push_back({p.back().x, {p.back().f, last}});
  return PiecewisePolynomial(std::move(breaks), std::move(pieces));
}

PiecewisePolynomial time_table(const std::vector<TablePoint>& p, Interpolation interpolation,
                               double period) {
  require_ascending(p, 2, true);
  for (std::size_t i = 2; i < p.size(); ++i)
    if (p[i].x == p[i - 2].x)
      throw InputError(
          ErrorCode::duplicate,
          "point " + std::to_string(i + 1) +
              " of a table: found the same x a third time, expected two points at a jump");
  const bool full = period > 0.0 && fills_period(p.front().x, p.back().x, period);
  const bool joined =
      full && p.front().f == p.back().f && p[1].x > p[0].x && p[p.size() - 2].x < p.back().x;
  std::vector<double> breaks;
  std::vector<PiecewisePolynomial::Piece> pieces{{p.front().x, {p.front().f, 0.0}}};
  for (std::size_t from = 0; from < p.size();) {
    std::size_t to = from + 1;  // the points up to the next jump
    while (to < p.size() && p[to].x > p[to - 1].x) ++to;
    const std::vector<TablePoint> side(p.begin() + from, p.begin() + to);
    std::vector<double> slopes;
    if (interpolation == Interpolation::cubic)
      slopes = table_slopes(side, from == 0 && !full, to == p.size() && !full);
    if (joined && !slopes.empty() && from == 0) slopes.front() = slope_across(p);
    if (joined && !slopes.empty() && to == p.size()) slopes.back() = slope_across(p);
    append_pieces(side, slopes, pieces);
    for (const TablePoint& q : side)
      if (breaks.empty() || q.x > breaks.back()) breaks.push_back(q.x);
    from = to;
  }
  pieces.push_back({p.back().x, {p.back().f, 0.0}});
  return PiecewisePolynomial(std::move(breaks), std::move(pieces));
}

PiecewisePolynomial profile_function(const std::vector<TablePoint>& p) {
  require_ascending(p, 1, true);
  std::vector<double> breaks{p.front().x};
  std::vector<PiecewisePolynomial::Piece> pieces{{p.front().x, {p.front().f}}};
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const double h = p[i + 1].x - p[i].x;
    if (h <= 0.0) continue;  // a jump: the break is already there
    pieces.push_back({p[i].x, {p[i].f, (p[i + 1].f - p[i].f) / h}});
    breaks.push_back(p[i + 1].x);
  }
  pieces.push_back({p.back().x, {p.back().f}});
  return PiecewisePolynomial(std::move(breaks), std::move(pieces));
}

PiecewisePolynomial step_function(const std::vector<TablePoint>& p) {
  require_ascending(p, 1, false);
  std::vector<double> breaks;
  std::vector<PiecewisePolynomial::Piece> pieces{{p.front().x, {0.0}}};
  for (const TablePoint& q : p) {
    breaks.push_back(q.x);
    pieces.push_back({q.x, {q.f}});
  }
  return PiecewisePolynomial(std::move(breaks), std::move(pieces));
}

bool fills_period(double x0, double x1, double period) noexcept {
  return std::abs(x1 - x0 - period) <= 1e-9 * period;
}

PiecewisePolynomial repeated(const PiecewisePolynomial& f, double period, double from, double to,
                             std::size_t most) {
  const std::vector<double>& b = f.breaks();
  if (!(period > 0.0) || b.empty()) return f;
  // Pieces 1 to `last`; the one behind the last break is within the period unless they fill it.
  const std::size_t last = fills_period(b.front(), b.back(), period) ? b.size() - 1 : b.size();
  std::vector<double> breaks;
  std::vector<PiecewisePolynomial::Piece> pieces(1);
  double n = std::floor((from - b.front()) / period);
  for (; n * period + b.front() <= to; n += 1.0) {
    for (std::size_t k = 1; k <= last; ++k) {
      breaks.push_back(b[k - 1] + n * period);
      pieces.push_back(f.pieces()[k]);
      pieces.back().centre += n * period;
    }
    if (pieces.size() + last > most) break;
  }
  pieces.front() = f.pieces()[last];
  pieces.front().centre = pieces[last].centre - period;
  return PiecewisePolynomial(std::move(breaks), std::move(pieces));
}

PiecewisePolynomial integral(const PiecewisePolynomial& f, double x, double value) {
  std::vector<PiecewisePolynomial::Piece> pieces = f.pieces();
  for (PiecewisePolynomial::Piece& p : pieces) {
    p.coefficients.insert(p.coefficients.begin(), 0.0);
    for (std::size_t j = 2; j < p.coefficients.size(); ++j) p.coefficients[j] /= j;
  }
  const std::vector<double>& b = f.breaks();
  const auto at = [](const PiecewisePolynomial::Piece& p, double where) {
    double sum = 0.0;
    for (std::size_t j = p.coefficients.size(); j-- > 0;)
      sum = sum * (where - p.centre) + p.coefficients[j];
    return sum;
  };
  const std::size_t here = f.piece_index(x);
  pieces[here].coefficients[0] = value - at(pieces[here], x);
  for (std::size_t k = here; k < b.size(); ++k)
    pieces[k + 1].coefficients[0] += at(pieces[k], b[k]) - at(pieces[k + 1], b[k]);
  for (std::size_t k = here; k-- > 0;)
    pieces[k].coefficients[0] += at(pieces[k + 1], b[k]) - at(pieces[k], b[k]);
  return PiecewisePolynomial(b, std::move(pieces));
}

PiecewisePolynomial operator+(const PiecewisePolynomial& a, const PiecewisePolynomial& b) {
  std::vector<double> breaks = a.breaks();
  breaks.insert(breaks.end(), b.breaks().begin(), b.breaks().end());
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  std::vector<PiecewisePolynomial::Piece> pieces;
  for (std::size_t k = 0; k <= breaks.size(); ++k) {
    // A break is the start of its right-hand piece; the first piece is left of all breaks.
    const std::size_t ka = k == 0 ? 0 : a.piece_index(breaks[k - 1]);
    const std::size_t kb = k == 0 ? 0 : b.piece_index(breaks[k - 1]);
    PiecewisePolynomial::Piece piece = a.pieces()[ka];
    const std::vector<double> other = shifted(b.pieces()[kb], piece.centre);
    if (other.size() > piece.coefficients.size()) piece.coefficients.resize(other.size(), 0.0);
    for (std::size_t j = 0; j < other.size(); ++j) piece.coefficients[j] += other[j];
    pieces.push_back(std::move(piece));
  }
  return PiecewisePolynomial(std::move(breaks), std::move(pieces));
}

void PiecewisePolynomial::find_edges() {
  if (pieces_.size() != breaks_.size() + 1) return;  // not valid: reported by the checks of models
  // A jump of so small a fraction of the largest value or slope is rounding.
  constexpr double rounding = 1e-9;
  double largest = 0.0, steepest = 0.0;
  for (std::size_t k = 0; k < breaks_.size(); ++k) {
    // Also between the breaks: all slopes at them may vanish.
    if (k > 0 && breaks_[k] > breaks_[k - 1])
      steepest = std::max(
          steepest, std::abs(piece_value(k, breaks_[k]).f - piece_value(k, breaks_[k - 1]).f) /
                        (breaks_[k] - breaks_[k - 1]));
    for (const std::size_t piece : {k, k + 1}) {
      const Value v = piece_value(piece, breaks_[k]);
      largest = std::max(largest, std::abs(v.f));
      steepest = std::max(steepest, std::abs(v.df));
    }
  }
  std::size_t first = 0;
  for (std::size_t k = 0; k < breaks_.size();) {
    std::size_t next = k + 1;  // the piece right of this break and of those equal to it
    while (next < breaks_.size() && breaks_[next] == breaks_[k]) ++next;
    const Value left = piece_value(k, breaks_[k]), right = piece_value(next, breaks_[k]);
    if (std::abs(right.f - left.f) > rounding * largest ||
        std::abs(right.df - left.df) > rounding * steepest) {
      edges_.push_back(breaks_[k]);
      stretches_.push_back({first, k});
      first = next;
    }
    k = next;
  }
  if (!edges_.empty()) stretches_.push_back({first, breaks_.size()});
}

PiecewisePolynomial ramp_below(double x0, double stiffness) {
  return PiecewisePolynomial({x0}, {{x0, {0.0, stiffness}}, {x0, {0.0}}});
}

PiecewisePolynomial ramp_above(double x0, double stiffness) {
  return PiecewisePolynomial({x0}, {{x0, {0.0}}, {x0, {0.0, stiffness}}});
}

JumpReport largest_jump(const PiecewisePolynomial& f) {
  JumpReport r;
  const std::vector<double>& b = f.breaks();
  if (b.empty()) return r;
  double width = b.back() - b.front();
  if (!(width > 0.0)) width = std::max(std::abs(b.front()), 1.0);
  double low = f.piece_value(0, b.front()).f, high = low;
  for (std::size_t k = 0; k <= b.size(); ++k) {
    const double x0 = k == 0 ? b.front() - width : b[k - 1];
    const double x1 = k == b.size() ? b.back() + width : b[k];
    constexpr int samples = 16;
    for (int i = 0; i <= samples; ++i) {
      const double v = f.piece_value(k, x0 + (x1 - x0) * i / samples).f;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  r.range = high - low;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const double jump = std::abs(f.piece_value(k + 1, b[k]).f - f.piece_value(k, b[k]).f);
    if (jump > r.jump) r.jump = jump, r.at = k;
  }
  return r;
}

}  // namespace floatframe
