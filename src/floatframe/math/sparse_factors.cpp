// Scaling, ordering and choice of the engine.
#include "floatframe/math/sparse_factors.hpp"

#include <dlfcn.h>
#include <metis.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <vector>

#include "floatframe/core/library_path.hpp"
#include "floatframe/math/blas_room.hpp"
#include "floatframe/math/sparse_engine.hpp"

namespace floatframe {
namespace {

/// Below this size MUMPS has no advantage.
constexpr Eigen::Index large = 3000;

struct Module {
  MumpsEngineFunction engine = nullptr;
  std::string why = "this Floatframe was built without it (libfloatframe_mumps.so)";
};

Module open_module() {
  Module module;
  const std::string file = module_path("libfloatframe_mumps.so");
  if (file.empty()) return module;
  if (!reserve_blas_room()) {
    module.why = "its BLAS needs more memory than the process may take (ulimit -v)";
    return module;
  }
  // RTLD_LOCAL: the sequential MUMPS contains stubs with names of MPI functions.
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    const char* why = ::dlerror();
    module.why = why ? why : "its module cannot be loaded";
    return module;
  }
  warm_blas(handle);
  module.engine = reinterpret_cast<MumpsEngineFunction>(::dlsym(handle, mumps_engine_symbol));
  if (!module.engine) module.why = "'" + file + "' is not its module";
  return module;
}

const Module& mumps() {
  static const Module module = open_module();
  return module;
}

/// Nested dissection: position of each row in the elimination.
std::vector<int> nested_dissection(const Eigen::SparseMatrix<double>& A) {
  static_assert(sizeof(idx_t) == sizeof(int));
  const std::size_t n = A.rows();
  std::vector<idx_t> start(n + 1, 0), neighbours, order(n), place(n);
  neighbours.reserve(A.nonZeros());
  for (int j = 0; j < A.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it)
      if (it.row() != j) neighbours.push_back(static_cast<idx_t>(it.row()));
    start[j + 1] = static_cast<idx_t>(neighbours.size());
  }
  if (neighbours.empty()) {
    for (std::size_t k = 0; k < n; ++k) place[k] = static_cast<idx_t>(k);
    return place;
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  auto size = static_cast<idx_t>(n);
  if (METIS_NodeND(&size, start.data(), neighbours.data(), nullptr, options, order.data(),
                   place.data()) != METIS_OK)
    throw std::runtime_error("the ordering of a sparse matrix needs more memory than is available");
  return place;
}

/// s such that diag(s) A diag(s) has diagonal entries of size 1 (where they are not tiny against
/// their row). `empty`: the first row without entries, -1 if there is none.
VecX scaling(const Eigen::SparseMatrix<double>& A, int& empty) {
  VecX s(A.cols());
  for (int j = 0; j < A.outerSize(); ++j) {
    double diagonal = 0.0, largest = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
      if (!std::isfinite(it.value()))
        throw std::runtime_error("a sparse matrix has an entry that is not finite");
      largest = std::max(largest, std::abs(it.value()));
      if (it.row() == j) diagonal = std::abs(it.value());
    }
    const double size = std::max(diagonal, 1e-8 * largest);
    if (size == 0.0 && empty < 0) empty = j;
    s(j) = size > 0.0 ? 1.0 / std::sqrt(size) : 1.0;
  }
  return s;
}

}  // namespace

struct SparseFactors::Implementation {
  VecX scale;
  int empty = -1;
  std::unique_ptr<SparseEngine> engine;
};

SparseFactors::SparseFactors(const Eigen::SparseMatrix<double>& A, SparseSolver solver)
    : implementation_(std::make_unique<Implementation>()) {
  if (solver == SparseSolver::mumps && !mumps().engine)
    throw std::runtime_error("MUMPS was requested, but " + mumps().why);
  VecX& s = implementation_->scale;
  s = scaling(A, implementation_->empty);
  Eigen::SparseMatrix<double> lower = A.triangularView<Eigen::Lower>();
  for (int j = 0; j < lower.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower, j); it; ++it)
      it.valueRef() *= s(it.row()) * s(j);
  const std::vector<int> order = nested_dissection(A);
  const LowerTriangle triangle{static_cast<int>(A.rows()), lower.outerIndexPtr(),
                               lower.innerIndexPtr(), lower.valuePtr(), order.data()};
  const bool use_mumps =
      A.rows() > 0 && (solver == SparseSolver::mumps ||
                       (solver == SparseSolver::automatic && A.rows() > large && mumps().engine));
  try {
    if (use_mumps) {
      implementation_->engine.reset(mumps().engine(triangle));
    } else {
      implementation_->engine = eigen_engine(triangle);
    }
  } catch (const std::bad_alloc&) {
    throw std::runtime_error("the sparse factors of " + std::to_string(A.rows()) +
                             " equations need more memory than is available");
  }
}

SparseFactors::~SparseFactors() = default;
SparseFactors::SparseFactors(SparseFactors&&) noexcept = default;
SparseFactors& SparseFactors::operator=(SparseFactors&&) noexcept = default;

MatX SparseFactors::solve(const MatX& B) const {
  const VecX& s = implementation_->scale;
  MatX X = s.asDiagonal() * B;
  implementation_->engine->solve(X.data(), static_cast<int>(X.cols()));
  return s.asDiagonal() * X;
}

int SparseFactors::singular() const noexcept {
  return implementation_->empty >= 0 ? implementation_->empty : implementation_->engine->singular;
}
int SparseFactors::negative_pivots() const noexcept {
  return implementation_->engine->negative_pivots;
}
const std::string& SparseFactors::name() const noexcept { return implementation_->engine->name; }
double SparseFactors::entries() const noexcept { return implementation_->engine->entries; }

bool mumps_available() { return mumps().engine != nullptr; }

}  // namespace floatframe
