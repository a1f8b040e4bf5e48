// Sparse factors by MUMPS: the module `libfloatframe_mumps.so`. The sequential MUMPS brings stubs
// with the names of MPI functions, so nothing but this module may see its symbols. MUMPS keeps
// state of its own between calls: one thread at a time.
#include <dmumps_c.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "floatframe/math/sparse_engine.hpp"

namespace floatframe {
namespace {

std::mutex one_at_a_time;

class MumpsEngine final : public SparseEngine {
 public:
  explicit MumpsEngine(const LowerTriangle& A) {
    const std::lock_guard lock(one_at_a_time);
    try {
      start();
      factorise(A);
    } catch (...) {
      call(-2);
      throw;
    }
    name = std::string("MUMPS ") + mumps_.version_number;
  }
  ~MumpsEngine() override {
    const std::lock_guard lock(one_at_a_time);
    call(-2);
  }
  MumpsEngine(const MumpsEngine&) = delete;
  MumpsEngine& operator=(const MumpsEngine&) = delete;

  void solve(double* B, int columns) const override {
    if (columns == 0) return;
    const std::lock_guard lock(one_at_a_time);
    mumps_.rhs = B;
    mumps_.nrhs = columns;
    mumps_.lrhs = mumps_.n;
    icntl(27) = std::min(columns, 32);  // so many at once through the factors
    call(3);
    mumps_.rhs = nullptr;
    check("solution");
  }

 private:
  int& icntl(int k) const { return mumps_.icntl[k - 1]; }
  void call(int job) const {
    mumps_.job = job;
    dmumps_c(&mumps_);
  }

  void start() {
    mumps_.sym = 2;  // symmetric, may be indefinite
    mumps_.par = 1;
    mumps_.comm_fortran = -987654;  // the value that stands for all processes
    call(-1);
    for (int stream = 1; stream <= 3; ++stream) icntl(stream) = -1;
    icntl(4) = 0;  // no messages
    check("start");
  }

  void factorise(const LowerTriangle& A) {
    // 1-based coordinates; the array of values is only read.
    const std::size_t count = A.start[A.n];
    std::vector<int> rows(count), columns(count), order(static_cast<std::size_t>(A.n));
    for (int j = 0; j < A.n; ++j) {
      for (int k = A.start[j]; k < A.start[j + 1]; ++k) {
        rows[k] = A.row[k] + 1;
        columns[k] = j + 1;
      }
      order[j] = A.order[j] + 1;
    }
    mumps_.n = A.n;
    mumps_.nnz = static_cast<MUMPS_INT8>(count);
    mumps_.irn = rows.data();
    mumps_.jcn = columns.data();
    mumps_.a = const_cast<double*>(A.value);
    icntl(7) = 1;  // the order of elimination is given
    mumps_.perm_in = order.data();
    icntl(6) = 0;           // no permutation to large diagonals: it would break the symmetry
    icntl(12) = 1;          // ordering of the matrix as it is
    icntl(8) = 0;           // scaled already
    icntl(24) = 1;          // vanishing pivots are found and ignored
    icntl(10) = 0;          // no iterative refinement
    mumps_.cntl[0] = 1e-6;  // relative pivot below which rows are exchanged
    mumps_.cntl[2] = -vanishing_pivot;  // minus: absolute
    call(1);
    check("analysis");
    for (int room = 20; room <= 2000; room *= 3) {  // percent more memory than foreseen
      icntl(14) = room;
      call(2);
      if (mumps_.infog[0] != -8 && mumps_.infog[0] != -9) break;
    }
    check("factorisation");
    negative_pivots = mumps_.infog[11];
    if (mumps_.infog[27] > 0) singular = mumps_.pivnul_list[0] - 1;
    const double reals = mumps_.infog[28];  // a negative count is in millions
    entries = reals < 0.0 ? -1e6 * reals : reals;
    mumps_.irn = mumps_.jcn = mumps_.perm_in = nullptr;
    mumps_.a = nullptr;
  }

  void check(const char* stage) const {
    const int error = mumps_.infog[0], detail = mumps_.infog[1];
    if (error >= 0) return;
    if (error == -5 || error == -7 || error == -8 || error == -9 || error == -11 || error == -13 ||
        error == -14 || error == -15 || error == -19 || error == -22)
      throw std::bad_alloc();
    const std::string why =
        error == -10 || error == -6
            ? "the matrix is singular"
            : "MUMPS reports error " + std::to_string(error) + " (" + std::to_string(detail) + ")";
    throw std::runtime_error("sparse " + std::string(stage) + " of " + std::to_string(mumps_.n) +
                             " equations: " + why);
  }

  mutable DMUMPS_STRUC_C mumps_{};
};

}  // namespace
}  // namespace floatframe

extern "C" __attribute__((visibility("default"))) floatframe::SparseEngine* floatframe_mumps_engine(
    const floatframe::LowerTriangle& A) {
  return new floatframe::MumpsEngine(A);
}
