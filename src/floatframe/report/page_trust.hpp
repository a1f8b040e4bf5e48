#pragma once
// What shows over time whether a run can be trusted, from the health in the states of the run
// (docs/result-file.md): violations of constraints, terms of the energy balance, effort of the
// steps, deformation of each body against its size.
#include <nlohmann/json_fwd.hpp>

#include "floatframe/report/page_writer.hpp"

namespace floatframe {

class StateHistory;

/// Numbers in all of these curves.
inline constexpr std::size_t most_numbers_of_trust = 300'000;

/// Adds "time", "channels" and "notes" to the "trust" of a page. Nothing is added where the run was
/// not watched.
void add_trust_curves(const StateHistory& history, nlohmann::ordered_json& trust,
                      PageBuffer& buffer);

}  // namespace floatframe
