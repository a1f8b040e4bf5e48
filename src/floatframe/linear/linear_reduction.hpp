#pragma once
// From first derivatives (small_motions.hpp) to the linear system of first order
// (linear_system.hpp), with inputs u that enter by their values, their rates u' and second
// derivatives u'': forces by u alone, the height of a road by u and u' (tyre damping), a prescribed
// motion by all three. With subscripts for derivatives, and r0, r1, r2 those of the residual,
//   Phi    = J x + Phi_u u = 0                              x  = N y + X u,      J X = -Phi_u
//   Phidot = J dv + G x + Phidot_u u + Phidot_u' u' = 0     dv = N w + P y + V0 u + V1 u'
//   Phiddot likewise                                        da = N w' + R y + T w + A0 u + A1 u' +
//                                                                A2 u''
// where X, V, A are zero in the free coordinates, and
//   N^T M N w' + N^T (M T + C N) w + N^T (M R + C P + K N) y + F0 u + F1 u' + F2 u'' = 0       (1)
//   F0 = N^T (M A0 + C V0 + K X + r0), F1 = N^T (M A1 + C V1 + r1), F2 = N^T (M A2 + r2)
// Massless directions are eliminated as in the system, together with the inputs. States of
// elements (small_motions.hpp) are free coordinates that have damping but no mass.
#include <string>
#include <vector>

#include "floatframe/linear/counted_stiffening.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/tangents/small_motions.hpp"

namespace floatframe {

/// Derivatives of residual and constraints with respect to each input (a column), its rate and its
/// second derivative, at constant x, v, a and lambda; x, v, a of all n unknowns.
struct InputMotions {
  MatX residual[3];      ///< n x nu
  MatX value, rate[3];   ///< nc x nu
  MatX acceleration[3];  ///< nc x nu
};

/// zdot = A z + B0 u + B1 u' + B2 u'', x = x_of z + x u, dv = v_of z + v0 u + v1 u',
/// da = a_of z + a0 u + a1 u' + a2 u''.
struct LinearInputs {
  MatX B[3];  ///< nz x nu
  MatX x, v[2], a[3];
};

/// "joint 'ball', coordinate 2" if several have the same owner: the words of coordinates in the
/// states of a system.
std::vector<std::string> disambiguated_names(const std::vector<std::string>& owners);

/// For coordinates with these owners. Throws RunError if a direction has neither mass nor stiffness
/// nor damping. `response` is filled if there are inputs. `slowest`: as in linear_system(), without
/// inputs.
LinearSystem reduced_system(const SmallMotions& m, const std::vector<std::string>& owners,
                            const InputMotions* inputs = nullptr, LinearInputs* response = nullptr,
                            int slowest = 0);

/// For a started formulation `f`: `linear_system` of a model for existing formulations and states.
LinearSystem linear_system_at(Formulation& f, const State& state,
                              const InputMotions* inputs = nullptr,
                              LinearInputs* response = nullptr, int slowest = 0);

/// The model with these options and the stiffening that matters there, and the messages about it in
/// its linear system.
CountedStiffening counted_at(const Model& model, const SimulationOptions& options);
void say_counted(const CountedStiffening& counted, LinearSystem& system);

}  // namespace floatframe
