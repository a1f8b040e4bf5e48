#pragma once
// Damping of the flexible bodies of a model: what each has in its own modes, and what the modes of
// the whole model get of it. Both are fractions of critical damping, of different modes: a body has
// the fraction it was given in the modes of the reference (body/modal_damping.hpp); mounted, and
// loaded by other bodies, it vibrates in others, of other frequencies.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// A table a damped body, alike ones together; empty without any.
std::string body_damping_text(const Model& model);
/// [{"bodies": [..], "frame": [..], "free": [{"frequency_Hz", "fraction"}], "mounted": [..]}]
nlohmann::ordered_json body_damping_json(const Model& model);

/// The slowest vibrations of the model about its start with their fractions, a line; a sentence if
/// they cannot be found at once. Empty if no body is damped.
std::string system_damping_text(const Model& model, int degrees_of_freedom);

}  // namespace floatframe
