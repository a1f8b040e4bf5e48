#pragma once
// Summary of a body file or a SID_FEM file, for people and as JSON. SI units.
#include <string>
#include <vector>

#include "floatframe/formats/body_file/body_file.hpp"

namespace floatframe {

std::string body_info_text(const std::string& file, const BodyFile& content);
std::string body_info_json(const std::string& file, const BodyFile& content);

std::string sid_info_text(const std::string& file, const FlexibleBody& body,
                          const std::vector<std::string>& notes);
std::string sid_info_json(const std::string& file, const FlexibleBody& body,
                          const std::vector<std::string>& notes);

}  // namespace floatframe
