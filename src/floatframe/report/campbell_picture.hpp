#pragma once
// A Campbell diagram as an SVG file: frequency over speed, lines by the way they whirl (colour and
// dashes), the orders of the speed, circles at critical speeds, thick where unstable.
#include <string>

#include "floatframe/simulation/campbell.hpp"

namespace floatframe {

std::string campbell_picture(const std::string& model, const CampbellOptions& options,
                             const CampbellDiagram& diagram);

}  // namespace floatframe
