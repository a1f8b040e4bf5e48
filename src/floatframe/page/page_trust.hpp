#pragma once
// Accuracy indicators of a run over time, from the health data in its states (docs/result-file.md):
// constraint violations, terms of the energy balance, effort of the steps, deformation of each body
// relative to its size.
#include <nlohmann/json_fwd.hpp>

#include "floatframe/page/page_writer.hpp"

namespace floatframe {

class StateHistory;
struct Verification;

/// Limit of numbers in all of these curves.
inline constexpr std::size_t most_numbers_of_trust = 300'000;

/// Adds "time", "channels" and "notes" to the "trust" of a page. Adds nothing if the run has no
/// health data.
void add_trust_curves(const StateHistory& history, nlohmann::ordered_json& trust,
                      PageBuffer& buffer);

/// Adds the table of a verification to the "tables" of the "trust" of a page.
void add_verification(const Verification& verification, nlohmann::ordered_json& trust);

}  // namespace floatframe
