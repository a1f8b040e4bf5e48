#pragma once
// Errors of a model, of which one mistake may make thousands.
#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

/// Errors, at most 20 of a kind, then their number.
class LimitedErrors {
 public:
  void add(ErrorCode code, const char* kind, const SourceMark& mark, std::string text) {
    if (++count_[kind] <= most_of_a_kind) errors_.add(code, mark, std::move(text));
  }
  /// With a text of fmt and its values.
  template <class First, class... Rest>
  void add(ErrorCode code, const char* kind, const SourceMark& mark,
           fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
    add(code, kind, mark,
        fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  bool empty() const { return errors_.empty(); }
  void throw_if_any() {
    for (const auto& [kind, count] : count_) {
      if (count > most_of_a_kind) {
        const int more = count - most_of_a_kind;
        errors_.add(ErrorCode::wrong_value, {}, fmt::format("and {} more {}", more, kind), more);
      }
    }
    errors_.throw_if_any();
  }

 private:
  static constexpr int most_of_a_kind = 20;
  ErrorList errors_;
  std::map<std::string, int> count_;
};

}  // namespace floatframe
