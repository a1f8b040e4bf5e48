// The `simulation` group: how the model is run.
#include "floatframe/io/read_parts.hpp"

namespace floatframe {

void read_simulation(const ModelInstance& self, ReadModel& model) {
  if (!self.root) return;
  YamlSection root = *self.root;
  const auto value = root.get("simulation");
  if (!value) return;
  auto section = value->section("a map with step, duration, ...");
  if (!section) return;
  YamlSection& s = *section;
  SimulationDescription& d = model.description.simulation;
  if (const auto v = s.get("coordinates"))
    if (const auto w = v->word({"relative", "absolute"}))
      d.coordinates = static_cast<Coordinates>(*w);
  if (const auto v = s.get("inertia"))
    if (const auto w = v->word({"preprocessing", "projection"}))
      d.inertia = static_cast<InertiaMethod>(*w);
  if (const auto v = s.get("start"))
    if (const auto w = v->word({"given", "equilibrium"})) d.start = static_cast<Start>(*w);
  if (const auto v = s.get("velocity"))
    if (const auto x = v->vector("m/s")) d.velocity = *x;
  d.step = s.number("step", positive_number("s"), d.step);
  d.duration = s.number("duration", non_negative_number("s"), d.duration);
  d.output_interval = s.number("output_interval", non_negative_number("s"), d.output_interval);
  const NumberRule radius{"a number from 0 to 1", "", 0.0, 1.0};
  d.spectral_radius = s.number("spectral_radius", radius, d.spectral_radius);
  d.tolerance = s.number("tolerance", positive_number(""), d.tolerance);
  if (const auto v = s.get("max_iterations"))
    d.max_iterations = v->integer(1, 1000, "a number of iterations").value_or(d.max_iterations);
  d.min_step = s.number("min_step", non_negative_number("s"), d.min_step);
  if (d.min_step > d.step)
    s.get("min_step")
        ->fault("found " + number_text(d.min_step) + ", expected at most the step, " +
                number_text(d.step) + " [s]");
  d.penalty = s.number("penalty", non_negative_number(""), d.penalty);
  d.position_tolerance = s.number("position_tolerance", positive_number("m"), d.position_tolerance);
  d.velocity_tolerance =
      s.number("velocity_tolerance", positive_number("m/s"), d.velocity_tolerance);
  s.finish();
}

}  // namespace floatframe
