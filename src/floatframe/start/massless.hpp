#pragma once
// Detection of massless coordinates, and start accelerations if there are any.
//
// With a little stiffness, T = M + s K + penalty Phi_q^T Phi_q, directions without mass that are
// held by modes or forces are regular: sparse, as in steps. T^-1 maps a massless direction to 1 /
// (s k); T^-1 M removes it from an acceleration and keeps the directions with mass, with an error
// of s k / m, which the passes correct.
#include "floatframe/tangents/mass_scale.hpp"

namespace floatframe {

/// The diagonal of the mass matrix, after `dynamics`. Throws RunError naming the entry, or the
/// force there, that is too large to compute with.
VecX mass_diagonal(Formulation& f, const State& state);

/// Upper bound of the growth of a solution with T = M + s K + penalty Phi_q^T Phi_q, relative to
/// masses of `scale`: the inverse of the smallest mass of a direction that constraints leave free,
/// as a fraction of its scale (inverse iteration from a vector that is in general orthogonal to no
/// direction). Infinite if a pivot vanishes.
double growth_of_motions(Formulation& f, const VecX& scale, double s, double penalty_mass);

/// The same without stiffness, at the diagonal of the mass matrix and `possible_masses`.
double growth_by_mass(Formulation& f, const VecX& diagonal, const VecX& possible,
                      double penalty_mass);

/// True if some direction that the constraints leave free may have no mass. A massless coordinate
/// alone is not sufficient: most of natural coordinates are held by constraints. Conservative:
/// false positives cost a dense solve, false negatives a wrong start.
bool may_lack_mass(Formulation& f, const VecX& diagonal, const VecX& possible, double penalty_mass);

/// The same for a given growth.
bool may_lack_mass(double growth);
/// The mass consists of rounding only: long chains fold with 1e-10 of their mass.
bool lacks_mass(double growth);

/// Start accelerations and multipliers of a system with massless directions: zero along these, by
/// passes with T. Returns false, with an unusable state, if stiffness does not hold all of them or
/// a force moves them beyond the available digits, unless the mass is small but above rounding. `f`
/// is at the state.
bool start_held_by_stiffness(Formulation& f, State& state, const VecX& scale, double penalty_mass);

/// Spectral radius to use instead of the trapezoidal rule, for which rate errors of massless
/// motions alternate in sign at each step.
inline constexpr double massless_spectral_radius = 0.7;

/// Sentences about flexible bodies with a massless motion that is held by stiffness, at the state
/// of `f`. None if a pivot vanishes, or if such a body has no mass at all: its motion is determined
/// by dampers. Rigid bodies without inertia are guided by their joints.
std::vector<std::string> massless_notes(Formulation& f, const State& state, double penalty_mass);

/// The value of s for a T without stiffness.
inline constexpr double no_stiffness = 1e-30;

/// Passes that solve M a + Phi_q^T lambda = Q, Phi_q a = gamma with T, in slot 0. False if T has a
/// vanishing pivot; true if the constraints are satisfied and all values are finite, and with
/// `must_settle` only if the passes converge.
bool start_by_passes(Formulation& f, State& state, double s, double penalty_mass, bool lacks_mass,
                     bool must_settle);

/// Number of coordinates up to which dense linear algebra takes milliseconds.
inline constexpr Eigen::Index few_dense = 150;
/// Number of coordinates above which dense linear algebra takes minutes.
inline constexpr Eigen::Index most_dense = 1000;

}  // namespace floatframe
