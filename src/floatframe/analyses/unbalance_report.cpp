#include "floatframe/analyses/unbalance_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/analyses/complex_curves.hpp"
#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/text_pieces.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

std::string place_of(const Unbalance& u) { return u.node.empty() ? u.body : u.body + ":" + u.node; }

ComplexParts parts_over_speed(const UnbalanceCurve& c) { return parts_of(c.amplitudes, true); }

std::string unbalances_text(const UnbalanceOptions& o) {
  std::string text;
  for (const Unbalance& u : o.unbalances)
    text += fmt::format(
        "{}{:g} kg m at '{}'{}", text.empty() ? "" : ", ", u.moment, place_of(u),
        u.angle == 0.0 ? "" : fmt::format(", {:g} degrees", u.angle * degrees_per_radian));
  return text;
}

}  // namespace

Unbalance unbalance_of(const std::string& text) {
  const std::size_t equals = text.rfind('='), at = text.rfind('@');
  const bool angled = at != std::string::npos && equals != std::string::npos && at > equals;
  if (equals != std::string::npos && equals > 0) {
    const auto moment = finite_number(
                   text.substr(equals + 1, angled ? at - equals - 1 : std::string::npos)),
               angle = angled ? finite_number(text.substr(at + 1)) : std::optional(0.0);
    const std::string place = text.substr(0, equals);
    const std::size_t colon = place.find(':');
    if (moment && angle)
      return {place.substr(0, colon), colon == std::string::npos ? "" : place.substr(colon + 1),
              *moment, *angle / degrees_per_radian};
  }
  throw InputError(ErrorCode::wrong_value,
                   fmt::format("--unbalance: found '{}', expected BODY=KG_M or BODY:NODE=KG_M, "
                               "with @DEGREES if it is at an angle, as disc=1e-4@90",
                               excerpt(text)));
}

std::string unbalance_text(const std::string& model, const UnbalanceOptions& o,
                           const UnbalanceResponse& r) {
  std::string text = r.stiffening.empty() ? "" : r.stiffening + ".\n\n";
  text += fmt::format("{}: '{}' at {:g} to {:g} rad/s, unbalance {}\n\n", model, o.joint,
                      r.speeds.front(), r.speeds.back(), unbalances_text(o));
  TextTable table({"output", "unit", "at [rad/s]", "amplitude", "phase [deg]", "mean", "largest",
                   "there [rad/s]"},
                  {1});
  for (const UnbalanceCurve& c : r.curves) {
    const auto [sizes, phases, real, imaginary] = parts_over_speed(c);
    const auto top =
        static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    for (const std::size_t k : {std::size_t{0}, sizes.size() - 1}) {
      const bool first = k == 0;
      table.add({first ? c.output.name : "", first ? c.output.unit : "",
                 fmt::format("{:g}", r.speeds[k]), fmt::format("{:.5g}", sizes[k]),
                 fmt::format("{:.1f}", phases[k]), fmt::format("{:.5g}", c.means[k]),
                 first ? fmt::format("{:.5g}", sizes[top]) : "",
                 first ? fmt::format("{:g}", r.speeds[top]) : ""});
    }
  }
  text += table.empty() ? "no outputs\n" : table.text();
  for (const std::string& note : r.notes) text += "Note: " + note + ".\n";
  return text;
}

std::string unbalance_json(const std::string& model, const UnbalanceOptions& o,
                           const UnbalanceResponse& r) {
  using Json = nlohmann::ordered_json;
  Json unbalances = Json::array(), outputs = Json::array();
  for (const Unbalance& u : o.unbalances)
    unbalances.push_back({{"body", u.body},
                          {"node", u.node},
                          {"kg_m", u.moment},
                          {"angle_deg", u.angle * degrees_per_radian}});
  for (const UnbalanceCurve& c : r.curves) {
    const ComplexParts parts = parts_over_speed(c);
    outputs.push_back({{"name", c.output.name},
                       {"unit", c.output.unit},
                       {"amplitude", parts.size},
                       {"phase_deg", parts.phase},
                       {"real", parts.real},
                       {"imaginary", parts.imaginary},
                       {"mean", c.means}});
  }
  return json_document({{"model", model},
                        {"joint", o.joint},
                        {"unbalance", unbalances},
                        {"speed_rad_s", r.speeds},
                        {"outputs", outputs},
                        {"stiffening_counted_in", r.stiffened},
                        {"notes", r.notes}});
}

std::string unbalance_csv(const UnbalanceResponse& r) {
  std::string text = "speed [rad/s]";
  for (const UnbalanceCurve& c : r.curves)
    text += "," + csv_title(c.output.name + " amplitude", c.output.unit) + "," +
            csv_title(c.output.name + " phase", "deg");
  text += "\n";
  std::vector<ComplexParts> curves;
  for (const UnbalanceCurve& c : r.curves) curves.push_back(parts_over_speed(c));
  for (std::size_t s = 0; s < r.speeds.size(); ++s) {
    text += fmt::format("{}", r.speeds[s]);
    for (const ComplexParts& c : curves)
      text += fmt::format(",{:.12g},{:.12g}", c.size[s], c.phase[s]);
    text += "\n";
  }
  return text;
}

std::string unbalance_svg(const std::string& model, const UnbalanceOptions& o,
                          const UnbalanceResponse& r) {
  const std::vector<LogPanel> panels = bode_panels(
      "Amplitude", r.curves, [](const UnbalanceCurve& c) { return c.output.unit; },
      [](const UnbalanceCurve& c) { return c.output.name; }, parts_over_speed);
  return log_plots(fmt::format("{}: unbalance {}", model, unbalances_text(o)),
                   fmt::format("speed of '{}' [rad/s]", o.joint), r.speeds, panels,
                   PlotAxis::linear);
}

}  // namespace floatframe
