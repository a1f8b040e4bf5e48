// Output of the benchmark: tables for people, JSON for programs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "floatframe/apps/command.hpp"
#include "floatframe/bench/bench_iltis.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/text_table.hpp"

namespace floatframe {
namespace {

using Key = std::pair<Coordinates, InertiaMethod>;

/// CPU seconds of Table 1 (machine not stated) at 5, 10, 50 and 100 elements per bar.
std::optional<double> paper_seconds(const BenchRow& row) {
  static const std::map<Key, std::array<double, 4>> table1{
      {{Coordinates::absolute, InertiaMethod::projection}, {4.19, 4.48, 7.58, 12.59}},
      {{Coordinates::absolute, InertiaMethod::preprocessing}, {3.85, 3.85, 3.85, 3.85}},
      {{Coordinates::relative, InertiaMethod::projection}, {1.11, 1.48, 4.32, 8.21}},
      {{Coordinates::relative, InertiaMethod::preprocessing}, {0.79, 0.79, 0.79, 0.79}}};
  const std::array<double, 4>& seconds = table1.at({row.coordinates, row.inertia});
  switch (row.elements_per_bar) {
    case 5:
      return seconds[0];
    case 10:
      return seconds[1];
    case 50:
      return seconds[2];
    case 100:
      return seconds[3];
    default:
      return std::nullopt;
  }
}

double steps_of(const BenchRow& row) { return static_cast<double>(std::max(row.steps, 1L)); }

std::string combination_name(const BenchRow& row) {
  return fmt::format("{} + {}", row.coordinates == Coordinates::absolute ? "Abs." : "Rel.",
                     row.inertia == InertiaMethod::projection ? "B" : "P");
}

std::string table1_text(const BenchResult& result) {
  std::vector<std::string> header{"elements per bar", ""}, totals{"elements in all", ""};
  for (const BenchBuild& build : result.builds) {
    header.push_back(std::to_string(build.elements_per_bar));
    totals.push_back(std::to_string(16 * build.elements_per_bar + 4));
  }
  TextTable table(header, {1});
  table.add(totals);
  const std::size_t n = result.builds.size();
  for (std::size_t first = 0; first + n <= result.rows.size(); first += n) {
    std::vector<std::string> paper{combination_name(result.rows[first]), "paper"};
    std::vector<std::string> least{"", "here, minimum"}, middle{"", "here, median"},
        factor{"", "x real time"};
    for (std::size_t i = first; i < first + n; ++i) {
      const BenchRow& row = result.rows[i];
      const std::optional<double> seconds = paper_seconds(row);
      paper.push_back(seconds ? fmt::format("{:.2f}", *seconds) : "-");
      least.push_back(fmt::format("{:.4f}", row.cpu_min));
      middle.push_back(fmt::format("{:.4f}", row.cpu_median));
      factor.push_back(fmt::format("{:.1f}", row.real_time_factor));
    }
    for (auto* line : {&paper, &least, &middle, &factor}) table.add(*line);
  }
  std::vector<std::string> read{"build", "reading [ms]"}, build{"", "preprocessing [ms]"};
  for (const BenchBuild& b : result.builds) {
    read.push_back(fmt::format("{:.2f}", 1e3 * b.read));
    build.push_back(fmt::format("{:.2f}", 1e3 * b.build));
  }
  table.add(read);
  table.add(build);
  return table.text(2);
}

std::string error_text(const BenchResult& result) {
  TextTable table(
      {"Rel. + P, step [ms]", "seconds", "x real time", "largest error [m]", "of", "at [s]"}, {4});
  for (const BenchError& e : result.errors)
    table.add({fmt::format("{:g}", 1e3 * e.step), fmt::format("{:.4f}", e.cpu_min),
               fmt::format("{:.1f}", e.real_time_factor), fmt::format("{:.1e}", e.error), e.channel,
               fmt::format("{:.4g}", e.time)});
  return table.text(2);
}

std::string work_text(const BenchResult& result) {
  TextTable table({"", "elements per bar", "steps", "by halving", "Newton iterations",
                   "us per iteration", "us per step", "LLTs per step", "positions [m]",
                   "velocities [m/s]"});
  for (const BenchRow& row : result.rows) {
    const double per_iteration = row.cpu_min / static_cast<double>(std::max(row.iterations, 1L));
    const double per_step = row.cpu_min / static_cast<double>(std::max(row.steps, 1L));
    table.add({combination_name(row), std::to_string(row.elements_per_bar),
               std::to_string(row.steps), std::to_string(row.substeps),
               std::to_string(row.iterations), fmt::format("{:.1f}", 1e6 * per_iteration),
               fmt::format("{:.1f}", 1e6 * per_step),
               fmt::format("{:.2f}", per_step / result.dense_llt),
               fmt::format("{:.1e}", row.max_position_violation),
               fmt::format("{:.1e}", row.max_velocity_violation)});
  }
  return table.text(2);
}

}  // namespace

std::string bench_text(const BenchResult& result) {
  return fmt::format(
             "Bombardier Iltis, 12 flexible bodies: {:g} s of manoeuvre at {:g} ms, {}\n"
             "Processor seconds, B projection, P preprocessing; paper: Lugris et al. 2009, Table 1 "
             "(8 s at 10 ms, machine not stated)\n\n",
             result.duration, 1e3 * result.step, plural(result.repeats, "run") + " each") +
         table1_text(result) +
         "\n  x real time: of the minimum. build: once a model, not part of the processor "
         "seconds; preprocessing\n"
         "  is finite elements, modes and constant integrals of all bodies.\n\n" +
         error_text(result) +
         fmt::format("\n  Errors of positions among the outputs, against steps of {:g} ms.\n\n",
                     10.0 * result.step) +
         work_text(result) +
         fmt::format(
             "\n  one dense LLT of a 98 x 98 matrix        {:8.2f} us\n"
             "  one full Newton iteration, Rel. + P      {:8.2f} us = {:.2f} LLTs\n\n  build      "
             "{}\n  processor  {}\n",
             1e6 * result.dense_llt, 1e6 * result.rel_p_iteration,
             result.rel_p_iteration / result.dense_llt, build_description(), processor_name());
}

std::string bench_json(const BenchResult& result) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array(), builds = Json::array(), errors = Json::array();
  for (const BenchRow& row : result.rows) {
    rows.push_back({{"coordinates", word(row.coordinates)},
                    {"inertia", word(row.inertia)},
                    {"elements_per_bar", row.elements_per_bar},
                    {"cpu_s_min", row.cpu_min},
                    {"cpu_s_median", row.cpu_median},
                    {"steps", row.steps},
                    {"substeps", row.substeps},
                    {"iterations", row.iterations},
                    {"factorizations", row.factorizations},
                    {"us_per_step_min", 1e6 * row.cpu_min / steps_of(row)},
                    {"llt_per_step_min", row.cpu_min / steps_of(row) / result.dense_llt},
                    {"real_time_factor", row.real_time_factor},
                    {"max_position_violation_m", row.max_position_violation},
                    {"max_velocity_violation_m_s", row.max_velocity_violation}});
  }
  for (const BenchBuild& build : result.builds) {
    builds.push_back({{"elements_per_bar", build.elements_per_bar},
                      {"read_s", build.read},
                      {"build_s", build.build}});
  }
  for (const BenchError& e : result.errors)
    errors.push_back({{"step_s", e.step},
                      {"cpu_s_min", e.cpu_min},
                      {"real_time_factor", e.real_time_factor},
                      {"error_m", e.error},
                      {"channel", e.channel},
                      {"time_s", e.time}});
  const Json json = {{"rows", rows},
                     {"errors", errors},
                     {"dense_llt_98_us", 1e6 * result.dense_llt},
                     {"rel_p_iteration_us", 1e6 * result.rel_p_iteration},
                     {"preprocessing", builds},
                     {"build", build_description()},
                     {"cpu", processor_name()}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace floatframe
