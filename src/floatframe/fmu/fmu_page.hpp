#pragma once
// The documentation inside an FMU: one page without scripts or links to other files, and the
// licences of what the binaries are made of.
#include <string>
#include <vector>

#include "floatframe/fmu/fmu_content.hpp"

namespace floatframe {

/// `notes`: what the export says of the model, beside those of the content; `platforms`: names of
/// the folders of binaries.
std::string fmu_page(const FmuContent& content, int version, const std::vector<std::string>& notes,
                     const std::vector<std::string>& platforms);

/// The texts of the licences.
std::string fmu_licences();

}  // namespace floatframe
