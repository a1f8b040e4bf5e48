// Advice: modes that a model does not need at a given step, verified by a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/analyses/model_order.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

std::string frequency_cell(double f) { return std::isfinite(f) ? fmt::format("{:.4g}", f) : "-"; }
std::string percent(double share) { return fmt::format("{:.3g}", 100.0 * share); }

std::string modes_text(const ModeAdviceReport& r) {
  TextTable table({"body", "mode", "name", "own [Hz]", "free [Hz]", "omega h", "static [%]",
                   "dynamic [%]", "kinetic/strain", "rms", "advice"},
                  {2, 10});
  for (const BodyAdvice& body : r.bodies)
    for (const ModeAdvice& m : body.modes)
      table.add({body.name, std::to_string(m.mode + 1), m.name, frequency_cell(m.frequency),
                 frequency_cell(m.free_frequency), fmt::format("{:.3g}", m.step_phase),
                 percent(m.static_share), percent(m.dynamic_share),
                 fmt::format("{:.2g}", m.kinetic_ratio), fmt::format("{:.2g}", m.rms),
                 std::string(word(m.action)) + (m.retained ? " (dropping changes results)" : "")});
  return table.text(2);
}

std::string cost_text(const ModeAdviceReport& r) {
  const auto per_step = [](double x, const RunSummary& s) {
    return x / static_cast<double>(std::max(1L, s.steps));
  };
  TextTable table({"", "full", "reduced", "ratio"});
  const auto add = [&](const char* what, double full, double reduced, const char* format) {
    table.add({what, fmt::format(fmt::runtime(format), full),
               fmt::format(fmt::runtime(format), reduced),
               full > 0.0 ? fmt::format("{:.3f}", reduced / full) : "-"});
  };
  add("amplitudes", r.modes, r.modes - r.dropped, "{:.0f}");
  add("kflop of flexible bodies per step (count)", 1e-3 * r.flops_full, 1e-3 * r.flops_reduced,
      "{:.3g}");
  add("Newton iterations per step (measured)",
      per_step(static_cast<double>(r.full.iterations), r.full),
      per_step(static_cast<double>(r.reduced.iterations), r.reduced), "{:.3f}");
  add("processor time per step [us] (measured)", per_step(1e6 * r.full.cpu, r.full),
      per_step(1e6 * r.reduced.cpu, r.reduced), "{:.3g}");
  return table.text(2);
}

std::string advice_text(const std::string& model, const SimulationDescription& s,
                        const ModeAdviceReport& r, const AdviceOptions& o) {
  std::string text =
      fmt::format("{}: {} of {}, step {:g} s, run for {:g} s\n\n", model, plural(r.modes, "mode"),
                  plural(static_cast<long>(r.bodies.size()), "flexible body", "flexible bodies"),
                  s.step, s.duration);
  if (r.modes == 0) return text + "  There is nothing to advise: the model has no modes.\n";
  text += modes_text(r) + '\n';
  if (r.candidates > r.dropped)
    text +=
        fmt::format("  {} with shares below {:g} % {}: without {} {}.\n",
                    plural(r.candidates - r.dropped, "mode"), 100.0 * o.drop_share,
                    r.candidates - r.dropped == 1 ? "is kept" : "are kept",
                    r.dropped == 0 && r.trials > 1 ? "a single one" : "them",
                    r.refused_by.empty() ? "the model does not run to its end"
                                         : fmt::format("'{}' changes by {:.2g} % of its range",
                                                       r.refused_by, 100.0 * r.refused_difference));
  if (r.dropped == 0) {
    text += "  No mode can be dropped.\n";
  } else {
    text += fmt::format("  Dropping {}, verified by a run without {}:\n", plural(r.dropped, "mode"),
                        r.dropped == 1 ? "it" : "them");
    TextTable table({"output", "range", "rms difference", "largest", "of peaks", "judged [%]"});
    constexpr std::size_t shown = 8;
    for (std::size_t k = 0; k < std::min(shown, r.differences.size()); ++k) {
      const OutputDifference& d = r.differences[k];
      const std::string unit = d.unit.empty() ? "" : " [" + d.unit + "]";
      table.add({d.name + unit, fmt::format("{:.4g}", d.range), fmt::format("{:.2g}", d.rms),
                 fmt::format("{:.2g}", d.largest), fmt::format("{:.2g}", d.peaks),
                 percent(d.relative)});
    }
    text += table.text(4);
    if (r.differences.size() > shown)
      text += fmt::format("    and {} with smaller differences\n", r.differences.size() - shown);
    text += '\n' + cost_text(r);
  }
  if (r.quasi_static > 0) {
    text += fmt::format(
        "\n  {} only {} compliance (\"quasi-static\"): {} own vibration is not excited, or the "
        "step "
        "is too\n  long to show it. An implicit step already treats {} so; it costs as much as any "
        "other. With\n  spectral_radius 1 an unresolved mode rings on: a smaller one damps it "
        "(this run: {:g}).\n",
        plural(r.quasi_static, "mode"), r.quasi_static == 1 ? "adds" : "add",
        r.quasi_static == 1 ? "its" : "their", r.quasi_static == 1 ? "it" : "them",
        s.spectral_radius);
  }
  return text;
}

