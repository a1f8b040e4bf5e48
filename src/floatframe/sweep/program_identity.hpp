#pragma once
// Which build of the program this is: results of two builds may differ in rounding.
#include <string>

namespace floatframe {

/// Version, build and the fingerprint of the library's file.
std::string program_identity();

}  // namespace floatframe
