#pragma once
// Names and units of inputs, outputs and parameters, as a handle keeps them: their texts stay where
// they are while models are built anew. A name is found without allocating.
#include <cstdint>
#include <string>
#include <vector>

namespace floatframe {

struct NamedColumn {
  std::string name, unit, about;
};

class NamedColumns {
 public:
  void set(std::vector<NamedColumn> columns);
  std::int32_t count() const noexcept { return std::int32_t(columns_.size()); }
  /// Null: no such index.
  const NamedColumn* at(std::int32_t index) const noexcept {
    return index >= 0 && index < count() ? &columns_[index] : nullptr;
  }
  /// -1: no column of this name, or null.
  std::int32_t find(const char* name) const noexcept;

 private:
  std::vector<NamedColumn> columns_;
  std::vector<std::int32_t> by_name_;
};

}  // namespace floatframe
