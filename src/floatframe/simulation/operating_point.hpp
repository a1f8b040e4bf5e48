#pragma once
// Where a model is linearised: where a run of it starts, in its equilibrium, or where a run has
// brought it after a time.
#include <string>

#include "floatframe/core/options.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/simulation/counted_stiffening.hpp"

namespace floatframe {

/// The model with such options that it starts there. `at`: "start", "equilibrium", or a time [s]
/// that a run with the options of the model is made to; empty is "start". At a time prescribed
/// motions and loads are those of then. Throws InputError for another text, RunError if the run
/// does not come so far.
Model at_operating_point(const Model& model, const std::string& at);

/// For a linear analysis: with the geometric stiffening of bodies that spin or carry load there
/// (counted_stiffening.hpp), which a run to a time is then made with.
CountedStiffening counted_at_operating_point(const Model& model, const std::string& at);

/// `--at` of the commands.
Option operating_point_option(std::string& at);

}  // namespace floatframe
