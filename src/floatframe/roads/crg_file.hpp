#pragma once
// OpenCRG files (ASAM OpenCRG 1.2), text or binary; CrgRoad says what they mean.
// Channels of a row: heights of the long sections, which may be absent ("*missing*", NaN) at the
// borders and then are those of the last one that is there; heading, slope and banking of the line.
// Heading and slope of row i are those of the step from row i - 1; the first ones are unused. The
// line is summed up from its beginning, and if the header gives its end as well, from there too:
// the mean of both, weighted by the distance, ends where the header says.
//   columns   by number: LONG_SECTION_V_RIGHT, _LEFT, _INCREMENT (0.01 m if none is given, and as
//             far to the left as to the right); or "at v = "
// Modifiers of a header are never applied; `CrgRoad::notes` names them.
#include <filesystem>
#include <string>
#include <string_view>

#include "floatframe/roads/crg_road.hpp"

namespace floatframe {

/// Reads the file piece by piece. Throws InputError: one sentence with line and column.
CrgRoad read_crg(const std::filesystem::path& file);
/// The same from its content; `name` for messages.
CrgRoad read_crg(std::string_view content, const std::string& name);

}  // namespace floatframe
