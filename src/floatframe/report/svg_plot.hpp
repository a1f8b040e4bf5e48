#pragma once
// Curves over time as static SVG for a web page: no scripts, colours by CSS classes
// (report_html.cpp), readable in grey and by colour-blind readers (each curve has its own dash
// pattern besides its colour).
#include <cstddef>
#include <string>
#include <vector>

#include "floatframe/report/report_curves.hpp"

namespace floatframe {

/// Columns shown in one plot: the same quantity in the same unit.
struct PlotGroup {
  std::string title;     ///< "chassis.z" or, for several curves, what they share: "wheel.z"
  std::string quantity;  ///< title of the vertical axis: "z"
  std::string unit;
  std::vector<std::size_t> columns;
};

inline constexpr std::size_t max_curves_per_plot = 4;

/// Groups columns 1.. of a table. Columns share a plot when their units and the ends of their names
/// agree: the last two words of `front_left.wheel.z`, the last one of `chassis.z`; names of one
/// word go together by unit. Order of first appearance; more than `max_curves_per_plot` columns are
/// spread evenly over several plots.
std::vector<PlotGroup> group_columns(const std::vector<Column>& columns);

/// Evenly spaced round numbers (1, 2, 5 times a power of ten) on and around [low, high].
struct Ticks {
  double first = 0, step = 1;
  int count = 0;
  double at(int i) const { return first + i * step; }
  double last() const { return at(count - 1); }
};
/// `cover`: the ticks enclose the interval, otherwise they lie inside it.
Ticks nice_ticks(double low, double high, int about, bool cover);

/// One `<svg>` element: axes with units, grid, curves with classes c0..c3.
std::string svg_plot(const ReportCurves& curves, const PlotGroup& group);

/// A short piece of line in the style of curve `index`, for a legend.
std::string svg_legend_key(std::size_t index);

}  // namespace floatframe
