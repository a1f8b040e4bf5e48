#pragma once

namespace floatframe {

/// The program that a finite-element model was made for, as far as its file shows.
enum class HomeProgram { unknown, abaqus, calculix, abaqus_or_calculix, nastran, ansys };

}  // namespace floatframe
