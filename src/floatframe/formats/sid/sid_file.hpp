#pragma once
// SID_FEM: the Standard Input Data of flexible bodies (Wallrapp 1993; Schwertassek and Wallrapp
// 1999), text. Its blocks follow from the inertia integrals.
//
// Data determined by the classical file: mass matrix at zero deformation and its first
// derivative in the modal amplitudes are in it completely, so m, m_u, P_u, S, S^i, the modal mass
// S^11 + S^22 + S^33 (Me) and the differences S^ij - S^ji (Cr m1, Ge) are recovered exactly. The
// rest of S^ij (three symmetric sums S^ij + S^ji, and the split of Me into S^11, S^22, S^33) gives
// the inertia tensor at second order of amplitudes and spin softening. It is in the file only if
// Oe has first-order terms and these are those of inertia only (Oe m1 of the first three columns
// then sums to -2 Me; geometric stiffening breaks that). `write_sid` writes them. If they
// are missing, S^11, S^22, S^33 are each taken as Me / 3 and the symmetric sums as zero, which
// keeps the mass matrix positive and the trace of the inertia tensor exact; a note reports it.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// SI units. `body.nodes` become the frames, numbered from 1 unless their names are numbers.
/// Throws InputError: no modes in step with the integrals, numbers that are not finite.
std::string write_sid(const FlexibleBody& body, const std::string& comment);

struct SidBody {
  FlexibleBody body;               ///< no projection; node names are the numbers of the frames
  std::vector<std::string> notes;  ///< one sentence each, with file:line: what is not in the file,
                                   ///< in doubt or left out
};

/// The file may be compressed with gzip. Throws InputError with file:line: unknown blocks,
/// dimensions that do not fit, entries out of range or twice, a mass matrix that is not positive.
SidBody read_sid(const std::filesystem::path& file);

/// The same from text; `name` is the file in messages.
SidBody parse_sid(std::string_view text, const std::string& name);

}  // namespace floatframe
