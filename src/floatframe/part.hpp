#pragma once
// Parts from finite-element files: read, convert to SI units, reduce to a flexible body with a
// health report, keep as a body file.
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/unit_system.hpp"
#include "floatframe/formats/body_file/body_file.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/parts/part_job.hpp"
#include "floatframe/reduction/part.hpp"
