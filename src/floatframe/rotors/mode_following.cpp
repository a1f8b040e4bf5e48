#include "floatframe/rotors/mode_following.hpp"

#include <algorithm>
#include <cmath>

namespace floatframe {
namespace {

constexpr double same_mode = 0.8;
constexpr int deepest = 9;

/// Modes of equal frequency, which may be arbitrary combinations of each other: an orthonormal
/// basis of each set of more than one, and the set of each mode.
struct EqualModes {
  std::vector<Eigen::MatrixXcd> bases;
  std::vector<int> set_of;  ///< -1: the mode is alone

  explicit EqualModes(const TurningModes& modes) : set_of(modes.size(), -1) {
    for (std::size_t first = 0; first < modes.size();) {
      std::size_t end = first + 1;
      const double size = std::abs(modes[first].lambda);
      while (end < modes.size() && std::abs(modes[end].lambda - modes[first].lambda) < 1e-6 * size)
        ++end;
      if (end - first > 1) add(modes, first, end);
      first = end;
    }
  }

  /// |projection of m on the set of mode k|^2.
  double part(const TurningModes& modes, std::size_t k, const Eigen::VectorXcd& m) const {
    if (set_of[k] < 0) return std::norm(modes[k].shape.dot(m));
    return (bases[static_cast<std::size_t>(set_of[k])].adjoint() * m).squaredNorm();
  }

 private:
  void add(const TurningModes& modes, std::size_t first, std::size_t end) {
    Eigen::MatrixXcd Q(modes[first].shape.size(), 0);
    for (std::size_t k = first; k < end; ++k) {
      Eigen::VectorXcd x = modes[k].shape;
      for (int twice = 0; twice < 2; ++twice) x -= (Q * (Q.adjoint() * x)).eval();
      const double rest = x.norm();
      set_of[k] = static_cast<int>(bases.size());
      if (!(rest > 1e-6)) continue;
      Q.conservativeResize(Eigen::NoChange, Q.cols() + 1);
      Q.col(Q.cols() - 1) = x / rest;
    }
    bases.push_back(std::move(Q));
  }
};

struct ModePair {
  std::size_t next = no_mode;
  double mac = 0.0, apart = 0.0;
  double rival = 0.0;  ///< MAC of one of the two with another mode of nearly this frequency
  /// Similarity of the two, at most 1.1.
  double likeness() const noexcept { return mac - 2.0 * apart; }
};

double apart(const TurningMode& a, const TurningMode& b) {
  const double size = std::abs(a.lambda) + std::abs(b.lambda);
  return size > 0.0 ? std::abs(a.lambda - b.lambda) / size : 0.0;
}

/// Matches the oscillating modes of `a` with those of `b`: the most similar first.
std::vector<ModePair> paired(const TurningModes& a, const TurningModes& b) {
  struct Candidate {
    double like;
    std::size_t i;
    ModePair pair;
  };
  const EqualModes equal_a(a), equal_b(b);
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (!(a[i].lambda.imag() > 0.0) || !(b[j].lambda.imag() > 0.0)) continue;
      const double own = std::norm(a[i].shape.dot(b[j].shape));
      ModePair p{j, std::max(equal_b.part(b, j, a[i].shape), equal_a.part(a, i, b[j].shape)),
                 apart(a[i], b[j])};
      all.push_back({p.likeness() + 0.1 * own, i, p});
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& x, const Candidate& y) { return x.like > y.like; });
  std::vector<ModePair> pairs(a.size());
  std::vector<char> taken(b.size(), 0);
  for (const Candidate& c : all) {
    if (pairs[c.i].next != no_mode || taken[c.pair.next]) continue;
    pairs[c.i] = c.pair;
    taken[c.pair.next] = 1;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (const Candidate& c : all)
      if ((c.i == i) != (c.pair.next == pairs[i].next) && c.pair.apart < 0.1)
        pairs[i].rival = std::max(pairs[i].rival, c.pair.mac);
  return pairs;
}

/// Paths that end in the same mode.
std::vector<std::size_t> merged_paths(const std::vector<ModePath>& paths) {
  std::vector<std::size_t> met;
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = 0; j < paths.size(); ++j)
      if (i != j && paths[i].mode != no_mode && paths[i].mode == paths[j].mode) {
        met.push_back(i);
        break;
      }
  return met;
}

/// Paths to `middle` and, for those that reach it, onwards by `go_on`.
template <class Begin, class GoOn>
std::vector<ModePath> joined(std::vector<ModePath> paths, double middle,
                             const std::vector<Begin>& begins, const GoOn& go_on) {
  std::vector<std::size_t> alive, modes;
  std::vector<Begin> of_alive;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (paths[k].mode == no_mode) continue;
    alive.push_back(k);
    modes.push_back(paths[k].mode);
    of_alive.push_back(begins[k]);
  }
  if (alive.empty()) return paths;
  const std::vector<ModePath> second = go_on(modes, of_alive);
  for (std::size_t k = 0; k < alive.size(); ++k) {
    ModePath whole = second[k];
    whole.between = paths[alive[k]].between;
    whole.between.emplace_back(middle, modes[k]);
    whole.between.insert(whole.between.end(), second[k].between.begin(), second[k].between.end());
    paths[alive[k]] = std::move(whole);
  }
  return paths;
}

