#pragma once
// Shapes of *BEAM SECTION.
#include <array>
#include <string>
#include <vector>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"

namespace floatframe {

struct AbaqusBeamShape {
  const char* name;
  std::size_t numbers, calculix;  ///< how many: in both programs, in CalculiX alone (0: none)
  std::array<const char*, 7> what;
  unsigned any = 0;  ///< bit k: number k need not be positive
};

/// Of SECTION=...; null if it is not read.
const AbaqusBeamShape* find_abaqus_beam_shape(const std::string& name);
/// What to say of a shape that is not read.
std::string unread_abaqus_shape(const std::string& name);
/// From the numbers of its shape; `offsets`: OFFSET1, OFFSET2 of CalculiX.
void set_abaqus_beam(AbaqusCard& card, const std::vector<double>& numbers,
                     const Eigen::Vector2d& offsets, AbaqusSection& section);

}  // namespace floatframe
