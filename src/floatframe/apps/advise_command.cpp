// floatframe advise: which modes a model could do without at a given step, verified by a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/apps/commands.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/model/inertia_choice.hpp"
#include "floatframe/model/validate.hpp"
#include "floatframe/report/advice_json.hpp"
#include "floatframe/simulation/mode_advice.hpp"

namespace floatframe {
namespace {

struct AdviseArguments {
  ModelArguments model;
  std::string step, duration;
  AdviceOptions options;
  bool json = false;
};

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

int advise(const AdviseArguments& a) {
  ModelDescription description = read_model(a.model);
  SimulationDescription& simulation = description.simulation;
  set_clock(simulation, a.step, a.duration);
  if (simulation.duration > 1e7 * simulation.step)
    throw InputError(place_of_clock(simulation),
                     fmt::format("a duration of {:g} s with a step of {:g} s takes more than 1e+07 "
                                 "steps; give a shorter --duration",
                                 simulation.duration, simulation.step));
  if (!(simulation.duration >= simulation.step))
    throw InputError(place_of_clock(simulation),
                     "the run is shorter than one step; give a --duration");
  check_inertia_method(description, simulation.inertia);
  const Model model = build_model(description);
  const ModeAdviceReport report = advise(model, simulation, a.options);
  print(a.json ? advice_json(description.name, simulation.step, report, a.options)
               : advice_text(description.name, simulation, report, a.options));
  for (const RangeWarning& warning : report.full.warnings) say("warning: " + warning.sentence);
  for (const RangeWarning& warning : report.reduced.warnings)
    say("warning: without the modes that are dropped: " + warning.sentence);
  return 0;
}

}  // namespace

Command advise_command() {
  const auto a = std::make_shared<AdviseArguments>();
  return {
      .name = "advise",
      .help = "Find out which modes of flexible bodies a model could do without",
      .options = joined(
          model_options(a->model),
          {text_option("--step", a->step, "SECONDS",
                       "Time step [s]; default: that of the model file"),
           text_option("--duration", a->duration, "SECONDS",
                       "Time to simulate [s]; default: that of the model file"),
           fraction_option(
               "--share", a->options.drop_share,
               "Modes with smaller static and dynamic shares may be dropped; default 0.001"),
           fraction_option(
               "--tolerance", a->options.tolerance,
               "Largest change of an output allowed, as a fraction of its range; default 0.01"),
           whole_option("--repeat", a->options.repeat, 1, 1000,
                        "Timed runs of both models, the quickest counts; default 3"),
           flag("--json", a->json, "JSON on standard output")}),
      .footer =
          "The model is run with the options of its file, then without the modes whose shares are "
          "small;\n"
          "modes are only called droppable if that run agrees. Shares and thresholds: "
          "docs/mode-advisor.md.\n"
          "Exit codes: 0 done, 1 the model does not run, 2 bad input.",
      .run = [a] { return advise(*a); }};
}

}  // namespace floatframe
