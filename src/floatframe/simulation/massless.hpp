#pragma once
// Which freedom has no mass, and start accelerations where some have none.
//
// With a little stiffness, T = M + s K + penalty Phi_q^T Phi_q, what has no mass but is held by
// modes or forces is regular: sparse, as in steps. What T^-1 makes of a direction without mass is
// 1 / (s k); T^-1 M takes that out of an acceleration again and leaves those with mass, but for
// s k / m, which the passes correct.
#include "floatframe/simulation/mass_scale.hpp"

namespace floatframe {

/// The diagonal of the mass matrix, after `dynamics`. Throws RunError naming what is too large to
/// compute with, of it or of the forces there.
template <class F>
VecX mass_diagonal(F& f, const State& state);

/// How much a solution with T = M + s K + penalty Phi_q^T Phi_q grows at most, against masses of
/// `scale`: the inverse of the smallest mass of a direction that constraints leave free, as a part
/// of its scale (inverse iteration from a vector that no direction is orthogonal to but by chance).
/// Infinite where a pivot vanishes.
template <class F>
double growth_of_motions(F& f, const VecX& scale, double s, double penalty_mass);

/// The same without stiffness, at the diagonal of the mass matrix and `possible_masses`.
template <class F>
double growth_by_mass(F& f, const VecX& diagonal, const VecX& possible, double penalty_mass);

/// True if some direction that the constraints leave free may have no mass. A coordinate without
/// mass alone says nothing: most of natural coordinates are held by constraints. Says yes too often
/// rather than too seldom.
template <class F>
bool may_lack_mass(F& f, const VecX& diagonal, const VecX& possible, double penalty_mass);

/// The same of a growth.
bool may_lack_mass(double growth);
/// Nothing but rounding is left of the mass: long chains fold up with a 1e-10 of theirs.
bool lacks_mass(double growth);

/// Start accelerations and multipliers of a system that lacks mass somewhere: none along directions
/// without mass, by passes with T. False, with nothing of use in the state, if stiffness does not
/// hold them all or a force moves them beyond what digits are left for, unless it is mass after
/// all, little but more than rounding. `f` is at the state.
template <class F>
bool start_held_by_stiffness(F& f, State& state, const VecX& scale, double penalty_mass);

/// Spectral radius in place of the trapezoidal rule, which turns an error of the rate of motions
/// without mass over in each step.
inline constexpr double massless_spectral_radius = 0.7;

/// Sentences on flexible bodies with a motion that has no mass and that stiffness holds, at the
/// state where `f` is. None if a pivot vanishes, or if a body without any mass has one: where these
/// go is decided by dampers. Rigid bodies without inertia are led by their joints.
template <class F>
std::vector<std::string> massless_notes(F& f, const State& state, double penalty_mass);

/// s of a T without stiffness.
inline constexpr double no_stiffness = 1e-30;

/// Passes that solve M a + Phi_q^T lambda = Q, Phi_q a = gamma with T, in slot 0. False if T has a
/// vanishing pivot; true if the constraints hold and nothing is beyond measure, and with
/// `must_settle` only if the passes settle.
template <class F>
bool start_by_passes(F& f, State& state, double s, double penalty_mass, bool lacks_mass,
                     bool must_settle);

/// Coordinates up to which dense linear algebra takes milliseconds.
inline constexpr Eigen::Index few_dense = 150;
/// Coordinates beyond which dense linear algebra takes minutes.
inline constexpr Eigen::Index most_dense = 1000;

}  // namespace floatframe
