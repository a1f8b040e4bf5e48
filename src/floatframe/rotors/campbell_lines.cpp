#include "floatframe/rotors/campbell_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>

#include "floatframe/core/work_progress.hpp"

namespace floatframe {
namespace {

bool swings(const TurningModes& modes, std::size_t k) {
  return modes[k].lambda.imag() > 0.0 && !is_rigid(modes, k);
}

std::vector<std::size_t> lowest_that_swing(const TurningModes& modes, std::size_t most) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < modes.size() && found.size() < most; ++k)
    if (swings(modes, k)) found.push_back(k);
  return found;
}

/// Lines during tracking: their modes at each speed.
class LineBundle {
 public:
  LineBundle(ModeFollower& follower, const std::vector<double>& speeds)
      : follower_(follower), speeds_(speeds) {}

  std::vector<std::vector<std::size_t>> lines;       ///< by line, of each speed
  std::vector<std::map<double, std::size_t>> modes;  ///< by line, also at speeds between
  std::vector<LineEnd> ends;

  /// Lines that begin at the last speed with these modes.
  void follow_down(const std::vector<std::size_t>& begin) {
    const std::size_t last = speeds_.size() - 1;
    std::vector<std::size_t> open(begin.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    for (const std::size_t mode : begin) add_line(last, mode);
    for (std::size_t k = last; k-- > 0;) {
      tell_progress("speeds", 1.0 - (k + 1.0) / (last + 1.0));
      const ListenToProgress ignores([](const char*, double) {});  // works within a speed
      advance(open, k + 1, k);
    }
  }

  /// Lines of the modes at the first speed that are on no other line and end before the last speed.
  void follow_up(const std::vector<std::size_t>& begin) {
    std::vector<std::size_t> open;
    const std::size_t before = lines.size(), last = speeds_.size() - 1;
    for (const std::size_t mode : begin) {
      if (taken(0, mode, lines.size())) continue;
      open.push_back(lines.size());
      add_line(0, mode);
    }
    for (std::size_t k = 0; k < last; ++k) {
      tell_progress("speeds, upwards", k / (last + 1.0));
      const ListenToProgress ignores([](const char*, double) {});
      advance(open, k, k + 1);
    }
    for (std::size_t line = lines.size(); line-- > before;)
      if (lines[line][last] != no_mode) remove(line);
  }

 private:
  void add_line(std::size_t k, std::size_t mode) {
    lines.emplace_back(speeds_.size(), no_mode);
    lines.back()[k] = mode;
    modes.push_back({{speeds_[k], mode}});
  }

  bool taken(std::size_t k, std::size_t mode, std::size_t but) const {
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (i != but && lines[i][k] == mode) return true;
    return false;
  }

  void advance(std::vector<std::size_t>& open, std::size_t from, std::size_t to) {
    std::vector<std::size_t> begin, on;
    for (const std::size_t line : open) begin.push_back(lines[line][from]);
    const std::vector<ModePath> paths = follower_.follow(speeds_[from], speeds_[to], begin);
    for (std::size_t i = 0; i < open.size(); ++i) {
      const ModePath& p = paths[i];
      for (const auto& [speed, mode] : p.between) modes[open[i]].emplace(speed, mode);
      if (p.mode == no_mode || taken(to, p.mode, open[i])) {
        ends.push_back({open[i], std::min(from, to), to > from, p.end, p.last});
        continue;
      }
      lines[open[i]][to] = p.mode;
      modes[open[i]].emplace(speeds_[to], p.mode);
      // A mode that starts to oscillate at standstill is a rigid motion below it, not tracked.
      if (swings(follower_.at(speeds_[to]), p.mode)) on.push_back(open[i]);
    }
    open = on;
  }

  void remove(std::size_t line) {
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
    modes.erase(modes.begin() + static_cast<std::ptrdiff_t>(line));
    std::erase_if(ends, [&](const LineEnd& e) { return e.line == line; });
    for (LineEnd& e : ends)
      if (e.line > line) --e.line;
  }

  ModeFollower& follower_;
  const std::vector<double>& speeds_;
};

/// By the majority of the known points.
std::string kind_of_line(const CampbellLine& line) {
  std::map<std::string, int> count;
  for (const CampbellPoint& p : line.points)
    if (p.known()) ++count[p.kind];
  std::string best;
  int most = 0;
  for (const auto& [word, n] : count)
    if (n > most) {
      best = word;
      most = n;
    }
  return best;
}

/// Growth rate of the fastest motion without oscillation; 0: there is none.
double growth(const TurningModes& modes) {
  if (modes.empty()) return 0.0;
  const double least = 1e-6 * std::abs(modes.back().lambda);  // unrestrained motions
  double most = 0.0;
  for (const TurningMode& m : modes)
    if (m.lambda.imag() == 0.0 && m.lambda.real() > least) most = std::max(most, m.lambda.real());
  return most;
}

int without_swing(const TurningModes& modes) {
  int n = 0;
  for (std::size_t k = 0; k < modes.size(); ++k)
    n += modes[k].lambda.imag() == 0.0 && !is_rigid(modes, k) ? 1 : 0;
  return n;
}

/// "mode 3 (bending) ends at 38.2 rad/s: ..."
std::string end_note(ModeFollower& follower, const LineEnd& e, const CampbellDiagram& d) {
  const double beyond = d.speeds[e.interval + (e.upwards ? 1 : 0)],
               inside = d.speeds[e.interval + (e.upwards ? 0 : 1)];
  const std::string who = fmt::format(
      "mode {} ({}) {} at {:.6g} rad/s, where its frequency is {:.4g} rad/s", e.line + 1,
      d.lines[e.line].kind, e.upwards ? "ends" : "begins", e.speed, std::abs(e.lambda.imag()));
  const double grows = growth(follower.at(beyond));
  const char* const side = e.upwards ? "above" : "below";
  if (grows > growth(follower.at(inside)))
    return fmt::format(
        "{}; {} that speed it diverges without swinging (as e^({:.4g} t) at {:g} rad/s)", who, side,
        grows, beyond);
  if (without_swing(follower.at(beyond)) > without_swing(follower.at(inside)))
    return fmt::format("{}; {} that speed it does not swing", who, side);
  return fmt::format("{}; {} that speed no mode has a shape like its own (MAC above 0.8){}", who,
                     side, follower.out_of_speeds() ? "; take a smaller step of the speed" : "");
}

/// A zero of g between two speeds at which it has different signs, by regula falsi (Illinois). NaN
/// if g is unknown at some speed.
template <class G>
double zero_between(double a, double b, double ga, double gb, const G& g) {
  for (int k = 0; k < 40; ++k) {
    const double x = (a * gb - b * ga) / (gb - ga);
    const double gx = g(x);
    if (!std::isfinite(gx)) return gx;
    if (gx == 0.0 || std::abs(b - a) < 1e-10 * (std::abs(a) + std::abs(b)) || x == a || x == b)
      return x;
    if ((gx > 0.0) == (gb > 0.0)) {
      ga *= 0.5;
    } else {
      a = b;
      ga = gb;
    }
    b = x;
    gb = gx;
  }
  return (a * gb - b * ga) / (gb - ga);
}

CampbellPoint unknown_point() {
  constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  CampbellPoint p;
  p.lambda = {not_known, not_known};
  return p;
}

/// One line between two speeds at which it is known.
struct LineInterval {
  ModeFollower& follower;
  double from, to;
  std::size_t mode_from, mode_to;

