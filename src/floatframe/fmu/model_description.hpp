#pragma once
// The XML files of an FMU for co-simulation: modelDescription.xml of FMI 2.0 and of FMI 3.0, and
// terminalsAndIcons.xml of FMI 3.0. Equal content gives equal bytes: no date is written.
//
// Outputs are those of the last instant: an input acts from the next step on, so that no output
// depends on one directly (ModelStructure); only those of the start do.
#include <string>
#include <string_view>

#include "floatframe/fmu/fmu_content.hpp"

namespace floatframe {

std::string fmi2_model_description(const FmuContent& content);
std::string fmi3_model_description(const FmuContent& content);

/// A terminal for all inputs and one for all outputs, as buses of signals, and the icon.
std::string fmi3_terminals(const FmuContent& content);

/// Text inside XML: marks, control characters and line breaks are replaced.
std::string xml_text(std::string_view text);

}  // namespace floatframe
