#pragma once
// Index of entities by name: a model may have tens of thousands, so that a linear search for each
// reference would be too slow.
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace floatframe {

class NameIndex {
 public:
  NameIndex() = default;
  template <class Entities>
  explicit NameIndex(const Entities& entities) {
    for (const auto& e : entities) add(e.name);
  }
  void add(const std::string& name) {
    places_.emplace(name, names_.size());
    names_.push_back(name);
  }
  /// Position in the order of insertion; of equal names the first.
  std::optional<std::size_t> find(const std::string& name) const {
    const auto it = places_.find(name);
    return it == places_.end() ? std::nullopt : std::optional(it->second);
  }
  /// The same as an index, -1 if there is none.
  int index(const std::string& name) const {
    const auto k = find(name);
    return k ? static_cast<int>(*k) : -1;
  }
  const std::vector<std::string>& names() const noexcept { return names_; }

 private:
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> places_;
};

}  // namespace floatframe
