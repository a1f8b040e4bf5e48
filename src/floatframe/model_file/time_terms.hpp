#pragma once
// Terms of functions of time in model files: steps, sines, chirps, periods; integrals.
#include <vector>

#include "floatframe/description/attachment.hpp"
#include "floatframe/yaml/yaml_value.hpp"

namespace floatframe {

/// The keys `period: T` and `periodic: true` of a table that repeats; 0 without. `width` of the
/// table [s].
double read_period(YamlSection& section, double width);

/// [[t, value], ...]: values from each time on, 0 before; and the key `period`.
PiecewisePolynomial read_steps(const YamlValue& value, YamlSection& section, double& period);

/// The keys `sine` and `chirp`, a map or a list of maps each; true if there is one.
bool read_sines(YamlSection& section, const char* unit, std::vector<SineTerm>& sines);

/// F with F' = f and F(0) = start, of a function without chirps and period.
TimeFunction integral_of(const TimeFunction& f, double start);

}  // namespace floatframe