bool is_accepted(const ModePair& p, bool last_resort) {
  if (p.next == no_mode) return false;
  if (p.mac > same_mode && (last_resort || p.likeness() > 0.4)) return true;
  // A shape with small components of many others and an unchanged frequency.
  if (p.mac > 0.5 && p.apart < 1e-3 && p.rival < 0.5 * p.mac) return true;
  // In the middle of two nearly crossing lines either continuation is equally good and continuous.
  return last_resort && p.mac > 0.3 && p.apart < 1e-3;
}

}  // namespace

const TurningModes& ModeFollower::at(double speed) {
  const auto found = known_.find(speed);
  return found != known_.end() ? found->second
                               : known_.emplace(speed, turning_.modes(speed)).first->second;
}

std::vector<ModePath> ModeFollower::follow(double from, double to,
                                           const std::vector<std::size_t>& modes) {
  std::vector<Begin> begins;
  for (const std::size_t k : modes) begins.push_back({from, std::abs(at(from)[k].lambda)});
  std::vector<ModePath> paths = follow(from, to, modes, begins, 0);
  // Paths by different intermediate speeds may merge if one of them has taken too long a step.
  for (int level = 1; level <= 5; ++level) {
    const std::vector<std::size_t> met = merged_paths(paths);
    if (met.empty()) return paths;
    std::vector<std::size_t> again;
    std::vector<Begin> again_begins;
    for (const std::size_t k : met) {
      again.push_back(modes[k]);
      again_begins.push_back(begins[k]);
    }
    const std::vector<ModePath> finer = follow_in_pieces(from, to, again, again_begins, level);
    for (std::size_t k = 0; k < met.size(); ++k) paths[met[k]] = finer[k];
  }
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (std::size_t j = i + 1; j < paths.size() && paths[i].mode != no_mode; ++j) {
      if (paths[j].mode != paths[i].mode) continue;
      const TurningMode& b = at(to)[paths[i].mode];
      const bool second = apart(at(from)[modes[i]], b) <= apart(at(from)[modes[j]], b);
      const std::size_t lost = second ? j : i;
      paths[lost] = {no_mode, from, at(from)[modes[lost]].lambda, {}};
    }
  return paths;
}

std::vector<ModePath> ModeFollower::follow_in_pieces(double from, double to,
                                                     const std::vector<std::size_t>& modes,
                                                     const std::vector<Begin>& begins, int level) {
  if (level == 0) return follow(from, to, modes, begins, 0);
  const double middle = 0.5 * (from + to);
  if (known_.count(middle) == 0) ++extra_;
  return joined(follow_in_pieces(from, middle, modes, begins, level - 1), middle, begins,
                [&](const std::vector<std::size_t>& alive, const std::vector<Begin>& of_alive) {
                  return follow_in_pieces(middle, to, alive, of_alive, level - 1);
                });
}

std::vector<ModePath> ModeFollower::follow(double from, double to,
                                           const std::vector<std::size_t>& modes,
                                           const std::vector<Begin>& begins, int depth) {
  const TurningModes &a = at(from), &b = at(to);
  const std::vector<ModePair> pairs = paired(a, b);
  std::vector<ModePath> paths(modes.size());
  std::vector<std::size_t> open, open_modes;
  std::vector<Begin> open_begins;
  const double middle = 0.5 * (from + to);
  const bool last = depth == deepest || (out_of_speeds() && known_.count(middle) == 0);
  std::size_t still = 0;  // rigid motions at standstill, two per mode that starts
  while (still < b.size() && is_rigid(b, still)) ++still;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const ModePair& p = pairs[modes[k]];
    const std::complex<double> lambda = a[modes[k]].lambda;
    // A frequency that falls with the speed is zero at standstill.
    const bool falls =
        last && to == 0.0 && still > 0 &&
        std::abs(lambda) * std::abs(begins[k].speed) < 1.05 * begins[k].size * std::abs(from);
    if (is_accepted(p, last)) {
      paths[k] = {p.next, to, b[p.next].lambda, {}};
    } else if (falls) {
      --still;
      paths[k] = {still, to, b[still].lambda, {}};
    } else if (last) {
      paths[k] = {no_mode, from, lambda, {}};
    } else {
      open.push_back(k);
      open_modes.push_back(modes[k]);
      open_begins.push_back(begins[k]);
    }
  }
  if (open.empty()) return paths;
  if (known_.count(middle) == 0) ++extra_;
  const std::vector<ModePath> whole =
      joined(follow(from, middle, open_modes, open_begins, depth + 1), middle, open_begins,
             [&](const std::vector<std::size_t>& alive, const std::vector<Begin>& of_alive) {
               return follow(middle, to, alive, of_alive, depth + 1);
             });
  for (std::size_t k = 0; k < open.size(); ++k) paths[open[k]] = whole[k];
  return paths;
}

}  // namespace floatframe
