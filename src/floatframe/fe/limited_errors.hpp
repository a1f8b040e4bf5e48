#pragma once
// Errors of a model, where one mistake may cause thousands.
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
    Count& known = counts_[kind];
    if (known.errors++ == 0) known.code = code;
    if (known.errors <= most_of_a_kind) errors_.add(code, mark, std::move(text));
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
    for (const auto& [kind, known] : counts_)
      if (const int more = known.errors - most_of_a_kind; more > 0)
        errors_.add(known.code, {}, fmt::format("and {} more {}", more, kind), more);
    errors_.throw_if_any();
  }

 private:
  static constexpr int most_of_a_kind = 20;
  struct Count {
    ErrorCode code{};  ///< of the first
    int errors = 0;
  };
  ErrorList errors_;
  std::map<std::string, Count> counts_;
};

}  // namespace floatframe
