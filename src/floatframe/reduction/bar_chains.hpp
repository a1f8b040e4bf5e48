#pragma once
// Frames of bars with very many equal elements. The stiffness of n Hermite beams in a row has a
// condition of n^4: with 20 000 of them its factors have no accurate digit of the first frequency.
// But such a row between two nodes is one long beam, exactly: the displacements inside are cubic in
// bending and linear along and about the axis. So rows of m elements become long beams, m about the
// square root of the number of elements, with
//   u = P u_c + (0, u_I)                  u_c: kept nodes, u_I: inside, with the kept nodes at rest
//   P^T K P = K_c, the stiffness of the long beams, computed from their lengths and not from K
//   K^-1 f = P K_c^-1 P^T f + (0, K_II^-1 f_I)
// This is the elimination of inner nodes without its round-off; both systems have a condition of
// n^2 at most.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/reduction/fixed_interface.hpp"

namespace floatframe {

/// The same interface as FixedInterface, for a model of beam2 elements.
class BarChains {
 public:
  /// Null if direct factors are as good: few elements, or no rows of equal ones. K, M: 6 dofs per
  /// node. `boundary`, `zero`, `label`: as for FixedInterface.
  static std::optional<BarChains> make(const FeModel& model, const SparseMatrix& K,
                                       const SparseMatrix& M, const std::vector<int>& boundary,
                                       const std::vector<int>& zero,
                                       const std::function<std::string(int)>& label);

  int inner() const noexcept { return static_cast<int>(inner_.size()); }
  MatX constraint_modes() const;
  MatX guyan_stiffness(const MatX&) const;
  MatX inner_response(const MatX& forces) const;
  Eigenmodes normal_modes(int count) const;
  int count_below(double frequency) const;

 private:
  BarChains(const FeModel& model, const SparseMatrix& K, const SparseMatrix& M,
            const std::vector<int>& boundary, const std::vector<int>& zero,
            const std::function<std::string(int)>& label, const std::vector<char>& kept);
  MatX solve(const MatX& f) const;
  Eigenmodes lowest(int count) const;

  int size_ = 0;
  std::vector<int> inner_;   ///< dofs that are neither boundary nor zero
  std::vector<int> inside_;  ///< of these, the nodes inside long beams
  SparseMatrix P_;           ///< dofs x dofs of the kept nodes
  SparseMatrix P_inner_;     ///< inner dofs x inner dofs of the kept nodes
  SparseMatrix M_inner_;
  std::optional<FixedInterface> coarse_;
  SparseFactors coarse_factors_, inside_factors_;
};

}  // namespace floatframe
