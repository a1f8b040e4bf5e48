#include "floatframe/fe/block_assembly.hpp"

#include <algorithm>
#include <span>

#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// Groups of nodes that share stiffness or mass: elements, then blocks.
class NodeGroups {
 public:
  NodeGroups(const FeModel& model, std::span<const SpringBlock> blocks) : model_(model) {
    for (const SpringBlock& block : blocks) {
      std::vector<int>& nodes = blocks_.emplace_back();
      for (const Dof& dof : block.dofs)
        if (nodes.empty() || nodes.back() != dof.node) nodes.push_back(dof.node);
    }
  }
  std::size_t size() const { return model_.elements.size() + blocks_.size(); }
  std::span<const int> operator[](std::size_t group) const {
    if (group >= model_.elements.size()) return blocks_[group - model_.elements.size()];
    const FeElement& e = model_.elements[group];
    return {e.nodes.data(), static_cast<std::size_t>(element_kernel(e.type).nodes)};
  }

 private:
  const FeModel& model_;
  std::vector<std::vector<int>> blocks_;
};

}  // namespace

BlockAssembly::BlockAssembly(const FeModel& model, const DofTable& table,
                             std::span<const SpringBlock> blocks)
    : table_(table) {
  const std::size_t n = model.positions.size();
  const NodeGroups groups(model, blocks);
  std::vector<int> first(n + 1, 0);  // groups of each node
  for (std::size_t e = 0; e < groups.size(); ++e) {
    for (const int node : groups[e]) ++first[node + 1];
  }
  for (std::size_t i = 1; i <= n; ++i) first[i] += first[i - 1];
  std::vector<int> elements(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  for (std::size_t e = 0; e < groups.size(); ++e) {
    for (const int node : groups[e]) {
      elements[next[node]++] = static_cast<int>(e);
    }
  }
  begin_.assign(n + 1, 0);
  std::vector<int> seen(n, -1);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t start = neighbours_.size();
    if (table.count(static_cast<int>(k)) > 0) {
      neighbours_.push_back(static_cast<int>(k));
      seen[k] = static_cast<int>(k);
    }
    for (int i = first[k]; i < first[k + 1]; ++i) {
      const int e = elements[i];
      for (const int node : groups[e]) {
        int& s = seen[node];
        if (s == static_cast<int>(k)) continue;
        s = static_cast<int>(k);
        neighbours_.push_back(node);
      }
    }
    std::sort(neighbours_.begin() + static_cast<std::ptrdiff_t>(start), neighbours_.end());
    begin_[k + 1] = static_cast<int>(neighbours_.size());
  }
  offset_.resize(neighbours_.size());
  matrix_.resize(table.size(), table.size());
  int* outer = matrix_.outerIndexPtr();
  outer[0] = 0;
  for (std::size_t k = 0; k < n; ++k) {
    int rows = 0;
    for (int i = begin_[k]; i < begin_[k + 1]; ++i) {
      offset_[i] = rows;
      rows += table.count(neighbours_[i]);
    }
    for (int c = table.begin[k]; c < table.begin[k + 1]; ++c) outer[c + 1] = outer[c] + rows;
  }
  matrix_.resizeNonZeros(outer[table.size()]);
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    for (int c = table.begin[k]; c < table.begin[k + 1]; ++c) {
      int* inner = matrix_.innerIndexPtr() + outer[c];
      for (int i = begin_[k]; i < begin_[k + 1]; ++i) {
        const int node = neighbours_[i];
        const int row = table.begin[node];
        for (int r = 0; r < table.count(node); ++r) *inner++ = row + r;
      }
    }
  }
}

double* BlockAssembly::block(int row_node, int column_node) {
  const std::size_t k = column_node;
  const auto from = neighbours_.begin() + begin_[k], to = neighbours_.begin() + begin_[k + 1];
  const auto at = std::lower_bound(from, to, row_node);
  return matrix_.valuePtr() + matrix_.outerIndexPtr()[table_.begin[k]] +
         offset_[at - neighbours_.begin()];
}

Eigen::Index BlockAssembly::stride(int node) const {
  const int c = table_.begin[node];
  return matrix_.outerIndexPtr()[c + 1] - matrix_.outerIndexPtr()[c];
}

void BlockAssembly::add(const int* nodes, int count, int d, const MatX& matrix) {
  for (int b = 0; b < count; ++b) {
    const Eigen::Index column = stride(nodes[b]);
    for (int a = 0; a < count; ++a) {
      double* to = block(nodes[a], nodes[b]);
      for (int c = 0; c < d; ++c) {
        for (int r = 0; r < d; ++r) to[c * column + r] += matrix(d * a + r, d * b + c);
      }
    }
  }
}

void BlockAssembly::add_scalar(const int* nodes, int count, const MatX& scalar) {
  for (int b = 0; b < count; ++b) {
    const Eigen::Index column = stride(nodes[b]);
    for (int a = 0; a < count; ++a) {
      double* to = block(nodes[a], nodes[b]);
      for (int c = 0; c < 3; ++c) to[c * column + c] += scalar(a, b);
    }
  }
}

void BlockAssembly::add(Dof row, Dof column, double value) {
  block(row.node, column.node)[column.axis * stride(column.node) + row.axis] += value;
}

SparseMatrix BlockAssembly::finish() {
  matrix_.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
  return std::move(matrix_);
}

}  // namespace floatframe
