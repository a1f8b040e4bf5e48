#include "floatframe/run/energy_cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {
namespace {

/// Both sides of an edge.
struct EdgeSides {
  PiecewisePolynomial::Value left, right;
};

EdgeSides edge_sides(const PiecewisePolynomial& f, double edge) {
  const auto k = std::lower_bound(f.breaks().begin(), f.breaks().end(), edge) - f.breaks().begin();
  return {f.piece_value(static_cast<std::size_t>(k), edge), f(edge)};
}

/// Range of the values at the edges, with those before the first and after the last.
double range_of_values(const PiecewisePolynomial& f) {
  double low = f(f.breaks().front()).f, high = low;
  for (const double b : f.breaks()) {
    const EdgeSides s = edge_sides(f, b);
    low = std::min({low, s.left.f, s.right.f});
    high = std::max({high, s.left.f, s.right.f});
  }
  return high - low;
}

class CauseFinder {
 public:
  CauseFinder(double from, double to, double step, std::span<const TimeCorner> corners)
      : from_(from - step), to_(to), step_(step), corners_(corners) {}

  /// A corner: the velocity jumps.
  void motion(const std::string& name, const TimeFunction& f, const char* unit) {
    const PiecewisePolynomial pieces = pieces_of(f);
    if (pieces.edges().empty()) return;
    const double range = range_of_values(pieces);
    for (const double e : pieces.edges()) {
      if (e < from_ || e > to_) continue;
      const EdgeSides s = edge_sides(pieces, e);
      const double jump = s.right.df - s.left.df;
      // The path in ten steps at this velocity, relative to the total range.
      const double share = 10.0 * step_ * std::abs(jump) / std::max(range, 1e-300);
      if (std::abs(s.right.f - s.left.f) > 1e-6 * range)
        offer(1.0 + share,
              fmt::format("the motion of joint '{}' jumps by {:.4g} {} at t = {:.6g} s, which "
                          "nothing with mass can; let it go there over several steps",
                          name, s.right.f - s.left.f, unit, e));
      else if (std::abs(jump) > 1e-9 * std::max(std::abs(s.left.df), std::abs(s.right.df)))
        offer(share, fmt::format("the velocity of the motion of joint '{}' jumps by {:.4g} {}/s at "
                                 "t = {:.6g} s: no step resolves that, round the corner "
                                 "(interpolation: cubic, or more entries there)",
                                 name, jump, unit, e));
    }
  }

  /// Jumps of values that are only sampled by steps (time_corners.hpp): a large part of the total
  /// variation of a table within one step. Jumps at which steps are divided are resolved.
  void sampled(const std::string& name, const TimeFunction& f, const char* unit) {
    const PiecewisePolynomial pieces = pieces_of(f);
    const std::vector<double>& breaks = pieces.breaks();
    if (breaks.empty()) return;
    const double range = std::max(range_of_values(pieces), 1e-300);
    for (std::size_t k = 0; k < breaks.size(); ++k) {
      if (breaks[k] < from_ || breaks[k] > to_ || divided(breaks[k])) continue;
      const double here = edge_sides(pieces, breaks[k]).left.f;
      double way = 0.0;
      for (std::size_t n = k + 1; n < breaks.size() && breaks[n] - breaks[k] < step_; ++n) {
        const double there = edge_sides(pieces, breaks[n]).right.f - here;
        if (std::abs(there) > std::abs(way)) way = there;
      }
      const double share = std::abs(way) / range;
      if (share > 0.1)
        offer(share, fmt::format("{} goes by {:.4g} {} within a step from t = {:.6g} s on: take a "
                                 "smaller step than {:g} s, or locate_edges: true",
                                 name, way, unit, breaks[k], step_));
    }
  }

  const std::string& text() const { return text_; }

 private:
  PiecewisePolynomial pieces_of(const TimeFunction& f) const {
    return repeated(f.pieces, f.period, from_ - f.period, to_, most_repeated_pieces);
  }

  void offer(double share, std::string text) {
    if (!(share > share_)) return;
    share_ = share;
    text_ = std::move(text);
  }

  bool divided(double at) const {
    return std::any_of(corners_.begin(), corners_.end(), [&](const TimeCorner& c) {
      return at > c.from - time_corner_width * step_ && at < c.to + time_corner_width * step_;
    });
  }

  double from_, to_, step_;
  std::span<const TimeCorner> corners_;
  double share_ = 0.0;
  std::string text_;
};

}  // namespace

std::string energy_cause(const Model& model, double from, double to, double step,
                         std::span<const TimeCorner> corners) {
  CauseFinder finder(from, to, step, corners);
  for (const Joint& j : model.joints)
    for (int k = 0; k < joint_velocities(j.type); ++k)
      if (const TimeFunction* motion = model.motion_of(j, k))
        finder.motion(j.name, *motion, joint_unit_name(j.type, k));
  for (const Element& e : model.elements)
    for (const ElementSignal& s : signals_of(e))
      if (e.acts)
        finder.sampled(fmt::format("the {} of force '{}'", s.what, e.name), s.signal->function,
                       s.unit);
  return finder.text();
}

}  // namespace floatframe
