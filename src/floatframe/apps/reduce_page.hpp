#pragma once
// The page of a reduced part for the viewer (viewer/README.md): its modes, interfaces with the
// points of the surface that follow them rigidly, and the health report.
#include <string>

#include "floatframe/formats/body_file/body_file.hpp"

namespace floatframe {

/// A report file with this name is a page; otherwise it is JSON.
bool is_page_name(const std::string& file);

/// Requires a program built with the viewer.
std::string part_page(const BodyFile& content);

}  // namespace floatframe
