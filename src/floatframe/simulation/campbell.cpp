#include "floatframe/simulation/campbell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/simulation/run_error.hpp"
#include "floatframe/simulation/turning_model.hpp"

namespace floatframe {
namespace {

/// Change of eigenvalues with the angle that is still called symmetric: meshes are not quite round.
constexpr double symmetric_enough = 5e-3;
/// Below this part of the largest |lambda| a mode is a rigid motion.
constexpr double rigid_part = 1e-7;
constexpr std::size_t most_speeds = 2000;

using Modes = std::vector<TurningMode>;

double mac(const TurningMode& a, const TurningMode& b) { return std::norm(a.m.dot(b.m)); }

/// How much two modes of neighbouring speeds are one, at most 1.
double likeness(const TurningMode& a, const TurningMode& b) {
  const double size = std::abs(a.lambda) + std::abs(b.lambda);
  const double apart = size > 0.0 ? std::abs(a.lambda - b.lambda) / size : 0.0;
  return mac(a, b) - 2.0 * apart;
}

struct Pairing {
  std::vector<std::size_t> next;  ///< of each mode of the first its mode of the second
  double doubt = 0.0;             ///< 1 - the smallest likeness
};

/// Of `wanted` modes of `a` those of `b`: the most alike first.
Pairing paired(const Modes& a, const Modes& b, const std::vector<std::size_t>& wanted) {
  struct Candidate {
    double like;
    std::size_t i, j;
  };
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) all.push_back({likeness(a[i], b[j]), i, j});
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& x, const Candidate& y) { return x.like > y.like; });
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> next(a.size(), none);
  std::vector<char> taken(b.size(), 0);
  std::vector<double> like(a.size(), -1.0);
  for (const Candidate& c : all) {
    if (next[c.i] != none || taken[c.j]) continue;
    next[c.i] = c.j;
    like[c.i] = c.like;
    taken[c.j] = 1;
  }
  Pairing p;
  for (const std::size_t i : wanted) {
    p.next.push_back(next[i]);
    p.doubt = std::max(p.doubt, next[i] == none ? 2.0 : 1.0 - like[i]);
  }
  return p;
}

class Follower {
 public:
  Follower(TurningModel& turning, CampbellDiagram& diagram)
      : turning_(turning), diagram_(diagram) {}

  const Modes& at(double speed) {
    const auto found = known_.find(speed);
    return found != known_.end() ? found->second
                                 : known_.emplace(speed, turning_.modes(speed)).first->second;
  }

  /// Modes at `to` of those named at `from`. Speeds between are added where pairs are in doubt.
  std::vector<std::size_t> follow(double from, double to, const std::vector<std::size_t>& modes,
                                  int depth = 0) {
    Pairing p = paired(at(from), at(to), modes);
    const bool lost =
        std::find(p.next.begin(), p.next.end(), static_cast<std::size_t>(-1)) != p.next.end();
    constexpr int deepest = 6;
    if ((p.doubt < 0.4 && !lost) || (depth == deepest && !lost)) return p.next;
    if (depth == deepest)
      throw RunError(
          fmt::format("modes cannot be followed between {:g} and {:g} rad/s: a "
                      "vibration stops to swing there",
                      from, to));
    const double middle = 0.5 * (from + to);
    if (known_.find(middle) == known_.end()) ++diagram_.extra_speeds;
    return follow(middle, to, follow(from, middle, modes, depth + 1), depth + 1);
  }

 private:
  TurningModel& turning_;
  CampbellDiagram& diagram_;
  std::map<double, Modes> known_;
};

CampbellPoint point_of(const TurningMode& m) { return {m.lambda, m.whirl, m.across}; }

