#pragma once
// Figures of a suspension on the rig as text and as JSON; angles in degrees, lengths in mm (text).
#include <string>

#include "floatframe/vehicle/manoeuvre_report.hpp"
#include "floatframe/vehicle/suspension_rig.hpp"

namespace floatframe {

ManoeuvreReport rig_report(const std::string& model, const RigFigures& figures);

/// travel.csv, roll.csv, steer.csv if it steers, and summary.json, the JSON of the report, in a
/// folder, which is created if necessary. Throws InputError if another process writes to it,
/// OutputError if a file cannot be written.
void save_rig(const RigFigures& figures, const ManoeuvreReport& report, const std::string& folder);

}  // namespace floatframe
