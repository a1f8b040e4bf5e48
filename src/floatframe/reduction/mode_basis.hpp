#pragma once
// The raw basis of a part before its rigid motions are removed: all displacements of the
// structure that the reduced body represents, and its six rigid motions exactly.
//   Craig-Bampton   [constraint modes, fixed-interface modes, attachment modes]
//   free-free       [rigid motions, free modes, attachment modes]
//   Craig-Chang     [rigid motions, free modes, residual-flexibility modes of all interface dofs]
// Attachment modes are the static response to unit forces at markers, without the component of the
// normal modes; dependent ones are omitted.
#include <optional>

#include "floatframe/reduction/fixed_interface.hpp"
#include "floatframe/reduction/free_structure.hpp"
#include "floatframe/reduction/mode_set.hpp"
#include "floatframe/reduction/part_places.hpp"

namespace floatframe {

struct ModeBasis : ModeSet {
  MatX rigid;                     ///< nm x 6: X rigid = R
  int first_normal = 0;           ///< column of the first normal mode
  std::vector<ModeHealth> modes;  ///< of the normal modes
  std::string solver;
};

/// Entries for the report: solver, normal modes, notes.
void report_basis(const ModeBasis& basis, HealthReport& health);

/// Errors of the options that need no model: contradictions, negative numbers.
void check_options(const PartOptions& options);

ModeBasis craig_bampton_basis(const PlacedPart& part, std::optional<FixedInterface>& fixed);

/// `elastic`: the free elastic modes, for further use.
ModeBasis free_basis(const PlacedPart& part, std::optional<FreeStructure>& structure,
                     Eigenpairs& elastic);

}  // namespace floatframe
