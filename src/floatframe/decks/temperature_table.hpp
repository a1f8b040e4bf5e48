#pragma once
// Constants of materials at several temperatures.
#include <optional>
#include <string>
#include <vector>

namespace floatframe {

struct TemperatureRow {
  double temperature = 0.0;
  std::vector<double> values;  ///< equally many in each row
};

struct AtTemperature {
  std::vector<double> values;
  bool chosen = false;  ///< they depend on the temperature
  std::string error;    ///< empty if the values are valid
};

/// The values at a temperature: linear between the rows, constant beyond the ends, as in Abaqus,
/// CalculiX and ANSYS. Rows with equal values need no temperature. At least one
/// row; the temperatures must ascend.
AtTemperature at_temperature(const std::vector<TemperatureRow>& rows, std::optional<double> T);

}  // namespace floatframe
