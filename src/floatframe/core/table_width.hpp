#pragma once
// The width that tables of text (core/text_table.hpp) of this thread should fit into.
#include <cstddef>

namespace floatframe {

namespace detail {
inline thread_local std::size_t table_width = 0;
}

/// While it exists, tables fit into `width` characters; 0: they are as wide as they are.
class FitTables {
 public:
  explicit FitTables(std::size_t width) : before_(detail::table_width) {
    detail::table_width = width;
  }
  ~FitTables() { detail::table_width = before_; }
  FitTables(const FitTables&) = delete;
  FitTables& operator=(const FitTables&) = delete;

 private:
  std::size_t before_;
};

}  // namespace floatframe
