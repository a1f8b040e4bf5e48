#pragma once
// Numbers of a model that double precision cannot compute with. Their effects on matrices and
// iterations (vanishing pivots, no convergence) would suggest another cause.
#include <exception>
#include <string>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/step.hpp"
#include "floatframe/loops/run_error.hpp"

namespace floatframe {

/// Squares of larger numbers overflow.
inline constexpr double largest_magnitude = 1e100;
/// Above it, values of order 1 are lost in round-off: reported as the cause of a failed step.
inline constexpr double largest_beside_one = 1e15;

/// "the spring of 's' has a slope of 1e+308 [N/m, N m/rad]", or nothing if all numbers of the model
/// at these positions and velocities and the time t are below the limit. The text is the same in
/// all formulations. Moves `f`.
std::string overflow_text(Formulation& f, const State& state, double t, double limit);

/// The first element whose formula, or that of one of its signals, has no value now, and why;
/// those that only follow from another one are not meant. Empty: there is none.
std::string undefined_formula_text(Formulation& f);

/// "the numbers of the model overflow: ..."
std::string overflow_sentence(const std::string& text, double t, double limit);

/// The text of an exception.
std::string thrown_text(const std::exception_ptr& thrown);
/// "the law of 'contact' threw an exception at t = 0.1 s: ...", of `Formulation::thrown`.
std::string thrown_sentence(const Formulation& f, double t);
/// Throws RunError with this sentence if there is one.
void require_laws(const Formulation& f, double t);

}  // namespace floatframe
