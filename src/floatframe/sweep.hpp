#pragma once
// Parameter studies: many runs of one model file in worker processes. For a study by threads use
// one Simulation for each. Of Floatframe::tools.
#include "floatframe/sweep/sweep.hpp"
