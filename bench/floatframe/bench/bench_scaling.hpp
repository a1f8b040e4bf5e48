#pragma once
// Scaling of the cost of a step: chains of flexible links with more elements, more interface nodes,
// more modes, more bodies.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/bench/bench_chain.hpp"

namespace floatframe {

enum class Sweep { elements, interface_nodes, modes, bodies };
inline constexpr Sweep all_sweeps[] = {Sweep::elements, Sweep::interface_nodes, Sweep::modes,
                                       Sweep::bodies};
/// "elements", "interface-nodes", "modes", "bodies"
const char* word(Sweep sweep) noexcept;

struct ScalingRow {
  Sweep sweep = Sweep::elements;
  /// Value of the varied quantity: elements per link, nodes of an end face, modes per link, links.
  int value = 0;
  int links = 0, modes = 0;
  int elements = 0;             ///< finite elements per link
  int finite_element_dofs = 0;  ///< of a link, before reduction
  Combination combination{Coordinates::relative, InertiaMethod::preprocessing};
  int freedoms = 0;  ///< velocities of the formulation
  StepTime time;
  double iteration = 0;  ///< one full Newton iteration at the start [s]
  double build = 0;      ///< [s] finite elements, modes and constant integrals
  std::string failure;
};

struct ScalingOptions {
  std::vector<Sweep> sweeps{std::begin(all_sweeps), std::end(all_sweeps)};
  std::vector<Coordinates> coordinates{Coordinates::relative, Coordinates::absolute};
  std::vector<InertiaMethod> inertia{InertiaMethod::preprocessing};
  double step = 1e-3;    ///< [s]
  int steps = 100;       ///< of every run
  int runs = 5;          ///< minimum number of timed runs of a row
  double seconds = 0.5;  ///< approximate processor time for the timed runs of a row
  std::function<void(double)> progress;
};

struct ScalingResult {
  ScalingOptions options;
  std::vector<ScalingRow> rows;
  double dense_llt = 0;  ///< [s], 98 x 98
};

/// A chain whose links are `across` x `across` x 50 bricks, six static and two normal modes.
ModelDescription solid_chain(int links, int across);

/// A failed run is reported in its row; the others continue.
ScalingResult bench_scaling(const ScalingOptions& options);

std::string scaling_text(const ScalingResult& result);
std::string scaling_json(const ScalingResult& result);

}  // namespace floatframe
