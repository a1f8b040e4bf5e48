#pragma once
// "did you mean": the known name nearest to a mistyped one, by the number of inserted, deleted,
// replaced or swapped letters (optimal string alignment distance).
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

/// Number of single-letter edits between two names, case ignored.
int edit_distance(std::string_view a, std::string_view b);

/// The closest known name (at most a third of the letters, or one, edited) or, if none is close,
/// the shortest that begins with `name` (three letters or more); null if nothing fits.
const std::string* nearest(std::string_view name, const std::vector<std::string>& known);

/// Limit of names compared: longer lists would cost too much time.
inline constexpr std::size_t most_known = 10'000;

/// The keys of a map of names, as candidates.
template <class Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) {
    if (keys.size() == most_known) break;
    keys.push_back(key);
  }
  return keys;
}

/// Limit of suggestions per reading: each takes up to tens of milliseconds, and the first ones are
/// enough to help.
inline constexpr std::size_t most_suggestions = 100;

/// ", did you mean 'name'?" with the closest known name, or an empty text.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

}  // namespace floatframe