nlohmann::ordered_json cost_json(const RunSummary& s, double flops) {
  const double steps = static_cast<double>(std::max(1L, s.steps));
  return {{"steps", s.steps},
          {"iterations_per_step", static_cast<double>(s.iterations) / steps},
          {"cpu_us_per_step", 1e6 * s.cpu / steps},
          {"flops_per_step", flops},
          {"warnings", sentences(s.warnings)}};
}

/// Infinite frequencies (massless modes) become null.
std::string advice_json(const Model& model, const ModeAdviceReport& r,
                        const AdviceOptions& options) {
  using Json = nlohmann::ordered_json;
  Json bodies = Json::array();
  for (const BodyAdvice& body : r.bodies) {
    Json modes = Json::array();
    for (const ModeAdvice& m : body.modes)
      modes.push_back({{"mode", m.mode + 1},
                       {"name", m.name},
                       {"frequency_Hz", m.frequency},
                       {"free_frequency_Hz", m.free_frequency},
                       {"omega_h", m.step_phase},
                       {"static_share", m.static_share},
                       {"dynamic_share", m.dynamic_share},
                       {"kinetic_ratio", m.kinetic_ratio},
                       {"rms", m.rms},
                       {"peak", m.peak},
                       {"action", word(m.action)},
                       {"retained_by_verification", m.retained}});
    bodies.push_back({{"body", body.name},
                      {"free_frequencies_Hz", json_array(body.free_frequencies)},
                      {"modes", modes}});
  }
  Json differences = Json::array();
  for (const OutputDifference& d : r.differences)
    differences.push_back({{"output", d.name},
                           {"unit", d.unit},
                           {"range", d.range},
                           {"rms_difference", d.rms},
                           {"largest_difference", d.largest},
                           {"difference_of_peaks", d.peaks},
                           {"solver_noise", d.noise},
                           {"relative", d.relative}});
  return json_document({{"model", model.name},
                        {"step_s", model.simulation.step},
                        {"modes", r.modes},
                        {"dropped", r.dropped},
                        {"quasi_static", r.quasi_static},
                        {"candidates", r.candidates},
                        {"reduced_models_run", r.trials},
                        {"newton_tolerance_compared", r.tolerance},
                        {"thresholds",
                         {{"drop_share", options.drop_share},
                          {"static_ratio", options.static_ratio},
                          {"tolerance", options.tolerance}}},
                        {"full", cost_json(r.full, r.flops_full)},
                        {"reduced", cost_json(r.reduced, r.flops_reduced)},
                        {"refused_by", r.refused_by},
                        {"refused_difference", r.refused_difference},
                        {"bodies", bodies},
                        {"differences", differences}});
}

AnalysisReport report_advice(const Model& model, const AdviceOptions& options) {
  const ModeAdviceReport r = advise(model, model.simulation, options);
  std::vector<std::string> warnings = sentences(r.full.warnings);
  for (const std::string& sentence : sentences(r.reduced.warnings))
    warnings.push_back("without the modes that are dropped: " + sentence);
  return {.text = advice_text(model.name, model.simulation, r, options),
          .json = advice_json(model, r, options),
          .warnings = std::move(warnings)};
}

}  // namespace

Analysis advise_analysis() {
  const auto o = std::make_shared<AdviceOptions>();
  const auto order = std::make_shared<ModelOrderOptions>();
  return {
      .name = "advise",
      .help = "Find the modes of flexible bodies that a model does not need",
      .makes_steps = true,
      .options =
          {fraction_option(
               "--share", o->drop_share,
               "Modes with smaller static and dynamic shares may be dropped; default 0.001"),
           fraction_option(
               "--tolerance", o->tolerance,
               "Largest change of an output allowed, as a fraction of its range; default 0.01"),
           whole_option("--repeat", o->repeat, 1, 1000,
                        "Timed runs of both models, the quickest counts; default 3"),
           number_option("--below", order->below, 1e-6, 1e9, "HERTZ",
                         "Another question: modes that the vibrations of the whole model below "
                         "this frequency need"),
           fraction_option("--frequency-error", order->tolerance,
                           "With --below: change of these frequencies allowed; default 0.01")},
      .footer =
          "The model is run with the options of its file, then without the modes whose shares are "
          "small;\n"
          "modes are only called droppable if that run agrees. Shares and thresholds: "
          "docs/mode-advisor.md.\n"
          "Exit codes: 0 done, 1 the model does not run, 2 bad input.",
      .run = [o, order](const Model& model) {
        return order->below > 0.0 ? report_model_order(model, *order) : report_advice(model, *o);
      }};
}

}  // namespace floatframe