/// A zero of g between two speeds where it has different signs, by regula falsi (Illinois); what
/// the mode is there is given back.
template <class G>
double zero_between(double a, double b, double ga, double gb, const G& g) {
  for (int k = 0; k < 40; ++k) {
    const double x = (a * gb - b * ga) / (gb - ga);
    const double gx = g(x);
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

struct Followed {
  std::vector<std::vector<std::size_t>> modes;  ///< of each speed, by line
};

/// Critical speeds and onsets between speeds k and k + 1.
void find_crossings(Follower& follower, const CampbellOptions& o, const Followed& f, std::size_t k,
                    double stiffest, CampbellDiagram& d) {
  const double from = d.speeds[k], to = d.speeds[k + 1];
  for (std::size_t line = 0; line < d.lines.size(); ++line) {
    const CampbellPoint &p = d.lines[line].points[k], &q = d.lines[line].points[k + 1];
    const auto mode_at = [&](double speed) {
      const bool first = speed - from < to - speed;
      const auto next = first ? follower.follow(from, speed, {f.modes[k][line]})
                              : follower.follow(to, speed, {f.modes[k + 1][line]});
      return point_of(follower.at(speed)[next[0]]);
    };
    for (const double n : o.orders) {
      const double a = p.frequency() - n * std::abs(from), b = q.frequency() - n * std::abs(to);
      if ((a > 0.0) == (b > 0.0) || (p.frequency() == 0.0 && q.frequency() == 0.0)) continue;
      const double speed = zero_between(
          from, to, a, b, [&](double x) { return mode_at(x).frequency() - n * std::abs(x); });
      const CampbellPoint there = mode_at(speed);
      if (there.frequency() > 0.0)  // not where a free rotor stands still
        d.critical.push_back({static_cast<int>(line), n, speed, there.frequency(), there.whirl});
    }
    const double noise = 1e-10 * stiffest;
    const auto grows = [&](const CampbellPoint& c) {
      return c.lambda.real() > noise + 1e-6 * std::abs(c.lambda);
    };
    if (!grows(p) && grows(q)) {
      const double a = std::min(p.lambda.real(), 0.0), b = q.lambda.real();
      const double speed =
          zero_between(from, to, a, b, [&](double x) { return mode_at(x).lambda.real(); });
      d.unstable.push_back({static_cast<int>(line), speed, mode_at(speed).frequency()});
    } else if (k == 0 && grows(p)) {
      d.unstable.push_back({static_cast<int>(line), from, p.frequency()});
    }
  }
}

/// The lowest modes that swing somewhere, by lines from the last speed, where no pair of a rotor
/// that turns is equal.
Followed follow_modes(Follower& follower, const CampbellOptions& o, CampbellDiagram& d) {
  const Modes& last = follower.at(d.speeds.back());
  const double stiffest = last.empty() ? 0.0 : std::abs(last.back().lambda);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < last.size(); ++i)
    if (std::abs(last[i].lambda) > rigid_part * stiffest && last[i].lambda.imag() > 0.0)
      wanted.push_back(i);
  const auto most = static_cast<std::size_t>(o.modes);
  if (wanted.size() > most) wanted.resize(most);
  Followed f;
  f.modes.assign(d.speeds.size(), {});
  f.modes.back() = wanted;
  for (std::size_t k = d.speeds.size() - 1; k-- > 0;)
    f.modes[k] = follower.follow(d.speeds[k + 1], d.speeds[k], f.modes[k + 1]);
  // Ascending by the frequency at the first speed, as one reads the diagram.
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Modes& first = follower.at(d.speeds.front());
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(first[f.modes[0][a]].lambda) < std::abs(first[f.modes[0][b]].lambda);
  });
  Followed sorted = f;
  for (std::size_t k = 0; k < f.modes.size(); ++k)
    for (std::size_t i = 0; i < order.size(); ++i) sorted.modes[k][i] = f.modes[k][order[i]];
  return sorted;
}

std::string kind_of_line(const CampbellLine& line) {
  std::map<std::string, int> count;
  for (const CampbellPoint& p : line.points) {
    const std::string word = whirl_word(p.whirl, p.across);
    ++count[word.empty() ? "axial or torsion" : word];
  }
  std::string best;
  int most = 0;
  for (const auto& [word, n] : count)
    if (n > most) {
      best = word;
      most = n;
    }
  return best;
}

/// Above it squares of speeds leave the range in which eigenvalues can be found.
constexpr double most_speed = 1e9;

void check_options(const CampbellOptions& o) {
  if (std::max(std::abs(o.from), std::abs(o.to)) > most_speed)
    throw InputError(fmt::format("--speed {}: found {:g} to {:g} rad/s, expected at most {:g}",
                                 o.joint, o.from, o.to, most_speed));
  if (!o.axis.allFinite() || !(o.axis.stableNorm() > 0.0))
    throw InputError(fmt::format("the axis of '{}' is ({:g}, {:g}, {:g}), expected a direction",
                                 o.joint, o.axis.x(), o.axis.y(), o.axis.z()));
  if (o.modes < 1)
    throw InputError(fmt::format("found {} modes to follow, expected at least 1", o.modes));
  for (const double order : o.orders)
    if (!(order > 0.0) || !std::isfinite(order))
      throw InputError(fmt::format("found the order {:g}, expected a positive number", order));
}