  CampbellPoint at(double speed) const {
    const bool first = speed - from < to - speed;
    const ModePath path = first ? follower.follow(from, speed, {mode_from})[0]
                                : follower.follow(to, speed, {mode_to})[0];
    if (path.mode == no_mode) return unknown_point();
    return campbell_point(follower.at(speed)[path.mode]);
  }
};

void find_orders(const LineInterval& i, const std::vector<double>& orders, int line,
                 CampbellDiagram& d) {
  const CampbellPoint p = campbell_point(i.follower.at(i.from)[i.mode_from]),
                      q = campbell_point(i.follower.at(i.to)[i.mode_to]);
  for (const double n : orders) {
    const double a = p.frequency() - n * std::abs(i.from), b = q.frequency() - n * std::abs(i.to);
    if ((a > 0.0) == (b > 0.0) || (p.frequency() == 0.0 && q.frequency() == 0.0)) continue;
    const double speed = zero_between(
        i.from, i.to, a, b, [&](double x) { return i.at(x).frequency() - n * std::abs(x); });
    if (!std::isfinite(speed)) continue;
    const CampbellPoint there = i.at(speed);
    if (!(there.frequency() > 0.0)) continue;  // where a free rotor is at rest
    auto& list = n != 1.0 || there.unbalance ? d.critical : d.crossings;
    list.push_back({line, n, speed, there.frequency(), there.whirl});
  }
}

/// `first`: of the diagram.
void find_onset(const LineInterval& i, double noise, bool first, int line, CampbellDiagram& d) {
  const CampbellPoint p = campbell_point(i.follower.at(i.from)[i.mode_from]),
                      q = campbell_point(i.follower.at(i.to)[i.mode_to]);
  const auto grows = [&](const CampbellPoint& c) {
    return c.lambda.real() > noise + 1e-6 * std::abs(c.lambda);
  };
  if (first && grows(p)) d.unstable.push_back({line, i.from, p.frequency()});
  if (grows(p) || !grows(q)) return;
  const double a = std::min(p.lambda.real(), 0.0), b = q.lambda.real();
  double speed = zero_between(i.from, i.to, a, b, [&](double x) { return i.at(x).lambda.real(); });
  const bool found = std::isfinite(speed);
  if (!found) speed = i.to;
  d.unstable.push_back({line, speed, (found ? i.at(speed) : q).frequency()});
}

/// Growing motions without oscillation that appear between two speeds.
void find_divergence(ModeFollower& follower, const FollowedLines& f, std::size_t k,
                     CampbellDiagram& d) {
  const double here = growth(follower.at(d.speeds[k]));
  if (!(here > 0.0)) return;
  if (k > 0 && growth(follower.at(d.speeds[k - 1])) > 0.0) return;
  // Round-off of unrestrained motions is not reproducible.
  double high = d.speeds[k], low = k > 0 ? d.speeds[k - 1] : d.speeds[1];
  const double again = growth(follower.at(high - 1e-3 * (high - low)));
  if (!(std::abs(again - here) < 0.3 * here)) return;
  if (k == 0) {
    d.unstable.push_back({-1, high, 0.0});
    return;
  }
  for (const LineEnd& e : f.ends)
    if (e.upwards && e.interval == k - 1) {
      d.unstable.push_back({static_cast<int>(e.line), e.speed, 0.0});
      return;
    }
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (growth(follower.at(middle)) > 0.0 ? high : low) = middle;
  }
  d.unstable.push_back({-1, high, 0.0});
}

}  // namespace

