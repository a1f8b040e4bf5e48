#pragma once
// Cache of built models in a worker of a study: runs whose values do not change the model share
// one, and unchanged bodies are not reduced again. A model never changes once built; each run has a
// separate state and workspace.
#include <functional>
#include <list>
#include <memory>
#include <string>

#include "floatframe/model/build_flexible.hpp"
#include "floatframe/sweep/sweep_case.hpp"

namespace floatframe {

class ModelPool {
 public:
  /// `capacity`: number of models kept; the least recently used is dropped first.
  explicit ModelPool(std::size_t capacity) : capacity_(capacity) {}

  /// The model of a run, built from the result of `read` if it is not in the pool. Where only the
  /// group `simulation` differs, the result is a copy with the run's options that shares all
  /// reduced bodies. Throws what `read` and `build_model` throw.
  std::shared_ptr<const Model> get(const ModelFingerprint& fingerprint,
                                   const SimulationDescription& simulation,
                                   const std::function<ModelDescription()>& read);

 private:
  struct Entry {
    std::string key, simulation;
    std::shared_ptr<const Model> model;
  };
  /// Limit for bodies not used by a kept model, for studies that vary bodies.
  static constexpr std::size_t most_bodies = 100;

  std::size_t capacity_;
  FlexibleBuilder bodies_;
  std::list<Entry> entries_;  ///< most recently used first
};

}  // namespace floatframe
