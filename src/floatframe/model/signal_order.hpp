#pragma once
// The order in which elements are evaluated, so that signals from element to element are known when
// they are needed. Lengths and rates follow from the motion alone: only forces and values of
// controllers make an element depend on another one; a sampled one only at its instants. Load time.
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// Elements that depend on each other in a ring, or one element.
struct SignalGroup {
  std::vector<std::size_t> elements;
  std::vector<std::size_t> links;  ///< between them; none: one element that is in no ring
};

struct SignalOrder {
  explicit SignalOrder(const Model& model);

  /// Of all elements with laws, each after those it depends on, else in the order of the model.
  std::vector<SignalGroup> groups;
  /// Elements whose length or rate is a signal.
  std::vector<std::size_t> measured;
  /// Sampled elements in the order of their signals at an instant; in a ring, in that of the model.
  std::vector<std::size_t> sampled;
  /// The first ring without a state, whose signals no law delays; empty: none.
  std::vector<std::size_t> ring;
};

}  // namespace floatframe
