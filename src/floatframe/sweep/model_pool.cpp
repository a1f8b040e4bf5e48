#include "floatframe/sweep/model_pool.hpp"

#include <algorithm>

namespace floatframe {

std::shared_ptr<const Model> ModelPool::get(const ModelFingerprint& fingerprint,
                                            const SimulationDescription& simulation,
                                            const std::function<ModelDescription()>& read) {
  std::promise<std::shared_ptr<const Model>> promise;
  Entry entry;
  bool build = false;
  {
    const std::lock_guard lock(mutex_);
    const auto known = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& e) { return e.key == fingerprint.model; });
    if (known != entries_.end()) {
      entries_.splice(entries_.begin(), entries_, known);
    } else {
      build = true;
      ++built_;
      entries_.push_front(
          {fingerprint.model, fingerprint.simulation, promise.get_future().share()});
      if (entries_.size() > capacity_) entries_.pop_back();
    }
    entry = entries_.front();
  }
  if (build) {
    try {
      promise.set_value(std::make_shared<const Model>(build_model(read())));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  std::shared_ptr<const Model> model = entry.model.get();
  if (entry.simulation == fingerprint.simulation) return model;
  auto copy = std::make_shared<Model>(*model);
  copy->simulation = simulation;
  return copy;
}

}  // namespace floatframe
