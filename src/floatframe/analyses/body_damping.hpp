#pragma once
// Damping of the flexible bodies of a model: in their own modes and in the modes of the whole
// model. Both are fractions of critical damping, but of different modes: a body has the specified
// fraction in the modes of the reference (body/modal_damping.hpp); mounted and loaded by other
// bodies, it vibrates in other modes with other frequencies.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// One table per damped body, equal ones combined; empty without any.
std::string body_damping_text(const Model& model);
/// [{"bodies": [..], "frame": [..], "free": [{"frequency_Hz", "fraction"}], "mounted": [..]}]
nlohmann::ordered_json body_damping_json(const Model& model);

/// The slowest vibrations of the model about its start with their fractions, one per line; a
/// sentence if they are too expensive to compute. Empty if no body is damped.
std::string system_damping_text(const Model& model, int degrees_of_freedom);

}  // namespace floatframe
