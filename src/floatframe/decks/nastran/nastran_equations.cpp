// Equations of directions in rotated axes, and MPC equations with scalar points: by Gauss and
// Jordan each of these is solved for a scalar point as long as there is one, first for those
// without springs. An equation of such a point only defines its motion and is omitted; that of
// another point makes it depend on nodes; without scalar points it ties nodes. A scalar point
// defined as the difference of nodes does not move with the part, so springs from it to the ground
// are internal springs of the part: they end at a node fixed by an equation.
#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {
namespace {

using DofKey = NastranEquations::Dof;

/// The largest factor of the block in the remaining rows.
std::pair<std::size_t, int> pivot_of(const std::vector<NastranEquations::Row>& rows,
                                     std::size_t from, int node, int first, double& most) {
  std::pair<std::size_t, int> best{from, first};
  most = 0.0;
  for (std::size_t r = from; r < rows.size(); ++r) {
    for (int axis = first; axis < first + 3; ++axis) {
      const auto it = rows[r].factors.find({node, axis});
      if (it == rows[r].factors.end() || !(std::abs(it->second) > most * (1.0 + 1e-9))) continue;
      most = std::abs(it->second);
      best = {r, axis};
    }
  }
  return best;
}

}  // namespace

void add_nastran_direction(LinearEquation& equation, int node, int first, const Vec3& axis,
                           double factor) {
  for (int k = 0; k < 3; ++k)
    if (axis(k) != 0.0) equation.terms.push_back({node, first + k, factor * axis(k)});
}

void NastranEquations::add(int node, bool rotation, const LinearEquation& equation) {
  Row& row = blocks_[{node, rotation}].emplace_back();
  row.at = equation.source;
  for (const LinearEquation::Term& t : equation.terms) row.factors[{t.node, t.axis}] += t.factor;
}

void NastranEquations::follow(int node, int component, const Mat3& axes, int reference,
                              const Vec3& arm, const FeSource& at) {
  const bool rotation = component >= 3;
  const int first = rotation ? 3 : 0;
  const Vec3 axis = axes.col(component % 3);
  LinearEquation e{{}, at};
  add_nastran_direction(e, node, first, axis, 1.0);
  add_nastran_direction(e, reference, first, axis, -1.0);
  if (!rotation) add_nastran_direction(e, reference, 3, arm.cross(axis), -1.0);
  add(node, rotation, e);
}

int add_nastran_term(NastranBuild& build, const NastranEquation& e,
                     const NastranEquation::Term& term, LinearEquation& equation) {
  const int node = build.node(term.node, e);
  if (node >= 0 && term.axis < 0)
    build.error(ErrorCode::missing, e,
                "the component of node {} is missing, expected one of 1 to 6", term.node);
  if (node < 0 || term.axis < 0) return -1;
  if (build.turned[node] == 0) {
    equation.terms.push_back({node, term.axis, term.factor});
    return node;
  }
  const Vec3 axis = build.axes(node).col(term.axis % 3);
  for (int k = 0; k < 3; ++k) {
    const double factor = term.factor * axis(k);
    if (std::abs(factor) > 1e-15 * std::abs(term.factor))
      equation.terms.push_back({node, term.axis >= 3 ? 3 + k : k, factor});
  }
  return node;
}

/// Gauss and Jordan with full pivoting over the three directions of the block.
void NastranEquations::flush(FeModel& model, TextSource& source) {
  for (auto& [block, rows] : blocks_) {
    const auto& [node, rotation] = block;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      double most = 0.0;
      const auto [best, axis] = pivot_of(rows, r, node, rotation ? 3 : 0, most);
      if (!(most > 1e-9)) {
        source.error(ErrorCode::duplicate, rows[r].at,
                     "the equations for node {} hold a direction twice", model.node_ids[node]);
        break;
      }
      std::swap(rows[r], rows[best]);
      const Dof dof = rows[r].pivot = {node, axis};
      const double pivot = rows[r].factors.at(dof);
      for (auto& [key, factor] : rows[r].factors) factor /= pivot;
      for (std::size_t other = 0; other < rows.size(); ++other) {
        std::map<Dof, double>& factors = rows[other].factors;
        const auto it = factors.find(dof);
        if (other == r || it == factors.end()) continue;
        const double f = it->second;
        for (const auto& [key, factor] : rows[r].factors) factors[key] -= f * factor;
        factors.erase(dof);
      }
    }
    if (source.errors() > 0) continue;
    for (const Row& row : rows) {
      LinearEquation& e = model.equations.emplace_back(
          LinearEquation{{{row.pivot.first, row.pivot.second, 1.0}}, row.at});
      for (const auto& [key, factor] : row.factors)
        if (key != row.pivot && std::abs(factor) > 1e-15)
          e.terms.push_back({key.first, key.second, factor});
    }
  }
  blocks_.clear();
}

namespace {

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
        if (t.axis > 0)
          return b_.error(
              ErrorCode::wrong_value, e,
              "the component is {}, but {} is a scalar point, which has one only (0 or blank)",
              t.axis + 1, t.node);
        const NastranScalarPoint* p = b_.scalars.find(t.node);
        if (p == nullptr) continue;  // held
        const DofKey key{p->node, p->axis};
        row.terms[key] += t.factor;
        points_[key] = Point{p->sprung, t.node};
        continue;
      }
      LinearEquation basic;
      const int node = add_nastran_term(b_, e, t, basic);
      if (node < 0) return;
      for (const LinearEquation::Term& x : basic.terms) row.terms[{x.node, x.axis}] += x.factor;
      if (row.first < 0) row.first = node, row.rotation = t.axis >= 3;
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

  /// Does the left-hand side of the equation vanish when the part is displaced, or, if it has only
  /// rotations, when it rotates?
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
    if (grounded_.insert(axis).second) b_.model.equations.push_back({{{ground_, axis, 1.0}}, at});
    return ground_;
  }

  void finish(const Row& row) {
    if (row.terms.empty()) return;
    const NastranEquation& from = *row.equation;
    LinearEquation e{{}, from.at};
    if (row.pivot) {
      if (!points_.at(*row.pivot).sprung) return;
      e.terms.push_back({row.pivot->first, row.pivot->second, row.terms.at(*row.pivot)});
    }
    for (const auto& [key, factor] : row.terms) {
      if (row.pivot == key) continue;
      if (points_.contains(key))
        return b_.error(ErrorCode::unsupported, from,
                        "scalar point {} is tied to scalar point {}, which only springs hold; it "
                        "needs an equation with nodes of its own",
                        points_.at(*row.pivot).id, points_.at(key).id);
      e.terms.push_back({key.first, key.second, factor});
    }
    if (row.pivot && is_difference(e)) differences_.insert(*row.pivot);
    if (!row.pivot) {  // the first term depends, as in the file
      const auto first = std::find_if(e.terms.begin(), e.terms.end(), [&](const auto& t) {
        return t.node == row.first && (t.axis >= 3) == row.rotation;
      });
      if (first != e.terms.end()) std::swap(*first, e.terms.front());
    }
    if (row.pivot || b_.turned[e.terms.front().node] == 0) {
      b_.model.equations.push_back(std::move(e));
    } else {
      const LinearEquation::Term& t = e.terms.front();
      b_.equations.add(t.node, t.axis >= 3, e);
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
