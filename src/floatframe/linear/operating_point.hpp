#pragma once
// The operating point of a linearisation: the start of a run, its equilibrium, or the state that a
// run reaches after a time.
#include <string>

#include "floatframe/core/options.hpp"
#include "floatframe/linear/counted_stiffening.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// The model with options that make it start there. `at`: "start", "equilibrium", or the time [s]
/// to which a run with the options of the model is made; empty is "start". At a time, prescribed
/// motions and loads have their values at that time. Throws InputError for another text, RunError
/// if the run does not reach that time.
Model at_operating_point(const Model& model, const std::string& at);

/// For a linear analysis: includes the geometric stiffening of bodies that spin or carry load there
/// (counted_stiffening.hpp), which is then used in the run to the time as well.
CountedStiffening counted_at_operating_point(const Model& model, const std::string& at);

/// Option `--at` of the commands.
Option operating_point_option(std::string& at);

}  // namespace floatframe
