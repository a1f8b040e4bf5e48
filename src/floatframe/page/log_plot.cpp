#include "floatframe/page/log_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "floatframe/page/html_text.hpp"
#include "floatframe/page/plot_ticks.hpp"

namespace floatframe {
namespace {

constexpr double sheet_width = 900, sheet_left = 92, sheet_right = 24, sheet_top = 44;
constexpr double log_height = 270, degree_height = 170;  ///< of panels
constexpr double above = 46, below = 44;  ///< margins of a panel: title and legend; x axis
constexpr const char* sheet_style = R"css(
text { font: 13px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; fill: #59636e; }
.sheet { fill: #ffffff; } .name { font-size: 18px; fill: #1c2126; }
.title { font-size: 14px; fill: #1c2126; }
.grid { stroke: #e8ebef; } .fine { stroke: #f3f5f7; } .axis { fill: none; stroke: #59636e; }
.curve { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
.c0 { stroke: #0072b2; } .c1 { stroke: #d55e00; stroke-dasharray: 9 4; }
.c2 { stroke: #008a64; stroke-dasharray: 2.5 3; }
.c3 { stroke: #b4558c; stroke-dasharray: 9 3 2.5 3; }
)css";

struct Tick {
  double at;  ///< axis coordinate: the value or its logarithm
  std::string label;
  bool fine = false;
};

/// Maps axis coordinates to the picture.
struct Span {
  double low, high, from, to;
  double operator()(double v) const { return from + (v - low) / (high - low) * (to - from); }
};

std::string power_label(int exponent) {
  if (exponent >= -2 && exponent <= 3) return fmt::format("{:g}", std::pow(10.0, exponent));
  return fmt::format("10<tspan dy=\"-5\" font-size=\"10\">{}</tspan>", exponent);
}

/// Ticks from 10^low to 10^high: powers of ten, and 2 to 9 times these as fine lines, which have
/// labels (2 and 5) where there are few powers.
std::vector<Tick> logarithmic_ticks(double low, double high) {
  std::vector<Tick> ticks;
  const bool few = high - low<1.7, many = high - low> 6.0;
  for (int decade = static_cast<int>(std::floor(low)); decade <= high; ++decade)
    for (int k = 1; k <= 9; ++k) {
      const double at = decade + std::log10(k);
      if (at < low - 1e-9 || at > high + 1e-9 || (many && k > 1)) continue;
      if (k == 1)
        ticks.push_back({at, power_label(decade)});
      else
        ticks.push_back(
            {at, few && (k == 2 || k == 5) ? fmt::format("{:g}", k * std::pow(10.0, decade)) : "",
             true});
    }
  return ticks;
}

std::vector<Tick> degree_ticks(double low, double high) {
  double step = 15.0;
  for (const double s : {30.0, 45.0, 90.0, 180.0, 360.0})
    if ((high - low) / step > 6.0) step = s;
  while ((high - low) / step > 8.0) step *= 2.0;
  std::vector<Tick> ticks;
  for (double at = std::ceil(low / step) * step; at <= high + 1e-9; at += step)
    ticks.push_back({at, fmt::format("{:g}\xC2\xB0", at == 0.0 ? 0.0 : at)});
  return ticks;
}

/// Smallest and largest value of a panel on its axis.
std::pair<double, double> panel_range(const LogPanel& panel) {
  const bool log = panel.scale == LogPanel::Scale::logarithmic;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const LogCurve& c : panel.curves)
    for (const double v : c.values) {
      if (!std::isfinite(v) || (log && !(v > 0.0))) continue;
      low = std::min(low, log ? std::log10(v) : v);
      high = std::max(high, log ? std::log10(v) : v);
    }
  if (low > high) return {log ? -1.0 : 0.0, log ? 1.0 : 90.0};
  if (log) {
    low = std::max(low, high - 8.0);  // limited to eight decades
    const double more = std::max(0.05 * (high - low), 0.1);
    return {low - more, high + more};
  }
  return {std::floor((low - 1e-6) / 15.0) * 15.0 - 5.0,
          std::ceil((high + 1e-6) / 15.0) * 15.0 + 5.0};
}

using Out = std::back_insert_iterator<fmt::memory_buffer>;

std::vector<Tick> linear_ticks(double low, double high) {
  const Ticks ticks = nice_ticks(low, high, 9);
  std::vector<Tick> found;
  for (int k = 0; k < ticks.count; ++k)
    found.push_back({ticks.at(k), fmt::format("{:g}", ticks.at(k))});
  return found;
}

void draw_log_axes(Out out, const Span& x, const std::vector<Tick>& x_ticks, const Span& y,
                   const LogPanel& panel, const std::string& x_title) {
  for (const Tick& t : x_ticks) {
    fmt::format_to(out, "<path class=\"{}\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n",
                   t.fine ? "fine" : "grid", x(t.at), y.from, y.to);
    if (!t.label.empty())
      fmt::format_to(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                     x(t.at), y.from + 18, t.label);
  }
  for (const Tick& t : panel.scale == LogPanel::Scale::degrees ? degree_ticks(y.low, y.high)
                                                               : logarithmic_ticks(y.low, y.high)) {
    fmt::format_to(out, "<path class=\"{}\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n",
                   t.fine ? "fine" : "grid", x.from, y(t.at), x.to);
    if (!t.label.empty())
      fmt::format_to(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
                     x.from - 8, y(t.at) + 4, t.label);
  }
  fmt::format_to(out, "<path class=\"axis\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n", x.from, y.to,
                 y.from, x.to);
  fmt::format_to(out,
                 "<text transform=\"translate(24 {:.1f}) rotate(-90)\" "
                 "text-anchor=\"middle\">{}</text>\n",
                 0.5 * (y.from + y.to), html_escape(panel.y_title));

  fmt::format_to(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                 0.5 * (x.from + x.to), y.from + 36, html_escape(x_title));
}

void draw_log_legend(Out out, double left, double baseline, const std::vector<LogCurve>& curves) {
  for (std::size_t k = 0; k < curves.size(); ++k) {
    fmt::format_to(out,
                   "<path class=\"curve c{}\" d=\"M{:.1f} {:.1f}h32\"/><text x=\"{:.1f}\" "
                   "y=\"{:.1f}\">{}</text>\n",
                   k, left, baseline - 4, left + 38, baseline, html_escape(curves[k].name));
    left += 62 + 7.3 * static_cast<double>(curves[k].name.size());
  }
}

/// `x`: axis coordinates.
void draw_log_curves(Out out, const Span& x_axis, const Span& y_axis, const std::vector<double>& x,
                     const LogPanel& panel) {
  const bool log = panel.scale == LogPanel::Scale::logarithmic;
  for (std::size_t k = 0; k < panel.curves.size(); ++k) {
    std::string path;
    bool connected = false;
    for (std::size_t i = 0; i < x.size() && i < panel.curves[k].values.size(); ++i) {
      const double v = panel.curves[k].values[i];
      const double at = log ? std::log10(v) : v;
      if (!std::isfinite(at)) {
        connected = false;
        continue;
      }
      path += fmt::format("{}{:.1f} {:.1f}", connected ? "L" : "M", x_axis(x[i]),
                          y_axis(std::max(at, y_axis.low)));
      connected = true;
    }
    fmt::format_to(out, "<path class=\"curve c{}\" d=\"{}\"/>\n", k, path);
  }
}

}  // namespace

std::string log_plots(const std::string& title, const std::string& x_title,
                      const std::vector<double>& x, const std::vector<LogPanel>& panels,
                      PlotAxis axis) {
  double height = sheet_top + 8;
  for (const LogPanel& p : panels)
    height += above + below + (p.scale == LogPanel::Scale::degrees ? degree_height : log_height);
  fmt::memory_buffer svg;
  auto out = std::back_inserter(svg);
  fmt::format_to(out,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
                 "width=\"{0:g}\" height=\"{1:g}\" role=\"img\">\n<title>{2}</title>\n"
                 "<style>{3}</style>\n<rect class=\"sheet\" width=\"{0:g}\" height=\"{1:g}\"/>\n"
                 "<text class=\"name\" x=\"{4:g}\" y=\"30\">{2}</text>\n",
                 sheet_width, height, html_escape(title), sheet_style, sheet_left);
  const bool linear = axis == PlotAxis::linear;
  std::vector<double> places;
  for (const double v : x) places.push_back(linear ? v : std::log10(v));
  const double low = x.empty() ? 0.0 : places.front(), high = x.empty() ? 1.0 : places.back();
  const Span x_axis{low, high > low ? high : low + 1.0, sheet_left, sheet_width - sheet_right};
  double top = sheet_top;
  for (const LogPanel& p : panels) {
    const double size = p.scale == LogPanel::Scale::degrees ? degree_height : log_height;
    const auto [bottom_value, top_value] = panel_range(p);
    const Span y_axis{bottom_value, top_value, top + above + size, top + above};
    fmt::format_to(out, "<text class=\"title\" x=\"{:g}\" y=\"{:.1f}\">{}</text>\n", sheet_left,
                   top + 18, html_escape(p.title));
    draw_log_legend(out, sheet_left, top + 38, p.curves);
    draw_log_axes(
        out, x_axis,
        linear ? linear_ticks(x_axis.low, x_axis.high) : logarithmic_ticks(x_axis.low, x_axis.high),
        y_axis, p, x_title);
    draw_log_curves(out, x_axis, y_axis, places, p);
    top += above + size + below;
  }
  fmt::format_to(out, "</svg>\n");
  return fmt::to_string(svg);
}

}  // namespace floatframe
