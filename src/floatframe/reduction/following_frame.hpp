#pragma once
// How a frame of 2-node beams follows the second-order strains of its modes. A beam that bends
// and twists,
//   theta = (phi, -w', v') in local axes,  sections rotated by exp(theta),
// keeps its length and its twist per length: its ends come nearer by 1/2 y^T gamma y and turn
// against each other about its axis by 1/2 y^T tau y,
//   gamma = int v'^T v' + w'^T w' + Ip/A phi'^T phi' dx,   Ip/A: its outer fibres are helices
//   tau   = int v'^T w'' - w'^T v'' dx (its symmetric part): (theta x theta')_1, the effect of
//           bending in two planes to the twist of the tangent
// and the frame follows, held by its body reference, with the least strain energy:
//   K h = -sum_e L_e^T (EA/L) gamma_e + sum_e T_e^T (GJ/L) tau_e,   L_e: stretch, T_e: twist
// Frames without loops that are held by six conditions follow without strain: from node to node h
// changes by -gamma along the element, the rotation by tau about it. For a straight bar clamped at
// its start see theory, section 8: h_1(k) = -sum over the elements up to k of gamma.
//
// Pairs of modes a >= b are the columns, row by row of the lower half, in groups that fit into
// memory.
#include <memory>
#include <optional>
#include <vector>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/reduction/fixed_interface.hpp"

namespace floatframe {

/// Slopes and twist of a beam in local axes.
struct BentBeam {
  double L = 0.0;
  Mat3 T;
  Eigen::Matrix<double, 12, Eigen::Dynamic> q;  ///< displacements of the ends, local axes

  /// X: six rows per node.
  BentBeam(const ElementInput& in, const FeElement& e, const MatX& X);
  /// Rows rx, -w', v' at s = x/L.
  Mat3X rotation(double s) const;
  /// Rows -w'', v''.
  Eigen::Matrix<double, 2, Eigen::Dynamic> curvature(double s) const;
};

/// A pair of modes.
struct ModePair {
  Eigen::Index a, b;
};
/// a >= b, row by row of the lower half.
std::vector<ModePair> mode_pairs(Eigen::Index modes);

class FollowingFrame {
 public:
  /// held: rows that the body reference holds, six at least.
  FollowingFrame(const FeModel& model, const MatX& X, std::vector<int> held);

  /// False for frames of very many elements with loops: their factors have no accurate digits.
  bool known() const noexcept { return tree_ || fixed_; }
  enum class Strain { shortening, twist };
  /// Six rows per node, a column for each pair from `first` on.
  MatX follow(Strain strain, const std::vector<ModePair>& pairs, std::size_t first,
              std::size_t count) const;

 private:
  /// A step from a known node to the next one.
  struct Step {
    int element, from, to;
    double sign;  ///< 1: from the first to the second node of the element
  };
  void find_tree();
  MatX strains(Strain strain, const std::vector<ModePair>& pairs, std::size_t first,
               std::size_t count) const;
  void hold(MatX& h) const;

  const FeModel& model_;
  const MatX& X_;
  std::vector<int> held_;
  bool tree_ = false;
  std::vector<Step> steps_;
  std::unique_ptr<FixedInterface> fixed_;
};

}  // namespace floatframe
