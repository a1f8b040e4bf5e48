#pragma once
// Curves over a logarithmic axis, usually frequency, or a linear one, as one SVG file: panels below
// each other, each with its title, legend and axes with units. Colours and dashes are those of the
// report.
#include <string>
#include <vector>

namespace floatframe {

struct LogCurve {
  std::string name;
  std::vector<double> values;  ///< one per x; values that are not finite are omitted
};

struct LogPanel {
  enum class Scale { logarithmic, degrees };
  std::string title;    ///< "chassis.az / road"
  std::string y_title;  ///< with its unit: "magnitude [m/s2 / m]"
  Scale scale = Scale::logarithmic;
  std::vector<LogCurve> curves;  ///< at most `max_curves_per_plot`
};

enum class PlotAxis { logarithmic, linear };

/// A standalone document. x: ascending, positive on a logarithmic axis.
std::string log_plots(const std::string& title, const std::string& x_title,
                      const std::vector<double>& x, const std::vector<LogPanel>& panels,
                      PlotAxis axis = PlotAxis::logarithmic);

}  // namespace floatframe
