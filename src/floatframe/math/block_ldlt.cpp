#include "floatframe/math/block_ldlt.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "floatframe/math/partial_ldlt.hpp"

namespace floatframe {

namespace {

/// Pivots smaller than this fraction of what was put into their place are round-off: it adds up
/// over the fronts, and a pivot of this size still has a digit or two. (Seed 181 of the random
/// mechanisms, a massless mode on a ball: pivots of 1e-14 were noise, with which a projection moved
/// velocities by 0.2 instead of 2e-5.)
constexpr double vanishing = 1e-13;

}  // namespace

BlockLdlt::BlockLdlt(const std::vector<int>& sizes, const std::vector<std::pair<int, int>>& edges) {
  const std::size_t n = sizes.size();
  std::vector<std::set<int>> neighbours(n);
  for (const auto& [a, b] : edges) {
    if (a == b) continue;
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  nodes_.resize(n);
  int offset = 0;
  for (std::size_t k = 0; k < n; ++k) {
    nodes_[k].size = sizes[k];
    nodes_[k].offset = offset;
    offset += sizes[k];
  }
  // Minimum degree, counted in unknowns, then the order given; eliminating a block couples its
  // neighbours.
  std::vector<long> degree(n, 0);
  std::set<std::pair<long, int>> left;
  for (std::size_t k = 0; k < n; ++k) {
    for (int j : neighbours[k]) degree[k] += sizes[j];
    left.emplace(degree[k], static_cast<int>(k));
  }
  while (!left.empty()) {
    const int best = left.begin()->second;
    left.erase(left.begin());
    const std::size_t b = best;
    nodes_[b].rank = static_cast<int>(order_.size());
    order_.push_back(best);
    nodes_[b].blocks.assign(neighbours[b].begin(), neighbours[b].end());
    for (int i : neighbours[b]) {
      const std::size_t k = i;
      left.erase({degree[k], i});
      for (int j : neighbours[b])
        if (i != j && neighbours[k].insert(j).second) degree[k] += sizes[j];
      neighbours[k].erase(best);
      degree[k] -= sizes[b];
      left.emplace(degree[k], i);
    }
  }
  for (Node& node : nodes_) {
    std::sort(node.blocks.begin(), node.blocks.end(),
              [&](int a, int b) { return nodes_[a].rank < nodes_[b].rank; });
    int start = node.size;
    for (int b : node.blocks) {
      node.start.push_back(start);
      for (int i = 0; i < sizes[b]; ++i) node.rows.push_back(nodes_[b].offset + i);
      start += sizes[b];
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
    for (int b : node.blocks) {
      const int at = start_of(p, b);
      for (int i = 0; i < sizes[b]; ++i) node.parent_rows.push_back(at + i);
    }
  }
}

int BlockLdlt::start_of(const Node& n, int block) const noexcept {
  if (&n == &nodes_[block]) return 0;
  for (std::size_t k = 0; k < n.blocks.size(); ++k)
    if (n.blocks[k] == block) return n.start[k];
  return -1;
}

void BlockLdlt::set_zero() noexcept {
  for (Node& n : nodes_) n.matrix.setZero();
}

MatX& BlockLdlt::front(int a, int b, int& offset_a, int& offset_b) noexcept {
  Node& na = nodes_[a];
  Node& nb = nodes_[b];
  Node& first = na.rank <= nb.rank ? na : nb;
  offset_a = start_of(first, a);
  offset_b = start_of(first, b);
  return first.matrix;
}

void BlockLdlt::add(int a, int i, int b, int j, double x) noexcept {
  int oa = 0, ob = 0;
  MatX& f = front(a, b, oa, ob);
  const int r = oa + i, c = ob + j;
  f(std::max(r, c), std::min(r, c)) += x;
}

int BlockLdlt::factorize() noexcept {
  // Before any front takes its part: what is left of a penalty after that says nothing about the
  // digits it has lost.
  for (Node& n : nodes_)
    for (int j = 0; j < n.size; ++j) n.original[j] = std::abs(n.matrix(j, j));
  for (const int k : order_) {
    Node& n = nodes_[k];
    const int total = n.total, ld = static_cast<int>(n.matrix.rows());
    const int failed = partial_ldlt(n.matrix.data(), total, n.size, n.original.data(), vanishing);
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

void BlockLdlt::solve(VecX& x) noexcept {
  for (const int k : order_) {
    Node& n = nodes_[k];
    const int total = n.total;
    n.work.head(n.size) = x.segment(n.offset, n.size);
    n.work.tail(n.work.size() - n.size).setZero();
    partial_forward(n.matrix.data(), total, n.size, n.work.data());
    x.segment(n.offset, n.size) = n.work.head(n.size);
    for (std::size_t i = 0; i < n.rows.size(); ++i)
      x[n.rows[i]] += n.work[n.size + static_cast<int>(i)];
  }
  for (std::size_t l = order_.size(); l-- > 0;) {
    Node& n = nodes_[order_[l]];
    const int total = n.total;
    n.work.head(n.size) = x.segment(n.offset, n.size);
    for (std::size_t i = 0; i < n.rows.size(); ++i)
      n.work[n.size + static_cast<int>(i)] = x[n.rows[i]];
    partial_backward(n.matrix.data(), total, n.size, n.work.data());
    x.segment(n.offset, n.size) = n.work.head(n.size);
  }
}

}  // namespace floatframe
