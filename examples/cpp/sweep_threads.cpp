// A parameter study in threads: one Model, which never changes and is shared, one Simulation in
// each thread. Which gain of the controller of control.cpp gives the smallest acceleration? The
// answers do not depend on the number of threads.
//
//   sweep_threads examples/active_damper/active_damper.yaml
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <floatframe/floatframe.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace ff = floatframe;

namespace {

/// Over one second [m/s2]; NaN if a step failed.
double rms_acceleration(const ff::Model& model, double gain) {
  constexpr std::array corners{"front_left", "front_right", "rear_left", "rear_right"};
  ff::Simulation sim(model, {.step = 2e-3});
  double sum = 0.0;
  int steps = 0;
  for (; sim.time() < 1.0; ++steps) {
    for (const std::string corner : corners)
      sim.set_input(corner, std::clamp(gain * sim.output(corner + ".vz"), -8000.0, 8000.0));
    if (!sim.step()) return NAN;
    const double a = sim.output("chassis.az");
    sum += a * a;
  }
  return std::sqrt(sum / steps);
}

std::vector<double> study(const ff::Model& model, const std::vector<double>& gains, int threads) {
  std::vector<double> results(gains.size());
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&] {
      for (std::size_t k; (k = next++) < gains.size();)
        results[k] = rms_acceleration(model, gains[k]);
    });
  workers.clear();  // joins them
  return results;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: sweep_threads MODEL");
  const ff::Model model = ff::load_model(argv[1], {{"flexible", "false"}});
  const std::vector<double> gains{0, 1000, 2000, 4000, 8000};
  const std::vector<double> results = study(model, gains, 4);
  for (std::size_t k = 0; k < gains.size(); ++k)
    std::printf("gain %5.0f N s/m: %.3f m/s2\n", gains[k], results[k]);
  const bool same = study(model, gains, 1) == results;
  std::printf("four threads and one: %s\n", same ? "the same bits" : "DIFFERENT");
  return same ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
