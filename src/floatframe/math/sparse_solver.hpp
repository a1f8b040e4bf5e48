#pragma once

namespace floatframe {

/// Library for large sparse factorisations. `automatic`: MUMPS for large ones, if available.
enum class SparseSolver { automatic, mumps, eigen };

/// True if the MUMPS module is available.
bool mumps_available();

}  // namespace floatframe
