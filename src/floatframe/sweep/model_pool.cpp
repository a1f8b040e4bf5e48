#include "floatframe/sweep/model_pool.hpp"

#include <algorithm>

namespace floatframe {

std::shared_ptr<const Model> ModelPool::get(const ModelFingerprint& fingerprint,
                                            const SimulationDescription& simulation,
                                            const std::function<ModelDescription()>& read) {
  // The formula that ends runs is connected to its model.
  const std::string key = fingerprint.model + (simulation.until ? simulation.until->text : "");
  const auto known =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
  if (known != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, known);
  } else {
    if (entries_.size() >= capacity_) entries_.pop_back();  // before the insertion, for its memory
    if (bodies_.reduced() > most_bodies) bodies_ = {};
    auto model = std::make_shared<const Model>(build_model(read(), bodies_));
    entries_.push_front({key, fingerprint.simulation, std::move(model)});
  }
  const Entry& entry = entries_.front();
  if (entry.simulation == fingerprint.simulation) return entry.model;
  auto copy = std::make_shared<Model>(*entry.model);
  copy->simulation = simulation;
  return copy;
}

}  // namespace floatframe
