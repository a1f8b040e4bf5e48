// MPC equations with scalar points. Gauss and Jordan: each is solved for a scalar point as long as
// there is one, first for those without springs. An equation of one without springs only says where
// that goes and is left out; one of another makes it depend on nodes; without scalar points it
// ties nodes. A scalar point that is the difference of nodes does not move when the part is
// displaced, so springs from it to the ground are springs of the part: they end at a node that an
// equation holds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {
namespace {

using DofKey = std::pair<int, int>;  // node, axis

class ScalarEquations {
 public:
  explicit ScalarEquations(NastranBuild& build)
      : b_(build),
        most_(1'000'000 + 100 * (build.content.grids.size() + build.content.elements.size())) {}

  void add(const NastranEquation& e) {
    Row row;
    row.equation = &e;
    for (const NastranEquation::Term& t : e.terms) {
      if (b_.content.scalar_points.contains(t.node)) {
        if (t.component > 0) {
          b_.source.error(ErrorCode::wrong_value, e.at,
                          "MPC {}: the component is {}, but {} is a scalar point, which has one "
                          "only (0 or blank)",
                          e.set, t.component + 1, t.node);
          return;
        }
        const NastranScalarPoint* p = b_.scalars.find(t.node);
        if (p == nullptr) continue;  // held
        const DofKey key{p->node, p->axis};
        row.terms[key] += t.factor;
        points_[key] = Point{p->sprung, t.node};
        continue;
      }
      const int node = nastran_node_of_term(b_, e, t);
      if (node < 0) return;
      LinearEquation basic;
      add_nastran_term(b_, node, t, basic);
      for (const LinearEquation::Term& x : basic.terms) row.terms[{x.node, x.axis}] += x.factor;
      if (row.first < 0) row.first = node, row.rotation = t.component >= 3;
    }
    for (const auto& [key, factor] : row.terms) {
      row.scale = std::max(row.scale, std::abs(factor));
      if (points_.contains(key)) rows_of_[key].insert(rows_.size());
    }
    rows_.push_back(std::move(row));
  }

  void solve() {
    for (const bool sprung : {false, true})
      for (std::size_t r = 0; r < rows_.size(); ++r)
        if (!rows_[r].pivot) eliminate(r, sprung);
    for (const Row& row : rows_) finish(row);
    for (Spring& s : b_.model.springs) {
      if (s.nodes[1] >= 0) continue;
      for (int axis = 0; axis < 6; axis += 3) {
        if (s.directions[0](axis) == 0.0 || !differences_.contains({s.nodes[0], axis})) continue;
        s.nodes[1] = ground(axis, s.source);
        s.directions[1](axis) = -s.directions[0](axis);
      }
    }
  }

 private:
  struct Point {
    bool sprung = false;
    int id = 0;
  };
  struct Row {
    std::map<DofKey, double> terms;
    const NastranEquation* equation = nullptr;
    double scale = 0.0;
    int first = -1;  ///< the first node that is no scalar point
    bool rotation = false;
    std::optional<DofKey> pivot;
  };

  void eliminate(std::size_t r, bool sprung) {
    Row& row = rows_[r];
    double most = 0.0;
    for (const auto& [key, factor] : row.terms) {
      const auto point = points_.find(key);
      if (point == points_.end() || point->second.sprung != sprung || std::abs(factor) <= most)
        continue;
      most = std::abs(factor);
      row.pivot = key;
    }
    if (!row.pivot) return;
    const double pivot = row.terms.at(*row.pivot);
    const std::set<std::size_t> others = rows_of_[*row.pivot];
    for (const std::size_t o : others) {
      if (o == r) continue;
      Row& other = rows_[o];
      const double f = other.terms.at(*row.pivot) / pivot;
      spent_ += row.terms.size();
      if (spent_ > most_)
        b_.source.stop(
            ErrorCode::wrong_count, row.equation->at,
            "MPC equations tie too many scalar points together, for a file of this size");
      for (const auto& [key, factor] : row.terms) {
        double& sum = other.terms[key];
        sum -= f * factor;
        other.scale = std::max(other.scale, std::abs(f * factor));
        const bool gone = key == *row.pivot || std::abs(sum) <= 1e-12 * other.scale;
        const bool point = points_.contains(key);
        if (point && !gone) rows_of_[key].insert(o);
        if (point && gone) rows_of_[key].erase(o);
        if (gone) other.terms.erase(key);
      }
    }
  }

  /// Does what the equation says vanish when the part is displaced; if it is of rotations alone,
  /// when it turns?
  static bool is_difference(const LinearEquation& e) {
    Vec3 moved = Vec3::Zero(), turned = Vec3::Zero();
    double largest = 0.0;
    bool moves = false;
    for (std::size_t k = 1; k < e.terms.size(); ++k) {
      const LinearEquation::Term& t = e.terms[k];
      (t.axis < 3 ? moved : turned)(t.axis % 3) += t.factor;
      largest = std::max(largest, std::abs(t.factor));
      moves = moves || t.axis < 3;
    }
    return (moves ? moved : turned).norm() < 1e-9 * largest;
  }

  int ground(int axis, const FeSource& at) {
    if (ground_ < 0) ground_ = b_.add_node(b_.model.positions.front(), at, "a spring");
    if (grounded_.insert(axis).second) {
      LinearEquation e;
      e.source = at;
      e.terms.push_back({ground_, axis, 1.0});
      b_.model.equations.push_back(std::move(e));
    }
    return ground_;
  }

  void finish(const Row& row) {
    if (row.terms.empty()) return;
    const NastranEquation& from = *row.equation;
    LinearEquation e;
    e.source = from.at;
    if (row.pivot) {
      if (!points_.at(*row.pivot).sprung) return;
      e.terms.push_back({row.pivot->first, row.pivot->second, row.terms.at(*row.pivot)});
    }
    for (const auto& [key, factor] : row.terms) {
      if (row.pivot == key) continue;
      if (points_.contains(key)) {
        b_.source.error(ErrorCode::unsupported, from.at,
                        "MPC {}: scalar point {} is tied to scalar point {}, which only springs "
                        "hold; it needs an equation with nodes of its own",
                        from.set, points_.at(*row.pivot).id, points_.at(key).id);
        return;
      }
      e.terms.push_back({key.first, key.second, factor});
    }
    if (row.pivot && is_difference(e)) differences_.insert(*row.pivot);
    if (!row.pivot) {  // the first term depends, as in the file
      const auto first = std::find_if(e.terms.begin(), e.terms.end(), [&](const auto& t) {
        return t.node == row.first && (t.axis >= 3) == row.rotation;
      });
      if (first != e.terms.end()) std::swap(*first, e.terms.front());
    }
    if (row.pivot || b_.turned[static_cast<std::size_t>(e.terms.front().node)] == 0) {
      b_.model.equations.push_back(std::move(e));
    } else {
      const LinearEquation::Term& t = e.terms.front();
      b_.equations.add(t.node, t.axis >= 3, std::move(e));
    }
  }

  NastranBuild& b_;
  std::vector<Row> rows_;
  std::map<DofKey, Point> points_;
  std::map<DofKey, std::set<std::size_t>> rows_of_;
  std::uint64_t spent_ = 0, most_;
  std::set<DofKey> differences_;
  int ground_ = -1;
  std::set<int> grounded_;
};

}  // namespace

void build_nastran_scalar_equations(NastranBuild& build,
                                    const std::vector<const NastranEquation*>& equations) {
  ScalarEquations system(build);
  for (const NastranEquation* e : equations) system.add(*e);
  if (build.source.errors() == 0) system.solve();
}

}  // namespace floatframe
