#pragma once
// Constants of materials at several temperatures.
#include <optional>
#include <string>
#include <vector>

namespace floatframe {

struct TemperatureRow {
  double temperature = 0.0;
  std::vector<double> values;  ///< as many in each row
};

struct AtTemperature {
  std::vector<double> values;
  bool chosen = false;  ///< they depend on the temperature
  std::string error;    ///< empty if the values are known
};

/// The values at a temperature: linear between the rows, those of the ends beyond them, as Abaqus,
/// CalculiX and ANSYS have it. Rows whose values are the same need no temperature. At least one
/// row; the temperatures must ascend.
AtTemperature at_temperature(const std::vector<TemperatureRow>& rows, std::optional<double> T);

}  // namespace floatframe
