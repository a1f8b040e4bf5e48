#include "floatframe/core/json_text.hpp"

#include <nlohmann/json.hpp>

namespace floatframe {
namespace {

/// Counts brackets outside texts: at least the depth that the parser reaches before an error.
bool nests_too_deep(std::string_view text) noexcept {
  int depth = 0;
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (quoted) {
      if (c == '\\') ++k;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest_json) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

}  // namespace

nlohmann::ordered_json read_json(std::string_view text, std::string& why) {
  nlohmann::ordered_json value(nlohmann::ordered_json::value_t::discarded);
  if (nests_too_deep(text)) {
    why = "nests deeper than " + std::to_string(deepest_json) + " levels";
    return value;
  }
  value = nlohmann::ordered_json::parse(text, nullptr, false);
  if (value.is_discarded()) why = "damaged, or not JSON";
  return value;
}

std::string json_excerpt(const nlohmann::ordered_json& value) {
  return excerpt(value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace floatframe
