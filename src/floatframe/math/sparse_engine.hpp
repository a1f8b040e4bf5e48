#pragma once
// Interface between SparseFactors and a library of sparse factors, and entry of the MUMPS module.
// Plain pointers: the module shares no other types with the library.
#include <memory>
#include <string>

#include "floatframe/math/sparse_factors.hpp"

namespace floatframe {

/// A symmetric matrix with diagonal entries of size 1: its lower triangle by columns, rows
/// ascending, from 0; `start` has n + 1 entries. order[k]: place of row k in the elimination.
struct LowerTriangle {
  int n = 0;
  const int* start = nullptr;
  const int* row = nullptr;
  const double* value = nullptr;
  const int* order = nullptr;
};

/// Factors L D L^T of such a matrix.
class SparseEngine {
 public:
  virtual ~SparseEngine() = default;
  /// B (n x columns, column major) becomes A^-1 B. Throws std::runtime_error.
  virtual void solve(double* B, int columns) const = 0;

  int singular = -1;        ///< a row whose pivot vanishes
  int negative_pivots = 0;  ///< of D
  double entries = 0.0;     ///< of L
  std::string name;
};

/// A pivot below this is rounding.
inline constexpr double vanishing_pivot = 1e-13;

/// Eigen's simplicial LDL^T.
std::unique_ptr<SparseEngine> eigen_engine(const LowerTriangle& A);

/// What the MUMPS module exports, as a C function of this name. Throws std::runtime_error.
inline constexpr const char* mumps_engine_symbol = "floatframe_mumps_engine";
using MumpsEngineFunction = SparseEngine* (*)(const LowerTriangle& A);

}  // namespace floatframe
