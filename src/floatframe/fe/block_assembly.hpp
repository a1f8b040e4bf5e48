#pragma once
// Assembly of large symmetric matrices from blocks of nodes: the pattern (which nodes share an
// element) is made once, element matrices are added in place.
#include <span>
#include <vector>

#include "floatframe/fe/springs.hpp"

namespace floatframe {

class BlockAssembly {
 public:
  /// `blocks`: nodes that share stiffness without an element.
  BlockAssembly(const FeModel& model, const DofTable& table,
                std::span<const SpringBlock> blocks = {});

  /// Element matrix with d dofs per node, as the kernels make it.
  void add(const int* nodes, int count, int d, const MatX& matrix);
  /// Scalar mass of an element, times the identity of the translations.
  void add_scalar(const int* nodes, int count, const MatX& scalar);
  /// Single entry.
  void add(Dof row, Dof column, double value);
  /// Entries that are exactly zero are left out. Ends the assembly.
  SparseMatrix finish();

 private:
  double* block(int row_node, int column_node);
  Eigen::Index stride(int node) const;

  const DofTable& table_;
  std::vector<int> begin_, neighbours_, offset_;  ///< of each node; rows above the neighbour's
  SparseMatrix matrix_;
};

}  // namespace floatframe
