#pragma once
// How many normal modes a part keeps: by number, by frequency, by effective mass; the first limit
// that is met ends the list. Pairs of modes of equal frequency stay whole (one mode more) but where
// a number is given that cuts one: then a note says so.
//   effective mass of a fixed-interface mode in direction r:  (x^T M R_r)^2 / (R_r^T M R_r)
// R: rigid motions about the centre of mass. The sum over all modes is the share of the mass that
// does not sit on the interfaces, R_i^T M_ii R_i; a limit means a fraction of that.
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
