#pragma once
// The modal mass of what turns with nodes, beyond its constant part. With H_k, k = 1..6, the
// integrals of displacements of second order as they enter force (S2_j) and moment (of S2i) about
// the origin of the body frame, C(y) = (y^T H_k) is the share of second order of M_rf, 6 x nm. What
// vibrations of a free body feel is M_ff - M_fr M_rr^-1 M_rf, which is small beside M_ff in a frame
// that follows a node: - C^T M_rr^-1 C would make it negative at amplitudes far from large. With
//   M_ff(y) = M_ff + C^T W C,   W = M_rr^-1 at y = 0
// it stays positive. What is added to the kinetic energy, 1/2 ydot^T C^T W C ydot, is of fourth
// order in (y, ydot), where M_ff is not exact otherwise either. Its forces are exact,
//   Q_f = -C^T W h,   h_k = ydot^T H_k ydot
// so that energy is kept. Neither whirl nor any small motion about a steady state changes.
#include "floatframe/body/second_order.hpp"

namespace floatframe {

struct PreprocessingData;

class TurningMass {
 public:
  TurningMass() = default;
  /// Of a body with these integrals.
  TurningMass(const PreprocessingData& data, const SecondOrder& turning);

  /// Adds to the block of modes of M and Q_v, which begins at `first`. Step time: no heap.
  void add(const double* y, const double* ydot, int first, MatX& M, VecX& Qv) noexcept;
  /// 1/2 ydot^T (M_ff(y) - M_ff) ydot
  double energy(const double* y, const double* ydot) const noexcept;

 private:
  Mat6 W_ = Mat6::Zero();
  MatX H_;                ///< row 6a+k, column b: H_k(a, b); rows filled up to whole lanes
  VecX C_, rate_;         ///< scratch: 6 of each mode
  MatX C_rows_, D_rows_;  ///< scratch: C and W C, modes side by side
};

}  // namespace floatframe
