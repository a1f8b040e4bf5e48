// One model, four ways: absolute and relative coordinates, inertia terms by projection and by
// preprocessing. Prints the tip of a flexible pendulum at the end of the run and the largest
// difference of any sample from the first way: rounding between the inertia methods, and between
// the coordinates that of two discretisations of second order.
//
//   formulations examples/flexible_pendulum/flexible_pendulum.yaml
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <floatframe/floatframe.hpp>
#include <optional>
#include <stdexcept>

namespace ff = floatframe;

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: formulations MODEL");
  const ff::Model model = ff::load_model(argv[1]);
  std::optional<ff::ResultTable> first;
  double largest = 0.0;
  for (const auto coordinates : {ff::Coordinates::relative, ff::Coordinates::absolute})
    for (const auto inertia : {ff::InertiaMethod::preprocessing, ff::InertiaMethod::projection}) {
      ff::SimulationDescription options = model.simulation;
      options.coordinates = coordinates;
      options.inertia = inertia;
      options.duration = 0.5;
      const ff::RunResult result = ff::run(model, options);
      if (result.summary.status != "completed") throw std::runtime_error(result.summary.message);
      const ff::ResultTable& table = result.table;
      if (!first) first = table;
      double difference = 0.0;
      for (std::size_t k = 0; k < table.rows(); ++k)
        difference = std::max(difference, std::abs(table.at(k, table.column("tip.x")) -
                                                   first->at(k, first->column("tip.x"))));
      std::printf("%-8s %-13s tip.x %.6f m, largest difference %s\n",
                  result.summary.coordinates.c_str(), result.summary.inertia.c_str(),
                  table.at(table.rows() - 1, table.column("tip.x")),
                  difference < 5e-5 ? "below 0.05 mm" : "TOO LARGE");
      largest = std::max(largest, difference);
    }
  return largest < 5e-5 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
