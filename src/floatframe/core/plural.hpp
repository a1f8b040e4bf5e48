#pragma once
// Counted nouns in sentences.
#include <string>

namespace floatframe {

/// 1, "body" -> "1 body"; 2, "body", "bodies" -> "2 bodies"; without plural an "s" is added.
inline std::string plural(long count, const std::string& one, const std::string& many = "") {
  if (count == 1) return "1 " + one;
  return std::to_string(count) + " " + (many.empty() ? one + "s" : many);
}

}  // namespace floatframe
