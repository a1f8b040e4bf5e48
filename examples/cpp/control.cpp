// A model file stepped with a controller in the loop: skyhook damping of the Iltis, whose four
// actuators pull down where the chassis moves up. Prints the root mean square of the vertical
// acceleration without and with it, and goes back to a saved state.
//
//   control examples/active_damper/active_damper.yaml
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <floatframe/floatframe.hpp>
#include <stdexcept>
#include <string>

namespace ff = floatframe;

namespace {

void step(ff::Simulation& sim, double gain) {
  constexpr std::array corners{"front_left", "front_right", "rear_left", "rear_right"};
  for (const std::string corner : corners)
    sim.set_input(corner, std::clamp(gain * sim.output(corner + ".vz"), -8000.0, 8000.0));
  if (const ff::StepReport r = sim.step(); !r) throw std::runtime_error(sim.failure());
}

/// Over two seconds [m/s2].
double rms_acceleration(ff::Simulation& sim, double gain) {
  double sum = 0.0;
  for (int k = 0; k < 2000; ++k) {
    step(sim, gain);
    const double a = sim.output("chassis.az");
    sum += a * a;
  }
  return std::sqrt(sum / 2000);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: control MODEL");
  const ff::Model model = ff::load_model(argv[1], {{"flexible", "false"}, {"speed", "8"}});
  ff::Simulation sim(model, {.step = 1e-3, .coordinates = ff::Coordinates::relative});
  const ff::SimulationState start = sim.save();

  const double passive = rms_acceleration(sim, 0.0);
  sim.restore(start);
  const double active = rms_acceleration(sim, 3000.0);
  sim.restore(start);
  const bool same = rms_acceleration(sim, 0.0) == passive;

  std::printf("rms of the acceleration: passive %.3f m/s2, active %.3f m/s2\n", passive, active);
  std::printf("from the saved state: %s\n", same ? "the same bits" : "DIFFERENT");
  return active < passive && same ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
