#pragma once
// Complex amplitudes over a frequency or a speed: components, and panels with magnitude and phase.
#include <complex>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/page/log_plot.hpp"
#include "floatframe/page/plot_ticks.hpp"

namespace floatframe {

/// [deg]
double phase_of(std::complex<double> value);

/// Complex values over a frequency or a speed, as written to files.
struct ComplexParts {
  std::vector<double> size, phase, real, imaginary;  ///< phase: without jumps [deg]
};
/// The phase of leading zeros (`at_rest`) is undefined: that of the first nonzero value is used.
ComplexParts parts_of(const std::vector<std::complex<double>>& values, bool at_rest = false);

/// Curves of one unit share panels, a few curves per panel.
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

/// For each such group, a panel of magnitudes and one of phases. `name`, `parts`: of a curve.
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

}  // namespace floatframe
