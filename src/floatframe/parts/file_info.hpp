#pragma once
// What is in a file of finite elements, in a body file or in a SID_FEM file, whichever it is.
#include <array>
#include <string>
#include <vector>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

/// Of `job` the file, and how it is to be read if it is one of finite elements. Each function: text
/// for people, or JSON. Throws InputError.
std::string file_info_text(const PartJob& job);
std::string file_info_json(const PartJob& job);

/// Of a body file, and of a SID_FEM file. SI units.
std::string body_info_text(const std::string& file, const BodyFile& content);
std::string body_info_json(const std::string& file, const BodyFile& content);
std::string sid_info_text(const std::string& file, const FlexibleBody& body,
                          const std::vector<std::string>& notes);
std::string sid_info_json(const std::string& file, const FlexibleBody& body,
                          const std::vector<std::string>& notes);

/// A vector as JSON has it: three numbers.
inline std::array<double, 3> json_vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// For a message that units are missing: " (the material looks like mm-t-s)"; empty if the material
/// says nothing.
std::string hint_of_units(const PartJob& job);

}  // namespace floatframe
