#pragma once
// What the command `response` found, and how it is written: tables, JSON, CSV, plots.
#include <complex>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/report/log_plot.hpp"
#include "floatframe/report/plot_ticks.hpp"
#include "floatframe/simulation/road_response.hpp"

namespace floatframe {

/// Complex values over a frequency or a speed, as they are written.
struct ComplexParts {
  std::vector<double> size, phase, real, imaginary;  ///< phase: without jumps [deg]
};
/// Where they begin at rest there is no phase: it is that of the first that moves.
ComplexParts parts_of(const std::vector<std::complex<double>>& values, bool at_rest = false);

/// From one input to one output, at all frequencies.
struct ResponseCurve {
  Column output, input;
  std::vector<std::complex<double>> values;
  std::string unit() const;  ///< "m/s2 per m"
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

/// Of each such group a panel with sizes and one with phases. `name` and `parts` of a curve.
template <class Curve, class Unit, class Name, class Parts>
std::vector<LogPanel> bode_panels(const char* title, const std::vector<Curve>& curves,
                                  const Unit& unit, const Name& name, const Parts& parts) {
  std::vector<LogPanel> panels;
  for (const auto& group : panels_of(curves, unit)) {
    LogPanel size{title, "[" + unit(*group[0]) + "]", LogPanel::Scale::logarithmic, {}},
        phase{"Phase", "", LogPanel::Scale::degrees, {}};
    for (const Curve* c : group) {
      size.curves.push_back({name(*c), parts(*c).size});
      phase.curves.push_back({name(*c), parts(*c).phase});
    }
    panels.push_back(std::move(size));
    panels.push_back(std::move(phase));
  }
  return panels;
}

std::string response_text(const ResponseResult& r);
std::string response_json(const ResponseResult& r);
std::string response_csv(const ResponseResult& r);
std::string response_svg(const ResponseResult& r);

}  // namespace floatframe
