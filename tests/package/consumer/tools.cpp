// Uses the tools: a run with its files, a result, and an error that is thrown by them.
#include <cstdio>
#include <floatframe/floatframe.hpp>

int main(int, char** argv) {
  namespace ff = floatframe;
  const ff::Model model = ff::load_model(argv[1]);
  ff::SimulationDescription options = model.simulation;
  options.duration = 0.1;
  const ff::KeptRun run = ff::run_and_keep(model, options);
  ff::save_run(model, run, argv[2]);
  std::printf("mass %.1f kg\n", ff::mass_properties(model).mass);
  try {
    ff::grid_plan({"speed"});
  } catch (const ff::InputError& error) {
    std::printf("caught: %s\n", error.what());
    return 0;
  }
  return 1;
}
