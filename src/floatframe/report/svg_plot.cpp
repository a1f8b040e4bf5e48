#include "floatframe/report/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "floatframe/report/html_text.hpp"

namespace floatframe {
namespace {

// In SVG units; the page scales the picture to its width.
constexpr double width = 880, height = 340;
constexpr double left = 78, right = 18, top = 12, bottom = 50;

/// Maps values to the picture.
struct Axis {
  double low = 0, high = 1;  ///< values at the two ends
  double from = 0, to = 1;   ///< picture coordinates of the two ends
  double operator()(double value) const {
    return from + (value - low) / (high - low) * (to - from);
  }
};

/// Smallest and largest finite value of the columns; {0, 1} if there is none.
std::pair<double, double> range_of(const ReportCurves& curves,
                                   const std::vector<std::size_t>& columns) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t c : columns) {
    low = std::min(low, curves.extremes[c].low);
    high = std::max(high, curves.extremes[c].high);
  }
  if (low > high) return {0.0, 1.0};
  return {low, high};
}

/// Range of the vertical axis: rounding noise is not blown up to the full height; zero is shown
/// when it is near.
std::pair<double, double> vertical_range(double low, double high) {
  // Their difference must remain a number.
  constexpr double largest = 1e300;
  low = std::clamp(low, -largest, largest);
  high = std::clamp(high, -largest, largest);
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= 1e-7 * size || high - low < 1e-280) {
    const double half = size > 1e-280 ? 0.1 * size : 1.0;
    const double middle = 0.5 * (low + high);
    return {middle - half, middle + half};
  }
  if (low > 0.0 && low < 0.5 * high) low = 0.0;
  if (high < 0.0 && high > 0.5 * low) high = 0.0;
  return {low, high};
}

/// Power of ten (a multiple of three) taken out of the tick labels when they would be long.
int label_exponent(const Ticks& ticks) {
  const double size = std::max(std::abs(ticks.first), std::abs(ticks.last()));
  if (!(size > 0.0) || (size < 1e5 && ticks.step >= 0.99e-3)) return 0;
  return static_cast<int>(3.0 * std::floor(std::log10(size) / 3.0 + 1e-9));
}

std::string tick_label(const Ticks& ticks, int i, int exponent) {
  const double scale = std::pow(10.0, -exponent);
  const double step = ticks.step * scale;
  double value = ticks.at(i) * scale;
  if (std::abs(value) < 1e-6 * step) value = 0.0;  // never "-0"
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-') text.replace(0, 1, "\xE2\x88\x92");  // a minus sign, not a hyphen
  return text;
}

std::string axis_title(const std::string& quantity, const std::string& unit, int exponent) {
  const std::string power =
      exponent == 0
          ? ""
          : fmt::format("10<tspan dy=\"-5\" font-size=\"10\">{}</tspan><tspan dy=\"5\"> </tspan>",
                        exponent);
  const std::string scaled = power + html_escape(unit);
  return html_escape(quantity) + (scaled.empty() ? "" : " [" + scaled + "]");
}

std::string curve_path(const std::vector<CurvePoint>& points, const Axis& x, const Axis& y) {
  fmt::memory_buffer path;
  bool pen_down = false;
  for (const CurvePoint& p : points) {
    if (!std::isfinite(p.time) || !std::isfinite(p.value)) {
      pen_down = false;
      continue;
    }
    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", pen_down ? "L" : "M", x(p.time),
                   y(p.value));
    pen_down = true;
  }
  return fmt::to_string(path);
}

}  // namespace

std::string svg_plot(const ReportCurves& curves, const PlotGroup& group) {
  const auto [time_low, time_high] = range_of(curves, {0});
  const auto values = range_of(curves, group.columns);
  const auto [low, high] = vertical_range(values.first, values.second);
  const Ticks y_ticks = nice_ticks(low, high, 5, true);
  const double time_end = time_high > time_low ? time_high : time_low + 1.0;
  const Ticks x_ticks = nice_ticks(time_low, time_end, 8, false);
  const Axis x{time_low, time_end, left, width - right};
  const Axis y{y_ticks.first, y_ticks.last(), height - bottom, top};

  fmt::memory_buffer svg;
  auto out = std::back_inserter(svg);
  fmt::format_to(out, "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{} over time\">\n",
                 width, height, html_escape(group.title));
  const int y_exponent = label_exponent(y_ticks), x_exponent = label_exponent(x_ticks);
  for (int i = 0; i < y_ticks.count; ++i) {
    const double at = y(y_ticks.at(i));
    fmt::format_to(out,
                   "<line class=\"grid\" x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\"/>"
                   "<text class=\"tick\" text-anchor=\"end\" x=\"{}\" y=\"{:.1f}\">{}</text>\n",
                   left, at, width - right, at, left - 9, at + 4.5,
                   tick_label(y_ticks, i, y_exponent));
  }
  for (int i = 0; i < x_ticks.count; ++i) {
    const double at = x(x_ticks.at(i));
    fmt::format_to(out,
                   "<line class=\"grid\" x1=\"{:.1f}\" y1=\"{}\" x2=\"{:.1f}\" y2=\"{}\"/>"
                   "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{}\">{}</text>\n",
                   at, top, at, height - bottom, at, height - bottom + 20,
                   tick_label(x_ticks, i, x_exponent));
  }
  fmt::format_to(out, "<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>\n", left, top, height - bottom,
                 width - right);
  const Column& time = curves.columns.front();
  fmt::format_to(out, "<text class=\"title\" text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text>\n",
                 0.5 * (left + width - right), height - 8,
                 axis_title(time.name, time.unit, x_exponent));
  const double middle = 0.5 * (top + height - bottom);
  fmt::format_to(
      out,
      "<text class=\"title\" text-anchor=\"middle\" transform=\"translate(18 {0}) rotate(-90)\">{1}"
      "</text>\n",
      middle, axis_title(group.quantity, group.unit, y_exponent));
  for (std::size_t i = 0; i < group.columns.size(); ++i) {
    fmt::format_to(out, "<path class=\"curve c{}\" d=\"{}\"/>\n", i % max_curves_per_plot,
                   curve_path(curves.points[group.columns[i]], x, y));
  }
  fmt::format_to(out, "</svg>\n");
  return fmt::to_string(svg);
}

std::string svg_legend_key(std::size_t index) {
  return fmt::format(
      "<svg class=\"key\" viewBox=\"0 0 34 10\" aria-hidden=\"true\"><path class=\"curve c{}\" "
      "d=\"M0 5H34\"/></svg>",
      index % max_curves_per_plot);
}

}  // namespace floatframe
