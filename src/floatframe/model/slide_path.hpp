#pragma once
// The path of a point that slides along a flexible body: a cubic spline through the deformed
// positions of its nodes, over the length u of the chords between them as drawn,
//   c(u) = sum_k N_k(u) r_k                                                                    (1)
// with the splines N_k that are 1 at node k and 0 at the others. Where N_k is linear in u beyond
// the ends, so is c. The shapes of the material point at u are the same sum of those of the nodes:
//   X(u) = sum_k N_k(u) X_k                                                                    (2)
// so that a load on it acts on the nodes with the weights N_k, and does the work that the
// deflection of the path says. c has a continuous curvature; of the bent lines of beams the error
// falls with the fourth power of the distance of the nodes.
#include <vector>

#include "floatframe/model/space_curve.hpp"

namespace floatframe {

class SlidePath {
 public:
  /// Through these nodes of a body at p, 3 x n, body axes, at least two. Allocates. Load time.
  SlidePath(std::vector<int> nodes, const Mat3X& p);

  const std::vector<int>& nodes() const noexcept { return nodes_; }
  Eigen::Index size() const noexcept { return p_.cols(); }
  /// As drawn, 3 x n.
  const Mat3X& points() const noexcept { return p_; }
  /// u of each node [m].
  const std::vector<double>& knots() const noexcept { return u_; }
  double last() const noexcept { return u_.back(); }
  /// The path as drawn, from its first node on.
  const SpaceCurve& drawn() const noexcept { return drawn_; }
  /// N_k(u) and its derivatives, as many as nodes. Step time.
  void weights(double u, VecX& N, VecX& dN, VecX& ddN) const noexcept;

 private:
  std::vector<int> nodes_;
  Mat3X p_;
  std::vector<double> u_;
  MatX curvatures_;  ///< N_k'' at knot j: (k, j)
  SpaceCurve drawn_;
};

}  // namespace floatframe
