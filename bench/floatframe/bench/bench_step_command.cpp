// floatframe bench step: makes the steps of a run and nothing else, for profiling tools (callgrind,
// perf). All steps are made inside one function with a fixed name, floatframe_counted_steps, by
// which a tool can switch counting on and off.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/bench/bench_command.hpp"
#include "floatframe/bench/bench_scaling.hpp"
#include "floatframe/bench/bench_stepper.hpp"
#include "floatframe/bench/chain_model.hpp"
#include "floatframe/bench/law_model.hpp"
#include "floatframe/bench/start_models.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"

extern "C" [[gnu::noinline]] bool floatframe_counted_steps(floatframe::BenchStepper* stepper,
                                                           long steps, long iterations) noexcept {
  stepper->iterate(iterations);
  return stepper->advance(steps);
}

/// From the built model to the first step, for the same tools.
extern "C" [[gnu::noinline]] floatframe::BenchStepper* floatframe_counted_start(
    const floatframe::Model* model, const floatframe::SimulationDescription* options) {
  return std::make_unique<floatframe::BenchStepper>(*model, *options).release();
}

namespace floatframe {
namespace {

struct StepArguments {
  std::string model = "chain", step, duration, tolerance, spectral_radius, coordinates, inertia;
  std::string json_file;
  bool overwrite = false;
  std::vector<std::string> settings;
  bool inputs_jump = false;
  int links = 4, modes = 8, elements = 20, across = 0, iterations = 0;
};

ModelDescription described(const StepArguments& a) {
  if (a.model == "chain") {
    if (a.across > 0) {
      ModelDescription d = solid_chain(a.links, a.across);
      d.simulation.spectral_radius = chain_spectral_radius;
      return d;
    }
    const int most = largest_chain_modes(a.elements);
    if (a.modes > most)
      throw InputError(ErrorCode::out_of_range,
                       fmt::format("--modes: found {}, expected at most {} with {} per link",
                                   a.modes, most, plural(a.elements, "element")));
    ModelDescription d = chain_model(a.links, a.modes, a.elements);
    d.simulation.spectral_radius = chain_spectral_radius;
    return d;
  }
  if (a.model == "laws" || a.model == "formulas") return law_model(a.model == "formulas");
  for (const StartKind kind : all_start_kinds)
    if (a.model == word(kind)) return start_model(kind, false, a.links);
  ModelArguments arguments;
  arguments.path = a.model == "iltis" ? find_iltis() : a.model;
  arguments.settings = a.settings;
  return read_model(arguments);
}

int run_steps(const StepArguments& a) {
  ModelDescription description = described(a);
  SimulationDescription& o = description.simulation;
  set_time_options(o, a.step, a.duration);
  if (!a.tolerance.empty()) o.tolerance = number_within("--tolerance", a.tolerance, 0.0, 1.0);
  if (!a.spectral_radius.empty())
    o.spectral_radius = number_within("--spectral-radius", a.spectral_radius, 0.0, 1.0);
  if (!a.coordinates.empty()) o.coordinates = coordinates_from(a.coordinates);
  if (!a.inertia.empty()) o.inertia = inertia_from(a.inertia);
  require_writable({{"--json", a.json_file}}, {a.model}, a.overwrite);
  check_inertia_method(description, o.inertia);
  const Model model = build_model(description);
  if (a.inputs_jump && model.inputs.empty())
    throw InputError(ErrorCode::missing,
                     "--inputs-jump: found a model without inputs, expected one with some");
  const std::unique_ptr<BenchStepper> stepper(floatframe_counted_start(&model, &o));
  if (a.inputs_jump) stepper->jump_inputs();
  const long steps = a.iterations > 0 ? 0 : std::max(1L, std::lround(o.duration / o.step));
  if (!floatframe_counted_steps(stepper.get(), steps, a.iterations))
    throw RunError(ErrorCode::step_failed, stepper->failure());
  const StepCounters c = stepper->counts();
  if (!a.json_file.empty()) {
    const nlohmann::ordered_json json = {{"model", model.name},
                                         {"coordinates", word(o.coordinates)},
                                         {"inertia", word(o.inertia)},
                                         {"step_s", o.step},
                                         {"steps", c.steps},
                                         {"substeps", c.substeps},
                                         {"iterations", c.iterations},
                                         {"factorizations", c.factorizations},
                                         {"full_iterations", a.iterations},
                                         {"build", build_description()},
                                         {"cpu", processor_name()}};
    write_file(a.json_file, json.dump(2) + '\n');
  }
  if (a.iterations > 0) {
    print(fmt::format("{}, {} coordinates, inertia terms by {}: {} at the start\n", model.name,
                      word(o.coordinates), word(o.inertia),
                      plural(a.iterations, "full iteration")));
    return 0;
  }
  print(fmt::format("{}, {} coordinates, inertia terms by {}: {} of {:g} ms, {}, {}\n", model.name,
                    word(o.coordinates), word(o.inertia), plural(c.steps, "step"), 1e3 * o.step,
                    plural(c.iterations, "iteration"), plural(c.factorizations, "factorisation")));
  return 0;
}

}  // namespace

Command bench_step_command() {
  const auto a = std::make_shared<StepArguments>();
  return {
      .name = "step",
      .help = "Only the steps of a run, for a profiler or an instruction counter",
      .options =
          {text_position("MODEL", a->model,
                         "chain (default), ladder or vehicles (rigid, as in bench start), laws or "
                         "formulas (masses on the same springs), iltis or a model file"),
           repeated_option("--set", a->settings, "NAME=VALUE",
                           "Change a parameter of the model file; may be repeated"),
           whole_option("--links", a->links, 1, 4096,
                        "Links of the chain (default 4), fields of the ladder, vehicles"),
           whole_option("--modes", a->modes, 1, 1000, "Modes per link of the chain (default 8)"),
           whole_option("--elements", a->elements, 1, 100000,
                        "Elements per link of the chain (default 20)"),
           whole_option("--iterations", a->iterations, 1, 1000000,
                        "Instead of steps, N full Newton iterations at the start"),
           one_of({"1", "3", "5", "7", "9"},
                  whole_option("--bricks", a->across, 1, 9,
                               "Links of N x N x 50 bricks with (N + 1)^2 nodes of each end tied "
                               "to the joint")),
           text_option("--step", a->step, "SECONDS", "Time step [s]; default: that of the model"),
           text_option("--duration", a->duration, "SECONDS",
                       "Time to simulate [s]; default: that of the model"),
           flag("--inputs-jump", a->inputs_jump,
                "All inputs of the model jump before each step, to and fro by 1 % of their range"),
           coordinates_option(a->coordinates, "relative or absolute; default: that of the model"),
           inertia_option(a->inertia, "preprocessing or projection; default: that of the model"),
           text_option("--tolerance", a->tolerance, "NUMBER",
                       "Newton tolerance; default: that of the model"),
           text_option("--spectral-radius", a->spectral_radius, "NUMBER",
                       "Spectral radius at infinite frequency; default: that of the model"),
           text_option("--json", a->json_file, "FILE", "Write the counts to this file as JSON"),
           overwrite_option(a->overwrite)},
      .footer =
          "All steps are made inside the function floatframe_counted_steps, for instance:\n"
          "valgrind --tool=callgrind --toggle-collect=floatframe_counted_steps \\\n"
          "  floatframe bench step chain --duration 0.1",
      .run = [a] { return run_steps(*a); }};
}

}  // namespace floatframe
