#pragma once
// Sets of numbered things that grow together.
#include <numeric>
#include <vector>

namespace floatframe {

class UnionFind {
 public:
  explicit UnionFind(int count = 0) : leader_(count) {
    std::iota(leader_.begin(), leader_.end(), 0);
  }
  /// One more, in a set of its own.
  int add() {
    leader_.push_back(static_cast<int>(leader_.size()));
    return leader_.back();
  }
  /// The number that stands for the set of k.
  int root(int k) const {
    while (leader_[k] != k) k = leader_[k] = leader_[leader_[k]];
    return k;
  }
  /// The root of b becomes that of both.
  void join(int a, int b) { leader_[root(a)] = root(b); }

 private:
  mutable std::vector<int> leader_;  // `root` shortens the paths
};

}  // namespace floatframe
