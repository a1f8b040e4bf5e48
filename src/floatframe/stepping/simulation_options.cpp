#include "floatframe/stepping/simulation_options.hpp"

#include "floatframe/description/validate.hpp"

namespace floatframe {

SimulationDescription described(const Model& model, const SimulationOptions& options) {
  SimulationDescription d = model.simulation;
  const auto set = [&d](const char* key, auto& value, const auto& wanted) {
    if (!wanted) return;
    value = *wanted;
    d.given_by("", key);
  };
  set("step", d.step, options.step);
  set("coordinates", d.coordinates, options.coordinates);
  set("inertia", d.inertia, options.inertia);
  if (options.state) {
    d.state = options.state;
    d.start = Start::state;
  }
  set("start", d.start, options.start);
  set("tolerance", d.tolerance, options.tolerance);
  set("spectral_radius", d.spectral_radius, options.spectral_radius);
  set("max_iterations", d.max_iterations, options.max_iterations);
  set("min_step", d.min_step, options.min_step);
  set("penalty", d.penalty, options.penalty);
  set("position_tolerance", d.position_tolerance, options.position_tolerance);
  set("velocity_tolerance", d.velocity_tolerance, options.velocity_tolerance);
  set("locate_edges", d.locate_edges, options.locate_edges);
  set("input", d.input, options.input);
  require_valid(d);
  return d;
}

}  // namespace floatframe
