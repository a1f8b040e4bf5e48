#include "floatframe/page/campbell_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "floatframe/page/html_text.hpp"
#include "floatframe/page/plot_ticks.hpp"

namespace floatframe {
namespace {

constexpr double picture_width = 900, picture_height = 560;
constexpr double frame_left = 84, frame_right = 190, frame_top = 44, frame_bottom = 58;

struct WhirlStyle {
  const char* kind;
  const char* css;
};
/// Colours that colour-blind readers can distinguish, and dash patterns.
constexpr std::array<WhirlStyle, 6> whirl_styles{{
    {"forward", "stroke:#0072b2"},
    {"backward", "stroke:#d55e00;stroke-dasharray:9 4"},
    {"planar", "stroke:#009e73;stroke-dasharray:9 3 2 3"},
    {"bending", "stroke:#b4558c;stroke-dasharray:12 3"},
    {"other bodies", "stroke:#b8860b;stroke-dasharray:6 2 2 2 2 2"},
    {"axial or torsion", "stroke:#6b6b6b;stroke-dasharray:2 4"},
}};

const WhirlStyle& style_of(const std::string& kind) {
  for (const WhirlStyle& s : whirl_styles)
    if (kind == s.kind) return s;
  return whirl_styles.back();
}

struct CampbellFrame {
  double speed_low, speed_high, top;
  double x(double speed) const {
    return frame_left + (speed - speed_low) / (speed_high - speed_low) *
                            (picture_width - frame_left - frame_right);
  }
  double y(double frequency) const {
    return picture_height - frame_bottom -
           frequency / top * (picture_height - frame_bottom - frame_top);
  }
};

/// The highest order or the lowest line, whichever is higher, plus a margin.
double highest_frequency(const CampbellOptions& o, const CampbellDiagram& d) {
  const double order = *std::max_element(o.orders.begin(), o.orders.end());
  const double speed = std::max(std::abs(d.speeds.front()), std::abs(d.speeds.back()));
  double lowest = 0.0;
  for (const CampbellPoint& p :
       d.lines.empty() ? std::vector<CampbellPoint>{} : d.lines.front().points)
    if (p.known()) lowest = std::max(lowest, p.frequency());
  const double top = std::max(1.15 * order * speed, 1.3 * lowest);
  return top > 0.0 ? top : 1.0;
}

using Out = std::back_insert_iterator<fmt::memory_buffer>;

void draw_axes(Out out, const CampbellFrame& f, const std::string& title) {
  const double right = picture_width - frame_right, bottom = picture_height - frame_bottom;
  fmt::format_to(out, "<text x=\"{}\" y=\"26\" font-size=\"17\">{}</text>\n", frame_left,
                 html_escape(title));
  const Ticks frequencies = nice_ticks(0.0, f.top, 6),
              speeds = nice_ticks(f.speed_low, f.speed_high, 8);
  for (int i = 0; i < frequencies.count; ++i) {
    const double y = f.y(frequencies.at(i));
    fmt::format_to(out,
                   "<path class=\"grid\" d=\"M{} {:.1f}H{}\"/><text class=\"tick\" "
                   "text-anchor=\"end\" x=\"{}\" y=\"{:.1f}\">{:g}</text>\n",
                   frame_left, y, right, frame_left - 8, y + 4.5, frequencies.at(i));
  }
  for (int i = 0; i < speeds.count; ++i) {
    const double x = f.x(speeds.at(i));
    fmt::format_to(out,
                   "<path class=\"grid\" d=\"M{:.1f} {}V{}\"/><text class=\"tick\" "
                   "text-anchor=\"middle\" x=\"{:.1f}\" y=\"{}\">{:g}</text>\n",
                   x, frame_top, bottom, x, bottom + 19, speeds.at(i));
  }
  fmt::format_to(out, "<path class=\"axis\" d=\"M{} {}V{}H{}\"/>\n", frame_left, frame_top, bottom,
                 right);
  fmt::format_to(out, "<text text-anchor=\"middle\" x=\"{}\" y=\"{}\">speed [rad/s]</text>\n",
                 0.5 * (frame_left + right), picture_height - 14);
  fmt::format_to(
      out,
      "<text text-anchor=\"middle\" transform=\"translate(22 {}) rotate(-90)\">frequency "
      "[rad/s]</text>\n",
      0.5 * (frame_top + bottom));
}

void draw_orders(Out out, const CampbellFrame& f, const std::vector<double>& orders) {
  for (const double n : orders) {
    fmt::format_to(out, "<path class=\"order\" clip-path=\"url(#inside)\" d=\"");
    // The speed may change its sign within the range.
    const double corner = std::clamp(0.0, f.speed_low, f.speed_high);
    for (const double speed : {f.speed_low, corner, f.speed_high})
      fmt::format_to(out, "{}{:.1f} {:.1f}", speed == f.speed_low ? "M" : "L", f.x(speed),
                     f.y(n * std::abs(speed)));
    const double end = std::min(n * std::abs(f.speed_high), f.top);
    const double at = n > 0.0 ? std::min(f.speed_high, end / n) : f.speed_high;
    fmt::format_to(out,
                   "\"/><text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{:g} "
                   "&#215; speed</text>\n",
                   f.x(at) - 14, f.y(end) + 4, n);
  }
}

void draw_line(Out out, const CampbellFrame& f, const CampbellDiagram& d, std::size_t index) {
  const CampbellLine& line = d.lines[index];
  fmt::format_to(out, "<path class=\"line\" clip-path=\"url(#inside)\" style=\"{}\" d=\"",
                 style_of(line.kind).css);
  bool connected = false;
  std::size_t last = 0;  // last speed at which it is known
  for (std::size_t k = 0; k < d.speeds.size(); ++k) {
    const bool known = line.points[k].known();
    if (known) {
      fmt::format_to(out, "{}{:.1f} {:.1f}", connected ? "L" : "M", f.x(d.speeds[k]),
                     f.y(line.points[k].frequency()));
      last = k;
    }
    connected = known;
  }
  fmt::format_to(out, "\"><title>mode {}, {}</title></path>\n", index + 1, line.kind);
  for (const InstabilityOnset& u : d.unstable) {
    if (u.line != static_cast<int>(index) || !(u.frequency > 0.0)) continue;
    fmt::format_to(out, "<path class=\"unstable\" clip-path=\"url(#inside)\" d=\"M{:.1f} {:.1f}",
                   f.x(u.speed), f.y(u.frequency));
    for (std::size_t k = 0; k < d.speeds.size(); ++k)
      if (d.speeds[k] > u.speed && line.points[k].lambda.real() > 0.0)
        fmt::format_to(out, "L{:.1f} {:.1f}", f.x(d.speeds[k]), f.y(line.points[k].frequency()));
    fmt::format_to(out, "\"/>\n");
  }
  const double end = line.points[last].frequency();
  if (end <= f.top && last + 1 == d.speeds.size())
    fmt::format_to(out, "<text class=\"tick\" x=\"{}\" y=\"{:.1f}\">{}</text>\n",
                   picture_width - frame_right + 6, f.y(end) + 4.5, index + 1);
  else if (end <= f.top)
    fmt::format_to(
        out,
        "<path class=\"end\" d=\"M{0:.1f} {1:.1f}v10\"/><text class=\"tick\" x=\"{2:.1f}\" "
        "y=\"{3:.1f}\">{4}</text>\n",
        f.x(d.speeds[last]), f.y(end) - 5.0, f.x(d.speeds[last]) + 5.0, f.y(end) - 5.0, index + 1);
}

void draw_speeds(Out out, const CampbellFrame& f, const std::vector<CriticalSpeed>& speeds,
                 const char* css, double radius) {
  for (const CriticalSpeed& c : speeds)
    if (c.frequency <= f.top)
      fmt::format_to(out,
                     "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\"><title>{:.5g} "
                     "rad/s</title></circle>\n",
                     css, f.x(c.speed), f.y(c.frequency), radius, c.speed);
}

void draw_legend(Out out, const CampbellDiagram& d) {
  const double x = picture_width - frame_right + 34;
  double y = frame_top + 8;
  const auto entry = [&](const std::string& mark, const std::string& text) {
    fmt::format_to(out,
                   "<g transform=\"translate({} {})\">{}<text x=\"40\" y=\"5\">{}</text></g>\n", x,
                   y, mark, text);
    y += 24;
  };
  for (const WhirlStyle& s : whirl_styles)
    if (std::any_of(d.lines.begin(), d.lines.end(),
                    [&](const CampbellLine& l) { return l.kind == s.kind; }))
      entry(fmt::format("<path class=\"line\" style=\"{}\" d=\"M0 0H32\"/>", s.css), s.kind);
  if (!d.critical.empty())
    entry("<circle class=\"critical\" cx=\"16\" cy=\"0\" r=\"5\"/>", "critical");
  if (!d.crossings.empty())
    entry("<circle class=\"crossing\" cx=\"16\" cy=\"0\" r=\"3.5\"/>", "not excited");
  if (!d.unstable.empty()) entry("<path class=\"unstable\" d=\"M0 0H32\"/>", "unstable");
}

}  // namespace

std::string campbell_picture(const std::string& model, const CampbellOptions& o,
                             const CampbellDiagram& d) {
  const CampbellFrame f{d.speeds.front(), d.speeds.back(), highest_frequency(o, d)};
  fmt::memory_buffer svg;
  Out out(svg);
  fmt::format_to(
      out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" aria-label=\"Campbell diagram\">\n"
      "<style>svg{{background:#fff;font-family:system-ui,sans-serif;font-size:14px;fill:#1a1a1a}}"
      ".grid{{stroke:#e3e3e3;fill:none}}.axis{{stroke:#666;fill:none}}"
      ".tick{{font-size:12.5px;fill:#555}}.line{{fill:none;stroke-width:2}}"
      ".order{{fill:none;stroke:#999;stroke-width:1;stroke-dasharray:5 5}}"
      ".unstable{{fill:none;stroke:#b00020;stroke-width:5;stroke-opacity:.55}}"
      ".critical{{fill:#fff;stroke:#1a1a1a;stroke-width:1.8}}"
      ".crossing{{fill:#fff;stroke:#999;stroke-width:1.2}}"
      ".end{{fill:none;stroke:#1a1a1a;stroke-width:1.8}}</style>\n"
      "<clipPath id=\"inside\"><rect x=\"{2}\" y=\"{3}\" width=\"{4}\" "
      "height=\"{5}\"/></clipPath>\n",
      picture_width, picture_height, frame_left, frame_top,
      picture_width - frame_left - frame_right, picture_height - frame_top - frame_bottom);
  draw_axes(out, f, fmt::format("{}: vibrations over the speed of '{}'", model, o.joint));
  draw_orders(out, f, o.orders);
  for (std::size_t k = 0; k < d.lines.size(); ++k) draw_line(out, f, d, k);
  draw_speeds(out, f, d.crossings, "crossing", 3.5);
  draw_speeds(out, f, d.critical, "critical", 5.0);
  draw_legend(out, d);
  fmt::format_to(out, "</svg>\n");
  return fmt::to_string(svg);
}

}  // namespace floatframe
