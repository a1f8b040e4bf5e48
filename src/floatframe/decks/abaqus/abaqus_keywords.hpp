#pragma once
// Keywords of Abaqus and CalculiX that are not read: those that are known to be harmless, and those
// for which there is advice. All others may change stiffness, mass or constraints.
#include <string>

namespace floatframe {

struct AbaqusKeywordRule {
  enum class Use {
    unknown,   ///< stops the reading
    refused,   ///< the same, with advice
    harmless,  ///< changes neither stiffness nor mass nor constraints of a linear part
  };
  Use use = Use::unknown;
  const char* advice = nullptr;  ///< of refused keywords: what to do instead
};

/// `name` is upper case without blanks.
AbaqusKeywordRule abaqus_keyword_rule(const std::string& name);

/// Does a keyword of a step say that the part is another one from there on? Loads, procedures and
/// output requests do not.
bool changes_part_in_step(const std::string& name);

}  // namespace floatframe
