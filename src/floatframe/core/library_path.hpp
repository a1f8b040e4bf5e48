#pragma once
// Where this program's code was loaded from: modules lie beside it.
#include <string>

namespace floatframe {

/// File of the loaded library (or of the program, if it is linked into one).
std::string library_path();

}  // namespace floatframe
