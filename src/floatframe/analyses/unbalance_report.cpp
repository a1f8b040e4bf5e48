#include "floatframe/analyses/unbalance_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/analyses/response_result.hpp"
#include "floatframe/analyses/rotor_options.hpp"
#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/report/json_values.hpp"
#include "floatframe/report/log_plot.hpp"

namespace floatframe {
namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

std::string place_of(const Unbalance& u) { return u.node.empty() ? u.body : u.body + ":" + u.node; }

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
    const auto moment =
                   number_of(text.substr(equals + 1, angled ? at - equals - 1 : std::string::npos)),
               angle = angled ? number_of(text.substr(at + 1)) : std::optional(0.0);
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

std::vector<double> amplitudes_of(const UnbalanceCurve& curve) {
  std::vector<double> all;
  for (const std::complex<double>& y : curve.amplitudes) all.push_back(std::abs(y));
  return all;
}

std::vector<double> phases_of(const UnbalanceCurve& curve) {
  std::vector<double> all;
  bool begun = false;  // at standstill there is none
  for (const std::complex<double>& y : curve.amplitudes) {
    const double phase = degrees_per_radian * std::arg(y);
    all.push_back(begun ? all.back() + std::remainder(phase - all.back(), 360.0) : phase);
    if (!begun && std::abs(y) > 0.0) std::fill(all.begin(), all.end(), phase);
    begun = begun || std::abs(y) > 0.0;
  }
  return all;
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
    const std::vector<double> sizes = amplitudes_of(c), phases = phases_of(c);
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
    std::vector<double> real, imaginary;
    for (const std::complex<double>& y : c.amplitudes)
      real.push_back(y.real()), imaginary.push_back(y.imag());
    outputs.push_back({{"name", c.output.name},
                       {"unit", c.output.unit},
                       {"amplitude", amplitudes_of(c)},
                       {"phase_deg", phases_of(c)},
                       {"real", real},
                       {"imaginary", imaginary},
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
    text += "," + csv_field(csv_title(c.output.name + " amplitude", c.output.unit)) + "," +
            csv_field(csv_title(c.output.name + " phase", "deg"));
  text += "\n";
  std::vector<std::vector<double>> phases;
  for (const UnbalanceCurve& c : r.curves) phases.push_back(phases_of(c));
  for (std::size_t s = 0; s < r.speeds.size(); ++s) {
    text += fmt::format("{}", r.speeds[s]);
    for (std::size_t k = 0; k < r.curves.size(); ++k)
      text += fmt::format(",{:.12g},{:.12g}", std::abs(r.curves[k].amplitudes[s]), phases[k][s]);
    text += "\n";
  }
  return text;
}

std::string unbalance_svg(const std::string& model, const UnbalanceOptions& o,
                          const UnbalanceResponse& r) {
  std::vector<LogPanel> panels;
  for (const auto& group :
       panels_of(r.curves, [](const UnbalanceCurve& c) { return c.output.unit; })) {
    LogPanel size{"Amplitude", "[" + group[0]->output.unit + "]", LogPanel::Scale::logarithmic, {}},
        phase{"Phase", "", LogPanel::Scale::degrees, {}};
    for (const UnbalanceCurve* c : group) {
      size.curves.push_back({c->output.name, amplitudes_of(*c)});
      phase.curves.push_back({c->output.name, phases_of(*c)});
    }
    panels.push_back(std::move(size));
    panels.push_back(std::move(phase));
  }
  return log_plots(fmt::format("{}: unbalance {}", model, unbalances_text(o)),
                   fmt::format("speed of '{}' [rad/s]", o.joint), r.speeds, panels,
                   PlotAxis::linear);
}

}  // namespace floatframe
