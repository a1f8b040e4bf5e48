#pragma once
// SID_FEM: the Standard Input Data of flexible bodies (Wallrapp 1993), text. The classical file
// holds the mass matrix and its first derivative in the modal amplitudes; second-order inertia
// terms are not in it, so a body read from it misses them.
#include <filesystem>
#include <string>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// SI units. `body.nodes` become the frames. Throws on write errors.
std::string write_sid(const FlexibleBody& body, const std::string& comment);

/// What a SID holds, as a body: m, m_u, P_u, S, Si exactly; Sij from Me and the first-order terms
/// as far as they determine it, the rest zero. Throws InputError with file:line.
FlexibleBody read_sid(const std::filesystem::path& file);

}  // namespace floatframe
