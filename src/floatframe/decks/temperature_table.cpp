#include "floatframe/decks/temperature_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace floatframe {

AtTemperature at_temperature(const std::vector<TemperatureRow>& rows, std::optional<double> T) {
  const auto same = [&](const TemperatureRow& r) { return r.values == rows.front().values; };
  if (std::all_of(rows.begin(), rows.end(), same)) return {rows.front().values, false, {}};
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (!(rows[k].temperature > rows[k - 1].temperature))
      return {{},
              true,
              fmt::format("has the temperature {:g} after {:g}, expected ascending ones",
                          rows[k].temperature, rows[k - 1].temperature)};
  if (!T)
    return {{},
            true,
            fmt::format("depends on the temperature ({:g} to {:g}): say at which one with "
                        "--temperature (key `temperature`)",
                        rows.front().temperature, rows.back().temperature)};
  const auto above = std::find_if(rows.begin(), rows.end(),
                                  [&](const TemperatureRow& r) { return r.temperature >= *T; });
  if (above == rows.begin()) return {rows.front().values, true, {}};
  if (above == rows.end()) return {rows.back().values, true, {}};
  const TemperatureRow &a = *std::prev(above), &b = *above;
  const double share = (*T - a.temperature) / (b.temperature - a.temperature);
  AtTemperature result{a.values, true, {}};
  for (std::size_t k = 0; k < result.values.size(); ++k)
    result.values[k] += share * (b.values[k] - a.values[k]);
  return result;
}

}  // namespace floatframe