CampbellPoint campbell_point(const TurningMode& m) {
  return {m.lambda, m.whirl, m.across, kind_of_motion(m.kind), m.unbalance};
}

FollowedLines follow_lines(ModeFollower& follower, int most, CampbellDiagram& d) {
  const auto n = static_cast<std::size_t>(most);
  LineBundle bundle(follower, d.speeds);
  bundle.follow_down(lowest_that_swing(follower.at(d.speeds.back()), n));
  bundle.follow_up(lowest_that_swing(follower.at(d.speeds.front()), n));
  // Ascending by the frequency at their beginning, the order in which the diagram is read.
  std::vector<std::size_t> order(bundle.lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto begin = [&](std::size_t line) {
    std::size_t k = 0;
    while (bundle.lines[line][k] == no_mode) ++k;
    return std::abs(follower.at(d.speeds[k])[bundle.lines[line][k]].lambda);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return begin(a) < begin(b); });
  FollowedLines f;
  for (const std::size_t line : order) {
    CampbellLine l;
    f.modes.push_back(bundle.modes[line]);
    for (std::size_t k = 0; k < d.speeds.size(); ++k) {
      const std::size_t mode = bundle.lines[line][k];
      l.points.push_back(mode == no_mode ? unknown_point()
                                         : campbell_point(follower.at(d.speeds[k])[mode]));
    }
    l.kind = kind_of_line(l);
    d.lines.push_back(std::move(l));
  }
  for (LineEnd e : bundle.ends) {
    e.line =
        static_cast<std::size_t>(std::find(order.begin(), order.end(), e.line) - order.begin());
    f.ends.push_back(e);
    d.notes.push_back(end_note(follower, e, d));
  }
  return f;
}

void find_crossings(ModeFollower& follower, const std::vector<double>& orders,
                    const FollowedLines& f, CampbellDiagram& d) {
  const TurningModes& first = follower.at(d.speeds.front());
  const double noise = first.empty() ? 0.0 : 1e-10 * std::abs(first.back().lambda);
  for (std::size_t k = 0; k < d.speeds.size(); ++k) find_divergence(follower, f, k, d);
  for (std::size_t line = 0; line < f.modes.size(); ++line)
    for (auto p = f.modes[line].begin(), q = std::next(p); q != f.modes[line].end(); p = q++) {
      const LineInterval i{follower, p->first, q->first, p->second, q->second};
      find_orders(i, orders, static_cast<int>(line), d);
      find_onset(i, noise, p == f.modes[line].begin(), static_cast<int>(line), d);
    }
  const auto by_speed = [](const auto& a, const auto& b) { return a.speed < b.speed; };
  std::stable_sort(d.critical.begin(), d.critical.end(), by_speed);
  std::stable_sort(d.crossings.begin(), d.crossings.end(), by_speed);
  std::stable_sort(d.unstable.begin(), d.unstable.end(), by_speed);
}

}  // namespace floatframe
