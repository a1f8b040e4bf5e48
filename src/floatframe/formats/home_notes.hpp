#pragma once
// What the frequencies of a part would be in the program that it was made for: how its elements are
// alike there, and where they differ and why.
#include <string>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// One paragraph; empty if the program is not known or has none of the elements.
std::string home_note(const FeModel& model);

}  // namespace floatframe
