#pragma once
// "did you mean": the known name nearest to a mistyped one, by the number of inserted, deleted,
// replaced or swapped letters (optimal string alignment distance).
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

/// Number of single-letter edits between two names, case ignored.
int edit_distance(std::string_view a, std::string_view b);

/// The known name that is near (a third of the letters, at least one, are edited) or, if none is,
/// the shortest that begins with `name` (three letters or more); null if nothing fits.
const std::string* nearest(std::string_view name, const std::vector<std::string>& known);

/// ", did you mean 'name'?" with the nearest known name, or an empty text.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

}  // namespace floatframe
