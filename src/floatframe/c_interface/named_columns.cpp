#include "floatframe/c_interface/named_columns.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>

namespace floatframe {

void NamedColumns::set(std::vector<NamedColumn> columns) {
  columns_ = std::move(columns);
  by_name_.resize(columns_.size());
  std::iota(by_name_.begin(), by_name_.end(), 0);
  std::ranges::sort(by_name_, {},
                    [this](std::int32_t k) { return std::string_view(columns_[k].name); });
}

std::int32_t NamedColumns::find(const char* name) const noexcept {
  if (name == nullptr) return -1;
  const auto name_of = [this](std::int32_t k) { return std::string_view(columns_[k].name); };
  const auto found = std::ranges::lower_bound(by_name_, std::string_view(name), {}, name_of);
  return found != by_name_.end() && name_of(*found) == name ? *found : -1;
}

}  // namespace floatframe
