// Campbell diagram: the vibrations of a model with a rotor over its speed, critical speeds, onset
// of instability (rotors/campbell.hpp); as text, JSON, CSV and a picture.
#include "floatframe/rotors/campbell.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/analyses/rotor_options.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/page/campbell_picture.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

struct CampbellArguments {
  std::string speed, axis;
  std::vector<double> orders;
  int modes = 12;
};

CampbellOptions campbell_options(const CampbellArguments& a) {
  const SpeedRange r = speed_range("--speed", a.speed);
  CampbellOptions o;
  o.joint = r.joint;
  o.from = r.from;
  o.to = r.to;
  o.step = r.step;
  o.axis = axis_named(a.axis);
  if (!a.orders.empty()) o.orders = a.orders;
  o.modes = a.modes;
  return o;
}

std::string ratio_text(double x) { return fmt::format("{:.4f}", std::abs(x) < 5e-5 ? 0.0 : x); }

std::string speeds_text(const char* title, const std::vector<CriticalSpeed>& speeds,
                        const CampbellDiagram& d) {
  TextTable table({title, "[rev/min]", "order", "mode", ""}, {4});
  for (const CriticalSpeed& c : speeds)
    table.add({fmt::format("{:.6g}", c.speed),
               fmt::format("{:.5g}", c.speed * 30.0 / std::acos(-1.0)),
               fmt::format("{:g}", c.order), std::to_string(c.line + 1),
               d.lines[static_cast<std::size_t>(c.line)].kind});
  return table.text();
}

std::string onset_text(const InstabilityOnset& u) {
  if (u.frequency > 0.0)
    return fmt::format("\nunstable from {:.6g} rad/s on: mode {} at {:.6g} rad/s\n", u.speed,
                       u.line + 1, u.frequency);
  return fmt::format("\nunstable from {:.6g} rad/s on: {} diverges without swinging\n", u.speed,
                     u.line >= 0 ? fmt::format("mode {}", u.line + 1) : "a motion");
}

std::string campbell_text(const std::string& name, const CampbellOptions& o,
                          const CampbellDiagram& d) {
  std::string text = d.stiffening.empty() ? "" : d.stiffening + ".\n\n";
  text += fmt::format("{}: '{}' at {:g} to {:g} rad/s, {}\n\n", name, o.joint, d.speeds.front(),
                      d.speeds.back(), plural(static_cast<long>(d.lines.size()), "vibration"));
  const std::size_t last = d.speeds.size() - 1, middle = last / 2;
  const auto at = [&](std::size_t k) { return fmt::format("at {:g} [rad/s]", d.speeds[k]); };
  TextTable table({"mode", "", at(0), at(middle), at(last), "damping", "at the end"}, {1});
  for (std::size_t k = 0; k < d.lines.size(); ++k) {
    const std::vector<CampbellPoint>& p = d.lines[k].points;
    const auto frequency = [&](std::size_t i) {
      return p[i].known() ? fmt::format("{:.6g}", p[i].frequency()) : "-";
    };
    const auto damping = [&](std::size_t i) {
      return p[i].known() ? ratio_text(p[i].damping()) : "-";
    };
    table.add({std::to_string(k + 1), d.lines[k].kind, frequency(0), frequency(middle),
               frequency(last), damping(0), damping(last)});
  }
  text += table.text() + '\n';
  text += d.critical.empty() ? "no critical speeds in this range\n"
                             : speeds_text("critical speed [rad/s]", d.critical, d);
  if (!d.crossings.empty())
    text += '\n' + speeds_text("crossing that unbalance does not excite [rad/s]", d.crossings, d);
  for (const InstabilityOnset& u : d.unstable) text += onset_text(u);
  if (d.rigid > 0)
    text += fmt::format("\n{} of frequency zero not shown\n", plural(d.rigid, "motion"));
  for (const std::string& note : d.notes) text += "Note: " + note + ".\n";
  return text;
}

nlohmann::ordered_json speeds_json(const std::vector<CriticalSpeed>& speeds) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CriticalSpeed& c : speeds)
    list.push_back({{"speed_rad_s", c.speed},
                    {"order", c.order},
                    {"mode", c.line + 1},
                    {"frequency_rad_s", c.frequency},
                    {"whirl", c.whirl}});
  return list;
}

