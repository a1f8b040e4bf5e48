#pragma once
// A model in one file, with parameters that take new values without a build, and as an FMU for
// co-simulation in other programs. Of Floatframe::tools.
#include "floatframe/fmu/fmu_file.hpp"
#include "floatframe/model_file/keep_outputs.hpp"
#include "floatframe/model_file/pack_model.hpp"
