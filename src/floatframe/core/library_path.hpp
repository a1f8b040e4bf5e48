#pragma once
// Where this program's code was loaded from: modules are in the same folder.
#include <string>

namespace floatframe {

/// File of the loaded library (or of the program, if it is linked into one).
std::string library_path();

/// The module of that name next to the library (the copy for newer processors is two folders
/// deeper); empty if there is none.
std::string module_path(const std::string& name);

}  // namespace floatframe
