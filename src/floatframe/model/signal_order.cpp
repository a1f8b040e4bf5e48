// Rings by Tarjan's algorithm, which ends a ring after all that it depends on.
#include "floatframe/model/signal_order.hpp"

#include <algorithm>

namespace floatframe {

namespace {

class Rings {
 public:
  Rings(const Model& model, bool at_samples)
      : links_(model.links),
        before_(model.elements.size()),
        number_(model.elements.size(), -1),
        lowest_(model.elements.size(), -1),
        open_(model.elements.size(), false) {
    for (std::size_t l = 0; l < links_.size(); ++l)
      if (links_[l].quantity == ElementQuantity::force &&
          (at_samples || !model.elements[links_[l].to].clock.ticks()))
        before_[links_[l].to].push_back(l);
    for (std::size_t k = 0; k < model.elements.size(); ++k)
      if (model.elements[k].acts && number_[k] < 0) visit(k);
  }
  std::vector<SignalGroup> groups;

 private:
  void visit(std::size_t k) {
    number_[k] = lowest_[k] = count_++;
    open_[k] = true;
    stack_.push_back(k);
    for (const std::size_t l : before_[k]) {
      const std::size_t from = links_[l].from;
      if (number_[from] < 0) visit(from);
      if (open_[from]) lowest_[k] = std::min(lowest_[k], lowest_[from]);
    }
    if (lowest_[k] != number_[k]) return;
    SignalGroup group;
    do {
      group.elements.push_back(stack_.back());
      open_[stack_.back()] = false;
      stack_.pop_back();
    } while (group.elements.back() != k);
    std::sort(group.elements.begin(), group.elements.end());
    for (const std::size_t to : group.elements)
      for (const std::size_t l : before_[to])
        if (std::binary_search(group.elements.begin(), group.elements.end(), links_[l].from))
          group.links.push_back(l);
    groups.push_back(std::move(group));
  }

  const std::vector<SignalLink>& links_;
  std::vector<std::vector<std::size_t>> before_;  ///< links to each element
  std::vector<int> number_, lowest_;
  std::vector<bool> open_;
  std::vector<std::size_t> stack_;
  int count_ = 0;
};

/// One ring of a group, each element after one that it depends on.
std::vector<std::size_t> ring_in(const Model& model, const SignalGroup& group) {
  std::vector<std::size_t> way{group.elements.front()};
  while (true) {  // backwards along any signal
    std::size_t before = way.back();
    for (const std::size_t l : group.links) {
      const std::size_t to = model.links[l].to;
      if (to == way.back()) before = model.links[l].from;
    }
    const auto seen = std::find(way.begin(), way.end(), before);
    if (seen != way.end()) {
      way.erase(way.begin(), seen);
      std::reverse(way.begin(), way.end());
      return way;
    }
    way.push_back(before);
  }
}

}  // namespace

SignalOrder::SignalOrder(const Model& model) : groups(Rings(model, false).groups) {
  for (const SignalGroup& group : Rings(model, true).groups)
    for (const std::size_t k : group.elements)
      if (model.elements[k].clock.ticks()) sampled.push_back(k);
  for (const SignalLink& link : model.links)
    if (link.quantity != ElementQuantity::force) measured.push_back(link.from);
  std::sort(measured.begin(), measured.end());
  measured.erase(std::unique(measured.begin(), measured.end()), measured.end());
  for (const SignalGroup& group : groups) {
    const bool delayed = std::any_of(group.elements.begin(), group.elements.end(),
                                     [&](std::size_t k) { return model.elements[k].states > 0; });
    if (!group.links.empty() && !delayed && ring.empty()) ring = ring_in(model, group);
  }
}

}  // namespace floatframe
