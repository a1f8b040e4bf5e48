#pragma once
// What is in a file of finite elements, in a body file or in a SID_FEM file, whichever it is.
#include <string>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

/// Of `job` the file, and how it is to be read if it is one of finite elements. Each function: text
/// for people, or JSON. Throws InputError.
std::string file_info_text(const PartJob& job);
std::string file_info_json(const PartJob& job);

/// For a message that units are missing: " (the material looks like mm-t-s)"; empty if the material
/// says nothing.
std::string hint_of_units(const PartJob& job);

}  // namespace floatframe
