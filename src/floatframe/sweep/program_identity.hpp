#pragma once
// Which build of the program this is: results of two builds may differ in rounding.
#include <string>

namespace floatframe {

/// File of the loaded library (or of the program, if it is linked into one).
std::string library_path();

/// Version, build and the fingerprint of the library's file.
std::string program_identity();

}  // namespace floatframe
