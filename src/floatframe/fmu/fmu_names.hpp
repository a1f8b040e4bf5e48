#pragma once
// Names in an FMU, by the grammar of variableNamingConvention="structured" (FMI 2.0.4, section
// 2.2.9; FMI 3.0.1, section 2.4.7.5.1): identifiers with points between them, each a word or a text
// in quotes, 'wheel z-1'. Characters that the grammar does not know become {U+00E4}.
#include <set>
#include <string>
#include <string_view>

namespace floatframe {

/// "front.wheel z" becomes "front.'wheel z'". The result is never empty and is ASCII.
std::string fmu_name(std::string_view name);

/// True if `fmu_name` has replaced characters, so that people no longer read the same name.
bool fmu_name_is_changed(std::string_view name);

/// The name as an identifier of C, of at most 60 characters.
std::string fmu_identifier(std::string_view name);

/// Gives each variable of an FMU a name of its own.
class FmuNames {
 public:
  /// The name, or "group.name", "group_2.name", ... if it is taken.
  std::string take(std::string_view name, const std::string& group);

 private:
  std::set<std::string> taken_;
};

}  // namespace floatframe
