#include "floatframe/bench/bench_scaling.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/bench/chain_model.hpp"
#include "floatframe/bench/solid_link.hpp"
#include "floatframe/core/thread_clock.hpp"
#include "floatframe/math/dense_factorization.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

constexpr int usual_links = 4, usual_modes = 8, usual_elements = 20;
constexpr int bricks_along = 50;

struct Point {
  ScalingRow row;
  ModelDescription description;
};

Point beam_point(Sweep sweep, int value, int links, int modes, int elements) {
  Point p;
  p.row.sweep = sweep;
  p.row.value = value;
  p.row.links = links;
  p.row.modes = modes;
  p.row.elements = elements;
  p.row.finite_element_dofs = 6 * (elements + 1);
  p.description = chain_model(links, modes, elements);
  return p;
}

Point solid_point(int across) {
  Point p;
  const int face = (across + 1) * (across + 1);
  p.row.sweep = Sweep::interface_nodes;
  p.row.value = face;
  p.row.links = usual_links;
  p.row.modes = usual_modes;
  p.row.elements = across * across * bricks_along + 2 * face;
  // Bricks have three dofs per node; the centres and, through the beams, the face nodes have six.
  p.row.finite_element_dofs = 3 * face * (bricks_along + 1) + 3 * 2 * face + 2 * 6;
  p.description = solid_chain(usual_links, across);
  return p;
}

/// Points are described one at a time: a large mesh needs a large description.
std::vector<std::function<Point()>> points(Sweep sweep) {
  std::vector<std::function<Point()>> list;
  switch (sweep) {
    case Sweep::elements:
      for (const int n : {5, 20, 100, 1000, 5000, 16700})
        list.push_back([=] { return beam_point(sweep, n, usual_links, usual_modes, n); });
      break;
    case Sweep::interface_nodes:
      for (const int across : {1, 3, 5, 7, 9}) list.push_back([=] { return solid_point(across); });
      break;
    case Sweep::modes:
      for (const int modes : {4, 8, 16, 32, 64})
        list.push_back([=] { return beam_point(sweep, modes, usual_links, modes, 40); });
      break;
    case Sweep::bodies:
      for (const int links : {1, 2, 4, 8, 16, 32, 64, 128, 256})
        list.push_back(
            [=] { return beam_point(sweep, links, links, usual_modes, usual_elements); });
      break;
  }
  return list;
}

void measure_part(const Model& model, const SimulationDescription& simulation,
                  const ScalingOptions& options, ScalingRow& row) {
  const auto stepper = std::make_unique<BenchStepper>(model, simulation);
  row.freedoms = stepper->freedoms();
  row.iteration = time_iteration(*stepper, 0.5 * options.seconds);
  try {
    // Fewer steps if a step takes long: a run should take at most 5 times the intended time.
    const double first = time_steps(*stepper, 1, 1, 0.0).least;
    const double most = std::clamp(5.0 * options.seconds / std::max(first, 1e-9), 1.0, 1e6);
    row.time = time_steps(*stepper, std::min<long>(options.steps, round_steps(std::lround(most))),
                          options.runs, options.seconds);
  } catch (const RunError& error) {
    row.failure = error.what();
    return;
  }
  // Repeated some time later: a disturbance may last longer than a measurement.
  stepper->restart();
  row.iteration = std::min(row.iteration, time_iteration(*stepper, 0.5 * options.seconds));
}

}  // namespace

const char* word(Sweep sweep) noexcept {
  switch (sweep) {
    case Sweep::elements:
      return "elements";
    case Sweep::interface_nodes:
      return "interface-nodes";
    case Sweep::modes:
      return "modes";
    case Sweep::bodies:
      return "bodies";
  }
  return "";
}

ModelDescription solid_chain(int links, int across) {
  ReductionOptions options;
  options.clamped = {{"start", all_dofs}};
  options.interfaces = {{"end", all_dofs}};
  options.normal_modes = 2;
  return chain_model(links, reduce(solid_link(across, bricks_along), options));
}

ScalingResult bench_scaling(const ScalingOptions& options) {
  ScalingResult result;
  result.options = options;
  result.dense_llt = dense_factorization_seconds(98);
  std::vector<std::function<Point()>> list;
  for (const Sweep sweep : options.sweeps) {
    for (const auto& point : points(sweep)) list.push_back(point);
  }
  double done = 0.0;
  for (const auto& make : list) {
    const double before = thread_seconds();
    Point point = make();
    const Model model = build_model(point.description);
    point.row.build = thread_seconds() - before;
    SimulationDescription simulation = model.simulation;
    simulation.step = options.step;
    simulation.spectral_radius = chain_spectral_radius;
    for (const Coordinates coordinates : options.coordinates) {
      for (const InertiaMethod inertia : options.inertia) {
        simulation.coordinates = coordinates;
        simulation.inertia = inertia;
        ScalingRow row = point.row;
        row.combination = {coordinates, inertia};
        measure_part(model, simulation, options, row);
        result.rows.push_back(row);
      }
    }
    done += 1.0;
    if (options.progress) options.progress(done / static_cast<double>(list.size()));
  }
  result.dense_llt = std::min(result.dense_llt, dense_factorization_seconds(98));
  return result;
}

}  // namespace floatframe
