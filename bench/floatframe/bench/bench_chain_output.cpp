// Output of the chain benchmark: a table for people, JSON for programs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/apps/command.hpp"
#include "floatframe/bench/bench_chain.hpp"
#include "floatframe/bench/chain_model.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/text_table.hpp"

namespace floatframe {

std::string short_name(const Combination& c) {
  return fmt::format("{} + {}", c.coordinates == Coordinates::absolute ? "Abs." : "Rel.",
                     c.inertia == InertiaMethod::projection ? "B" : "P");
}

namespace {

double per_chain_step(long count, const ChainRow& row) {
  return static_cast<double>(count) / static_cast<double>(std::max(row.time.steps, 1L));
}

std::string small(const std::optional<double>& x) { return x ? fmt::format("{:.1e}", *x) : "-"; }

}  // namespace

std::string chain_text(const ChainResult& result) {
  const ChainOptions& o = result.options;
  TextTable table(
      {"links", "modes", "", "us per step, min", "median", "LLTs", "us per link", "iterations",
       "us each", "factoris.", "tip error [m]", "to published", "energy drift", "steps"},
      {2});
  std::string failures;
  bool shortened = false;
  const long wanted = std::max(1L, std::lround(o.duration / o.step));
  for (const ChainRow& row : result.rows) {
    const double us = 1e6 * row.time.least;
    const double iterations = per_chain_step(row.time.counts.iterations, row);
    table.add({std::to_string(row.links), std::to_string(row.modes), short_name(row.combination),
               fmt::format("{:.2f}", us), fmt::format("{:.2f}", 1e6 * row.time.median),
               fmt::format("{:.3f}", row.time.least / result.dense_llt),
               fmt::format("{:.2f}", us / row.links), fmt::format("{:.2f}", iterations),
               fmt::format("{:.2f}", us / std::max(iterations, 1e-9)),
               fmt::format("{:.2f}", per_chain_step(row.time.counts.factorizations, row)),
               small(row.tip_error), small(row.tip_published),
               fmt::format("{:.1e}", row.energy_drift), std::to_string(row.time.steps)});
    shortened = shortened || (row.time.steps < wanted && row.failure.empty());
    if (!row.failure.empty())
      failures += fmt::format("  {}, {}: {}\n", plural(row.links, "link"),
                              short_name(row.combination), row.failure);
  }
  std::string text = fmt::format(
      "Chain of flexible links released from the horizontal: {:g} s at {:g} ms, {} per link, "
      "Newton "
      "tolerance {:g}, spectral radius {:g}\n"
      "Processor time per step, B projection, P preprocessing; LLTs: in units of one dense LLT of "
      "a "
      "98 x 98 matrix\n\n",
      o.duration, 1e3 * o.step, plural(o.elements, "element"), o.tolerance, o.spectral_radius);
  text += table.text(2);
  text += fmt::format(
      "\n  min, median: of every block of 20 steps over {} runs or more, summed over the blocks.\n"
      "  tip error: at 1 s against a run at {:g} ms (up to {} links); to published: distance "
      "of the tip of\n"
      "  four links to another program's. energy drift: over the range of the potential energy.\n",
      o.runs, 1e3 * result.tip_reference_step, largest_reference_chain);
  if (shortened)
    text +=
        "  Rows of fewer steps are those whose run takes long: only its first steps are made.\n";
  if (!failures.empty()) text += "\n  Failed:\n" + failures;
  text += fmt::format(
      "\n  one dense LLT of a 98 x 98 matrix  {:.2f} us\n\n  build      {}\n  processor  {}\n",
      1e6 * result.dense_llt, build_description(), processor_name());
  return text;
}

std::string chain_json(const ChainResult& result) {
  using Json = nlohmann::ordered_json;
  const ChainOptions& o = result.options;
  const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(); };
  Json rows = Json::array();
  for (const ChainRow& row : result.rows) {
    const double iterations = per_chain_step(row.time.counts.iterations, row);
    rows.push_back(
        {{"links", row.links},
         {"modes", row.modes},
         {"coordinates", word(row.combination.coordinates)},
         {"inertia", word(row.combination.inertia)},
         {"us_per_step_min", 1e6 * row.time.least},
         {"us_per_step_median", 1e6 * row.time.median},
         {"iterations_per_step", iterations},
         {"tip_error_m", number(row.tip_error)},
         {"factorizations_per_step", per_chain_step(row.time.counts.factorizations, row)},
         {"us_per_iteration_min", 1e6 * row.time.least / std::max(iterations, 1e-9)},
         {"llt_per_step_min", row.time.least / result.dense_llt},
         {"tip_to_published_m", number(row.tip_published)},
         {"energy_drift", row.energy_drift},
         {"freedoms", row.freedoms},
         {"steps", row.time.steps},
         {"substeps", row.time.counts.substeps},
         {"runs", row.time.runs},
         {"failure", row.failure.empty() ? Json() : Json(row.failure)}});
  }
  const Json json = {{"rows", rows},
                     {"dense_llt_98_us", 1e6 * result.dense_llt},
                     {"step_s", o.step},
                     {"duration_s", o.duration},
                     {"elements", o.elements},
                     {"tolerance", o.tolerance},
                     {"spectral_radius", o.spectral_radius},
                     {"tip_reference_step_s", result.tip_reference_step},
                     {"build", build_description()},
                     {"cpu", processor_name()}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace floatframe
