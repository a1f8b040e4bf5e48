#pragma once
// What a Magic Formula tyre cannot have: radii, stiffnesses and friction that are not positive,
// ranges without zero slip; and what is unusual. Everything is said at its place in the file.
#include <string>
#include <vector>

#include "floatframe/tyres/magic_tyre.hpp"

namespace floatframe {

/// Inflation [Pa]: that of the model, of the file, or the one of its measurements; 0: none.
double magic_pressure(const TirFile& file, const MagicOptions& options);
/// One error for each value that makes no sense.
void check_magic_file(const TirFile& file, MagicVersion version, const MagicOptions& options,
                      ErrorList& errors);
/// What of a tyre that was accepted is outside of the file's own limits or unlike a tyre, a
/// sentence each.
std::vector<std::string> magic_notes(const TirFile& file, const MagicTyre& tyre,
                                     const MagicOptions& options);

}  // namespace floatframe
