#include "floatframe/math/block_ldlt.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "floatframe/math/contracts.hpp"
#include "floatframe/math/partial_ldlt.hpp"

namespace floatframe {

namespace {

/// Pivots smaller than this fraction of the assembled diagonal are round-off: it accumulates over
/// the fronts, and a pivot of this size still has a digit or two. (Seed 181 of the random
/// mechanisms, a massless mode on a spherical joint: pivots of 1e-14 were noise, with which a
/// projection changed velocities by 0.2 instead of 2e-5.)
constexpr double vanishing = 1e-13;

std::vector<std::set<int>> neighbours_of(std::size_t n,
                                         const std::vector<std::pair<int, int>>& edges) {
  std::vector<std::set<int>> neighbours(n);
  for (const auto& [a, b] : edges) {
    assert(is_index(a, neighbours) && is_index(b, neighbours));
    if (a == b) continue;
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  return neighbours;
}

std::vector<BlockLdlt::Block> blocks_of(const std::vector<int>& sizes) {
  std::vector<BlockLdlt::Block> blocks;
  for (const int size : sizes) blocks.push_back({.size = size});
  return blocks;
}

/// Calls eliminate(block, its remaining neighbours) in the order of elimination; eliminating a
/// block couples its neighbours.
template <class Eliminate>
void by_minimum_degree(const std::vector<BlockLdlt::Block>& blocks,
                       const std::vector<std::pair<int, int>>& edges, const Eliminate& eliminate) {
  const std::size_t n = blocks.size();
  std::vector<std::set<int>> neighbours = neighbours_of(n, edges);
  std::vector<long> degree(n, 0), key(n, 0);
  double heaviest = 0.0;
  for (const BlockLdlt::Block& b : blocks) heaviest = std::max(heaviest, b.mass);
  const auto is_light = [&](std::size_t k, double part) {
    return blocks[k].mass > 0.0 && blocks[k].mass < part * heaviest;
  };
  const auto key_of = [&](std::size_t k) {
    // Above any degree. Light ends cause no fill in any order; constrained bodies may, so that only
    // those are moved whose mass would be lost otherwise.
    constexpr long first = -1'000'000'000, second = -500'000'000, last = 500'000'000;
    if (blocks[k].chooses) return degree[k] + first;
    if (blocks[k].held) return degree[k] + (is_light(k, 1e-6) ? last : 0);
    return degree[k] + (neighbours[k].size() == 1 && is_light(k, 1e-3) ? second : 0);
  };
  std::set<std::pair<long, int>> left;
  for (std::size_t k = 0; k < n; ++k) {
    for (int j : neighbours[k]) degree[k] += blocks[j].size;
    key[k] = key_of(k);
    left.emplace(key[k], static_cast<int>(k));
  }
  while (!left.empty()) {
    const int best = left.begin()->second;
    left.erase(left.begin());
    const std::size_t b = best;
    eliminate(best, neighbours[b]);
    for (int i : neighbours[b]) {
      const std::size_t k = i;
      left.erase({key[k], i});
      for (int j : neighbours[b])
        if (i != j && neighbours[k].insert(j).second) degree[k] += blocks[j].size;
      neighbours[k].erase(best);
      degree[k] -= blocks[b].size;
      key[k] = key_of(k);
      left.emplace(key[k], i);
    }
  }
}

}  // namespace

std::vector<int> BlockLdlt::elimination_order(const std::vector<Block>& blocks,
                                              const std::vector<std::pair<int, int>>& edges) {
  std::vector<int> order;
  by_minimum_degree(blocks, edges,
                    [&](int block, const std::set<int>&) { order.push_back(block); });
  return order;
}

BlockLdlt::BlockLdlt(const std::vector<int>& sizes, const std::vector<std::pair<int, int>>& edges)
    : BlockLdlt(blocks_of(sizes), edges) {}

BlockLdlt::BlockLdlt(const std::vector<Block>& blocks,
                     const std::vector<std::pair<int, int>>& edges) {
  nodes_.resize(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    assert(blocks[k].size >= 0 && blocks[k].inner >= 0 && !(blocks[k].mass < 0.0));
    Node& node = nodes_[k];
    node.size = blocks[k].size + blocks[k].inner;
    node.offset = unknowns_;
    node.chooses = blocks[k].chooses;
    if (node.chooses) node.pivots = PivotOrder(node.size);
    unknowns_ += node.size;
  }
  by_minimum_degree(blocks, edges, [&](int block, const std::set<int>& neighbours) {
    nodes_[block].rank = static_cast<int>(order_.size());
    order_.push_back(block);
    nodes_[block].blocks.assign(neighbours.begin(), neighbours.end());
  });
  assert(order_.size() == blocks.size());
  for (Node& node : nodes_) {
    std::sort(node.blocks.begin(), node.blocks.end(),
              [&](int a, int b) { return nodes_[a].rank < nodes_[b].rank; });
    int start = node.size;
    for (int b : node.blocks) {
      node.start.push_back(start);
      for (int i = 0; i < blocks[b].size; ++i) node.rows.push_back(nodes_[b].offset + i);
      start += blocks[b].size;
    }
    node.total = start;
    node.matrix = MatX::Zero(front_stride(start), start);
    node.original = VecX::Zero(node.size);
    node.work = VecX::Zero(front_stride(start));
  }
  for (Node& node : nodes_) {
    if (node.blocks.empty()) continue;
    node.parent = node.blocks.front();
    const Node& p = nodes_[node.parent];
    assert(p.rank > node.rank);
    for (int b : node.blocks) {
      const int at = start_of(p, b);
      assert(at >= 0);  // what an eliminated block couples is coupled in the next front
      for (int i = 0; i < blocks[b].size; ++i) node.parent_rows.push_back(at + i);
    }
  }
}

int BlockLdlt::start_of(const Node& n, int block) const noexcept {
  assert(is_index(block, nodes_));
  if (&n == &nodes_[block]) return 0;
  for (std::size_t k = 0; k < n.blocks.size(); ++k)
    if (n.blocks[k] == block) return n.start[k];
  return -1;
}

void BlockLdlt::set_zero() noexcept {
  constexpr Eigen::Index small = 240;  // 2 kB: at once is faster than column by column
  for (Node& n : nodes_) {
    if (n.matrix.size() <= small) {
      n.matrix.setZero();
      continue;
    }
    // Starting at the lane of the diagonal: entries above it are never read.
    for (Eigen::Index j = 0; j < n.matrix.cols(); ++j)
      n.matrix.col(j).tail(n.matrix.rows() - (j & ~3)).setZero();
  }
}

MatX& BlockLdlt::front(int a, int b, int& offset_a, int& offset_b) noexcept {
  assert(is_index(a, nodes_));
  assert(is_index(b, nodes_));
  Node& na = nodes_[a];
  Node& nb = nodes_[b];
  Node& first = na.rank <= nb.rank ? na : nb;
  offset_a = start_of(first, a);
  offset_b = start_of(first, b);
  assert(offset_a >= 0 && offset_b >= 0);  // coupled
  return first.matrix;
}

void BlockLdlt::add(int a, int i, int b, int j, double x) noexcept {
  int oa = 0, ob = 0;
  MatX& f = front(a, b, oa, ob);
  const int r = oa + i, c = ob + j;
  assert(i >= 0 && i < nodes_[a].size && j >= 0 && j < nodes_[b].size);
  f(std::max(r, c), std::min(r, c)) += x;
}

int BlockLdlt::factorize() noexcept {
  // Before any front is eliminated: the remainder of a penalty after elimination does not show the
  // digits it has lost.
  for (Node& n : nodes_)
    for (int j = 0; j < n.size; ++j) n.original[j] = std::abs(n.matrix(j, j));
  for (const int k : order_) {
    Node& n = nodes_[k];
    const int total = n.total, ld = static_cast<int>(n.matrix.rows());
    const int failed =
        n.chooses ? pivoted_ldlt(n.matrix.data(), total, n.size, n.pivots, vanishing)
                  : partial_ldlt(n.matrix.data(), total, n.size, n.original.data(), vanishing);
    if (failed >= 0) return n.offset + failed;
    if (n.parent < 0) continue;
    MatX& p = nodes_[n.parent].matrix;
    const int m = total - n.size;
    for (int j = 0; j < m; ++j) {
      const double* from = n.matrix.data() + static_cast<Eigen::Index>(n.size + j) * ld + n.size;
      double* to = p.data() + static_cast<Eigen::Index>(n.parent_rows[j]) * p.rows();
      for (int i = j; i < m; ++i) to[n.parent_rows[i]] += from[i];
    }
  }
  return -1;
}

double BlockLdlt::log_pivots() const noexcept {
  double sum = 0.0;
  for (const Node& n : nodes_) {
    if (n.chooses)
      sum += pivoted_log(n.size, n.pivots);
    else
      for (int j = 0; j < n.size; ++j) sum -= std::log(std::abs(n.matrix(j, j)));
  }
  return sum;
}

void BlockLdlt::solve(VecX& x) noexcept {
  assert(x.size() == unknowns_);
  double* all = x.data();
  for (const int k : order_) {
    Node& n = nodes_[k];
    const int total = n.total, stride = front_stride(total), size = n.size;
    const int* rows = n.rows.data();
    double *own = all + n.offset, *work = n.work.data();
    for (int i = 0; i < size; ++i) work[i] = own[i];
    for (int i = size; i < stride; ++i) work[i] = 0.0;
    if (n.chooses)
      pivoted_forward(n.matrix.data(), total, size, n.pivots, work);
    else
      partial_forward(n.matrix.data(), total, size, work);
    for (int i = 0; i < size; ++i) own[i] = work[i];
    for (int i = size; i < total; ++i) all[rows[i - size]] += work[i];
  }
  for (std::size_t l = order_.size(); l-- > 0;) {
    Node& n = nodes_[order_[l]];
    const int total = n.total, size = n.size;
    const int* rows = n.rows.data();
    double *own = all + n.offset, *work = n.work.data();
    for (int i = 0; i < size; ++i) work[i] = own[i];
    for (int i = size; i < total; ++i) work[i] = all[rows[i - size]];
    if (n.chooses)
      pivoted_backward(n.matrix.data(), total, size, n.pivots, work);
    else
      partial_backward(n.matrix.data(), total, size, work);
    for (int i = 0; i < size; ++i) own[i] = work[i];
  }
}

}  // namespace floatframe
