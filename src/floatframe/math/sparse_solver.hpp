#pragma once

namespace floatframe {

/// What factors large sparse matrices. `automatic`: MUMPS for large ones, if it is there.
enum class SparseSolver { automatic, mumps, eigen };

/// Is the MUMPS module there?
bool mumps_available();

}  // namespace floatframe
