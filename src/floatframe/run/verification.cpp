#include "floatframe/run/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "floatframe/core/text_pieces.hpp"
#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/element_keys.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

/// Below it, an order is not the 2 of the method.
constexpr double low_order = 1.5;

/// "outputs 'tip.x' and 2 more", those that `chosen` selects; empty without any.
template <class Chosen>
std::string named(const Verification& v, const Chosen& chosen) {
  std::vector<std::string> names;
  for (const VerifiedOutput& o : v.outputs)
    if (chosen(o)) names.push_back("'" + o.column.name + "'");
  if (names.empty()) return {};
  return (names.size() == 1 ? "output " : "outputs ") + names_text(names, 4);
}

/// It rubs, or may do so: a formula, a program, a damper whose law has corners.
bool may_rub(const Element& e) {
  if (e.laws.size() == 2 && !e.laws[1].edges().empty()) return true;  // of its rate
  if (std::ranges::any_of(e.signals, [](const Signal& s) { return s.local != nullptr; }))
    return true;
  return std::ranges::any_of(element_keys(e.type), [](const ElementKey& key) {
    const std::string_view name = key.name;
    return name == "kinetic" || name == "breakaway" || key.kind == KeyKind::formula ||
           key.kind == KeyKind::function;
  });
}

/// `converges`: slowly, but it does.
std::string likely_causes(const Model& model, const SimulationDescription& o, bool converges) {
  if (model.elements.empty())
    return std::string(converges ? "" : "a chaotic motion or ") +
           "a step that is long for the fastest motion";
  std::string text = converges ? "" : "impacts, a chaotic motion, ";
  if (!o.locate_edges && std::any_of(model.elements.begin(), model.elements.end(),
                                     [](const Element& e) { return has_branches(e); }))
    text += "corners and jumps of forces within steps (locate_edges: true divides steps there), ";
  if (std::ranges::any_of(model.elements, may_rub))
    text += "friction, ";
  else if (std::ranges::any_of(model.elements, [](const Element& e) { return has_branches(e); }))
    text += "contacts, ";
  return text + "tables that steps sample, or a step that is long for the fastest motion";
}

void add_low_orders(const std::string& causes, Verification& v) {
  double low = low_order, high = 0.0;
  const std::string names = named(v, [&](const VerifiedOutput& x) {
    const bool is = x.convergence == Convergence::regular && x.order < low_order;
    if (is) {
      low = std::min(low, x.order);
      high = std::max(high, x.order);
    }
    return is;
  });
  if (names.empty()) return;
  const std::string order =
      high - low < 0.05 ? fmt::format("{:.1f}", low) : fmt::format("{:.1f} to {:.1f}", low, high);
  v.sentences.push_back(fmt::format(
      "converging with order {} instead of 2: {}; likely because of {}", order, names, causes));
}

void add_sentences(const Model& model, const SimulationDescription& description, Verification& v) {
  add_low_orders(likely_causes(model, description, true), v);
  const auto is = [](Convergence c) {
    return [c](const VerifiedOutput& o) { return o.convergence == c; };
  };
  if (const std::string names = named(v, is(Convergence::none)); !names.empty())
    v.sentences.push_back(
        fmt::format("not converging at these steps: {}; the error is as large as the difference or "
                    "larger; likely because of {}",
                    names, likely_causes(model, description, false)));
  if (const std::string names = named(v, is(Convergence::too_coarse)); !names.empty())
    v.sentences.push_back(fmt::format(
        "falling faster than the method converges: {}; the step is too long for an estimate of the "
        "order, and the error is about the difference",
        names));
}

/// A run at a part of the step, with rows at the same instants.
RunResult run_part(const Model& model, const SimulationDescription& given, int part,
                   double duration, const RunOptions& options) {
  SimulationDescription o = given;
  o.output_interval = steps_per_row(given) * given.step;
  o.step = given.step / part;
  o.duration = std::max(duration, o.step);
  o.min_step = std::min(given.min_step, o.step);
  try {
    return run(model, o, options);
  } catch (const RunError& error) {
    RunResult r;
    r.summary = failed_summary(model.name, o, error.what());
    return r;
  }
}

/// "failed: ..." or "was interrupted at ..."
std::string ending(const RunSummary& s) {
  return s.status == "failed" ? "failed: " + s.message : "was " + s.message;
}

}  // namespace

Verification verify_steps(const Model& model, const SimulationDescription& description,
                          double duration, NextRow rows, const RunOptions& given) {
  RunOptions options;
  options.watch = false;
  options.stop = given.stop;
  // A third of the work is that of the run at half the step.
  if (given.progress) options.progress = [&](double f) { given.progress(f / 3.0); };
  const RunResult half = run_part(model, description, 2, duration, options);
  Verification v;
  RunSummary quarter;
  if (half.table.rows() > 0) {
    std::vector<char> crossings;
    for (const Output& o : model.outputs)
      crossings.push_back(output_kind(o.type).of == OutputOf::crossing);
    StepDifferences differences(std::move(rows), half.table, 1e-6 * description.step,
                                std::move(crossings));
    options.rows = [&](const std::vector<Column>&, std::span<const double> numbers) {
      differences.take(numbers);
    };
    if (given.progress) options.progress = [&](double f) { given.progress((1 + 2 * f) / 3.0); };
    if (half.summary.status != "interrupted")
      quarter = run_part(model, description, 4, std::min(duration, half.summary.duration), options)
                    .summary;
    v = differences.result();
  }
  v.step = description.step;
  v.cpu = half.summary.cpu + quarter.cpu;
  if (!description.until && duration < (1.0 - 1e-9) * description.duration)
    v.sentences.push_back(fmt::format("the run ended early: compared up to {:g} s", v.to));
  for (const auto& [s, name] : {std::pair{&half.summary, "half"}, {&quarter, "a quarter of"}}) {
    if (s->status == "completed") continue;
    v.interrupted = v.interrupted || s->status == "interrupted";
    v.sentences.push_back(fmt::format("the run at {} the step {}", name, ending(*s)));
  }
  add_sentences(model, description, v);
  return v;
}

}  // namespace floatframe
