#pragma once
// Disjoint sets of numbered elements that are merged.
#include <cassert>
#include <numeric>
#include <vector>

#include "floatframe/math/contracts.hpp"

namespace floatframe {

class UnionFind {
 public:
  explicit UnionFind(int count = 0) : leader_(count) {
    std::iota(leader_.begin(), leader_.end(), 0);
  }
  /// Adds an element in a separate set.
  int add() {
    leader_.push_back(static_cast<int>(leader_.size()));
    return leader_.back();
  }
  /// The representative of the set of k.
  int root(int k) const {
    assert(is_index(k, leader_));
    while (leader_[k] != k) k = leader_[k] = leader_[leader_[k]];
    return k;
  }
  /// The root of b becomes that of both.
  void join(int a, int b) { leader_[root(a)] = root(b); }

 private:
  mutable std::vector<int> leader_;  // `root` shortens the paths
};

}  // namespace floatframe
