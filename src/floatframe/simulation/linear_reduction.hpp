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
// Directions without mass follow as those of the system do, the inputs with them.
#include <string>
#include <vector>

#include "floatframe/simulation/counted_stiffening.hpp"
#include "floatframe/simulation/linear_system.hpp"
#include "floatframe/simulation/small_motions.hpp"

namespace floatframe {

/// What a unit of each input (a column), of its rate and of its second derivative does to residual
/// and constraints where x, v, a and lambda are held.
struct InputMotions {
  MatX residual[3];      ///< nv x nu
  MatX value, rate[3];   ///< nc x nu
  MatX acceleration[3];  ///< nc x nu
};

/// zdot = A z + B0 u + B1 u' + B2 u'', x = x_of z + x u, dv = v_of z + v0 u + v1 u',
/// da = a_of z + a0 u + a1 u' + a2 u''.
struct LinearInputs {
  MatX B[3];  ///< nz x nu
  MatX x, v[2], a[3];
};

/// For coordinates with these owners. Throws RunError where a direction has neither mass nor
/// stiffness nor damping. `response` is filled if there are inputs. `slowest`: as linear_system(),
/// without inputs.
LinearSystem reduced_system(const SmallMotions& m, const std::vector<std::string>& owners,
                            const InputMotions* inputs = nullptr, LinearInputs* response = nullptr,
                            int slowest = 0);

/// Where `f` is started; `linear_system` of a model for formulations and states at hand.
template <class F>
LinearSystem linear_system_at(F& f, const State& state, const InputMotions* inputs = nullptr,
                              LinearInputs* response = nullptr, int slowest = 0);

/// The model with these options and the stiffening that counts there, and what is said of it in its
/// linear system.
CountedStiffening counted_at(const Model& model, const SimulationOptions& options);
void say_counted(const CountedStiffening& counted, LinearSystem& system);

}  // namespace floatframe
