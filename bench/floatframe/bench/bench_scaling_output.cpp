// Output of the scaling benchmark: one table per sweep for people, JSON for programs.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "floatframe/apps/command.hpp"
#include "floatframe/bench/bench_scaling.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/text_table.hpp"

namespace floatframe {
namespace {

const char* title(Sweep sweep) {
  switch (sweep) {
    case Sweep::elements:
      return "Elements per link (beams; 4 links, 8 modes)";
    case Sweep::interface_nodes:
      return "Nodes of each end face tied to the joint (bricks; 4 links, 8 modes)";
    case Sweep::modes:
      return "Modes per link (4 links, 40 elements)";
    case Sweep::bodies:
      return "Links (8 modes, 20 elements)";
  }
  return "";
}

/// Reference row for the cost of a row: the row of 20 elements, 4 interface nodes, 8 modes or 8
/// links of the same combination, or the first one if there is none.
const ScalingRow& base_row(const ScalingResult& result, const ScalingRow& row) {
  const int usual = row.sweep == Sweep::elements ? 20 : row.sweep == Sweep::interface_nodes ? 4 : 8;
  const ScalingRow* base = nullptr;
  for (const ScalingRow& other : result.rows) {
    if (other.sweep != row.sweep || other.combination.coordinates != row.combination.coordinates ||
        other.combination.inertia != row.combination.inertia || !other.failure.empty())
      continue;
    if (!base || other.value == usual) base = &other;
  }
  return base ? *base : row;
}

double ratio(const ScalingResult& result, const ScalingRow& row) {
  const double base = base_row(result, row).iteration;
  return base > 0.0 ? row.iteration / base : 0.0;
}

double iterations_a_step(const ScalingRow& row) {
  return static_cast<double>(row.time.counts.iterations) /
         static_cast<double>(std::max(row.time.steps, 1L));
}

}  // namespace

std::string scaling_text(const ScalingResult& result) {
  std::string text = fmt::format(
      "Growth of the cost of a chain of flexible links, first {} of {:g} ms\n"
      "B projection, P preprocessing; an iteration: full, with its factorisation; ratio: to that "
      "of "
      "20 elements, 4 nodes, 8 modes or 8 links\n",
      plural(result.options.steps, "step"), 1e3 * result.options.step);
  std::string failures;
  for (const Sweep sweep : result.options.sweeps) {
    TextTable table({word(sweep), "", "dofs per link", "us per iteration", "ratio", "us per link",
                     "iterations per step", "us per step", "LLTs", "build [s]"},
                    {1});
    for (const ScalingRow& row : result.rows) {
      if (row.sweep != sweep) continue;
      if (!row.failure.empty()) {
        failures += fmt::format("  {} {}, {}: {}\n", word(sweep), row.value,
                                short_name(row.combination), row.failure);
        continue;
      }
      const double us = 1e6 * row.iteration;
      table.add({std::to_string(row.value), short_name(row.combination),
                 std::to_string(row.finite_element_dofs), fmt::format("{:.3f}", us),
                 fmt::format("{:.3f}", ratio(result, row)), fmt::format("{:.3f}", us / row.links),
                 fmt::format("{:.2f}", iterations_a_step(row)),
                 fmt::format("{:.2f}", 1e6 * row.time.least),
                 fmt::format("{:.3f}", row.time.least / result.dense_llt),
                 fmt::format("{:.2f}", row.build)});
    }
    text += fmt::format("\n{}\n{}", title(sweep), table.text(2));
  }
  if (!failures.empty()) text += "\n  Failed:\n" + failures;
  text += fmt::format(
      "\n  one dense LLT of a 98 x 98 matrix  {:.2f} us\n\n  build      {}\n  processor  {}\n",
      1e6 * result.dense_llt, build_description(), processor_name());
  return text;
}

std::string scaling_json(const ScalingResult& result) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (const ScalingRow& row : result.rows) {
    rows.push_back({{"sweep", word(row.sweep)},
                    {"value", row.value},
                    {"coordinates", word(row.combination.coordinates)},
                    {"inertia", word(row.combination.inertia)},
                    {"links", row.links},
                    {"modes", row.modes},
                    {"elements", row.elements},
                    {"finite_element_dofs", row.finite_element_dofs},
                    {"freedoms", row.freedoms},
                    {"us_per_iteration_min", 1e6 * row.iteration},
                    {"iteration_ratio", ratio(result, row)},
                    {"us_per_step_min", 1e6 * row.time.least},
                    {"us_per_step_median", 1e6 * row.time.median},
                    {"iterations_per_step", iterations_a_step(row)},
                    {"steps", row.time.steps},
                    {"build_s", row.build},
                    {"failure", row.failure.empty() ? Json() : Json(row.failure)}});
  }
  const Json json = {{"rows", rows},
                     {"dense_llt_98_us", 1e6 * result.dense_llt},
                     {"step_s", result.options.step},
                     {"steps", result.options.steps},
                     {"build", build_description()},
                     {"cpu", processor_name()}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace floatframe
