#pragma once
// The health report of a reduction for people (text tables) and for programs (JSON, SI units, which
// the keys name). Numbers that are not finite are null in JSON.
#include <string>

#include "floatframe/reduction/health_report.hpp"

namespace floatframe {

/// Aligned tables; warnings come last. Each line ends with a line break.
std::string health_text(const HealthReport& report);

/// A frequency of a table: three decimals, below 1 Hz three digits; "-" if it is not positive.
std::string hertz_text(double frequency);

/// A table of the first `most` modes of a body with what fraction of critical damping [%] each has:
/// free, with its interfaces held (mounted), and with its frame held if that is something else.
std::string own_damping_text(const OwnDamping& damping, std::size_t most, std::size_t indent);

/// An object; `indent` blanks a level.
std::string health_json(const HealthReport& report, int indent = 2);
/// Reads the output of `health_json`; unknown keys are ignored, missing ones keep their defaults.
/// Throws InputError with one sentence, without a location, that contains the key.
HealthReport health_from_json(const std::string& text);

}  // namespace floatframe
