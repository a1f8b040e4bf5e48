// Cost of a gauge per instant: von Mises stress of a moving bar against its number of modes, with
// and without the contribution of its own inertia and weight. The accelerations are given.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {
namespace {

Model bar(int modes, bool loads) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "floatframe_gauge_bench.yaml";
  std::ofstream(file) << R"(floatframe: 1
points: {hub: [0, 0, 0], tip: [0.8, 0, 0]}
bodies:
  bar:
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7850}
      bars: {bar: {from: hub, to: tip, elements: 30, section: {round: 0.02}}}
      clamped: [hub]
      static_modes: []
      normal_modes: )" << modes
                      << R"(
joints:
  hub: {type: revolute, child: bar, at: hub, axis: z, motion: {polynomial: [0, 20]}}
outputs:
  root: {stress: {body: bar, node: hub, toward: y}, component: von_mises, inertia_loads: )"
                      << (loads ? "true" : "false") << R"(}
simulation: {step: 1e-4, duration: 1}
)";
  const Model model = build_model(read_model(file.string(), {}));
  std::filesystem::remove(file);
  return model;
}

void gauge(benchmark::State& state, Coordinates coordinates) {
  const Model model = bar(static_cast<int>(state.range(0)), state.range(1) != 0);
  SimulationDescription options = model.simulation;
  options.coordinates = coordinates;
  Stepper steps(model, options, {.duration = 1.0});
  std::vector<double> row(2);
  steps.sample(row.data());
  const SystemMotion& motion = steps.formulation().motion({.accelerations = true});
  FollowedOutput last;
  for (auto _ : state) benchmark::DoNotOptimize(output_value(motion, model.outputs[0], last));
}

void gauge_relative(benchmark::State& state) { gauge(state, Coordinates::relative); }
void gauge_absolute(benchmark::State& state) { gauge(state, Coordinates::absolute); }

void sizes_of_gauges(benchmark::internal::Benchmark* b) {
  b->ArgNames({"modes", "loads"});
  for (const int modes : {10, 44})
    for (const int loads : {0, 1}) b->Args({modes, loads});
}

BENCHMARK(gauge_relative)->Apply(sizes_of_gauges);
BENCHMARK(gauge_absolute)->Apply(sizes_of_gauges);

}  // namespace
}  // namespace floatframe
