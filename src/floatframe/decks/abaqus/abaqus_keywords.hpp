#pragma once
// Keywords of Abaqus and CalculiX that are not read. Those that are in neither list may change
// stiffness, mass or constraints. Names are in upper case without blanks.
#include <string>

namespace floatframe {

/// What to do in place of a keyword that is refused; null if it is not known.
const char* advice_for_abaqus(const std::string& name);
/// Does it change neither stiffness nor mass nor constraints of a linear part?
bool is_harmless_in_abaqus(const std::string& name);

}  // namespace floatframe
