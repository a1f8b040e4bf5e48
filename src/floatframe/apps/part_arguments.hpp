#pragma once
// Words of the command line that describe parts. The grammar of a place:
//   NAME=WAY:VALUE[,KEY=VALUE ...]     BALL=set:BALL   EYE=cylinder:0,0,0,axis=z,radius=12,at=0,0,5
// A piece between commas without '=' belongs to the value before it, so vectors need no brackets
// and nothing needs quotes in a shell. Lengths are in the units of the file.
#include <string>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

/// Each throws InputError with one sentence that names the option and what was expected.
InterfaceDescription interface_argument(const std::string& text);
MarkerDescription marker_argument(const std::string& text);
/// "young,poisson,density" in the units of the file.
Material material_argument(const std::string& text);
/// "mean_axis", "buckens" or "node:NAME"
BodyReference reference_argument(const std::string& text);

}  // namespace floatframe
