#include "floatframe/analyses/response_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/analyses/complex_curves.hpp"
#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

std::string name_of(const ResponseCurve& c) { return c.output.name + " / " + c.input.name; }

std::string density_unit(const Column& output) {
  const std::string& u = output.unit;
  if (u.empty()) return "1/Hz";
  return (u.find_first_of("/ ") == std::string::npos ? u : "(" + u + ")") + "^2/Hz";
}

std::string curves_text(const ResponseResult& r) {
  TextTable table(
      {"output", "input", "unit", "at [Hz]", "magnitude", "phase [deg]", "largest", "there [Hz]"},
      {1, 2});
  for (const ResponseCurve& c : r.curves) {
    const auto [sizes, phases, real, imaginary] = parts_of(c.values);
    const auto top = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
    const std::size_t ends[] = {0, sizes.size() - 1};
    for (const std::size_t k : ends) {
      const bool first = k == 0;
      if (!first && sizes.size() == 1) break;
      table.add({first ? c.output.name : "", first ? c.input.name : "", first ? c.unit() : "",
                 fmt::format("{:.4g}", r.frequencies[k]), fmt::format("{:.5g}", sizes[k]),
                 fmt::format("{:.1f}", std::remainder(phases[k], 360.0)),
                 first ? fmt::format("{:.5g}", sizes[static_cast<std::size_t>(top)]) : "",
                 first ? fmt::format("{:.4g}", r.frequencies[static_cast<std::size_t>(top)]) : ""});
    }
  }
  return table.text();
}

std::string harmonic_text(const HarmonicResponse& h) {
  TextTable table({"output", "unit", "mean", "amplitude", "phase [deg]"}, {1});
  for (std::size_t k = 0; k < h.outputs.size(); ++k)
    table.add({h.outputs[k].name, h.outputs[k].unit, fmt::format("{:.6g}", h.means[k]),
               fmt::format("{:.6g}", std::abs(h.values[k])),
               fmt::format("{:.2f}", phase_of(h.values[k]))});
  return fmt::format("{} = {:g} {} cos(2 pi {:g} Hz t), in steady motion:\n{}", h.input,
                     h.amplitude, h.unit, h.frequency, table.text());
}

std::string road_text(const RoadLoading& loading, const RoadResponse& road) {
  TextTable table({"output", "unit", "rms"}, {1});
  for (const OutputSpectrum& o : road.outputs)
    table.add({o.output.name, o.output.unit, fmt::format("{:.5g}", o.rms)});
  return fmt::format(
      "road of {:g} m3 at 0.1 cycles/m, waviness {:g}, at {:g} m/s, from {:.4g} to {:.4g} Hz "
      "(height: rms {:.4g} m):\n{}",
      loading.roughness, loading.waviness, loading.speed, road.from, road.to, road.road,
      table.text());
}

}  // namespace

std::string ResponseCurve::unit() const {
  const std::string above = output.unit.empty() ? "1" : output.unit;
  return input.unit.empty() ? above : above + " per " + input.unit;
}

std::string response_text(const ResponseResult& r) {
  std::string text = r.stiffening.empty() ? "" : r.stiffening + ".\n\n";
  text += fmt::format("{} at t = {:g} s\n", r.model, r.time);
  if (!r.curves.empty()) text += "\n" + curves_text(r);
  for (const HarmonicResponse& h : r.harmonics) text += "\n" + harmonic_text(h);
  if (r.road) text += "\n" + road_text(r.loading, *r.road);
  if (r.curves.empty() && r.harmonics.empty() && !r.road)
    text +=
        "\nThe model has no inputs (its own, prescribed motions, roads), or no outputs: there is "
        "nothing to respond.\n";
  for (const std::string& note : r.notes) text += "Note: " + note + ".\n";
  return text;
}

