#pragma once
// Sparse LDL^T over variable blocks (one block per body): multifrontal, ordered by minimum degree.
// The pattern, the elimination order and all sizes are fixed at construction; assembling,
// factorising and solving never allocate. Contributions of a pair of blocks go into the front of
// the one eliminated first.
//
// A block may end with inner unknowns, which are coupled with this block and with neighbours that
// are eliminated later, but are eliminated with it: the multipliers of a saddle point. Pivots are
// used in the given order (z of a body with mass, then multipliers: quasi-definite, so every order
// has a factorisation); blocks with the option choose them within the block, 1x1 or 2x2. Such
// blocks come first: Schur complements of others would leave no digits of their small entries. So
// do light blocks coupled with only one other (a link of 1 g on a crane). Light blocks that are
// constrained come last: with their small mass the pivots of their multipliers cancel.
#include <cassert>
#include <utility>
#include <vector>

#include "floatframe/math/contracts.hpp"
#include "floatframe/math/pivoted_ldlt.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

class BlockLdlt {
 public:
  struct Block {
    int size = 0;          ///< unknowns that other blocks see
    int inner = 0;         ///< more unknowns at its end
    bool chooses = false;  ///< its pivots are chosen
    double mass = 0.0;     ///< compared with that of other blocks; 0: unknown
    bool held = false;     ///< constrained by joints on two sides, one of them the ground
  };

  BlockLdlt() = default;
  /// edges: pairs of blocks that are coupled.
  BlockLdlt(const std::vector<Block>& blocks, const std::vector<std::pair<int, int>>& edges);
  BlockLdlt(const std::vector<int>& sizes, const std::vector<std::pair<int, int>>& edges);

  /// The blocks in the order of their elimination: first those with chosen pivots, then light ones
  /// at the ends, then by minimum degree, counted in unknowns coupled with others, then the given
  /// order; last light ones that are constrained.
  static std::vector<int> elimination_order(const std::vector<Block>& blocks,
                                            const std::vector<std::pair<int, int>>& edges);

  void set_zero() noexcept;
  /// Adds x to entry (row i of block a, column j of block b) and its mirror image. The blocks must
  /// be coupled or equal.
  void add(int a, int i, int b, int j, double x) noexcept;
  /// The front that holds the pair (a, b), and where each block starts in it.
  MatX& front(int a, int b, int& offset_a, int& offset_b) noexcept;
  MatX& front(int a) noexcept {
    assert(is_index(a, nodes_));
    return nodes_[a].matrix;
  }

  /// First unknown of a block, blocks in the given order.
  int offset(int block) const noexcept {
    assert(is_index(block, nodes_));
    return nodes_[block].offset;
  }
  int unknowns() const noexcept { return unknowns_; }

  /// Returns -1 or the unknown (global index, blocks in the given order) whose pivot vanished.
  int factorize() noexcept;
  void solve(VecX& x) noexcept;
  /// Sum of the logarithms of the pivots' magnitudes: log of the determinant's.
  double log_pivots() const noexcept;

 private:
  struct Node {
    int size = 0, total = 0, offset = 0, rank = 0, parent = -1;
    std::vector<int> blocks;       // coupled blocks eliminated later, in elimination order
    std::vector<int> start;        // where they start in the front
    std::vector<int> rows;         // global index of each trailing row
    std::vector<int> parent_rows;  // its position in the parent's front
    MatX matrix;
    VecX original, work;
    PivotOrder pivots;
    bool chooses = false;
  };
  int start_of(const Node& n, int block) const noexcept;
  std::vector<Node> nodes_;
  std::vector<int> order_;
  int unknowns_ = 0;
};

}  // namespace floatframe
