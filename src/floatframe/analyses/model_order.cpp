#include "floatframe/analyses/model_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

/// "1-4, 7"
std::string ranges_text(const std::vector<int>& modes) {
  std::string text;
  for (std::size_t k = 0; k < modes.size();) {
    std::size_t end = k;
    while (end + 1 < modes.size() && modes[end + 1] == modes[end] + 1) ++end;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", modes[k] + 1);
    if (end > k) text += fmt::format("-{}", modes[end] + 1);
    k = end + 1;
  }
  return text.empty() ? "none: rigid" : text;
}

std::string order_text(const std::string& name, const ModelOrderOptions& o, const ModelOrder& r) {
  std::string text = fmt::format("{}: {} below {:g} Hz need {} of {}\n\n", name,
                                 plural(static_cast<long>(r.full.size()), "vibration"), o.below,
                                 r.needed, plural(r.modes, "mode"));
  TextTable bodies({"body", "modes", "needed", "which", "own to [Hz]"}, {3});
  for (const BodyOrder& b : r.bodies)
    bodies.add({b.name, std::to_string(b.estimates.size()), std::to_string(b.needed.size()),
                ranges_text(b.needed), b.own > 0.0 ? fmt::format("{:.4g}", b.own) : "-"});
  text += bodies.text(2) + '\n';
  text += fmt::format(
      "  With them no frequency of the range changes by more than {:.2g} % (allowed {:g} %):\n",
      100.0 * r.change, 100.0 * o.tolerance);
  TextTable table({"vibration", "all modes [Hz]", "needed ones [Hz]", "change [%]"});
  for (std::size_t k = 0; k < r.full.size(); ++k)
    table.add({std::to_string(k + 1), fmt::format("{:.5g}", r.full[k]),
               fmt::format("{:.5g}", r.reduced[k]),
               fmt::format("{:.2g}", 100.0 * (r.reduced[k] / r.full[k] - 1.0))});
  text += table.text(4);
  if (!r.ran) return text;
  text += "\n  Verified by a run; the outputs that change most:\n";
  TextTable outputs({"output", "range", "rms difference", "of peaks", "judged [%]"});
  for (std::size_t k = 0; k < std::min<std::size_t>(8, r.differences.size()); ++k) {
    const OutputDifference& d = r.differences[k];
    outputs.add({d.name + (d.unit.empty() ? "" : " [" + d.unit + "]"),
                 fmt::format("{:.4g}", d.range), fmt::format("{:.2g}", d.rms),
                 fmt::format("{:.2g}", d.peaks),
                 d.relative > 1.0 ? "> 100" : fmt::format("{:.2g}", 100.0 * d.relative)});
  }
  text += outputs.text(4);
  if (!r.differences.empty() && r.differences.front().relative > 1.0)
    text += "    (> 100: an output that hardly moves in this run, whose place changes)\n";
  return text;
}

std::string order_json(const std::string& name, const ModelOrderOptions& o, const ModelOrder& r) {
  using Json = nlohmann::ordered_json;
  Json bodies = Json::array(), differences = Json::array();
  for (const BodyOrder& b : r.bodies) {
    Json needed = Json::array();
    for (const int k : b.needed) needed.push_back(k + 1);
    bodies.push_back({{"body", b.name},
                      {"modes", b.estimates.size()},
                      {"needed", needed},
                      {"estimated_change_without", b.estimates},
                      {"own_frequencies_to_Hz", b.own}});
  }
  for (const OutputDifference& d : r.differences)
    differences.push_back({{"output", d.name},
                           {"unit", d.unit},
                           {"range", d.range},
                           {"rms_difference", d.rms},
                           {"difference_of_peaks", d.peaks},
                           {"relative", d.relative}});
  return json_document({{"model", name},
                        {"below_Hz", o.below},
                        {"tolerance", o.tolerance},
                        {"modes", r.modes},
                        {"needed", r.needed},
                        {"reduced_systems", r.trials},
                        {"frequencies_Hz", r.full},
                        {"with_needed_modes_Hz", r.reduced},
                        {"largest_change", r.change},
                        {"bodies", bodies},
                        {"ran", r.ran},
                        {"differences", differences},
                        {"warnings", r.warnings}});
}

}  // namespace

AnalysisReport report_model_order(const Model& model, const ModelOrderOptions& options) {
  const ModelOrder r = model_order(model, options);
  return {.text = order_text(model.name, options, r),
          .json = order_json(model.name, options, r),
          .warnings = r.warnings};
}

}  // namespace floatframe
