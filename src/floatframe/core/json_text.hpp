#pragma once
// JSON of foreign or damaged files.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "floatframe/core/excerpt.hpp"

namespace floatframe {

/// Files of this program nest at most ten levels. Copies, comparisons and output of nested values
/// use stack for each level.
inline constexpr int deepest_json = 64;

/// The value; discarded, with the reason in `why`, if the text is not JSON or nests deeper.
nlohmann::ordered_json read_json(std::string_view text, std::string& why);

/// The value as JSON, truncated for a sentence.
std::string json_excerpt(const nlohmann::ordered_json& value);

}  // namespace floatframe
