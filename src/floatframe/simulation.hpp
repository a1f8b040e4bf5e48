#pragma once
// A model that a program steps: options, inputs, outputs, forces, saved states.
#include "floatframe/model_file/state_json.hpp"
#include "floatframe/stepping/simulation_options.hpp"
#include "floatframe/stepping/stepping.hpp"
