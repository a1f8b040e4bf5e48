#pragma once
// Parts from finite-element files: read, convert to SI units, reduce to a flexible body with a
// health report, keep as a body file or SID_FEM; the options of a reduction as a list; what is in a
// file.
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/unit_system.hpp"
#include "floatframe/formats/body_file/body_file.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/sid/sid_file.hpp"
#include "floatframe/parts/file_info.hpp"
#include "floatframe/parts/mesh_file.hpp"
#include "floatframe/parts/node_ways.hpp"
#include "floatframe/parts/part_job.hpp"
#include "floatframe/parts/part_options.hpp"
#include "floatframe/parts/part_text.hpp"
#include "floatframe/reduction/part.hpp"
