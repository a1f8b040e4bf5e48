#pragma once
// All analyses: one call with a model, one plain struct. An analysis is the header with its result
// and its function, included here, and one entry: the name of the source file analyses/<name>.cpp,
// which ends with the function that makes a command of it, `Analysis <name>_analysis()`. The public
// header floatframe/analysis.hpp and the program iterate over this list.
#include "floatframe/advice/mode_advice.hpp"
#include "floatframe/advice/model_order.hpp"
#include "floatframe/analyses/mass_properties.hpp"
#include "floatframe/linear/frequency_response.hpp"
#include "floatframe/linear/linear_ports.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/linear/road_response.hpp"
#include "floatframe/rotors/campbell.hpp"
#include "floatframe/rotors/unbalance_response.hpp"
#include "floatframe/run/run.hpp"

// clang-format off
#define FLOATFRAME_ANALYSES(entry) \
  entry(check)                     \
  entry(statics)                   \
  entry(advise)                    \
  entry(mass_properties)           \
  entry(modes)                     \
  entry(linearize)                 \
  entry(campbell)                  \
  entry(response)
// clang-format on
