#include "floatframe/fe/rigid_leaders.hpp"

#include <cmath>
#include <map>

#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

/// Columns of three rows, from which others may be taken away.
class ThreeRows {
 public:
  void add(const SparseRows& rows, int node, const Mat3& factor) {
    for (int j = 0; j < 3; ++j)
      for (SparseRows::InnerIterator it(rows, 3 * node + j); it; ++it)
        columns_.try_emplace(static_cast<int>(it.col()), Vec3::Zero()).first->second +=
            it.value() * factor.col(j);
  }
  double largest() const {
    double size = 0.0;
    for (const auto& [column, value] : columns_) size = std::max(size, value.cwiseAbs().maxCoeff());
    return size;
  }

 private:
  std::map<int, Vec3> columns_;
};

constexpr double rounding = 1e-9;

bool is_dependent(const FeSystem& system, int node) {
  for (int axis = 0; axis < 3; ++axis)
    if (system.row(node, axis) >= 0) return false;
  return system.T.middleRows(3 * node, 3).nonZeros() > 0;
}

bool follows(const FeModel& model, const FeSystem& system, int node, int leader) {
  const Vec3 arm = model.positions[node] - model.positions[leader];
  ThreeRows rest, turn;
  rest.add(system.T, node, Mat3::Identity());
  rest.add(system.T, leader, -Mat3::Identity());
  turn.add(system.T_theta, leader, skew(arm));
  rest.add(system.T_theta, leader, skew(arm));
  return rest.largest() <= rounding * (1.0 + turn.largest());
}

/// Pairs of nodes that may be fixed to each other.
std::vector<std::vector<int>> candidates(const FeModel& model, const FeSystem& system) {
  std::vector<std::vector<int>> of(model.positions.size());  // leader: its followers
  const auto add = [&](int node, int leader) {
    if (node == leader || !is_dependent(system, node)) return;
    if (of[leader].empty() || of[leader].back() != node) of[leader].push_back(node);
  };
  for (const Spider& s : model.spiders)
    if (s.kind == Spider::Kind::rigid)
      for (const int node : s.nodes) add(node, s.reference);
  for (const LinearEquation& e : model.equations) {
    const int first = e.terms.front().node;
    int other = -1;
    bool two = true;
    for (const LinearEquation::Term& t : e.terms) {
      if (t.node == first || t.node == other) continue;
      two = two && other < 0;
      other = t.node;
    }
    if (!two || other < 0) continue;
    add(first, other);
    add(other, first);
  }
  return of;
}

}  // namespace

std::vector<int> rigid_leaders(const FeModel& model, const FeSystem& system) {
  std::vector<int> leaders(model.positions.size(), -1);
  if (model.spiders.empty() && model.equations.empty()) return leaders;
  const std::vector<std::vector<int>> followers = candidates(model, system);
  // From the independent ones outwards.
  std::vector<int> next;
  for (int k = 0; k < model.nodes(); ++k)
    if (!followers[k].empty() && !is_dependent(system, k)) next.push_back(k);
  for (std::size_t i = 0; i < next.size(); ++i) {
    const int leader = next[i];
    for (const int node : followers[leader]) {
      if (leaders[node] >= 0 || !follows(model, system, node, leader)) continue;
      leaders[node] = leader;
      next.push_back(node);
    }
  }
  return leaders;
}

bool turn_alike(const FeSystem& system, int a, int b) {
  ThreeRows rest;
  rest.add(system.T_theta, a, Mat3::Identity());
  rest.add(system.T_theta, b, -Mat3::Identity());
  return rest.largest() <= rounding;
}

}  // namespace floatframe