std::string response_json(const ResponseResult& r) {
  using Json = nlohmann::ordered_json;
  Json curves = Json::array(), harmonics = Json::array();
  for (const ResponseCurve& c : r.curves) {
    const ComplexParts parts = parts_of(c.values);
    curves.push_back({{"output", c.output.name},
                      {"input", c.input.name},
                      {"unit", c.unit()},
                      {"magnitude", parts.size},
                      {"phase_deg", parts.phase},
                      {"real", parts.real},
                      {"imaginary", parts.imaginary}});
  }
  for (const HarmonicResponse& h : r.harmonics) {
    Json outputs = Json::array();
    for (std::size_t k = 0; k < h.outputs.size(); ++k)
      outputs.push_back({{"name", h.outputs[k].name},
                         {"unit", h.outputs[k].unit},
                         {"mean", h.means[k]},
                         {"amplitude", std::abs(h.values[k])},
                         {"phase_deg", phase_of(h.values[k])}});
    harmonics.push_back({{"input", h.input},
                         {"amplitude", h.amplitude},
                         {"frequency_Hz", h.frequency},
                         {"outputs", outputs}});
  }
  Json all{{"model", r.model},
           {"time_s", r.time},
           {"frequencies_Hz", r.frequencies},
           {"responses", curves},
           {"harmonic", harmonics}};
  if (r.road) {
    Json outputs = Json::array();
    for (const OutputSpectrum& o : r.road->outputs)
      outputs.push_back({{"name", o.output.name},
                         {"unit", o.output.unit},
                         {"rms", o.rms},
                         {"density", o.density}});
    all["road"] = {{"roughness_m3", r.loading.roughness},
                   {"waviness", r.loading.waviness},
                   {"speed_m_s", r.loading.speed},
                   {"from_Hz", r.road->from},
                   {"to_Hz", r.road->to},
                   {"rms_m", r.road->road},
                   {"outputs", outputs}};
  }
  all["stiffening_counted_in"] = r.stiffened;
  all["notes"] = r.notes;
  return json_document(all);
}

std::string response_csv(const ResponseResult& r) {
  std::vector<std::pair<std::string, std::vector<double>>> columns;
  columns.emplace_back("frequency [Hz]", r.frequencies);
  for (const ResponseCurve& c : r.curves) {
    ComplexParts parts = parts_of(c.values);
    const auto add = [&](const char* what, const std::string& unit, std::vector<double>& values) {
      columns.emplace_back(csv_title(name_of(c) + what, unit), std::move(values));
    };
    add(" magnitude", c.unit(), parts.size);
    add(" phase", "deg", parts.phase);
    add(" real", c.unit(), parts.real);
    add(" imaginary", c.unit(), parts.imaginary);
  }
  if (r.road)
    for (const OutputSpectrum& o : r.road->outputs)
      columns.emplace_back(csv_title(o.output.name + " density", density_unit(o.output)),
                           o.density);
  std::string text;
  for (const auto& [title, values] : columns) text += (text.empty() ? "" : ",") + title;
  text += "\n";
  for (std::size_t k = 0; k < r.frequencies.size(); ++k) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += fmt::format("{}{:.12g}", c == 0 ? "" : ",", columns[c].second[k]);
    text += "\n";
  }
  return text;
}

std::string response_svg(const ResponseResult& r) {
  std::vector<LogPanel> panels = bode_panels(
      "Magnitude", r.curves, [](const ResponseCurve& c) { return c.unit(); }, name_of,
      [](const ResponseCurve& c) { return parts_of(c.values); });
  if (r.road)
    for (const auto& group : panels_of(
             r.road->outputs, [](const OutputSpectrum& o) { return density_unit(o.output); })) {
      LogPanel panel{"Spectral density",
                     "[" + density_unit(group[0]->output) + "]",
                     LogPanel::Scale::logarithmic,
                     {}};
      for (const OutputSpectrum* o : group)
        panel.curves.push_back(
            {fmt::format("{}, rms {:.4g} {}", o->output.name, o->rms, o->output.unit), o->density});
      panels.push_back(std::move(panel));
    }
  const std::string title = r.road ? fmt::format("{}: road of {:g} m3 at {:g} m/s", r.model,
                                                 r.loading.roughness, r.loading.speed)
                                   : r.model;
  return log_plots(title, "frequency [Hz]", r.frequencies, panels);
}

}  // namespace floatframe
