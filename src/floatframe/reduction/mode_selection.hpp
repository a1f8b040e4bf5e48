#pragma once
// Number of normal modes of a part: by number, by frequency, by effective mass; the first limit
// reached ends the list. Pairs of modes of equal frequency stay whole (one mode more) unless
// a given number cuts one: then there is a note.
//   effective mass of a fixed-interface mode in direction r:  (x^T M R_r)^2 / (R_r^T M R_r)
// R: rigid motions about the centre of mass. The sum over all modes is the part of the mass that
// is not on the interfaces, R_i^T M_ii R_i; a limit is a fraction of that.
#include "floatframe/reduction/fixed_interface.hpp"
#include "floatframe/reduction/free_structure.hpp"
#include "floatframe/reduction/part_places.hpp"

namespace floatframe {

/// The number of normal modes that ends the list; nullopt: the other limits do.
std::optional<int> most_normal_modes(const PartOptions& options);

/// Modes kept; `list` has them with their effective masses.
Eigenmodes select_fixed_modes(const FixedInterface& fixed, const PlacedPart& part,
                              const std::vector<int>& boundary, std::vector<ModeHealth>& list,
                              int& equal_left_out);

/// Elastic modes kept.
Eigenpairs select_free_modes(const FreeStructure& structure, const PlacedPart& part,
                             std::vector<ModeHealth>& list, int& equal_left_out);

}  // namespace floatframe
