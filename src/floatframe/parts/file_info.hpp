#pragma once
// Summary of a finite-element file, a body file or a SID_FEM file, whichever it is.
#include <string>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

/// Uses the file of `job`, and its reading options for a finite-element file. Each function: text
/// for people, or JSON. Throws InputError.
std::string file_info_text(const PartJob& job);
std::string file_info_json(const PartJob& job);

/// For a message that units are missing: " (the material looks like mm-t-s)"; empty if the material
/// gives no hint.
std::string hint_of_units(const PartJob& job);

}  // namespace floatframe
