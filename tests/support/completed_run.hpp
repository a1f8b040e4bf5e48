#pragma once
// Runs that must come to their end: one that does not fails the test with its message.
#include <stdexcept>

#include "floatframe/run/run.hpp"
#include "support/coordinates.hpp"

namespace floatframe::test {

inline RunResult completed_run(const Model& model, const SimulationDescription& s,
                               const RunOptions& options = {}) {
  RunResult r = run(model, s, options);
  if (r.summary.status != "completed")
    throw std::runtime_error("the run in " + name_of(s.coordinates) + " coordinates has " +
                             r.summary.status + ": " + r.summary.message);
  return r;
}
inline RunResult completed_run(const Model& model) {
  return completed_run(model, model.simulation);
}
inline RunResult completed_run(const ModelDescription& d) { return completed_run(build_model(d)); }

}  // namespace floatframe::test
