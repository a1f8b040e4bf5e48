#pragma once
// Built models, shared by the threads of a study: runs whose values do not change the model itself
// use one. A model never changes once built; each run has a state and a workspace of its own.
#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "floatframe/model/model.hpp"
#include "floatframe/sweep/sweep_case.hpp"

namespace floatframe {

class ModelPool {
 public:
  /// `capacity`: models kept; the one used longest ago goes first.
  explicit ModelPool(std::size_t capacity) : capacity_(capacity) {}

  /// The model of a run, built by the first thread that asks for it from what `read` returns while
  /// the others wait. Where only the group `simulation` differs, the result is a copy with the
  /// run's own options that shares all reduced bodies. Throws what `read` and `build_model` throw.
  std::shared_ptr<const Model> get(const ModelFingerprint& fingerprint,
                                   const SimulationDescription& simulation,
                                   const std::function<ModelDescription()>& read);

  /// Models built so far.
  std::uint64_t built() const noexcept { return built_; }

 private:
  struct Entry {
    std::string key, simulation;
    std::shared_future<std::shared_ptr<const Model>> model;
  };
  std::size_t capacity_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the one used last in front
  std::atomic<std::uint64_t> built_ = 0;
};

}  // namespace floatframe
