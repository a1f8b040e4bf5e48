#pragma once
// The modal mass of what turns with nodes, beyond its constant part. With H_k, k = 1..6, the
// integrals of displacements of second order as they enter force (S2_j) and moment (of S2i) about
// the origin of the body frame, C(y) = (y^T H_k) is the share of second order of M_rf, 6 x nm. A
// rotor that vibrates freely has M_rr v = -M_rf ydot, so that M_ff - M_fr M_rr^-1 M_rf is what its
// vibrations feel. It is small beside M_ff in a frame that follows a node, and C would make it
// negative at amplitudes that are far from large. With
//   M_ff(y) = M_ff + E^T C + C^T E,  E = B + 1/2 M_rr^-1 C,  B = M_rr^-1 M_rf     (y = 0: M_rr, B)
// it keeps its value at y = 0, as in mean axes (B = 0) to first order. What is added to the kinetic
// energy, ydot^T E^T C ydot, is of third and fourth order in (y, ydot), which M_ff leaves out
// otherwise. Its forces are exact,
//   Q_f = -(B + M_rr^-1 C)^T h,  h_k = ydot^T H_k ydot
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
  Mat6 inverse_ = Mat6::Zero();  ///< M_rr^-1
  Mat6X B_;
  MatX H_;       ///< 6nm x nm: row 6a+k, column b: H_k(a, b)
  Mat6X C_, E_;  ///< scratch
};

}  // namespace floatframe
