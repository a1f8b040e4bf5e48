#pragma once
// Counted nouns in sentences.
#include <string>
#include <vector>

namespace floatframe {

/// 1, "body" -> "1 body"; 2, "body", "bodies" -> "2 bodies"; without plural an "s" is added.
inline std::string plural(long count, const std::string& one, const std::string& many = "") {
  if (count == 1) return "1 " + one;
  return std::to_string(count) + " " + (many.empty() ? one + "s" : many);
}

/// "body 'a'", "bodies 'a', 'b' and 'c'".
inline std::string named_text(const char* one, const char* many,
                              const std::vector<std::string>& names) {
  std::string text = names.size() == 1 ? one : many;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += i == 0 ? " '" : i + 1 == names.size() ? " and '" : ", '";
    text += names[i] + "'";
  }
  return text;
}

}  // namespace floatframe
