// Campbell diagram: the vibrations of a model with a rotor over its speed, critical speeds, onset
// of instability (simulation/campbell.hpp); as text, JSON, CSV and a picture.
#include "floatframe/simulation/campbell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/report/campbell_picture.hpp"
#include "floatframe/report/json_values.hpp"

namespace floatframe {
namespace {

struct CampbellArguments {
  std::string speed, axis = "z";
  std::vector<double> orders;
  int modes = 12;
};

/// "motor=0:1200:40".
CampbellOptions campbell_options(const CampbellArguments& a) {
  CampbellOptions o;
  const auto bad = [&] {
    return InputError(fmt::format(
        "--speed: found '{}', expected JOINT=FROM:TO:STEP [rad/s], as in motor=0:1200:40",
        excerpt(a.speed)));
  };
  const std::size_t equals = a.speed.rfind('=');
  if (equals == std::string::npos || equals == 0) throw bad();
  o.joint = a.speed.substr(0, equals);
  double* const numbers[] = {&o.from, &o.to, &o.step};
  const char* at = a.speed.data() + equals + 1;
  const char* const end = a.speed.data() + a.speed.size();
  for (int k = 0; k < 3; ++k) {
    const auto [rest, error] = std::from_chars(at, end, *numbers[k]);
    const bool last = k == 2;
    if (error != std::errc() || (last ? rest != end : rest == end || *rest != ':')) throw bad();
    at = rest + 1;
  }
  o.axis = Vec3::Unit(a.axis[0] - 'x');
  if (!a.orders.empty()) o.orders = a.orders;
  o.modes = a.modes;
  return o;
}

std::string ratio_text(double x) { return fmt::format("{:.4f}", std::abs(x) < 5e-5 ? 0.0 : x); }

std::string campbell_text(const std::string& name, const CampbellOptions& o,
                          const CampbellDiagram& d) {
  std::string text =
      fmt::format("{}: '{}' at {:g} to {:g} rad/s, {}\n\n", name, o.joint, d.speeds.front(),
                  d.speeds.back(), plural(static_cast<long>(d.lines.size()), "vibration"));
  const std::size_t last = d.speeds.size() - 1, middle = last / 2;
  const auto at = [&](std::size_t k) { return fmt::format("at {:g} [rad/s]", d.speeds[k]); };
  TextTable table({"mode", "", at(0), at(middle), at(last), "damping", "at the end"}, {1});
  for (std::size_t k = 0; k < d.lines.size(); ++k) {
    const std::vector<CampbellPoint>& p = d.lines[k].points;
    const auto frequency = [&](std::size_t i) { return fmt::format("{:.6g}", p[i].frequency()); };
    table.add({std::to_string(k + 1), d.lines[k].kind, frequency(0), frequency(middle),
               frequency(last), ratio_text(p[0].damping()), ratio_text(p[last].damping())});
  }
  text += table.text() + '\n';
  TextTable critical({"critical speed [rad/s]", "[rev/min]", "order", "mode", ""}, {4});
  for (const CriticalSpeed& c : d.critical)
    critical.add({fmt::format("{:.6g}", c.speed),
                  fmt::format("{:.5g}", c.speed * 30.0 / std::acos(-1.0)),
                  fmt::format("{:g}", c.order), std::to_string(c.line + 1),
                  d.lines[static_cast<std::size_t>(c.line)].kind});
  text += critical.empty() ? "no critical speeds in this range\n" : critical.text();
  for (const InstabilityOnset& u : d.unstable)
    text += fmt::format("\nunstable from {:.6g} rad/s on: mode {} at {:.6g} rad/s\n", u.speed,
                        u.line + 1, u.frequency);
  if (d.rigid > 0)
    text += fmt::format("\n{} of frequency zero not shown\n", plural(d.rigid, "motion"));
  for (const std::string& note : d.notes) text += "Note: " + note + ".\n";
  return text;
}

std::string campbell_json(const std::string& name, const CampbellOptions& o,
                          const CampbellDiagram& d) {
  using Json = nlohmann::ordered_json;
  Json lines = Json::array(), critical = Json::array(), unstable = Json::array();
  for (const CampbellLine& line : d.lines) {
    Json real = Json::array(), imaginary = Json::array(), whirl = Json::array();
    for (const CampbellPoint& p : line.points) {
      real.push_back(p.lambda.real());
      imaginary.push_back(p.lambda.imag());
      whirl.push_back(p.whirl);
    }
    lines.push_back({{"kind", line.kind},
                     {"real_1_s", real},
                     {"frequency_rad_s", imaginary},
                     {"whirl", whirl}});
  }
  for (const CriticalSpeed& c : d.critical)
    critical.push_back({{"speed_rad_s", c.speed},
                        {"order", c.order},
                        {"mode", c.line + 1},
                        {"frequency_rad_s", c.frequency},
                        {"whirl", c.whirl}});
  for (const InstabilityOnset& u : d.unstable)
    unstable.push_back(
        {{"speed_rad_s", u.speed}, {"mode", u.line + 1}, {"frequency_rad_s", u.frequency}});
  return json_document({{"model", name},
                        {"joint", o.joint},
                        {"speed_rad_s", d.speeds},
                        {"modes", lines},
                        {"critical_speeds", critical},
                        {"unstable", unstable},
                        {"dependence_on_angle", d.dependence_on_angle},
                        {"of_frequency_zero", d.rigid},
                        {"without_swing", d.overdamped},
                        {"speeds_between", d.extra_speeds},
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
      text += fmt::format(",{},{},{}", p.frequency(), p.lambda.real(), p.whirl);
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
          .options = {speed,
                      word_option("--axis", a->axis, {"x", "y", "z"},
                                  "Axis of a rotor on a free joint; default z"),
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
