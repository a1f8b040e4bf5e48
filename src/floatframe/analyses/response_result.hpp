#pragma once
// What the command `response` found, and how it is written: tables, JSON, CSV, plots.
#include <complex>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/report/plot_ticks.hpp"
#include "floatframe/simulation/road_response.hpp"

namespace floatframe {

/// From one input to one output, at all frequencies.
struct ResponseCurve {
  Column output, input;
  std::vector<std::complex<double>> values;
  std::string unit() const;  ///< "m/s2 per m"
  std::vector<double> magnitudes() const;
  std::vector<double> phases() const;  ///< without jumps [deg]
};

/// Outputs in steady motion where an input moves by amplitude cos(2 pi f t).
struct HarmonicResponse {
  std::string input, unit;
  double amplitude = 0.0, frequency = 0.0;
  std::vector<Column> outputs;
  std::vector<double> means;
  std::vector<std::complex<double>> values;
};

struct ResponseResult {
  std::string model;
  double time = 0.0;
  std::vector<double> frequencies;
  std::vector<ResponseCurve> curves;
  std::vector<HarmonicResponse> harmonics;
  RoadLoading loading;
  std::optional<RoadResponse> road;
  std::vector<std::string> notes;
  std::vector<std::string> stiffened;  ///< as in LinearSystem
  std::string stiffening;
};

/// Curves of one unit share panels, a few of them each.
template <class Curve, class Unit>
std::vector<std::vector<const Curve*>> panels_of(const std::vector<Curve>& curves,
                                                 const Unit& unit) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const Curve*>> groups;
  for (const Curve& c : curves) {
    if (groups[unit(c)].empty()) order.push_back(unit(c));
    groups[unit(c)].push_back(&c);
  }
  std::vector<std::vector<const Curve*>> panels;
  for (const std::string& u : order)
    for (std::size_t k = 0; k < groups[u].size(); ++k) {
      if (k % max_curves_per_plot == 0) panels.emplace_back();
      panels.back().push_back(groups[u][k]);
    }
  return panels;
}

std::string response_text(const ResponseResult& r);
std::string response_json(const ResponseResult& r);
std::string response_csv(const ResponseResult& r);
std::string response_svg(const ResponseResult& r);

}  // namespace floatframe
