#pragma once
// The part of K and C (linearization.hpp) that comes from the efforts of elements, exact: with J_i
// the motion of marker i per increment of the coordinates, w its wrench and k, c the derivatives of
// the law (`exact_tangent`),
//   C = sum J^T c J,   K = sum J^T (k J + c V),   V = d(velocities of the markers)/dx.          (1)
// States z of elements are ns more unknowns, with the equations zdot - f(x, v, z) = 0 behind the
// others:
//   K_xz = J^T d(-w)/dz,  K_zx = -(f_r J + f_v V),  K_zz = -f_z,  C_zx = -f_v J,  C_zz = I      (2)
// So are the signals u between elements, with u - factor h(x, v, z, u) = 0, which are eliminated:
//   K -= K_u K_uu^-1 K_ux,  C -= K_u K_uu^-1 C_ux                                              (3)
// What is left of K, the change of J under constant wrenches, is a smooth function: differences
// while the efforts are held. (1) is dense: where it would take longer than the differences of
// everything, these are taken. Allocates: load time only.
#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/step.hpp"

namespace floatframe {

class ElementTangents {
 public:
  /// At t, q, v of the state, where `f` is afterwards with its efforts held until the end of this
  /// object. `reach`: sizes of the increments of the differences that follow. If an element passes
  /// an edge of its law within them, it has no one slope: nothing is held, and K and C are zero.
  /// The same for large models.
  ElementTangents(Formulation& f, const State& s, const VecX& reach);
  ~ElementTangents() { f_.hold_efforts(false); }
  ElementTangents(const ElementTangents&) = delete;
  ElementTangents& operator=(const ElementTangents&) = delete;

  MatX K, C;           ///< nv + ns; parts of dr/dx and dr/dv
  bool exact = false;  ///< the efforts are held
  /// K of the coordinates alone at the state s, with states that follow at rest, deflections their
  /// places by central differences of this step; others without an equation there are constant.
  MatX at_rest(const State& s, double step) const;

 private:
  Formulation& f_;
};

}  // namespace floatframe
