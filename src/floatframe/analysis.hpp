#pragma once
// One call, one result: a run, its verification, the static equilibrium, counts of coordinates and
// constraints, a linear system near a state, advice on modes. Each takes a model, most of them
// options, and returns a plain struct. Of Floatframe::tools: advise, model_order, mass_properties.
#include "floatframe/analyses/analysis_list.hpp"
#include "floatframe/linear/linearize.hpp"
#include "floatframe/run/results.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/run/verification.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/statics.hpp"
