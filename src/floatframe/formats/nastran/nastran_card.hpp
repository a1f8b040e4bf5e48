#pragma once
// One card of Nastran bulk data: a name and fields.
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

struct NastranCard {
  std::string name;                      ///< upper case, without '*'
  std::vector<std::string_view> fields;  ///< trimmed, from field 2; those of continuations follow
  FeSource at;
  /// First field of each continuation and where it stands.
  std::vector<std::pair<std::size_t, FeSource>> continuations;

  /// Where a field stands.
  FeSource place(std::size_t i) const {
    const auto next = std::upper_bound(continuations.begin(), continuations.end(), i,
                                       [](std::size_t k, const auto& c) { return k < c.first; });
    return next == continuations.begin() ? at : std::prev(next)->second;
  }
  std::string_view field(std::size_t i) const {
    return i < fields.size() ? fields[i] : std::string_view{};
  }
};

}  // namespace floatframe
