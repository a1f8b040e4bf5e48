#pragma once
// The picture of an FMU: a beam that bends in the frame that moves with it, drawn by this code.
#include <string>

namespace floatframe {

/// A PNG file of 128 x 128 pixels.
std::string fmu_icon();

}  // namespace floatframe