std::vector<double> speeds_of(const CampbellOptions& o) {
  if (!(o.step > 0.0) || !(o.to > o.from) || !std::isfinite(o.from) || !std::isfinite(o.to) ||
      !std::isfinite(o.step))
    throw InputError(fmt::format(
        "--speed {}: found {:g} to {:g} in steps of {:g} rad/s, expected an ascending range and a "
        "positive step",
        o.joint, o.from, o.to, o.step));
  if ((o.to - o.from) / o.step > static_cast<double>(most_speeds))
    throw InputError(
        fmt::format("--speed {}: more than {} speeds; take a larger step", o.joint, most_speeds));
  std::vector<double> speeds;
  const auto n = static_cast<std::size_t>(std::floor((o.to - o.from) / o.step + 1e-9));
  for (std::size_t k = 0; k <= n; ++k) speeds.push_back(o.from + static_cast<double>(k) * o.step);
  if (o.to - speeds.back() > 1e-9 * o.step) speeds.push_back(o.to);
  return speeds;
}

}  // namespace

double CampbellPoint::damping() const noexcept {
  const double size = std::abs(lambda);
  return size > 0.0 ? -lambda.real() / size : 0.0;
}

std::string whirl_word(double whirl, double across) {
  if (across < 1e-3) return "";
  return whirl > 0.1 ? "forward" : whirl < -0.1 ? "backward" : "planar";
}

CampbellDiagram campbell(const Model& model, const CampbellOptions& o) {
  CampbellDiagram d;
  check_options(o);
  d.speeds = speeds_of(o);
  TurningModel turning(model, o.joint, o.axis.stableNormalized());
  d.dependence_on_angle = turning.dependence_on_angle(d.speeds.back());
  if (!(d.dependence_on_angle <= symmetric_enough))
    throw RunError(fmt::format(
        "'{}': the linear system depends on the angle of the rotor (eigenvalues change by {:.2g} "
        "%), so that no eigenvalues tell of its vibrations; expected a rotor that is symmetric "
        "about its axis, with modes in equal pairs",
        o.joint, 100.0 * d.dependence_on_angle));
  if (d.dependence_on_angle > 1e-5)
    d.notes.push_back(fmt::format(
        "the rotor is not quite symmetric: eigenvalues change by up to {:.2g} % with its angle",
        100.0 * d.dependence_on_angle));
  if (turning.eccentricity() > 1e-9 * turning.rotor().length)
    d.notes.push_back(fmt::format(
        "the centre of mass of the rotor is {:.3g} m from its axis: unbalance is no part of the "
        "steady state",
        turning.eccentricity()));
  Follower follower(turning, d);
  const Followed f = follow_modes(follower, o, d);
  const Modes& first = follower.at(d.speeds.front());
  const double stiffest = first.empty() ? 0.0 : std::abs(first.back().lambda);
  for (const TurningMode& m : first)
    if (std::abs(m.lambda) <= rigid_part * stiffest)
      ++d.rigid;
    else if (m.lambda.imag() == 0.0)
      ++d.overdamped;
  for (std::size_t line = 0; line < f.modes.front().size(); ++line) {
    CampbellLine l;
    for (std::size_t k = 0; k < d.speeds.size(); ++k)
      l.points.push_back(point_of(follower.at(d.speeds[k])[f.modes[k][line]]));
    l.kind = kind_of_line(l);
    d.lines.push_back(std::move(l));
  }
  for (const std::string& note : turning.notes()) d.notes.push_back(note);
  for (std::size_t k = 0; k + 1 < d.speeds.size(); ++k)
    find_crossings(follower, o, f, k, stiffest, d);
  std::stable_sort(
      d.critical.begin(), d.critical.end(),
      [](const CriticalSpeed& a, const CriticalSpeed& b) { return a.speed < b.speed; });
  std::stable_sort(
      d.unstable.begin(), d.unstable.end(),
      [](const InstabilityOnset& a, const InstabilityOnset& b) { return a.speed < b.speed; });
  return d;
}

}  // namespace floatframe