/// Null where the mode is unknown.
nlohmann::ordered_json number_json(const CampbellPoint& p, double x) {
  return p.known() ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

std::string campbell_json(const std::string& name, const CampbellOptions& o,
                          const CampbellDiagram& d) {
  using Json = nlohmann::ordered_json;
  Json lines = Json::array(), unstable = Json::array();
  for (const CampbellLine& line : d.lines) {
    Json real = Json::array(), imaginary = Json::array(), whirl = Json::array();
    for (const CampbellPoint& p : line.points) {
      real.push_back(number_json(p, p.lambda.real()));
      imaginary.push_back(number_json(p, p.lambda.imag()));
      whirl.push_back(number_json(p, p.whirl));
    }
    lines.push_back({{"kind", line.kind},
                     {"real_1_s", real},
                     {"frequency_rad_s", imaginary},
                     {"whirl", whirl}});
  }
  for (const InstabilityOnset& u : d.unstable)
    unstable.push_back({{"speed_rad_s", u.speed},
                        {"mode", u.line >= 0 ? Json(u.line + 1) : Json(nullptr)},
                        {"frequency_rad_s", u.frequency}});
  return json_document({{"model", name},
                        {"joint", o.joint},
                        {"speed_rad_s", d.speeds},
                        {"modes", lines},
                        {"critical_speeds", speeds_json(d.critical)},
                        {"crossings", speeds_json(d.crossings)},
                        {"unstable", unstable},
                        {"dependence_on_angle", d.dependence_on_angle},
                        {"of_frequency_zero", d.rigid},
                        {"without_swing", d.overdamped},
                        {"speeds_between", d.extra_speeds},
                        {"stiffening_counted_in", d.stiffened},
                        {"notes", d.notes}});
}

std::string campbell_csv(const CampbellDiagram& d) {
  std::string text = "speed [rad/s]";
  for (std::size_t k = 0; k < d.lines.size(); ++k)
    for (const char* what : {"frequency [rad/s]", "real part [1/s]", "whirl [-]"})
      text += fmt::format(",mode {} {}", k + 1, what);
  text += '\n';
  for (std::size_t s = 0; s < d.speeds.size(); ++s) {
    text += fmt::format("{}", d.speeds[s]);
    for (const CampbellLine& line : d.lines) {
      const CampbellPoint& p = line.points[s];
      text += p.known() ? fmt::format(",{},{},{}", p.frequency(), p.lambda.real(), p.whirl) : ",,,";
    }
    text += '\n';
  }
  return text;
}

AnalysisReport report_campbell(const Model& model, const CampbellArguments& a) {
  const CampbellOptions o = campbell_options(a);
  const auto d = std::make_shared<CampbellDiagram>(campbell(model, o));
  return {.text = campbell_text(model.name, o, *d),
          .json = campbell_json(model.name, o, *d),
          .files = {[d] { return campbell_csv(*d); },
                    [d, o, name = model.name] { return campbell_picture(name, o, *d); }}};
}

}  // namespace

Analysis campbell_analysis() {
  const auto a = std::make_shared<CampbellArguments>();
  Option speed = text_option("--speed", a->speed, "JOINT=FROM:TO:STEP",
                             "Joint that the rotor hangs on, and its speeds [rad/s]");
  speed.required = true;
  return {.name = "campbell",
          .help =
              "Campbell diagram of a rotor: vibrations over its speed, critical speeds [rad/s], "
              "onset of instability",
          .options = {speed, word_option("--axis", a->axis, {"x", "y", "z"}, axis_help),
                      number_list("--orders", a->orders, 0.01, 1000.0, "NUMBER",
                                  "Orders of the speed whose critical speeds are found; default 1"),
                      whole_option("--modes", a->modes, 1, 1000,
                                   "Vibrations that are followed, the lowest; default 12")},
          .json_help = "JSON on standard output (rad/s, 1/s)",
          .files = {{"--csv", "Write frequencies, real parts and whirl over the speed"},
                    {"--svg", "Write the diagram as a picture"}},
          .footer =
              "The joint is revolute, cylindrical or free. Frequencies are those in axes that do "
              "not turn; where its angle\nmatters the rotor must be symmetric about its axis: "
              "docs/vibrations.md.\n"
              "Exit codes: 0 done, 1 no steady state or a rotor that is not symmetric, 2 bad "
              "input.",
          .run = [a](const Model& model) { return report_campbell(model, *a); }};
}

}  // namespace floatframe
