#include "floatframe/bench/bench_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "floatframe/apps/command.hpp"
#include "floatframe/bench/bench_stepper.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/core/thread_clock.hpp"

namespace floatframe {
namespace {

StartRow measured(StartKind kind, bool flexible, Coordinates coordinates, int count, int runs) {
  StartRow row;
  row.kind = kind;
  row.flexible = flexible;
  row.coordinates = coordinates;
  row.count = count;
  const Model model = build_model(start_model(kind, flexible, count));
  SimulationDescription o = model.simulation;
  o.coordinates = coordinates;
  try {
    std::unique_ptr<BenchStepper> stepper;
    row.start = row.step = std::numeric_limits<double>::infinity();
    double spent = 0.0;
    for (int run = 0; run < runs && (run == 0 || spent < 2.0); ++run) {
      const double before = thread_seconds();
      stepper = std::make_unique<BenchStepper>(model, o);
      const double time = thread_seconds() - before;
      row.start = std::min(row.start, time);
      spent += time;
    }
    row.freedoms = stepper->freedoms();
    for (int k = 0; k < 5; ++k) {
      const double before = thread_seconds();
      if (!stepper->advance(1)) throw RunError(ErrorCode::step_failed, stepper->failure());
      row.step = std::min(row.step, thread_seconds() - before);
    }
  } catch (const RunError& e) {
    row.failure = e.what();
  }
  return row;
}

/// Approximate number of coordinates of one link, field or vehicle.
int coordinates_of_one(StartKind kind, bool flexible, Coordinates coordinates) {
  const Model model = build_model(start_model(kind, flexible, 1));
  SimulationDescription o = model.simulation;
  o.coordinates = coordinates;
  return std::max(1, std::make_unique<BenchStepper>(model, o)->freedoms());
}

const char* stiffness(bool flexible) { return flexible ? "flexible" : "rigid"; }

}  // namespace

StartResult bench_start(const StartOptions& options) {
  StartResult result{options, {}};
  constexpr int sizes = 4;
  const double series =
      2.0 * static_cast<double>(options.kinds.size() * options.coordinates.size());
  double done = 0.0;
  for (const StartKind kind : options.kinds)
    for (const bool flexible : {false, true})
      for (const Coordinates coordinates : options.coordinates) {
        const int one = coordinates_of_one(kind, flexible, coordinates);
        for (int k = 0; k < sizes; ++k) {
          const double freedoms =
              options.least *
              std::pow(static_cast<double>(options.most) / options.least, k / (sizes - 1.0));
          const int count = std::max(1, static_cast<int>(std::lround(freedoms / one)));
          result.rows.push_back(measured(kind, flexible, coordinates, count, options.runs));
          if (options.progress) options.progress(100.0 * (done + (k + 1.0) / sizes) / series);
        }
        done += 1.0;
      }
  return result;
}

double exponent(const std::vector<StartRow>& series) {
  if (series.empty()) return 0.0;
  const StartRow &a = series.front(), &b = series.back();
  if (a.freedoms == b.freedoms) return 0.0;
  return std::log(b.start / a.start) / std::log(static_cast<double>(b.freedoms) / a.freedoms);
}

std::string start_text(const StartResult& result) {
  TextTable table({"model", "", "coordinates", "number", "freedoms", "start [ms]", "step [ms]",
                   "allowed [ms]", "exponent"},
                  {3, 4, 5, 6, 7, 8});
  std::vector<StartRow> series;
  for (const StartRow& r : result.rows) {
    if (!series.empty() && (series[0].kind != r.kind || series[0].flexible != r.flexible ||
                            series[0].coordinates != r.coordinates))
      series.clear();
    series.push_back(r);
    if (!r.failure.empty()) {
      table.add({word(r.kind), stiffness(r.flexible), word(r.coordinates),
                 fmt::format("{}", r.count), "failed: " + r.failure});
      continue;
    }
    table.add({word(r.kind), stiffness(r.flexible), word(r.coordinates), fmt::format("{}", r.count),
               fmt::format("{}", r.freedoms), fmt::format("{:.3g}", 1e3 * r.start),
               fmt::format("{:.3g}", 1e3 * r.step),
               fmt::format("{:.3g}{}", 1e3 * r.allowed(), r.start > r.allowed() ? " exceeded" : ""),
               r.freedoms > series[0].freedoms ? fmt::format("{:.2f}", exponent(series)) : ""});
  }
  return table.text() +
         "\nFrom the built model to the first step, processor time. Allowed: the time of 20 steps, "
         "2 ms and 50 us\nfor each coordinate. The exponent is that from the first row of a "
         "series.\n";
}

std::string start_json(const StartResult& result) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const StartRow& r : result.rows)
    rows.push_back({{"model", word(r.kind)},
                    {"flexible", r.flexible},
                    {"coordinates", word(r.coordinates)},
                    {"number", r.count},
                    {"freedoms", r.freedoms},
                    {"start_s", r.start},
                    {"step_s", r.step},
                    {"allowed_s", r.allowed()},
                    {"failure", r.failure}});
  const nlohmann::ordered_json json = {
      {"rows", rows}, {"build", build_description()}, {"cpu", processor_name()}};
  return json.dump(2) + '\n';
}

}  // namespace floatframe
