#pragma once
// Units as text, "N s/m", by the base units of the SI and of FMI:
//   value in base units = factor * value + offset.
// Factors stand side by side with a space, '*' or '.', exponents behind: "m/s2", "m/s^2", "kg m2".
// A quotient ends with one factor or with brackets: "N s/(m rad)"; "J/kg K" could mean two things.
#include <array>
#include <optional>
#include <string_view>

namespace floatframe {

/// The attributes of BaseUnit, in their order.
inline constexpr std::array<const char*, 8> fmu_base_units{"kg", "m",   "s",  "A",
                                                           "K",  "mol", "cd", "rad"};

struct FmuUnit {
  std::array<int, 8> exponents{};  ///< of `fmu_base_units`
  double factor = 1.0, offset = 0.0;
};

/// Nothing if the text is no unit that is known here, or has two meanings: "g" is gram and gravity.
std::optional<FmuUnit> fmu_unit(std::string_view text);

}  // namespace floatframe
