#pragma once
// A Campbell diagram as an SVG file: frequency over speed, lines by whirl direction (colour and
// dashes), the orders of the speed, circles at critical speeds, thick lines where unstable.
#include <string>

#include "floatframe/rotors/campbell.hpp"

namespace floatframe {

std::string campbell_picture(const std::string& model, const CampbellOptions& options,
                             const CampbellDiagram& diagram);

}  // namespace floatframe
