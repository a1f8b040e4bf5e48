#pragma once
// Response to unbalance over the speed of a rotor, as output by the command `response`: a table,
// JSON, CSV, a picture.
#include <string>
#include <vector>

#include "floatframe/rotors/unbalance_response.hpp"

namespace floatframe {

/// "disc=1e-4@90" or "shaft:middle=1e-4": BODY or BODY:NODE, kg m, degrees. Throws InputError.
Unbalance unbalance_of(const std::string& text);

std::string unbalance_text(const std::string& model, const UnbalanceOptions& o,
                           const UnbalanceResponse& r);
std::string unbalance_json(const std::string& model, const UnbalanceOptions& o,
                           const UnbalanceResponse& r);
std::string unbalance_csv(const UnbalanceResponse& r);
std::string unbalance_svg(const std::string& model, const UnbalanceOptions& o,
                          const UnbalanceResponse& r);

}  // namespace floatframe
