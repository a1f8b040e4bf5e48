#pragma once
// Built models kept by a worker of a study: runs whose values do not change the model itself use
// one, and bodies that they do not change are not reduced again. A model never changes once built;
// each run has a state and a workspace of its own.
#include <functional>
#include <list>
#include <memory>
#include <string>

#include "floatframe/model/build_flexible.hpp"
#include "floatframe/sweep/sweep_case.hpp"

namespace floatframe {

class ModelPool {
 public:
  /// `capacity`: models kept; the one used longest ago goes first.
  explicit ModelPool(std::size_t capacity) : capacity_(capacity) {}

  /// The model of a run, built from what `read` returns if it is not there. Where only the group
  /// `simulation` differs, the result is a copy with the run's own options that shares all reduced
  /// bodies. Throws what `read` and `build_model` throw.
  std::shared_ptr<const Model> get(const ModelFingerprint& fingerprint,
                                   const SimulationDescription& simulation,
                                   const std::function<ModelDescription()>& read);

 private:
  struct Entry {
    std::string key, simulation;
    std::shared_ptr<const Model> model;
  };
  /// Bodies kept beyond models: of a study that varies them no more are kept than this.
  static constexpr std::size_t most_bodies = 100;

  std::size_t capacity_;
  FlexibleBuilder bodies_;
  std::list<Entry> entries_;  ///< the one used last in front
};

}  // namespace floatframe
