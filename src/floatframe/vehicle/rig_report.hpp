#pragma once
// Figures of a suspension on the rig as text and as JSON; angles in degrees, lengths in mm (text).
#include <string>

#include "floatframe/vehicle/manoeuvre_report.hpp"
#include "floatframe/vehicle/suspension_rig.hpp"

namespace floatframe {

ManoeuvreReport rig_report(const std::string& model, const RigFigures& figures);

}  // namespace floatframe
