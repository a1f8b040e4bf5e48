// Both engines of the sparse factors: solutions, count of negative eigenvalues, singular rows,
// independence of units, errors; and MUMPS beside MPI in one process.
#include "floatframe/math/sparse_factors.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/core/library_path.hpp"

namespace floatframe::test {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Laplacian of a grid of m^3 points, `dofs` unknowns a point that do not couple, held at its
/// sides.
Sparse laplacian(int m, int dofs = 1, bool held = true) {
  std::vector<Eigen::Triplet<double>> entry;
  const auto at = [&](int i, int j, int k) { return (i * m + j) * m + k; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      for (int k = 0; k < m; ++k)
        for (int axis = 0; axis < 3; ++axis)
          for (int side : {-1, 1}) {
            const int p[3] = {i + side * (axis == 0), j + side * (axis == 1),
                              k + side * (axis == 2)};
            const bool inside = p[axis] >= 0 && p[axis] < m;
            for (int d = 0; d < dofs; ++d) {
              const int row = dofs * at(i, j, k) + d;
              if (inside || held) entry.emplace_back(row, row, 1.0);
              if (inside) entry.emplace_back(row, dofs * at(p[0], p[1], p[2]) + d, -1.0);
            }
          }
  Sparse A(dofs * m * m * m, dofs * m * m * m);
  A.setFromTriplets(entry.begin(), entry.end());
  return A;
}

Sparse shifted(const Sparse& A, double sigma) {
  Sparse I(A.rows(), A.cols());
  I.setIdentity();
  return A - sigma * I;
}

class EveryEngine : public testing::TestWithParam<SparseSolver> {
 protected:
  void SetUp() override {
    if (GetParam() == SparseSolver::mumps && !mumps_available())
      GTEST_SKIP() << "built without MUMPS";
  }
};

TEST_P(EveryEngine, Solves) {
  const Sparse A = laplacian(9, 3);
  const SparseFactors factors(A, GetParam());
  EXPECT_EQ(factors.singular(), -1);
  EXPECT_EQ(factors.negative_pivots(), 0);
  EXPECT_GT(factors.entries(), static_cast<double>(A.nonZeros()) / 2.0);
  for (int columns : {1, 2, 8, 11, 40}) {
    const MatX X = MatX::Random(A.rows(), columns);
    EXPECT_LT((factors.solve(A * X) - X).cwiseAbs().maxCoeff(), 1e-12) << columns;
  }
  EXPECT_EQ(factors.solve(MatX::Zero(A.rows(), 0)).cols(), 0);
}

TEST_P(EveryEngine, CountsEigenvaluesBelowTheShift) {
  const int m = 8;
  std::vector<double> exact;
  const auto one = [&](int i) {
    return 2.0 - 2.0 * std::cos((i + 1) * std::numbers::pi / (m + 1));
  };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      for (int k = 0; k < m; ++k) exact.push_back(one(i) + one(j) + one(k));
  for (double sigma : {0.3, 1.0, 4.321, 9.9, 12.5}) {
    const Sparse A = shifted(laplacian(m), sigma);
    const SparseFactors factors(A, GetParam());
    EXPECT_EQ(factors.negative_pivots(),
              std::count_if(exact.begin(), exact.end(), [&](double e) { return e < sigma; }))
        << sigma;
    const MatX X = MatX::Random(A.rows(), 3);
    EXPECT_LT((factors.solve(A * X) - X).cwiseAbs().maxCoeff(), 1e-9) << sigma;
  }
}

TEST_P(EveryEngine, SeesSingularMatrices) {
  EXPECT_GE(SparseFactors(laplacian(7, 3, false), GetParam()).singular(), 0);
  // Three rows that nothing holds, and one that is empty.
  Sparse A = laplacian(6);
  std::vector<Eigen::Triplet<double>> entry;
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator it(A, j); it; ++it)
      entry.emplace_back(static_cast<int>(it.row()), static_cast<int>(it.col()), it.value());
  const int n = static_cast<int>(A.rows());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) entry.emplace_back(n + i, n + j, i == j ? 2.0 : -1.0);
  Sparse loose(n + 3, n + 3);
  loose.setFromTriplets(entry.begin(), entry.end());
  EXPECT_GE(SparseFactors(loose, GetParam()).singular(), n);
  Sparse empty = A;
  empty.conservativeResize(n + 1, n + 1);
  EXPECT_EQ(SparseFactors(empty, GetParam()).singular(), n);
  EXPECT_EQ(SparseFactors(A, GetParam()).singular(), -1);
}

TEST_P(EveryEngine, UnitsDoNotMatter) {
  // Rows in very different units, as of translations and rotations in mm-t-s.
  const Sparse A = laplacian(8);
  VecX unit(A.rows());
  for (Eigen::Index i = 0; i < unit.size(); ++i) unit(i) = std::pow(10.0, double(i % 9) - 4.0);
  const Sparse B = unit.asDiagonal() * A * unit.asDiagonal();
  const SparseFactors factors(B, GetParam());
  EXPECT_EQ(factors.singular(), -1);
  const MatX r = MatX::Random(A.rows(), 2);
  const MatX x = factors.solve(unit.asDiagonal() * r);  // (U A U) x = U r: U x = A^-1 r
  const MatX expected = SparseFactors(A, GetParam()).solve(r);
  EXPECT_LT((unit.asDiagonal() * x - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(EveryEngine, SmallestSizesAndErrors) {
  EXPECT_EQ(SparseFactors(Sparse(0, 0), GetParam()).solve(MatX::Zero(0, 3)).cols(), 3);
  Sparse one(1, 1);
  one.insert(0, 0) = 4.0;
  EXPECT_NEAR(SparseFactors(one, GetParam()).solve(MatX::Constant(1, 1, 2.0))(0, 0), 0.5, 1e-15);
  one.coeffRef(0, 0) = std::numeric_limits<double>::quiet_NaN();
  try {
    const SparseFactors factors(one, GetParam());
    ADD_FAILURE() << "a matrix with NaN has factors";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "a sparse matrix has an entry that is not finite");
  }
}

INSTANTIATE_TEST_SUITE_P(Sparse, EveryEngine,
                         testing::Values(SparseSolver::eigen, SparseSolver::mumps),
                         [](const auto& test) {
                           return test.param == SparseSolver::eigen ? "Eigen" : "Mumps";
                         });

TEST(SparseFactorsChoice, LargeMatricesGoToMumpsAndBothAgree) {
  const Sparse small = laplacian(5), A = laplacian(11, 3);
  EXPECT_EQ(SparseFactors(small).name(), "Eigen LDLT, METIS ordering");
  const SparseFactors automatic(A), eigen(A, SparseSolver::eigen);
  EXPECT_EQ(automatic.name().substr(0, 5), mumps_available() ? "MUMPS" : "Eigen");
  const MatX B = MatX::Random(A.rows(), 5);
  EXPECT_LT((automatic.solve(B) - eigen.solve(B)).cwiseAbs().maxCoeff(), 1e-12);
}

/// The MPI module is loaded with its symbols for all; the sequential MUMPS has stubs with the names
/// of some of them. Neither may see the other's, whichever comes first.
void load_mpi_module() {
  const std::string file = module_path("libfloatframe_mpi.so");
  if (file.empty()) GTEST_SKIP() << "built without MPI";
  ASSERT_NE(::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL), nullptr) << ::dlerror();
}

void expect_both_in_place() {
  const Sparse A = laplacian(11, 3);
  const MatX X = MatX::Random(A.rows(), 2);
  EXPECT_LT((SparseFactors(A, SparseSolver::mumps).solve(A * X) - X).cwiseAbs().maxCoeff(), 1e-12);
  for (const char* name : {"MPI_Init", "MPI_Comm_rank", "MPI_Finalize"}) {
    Dl_info where{};
    ASSERT_NE(::dladdr(::dlsym(RTLD_DEFAULT, name), &where), 0) << name;
    EXPECT_EQ(std::string(where.dli_fname).find("mumps"), std::string::npos) << where.dli_fname;
  }
  EXPECT_EQ(::dlsym(RTLD_DEFAULT, "dmumps_c"), nullptr);
  EXPECT_EQ(::dlsym(RTLD_DEFAULT, "mpi_bcast_"), nullptr);
}

TEST(MumpsBesideMpi, LoadedBeforeMpi) {
  if (!mumps_available()) GTEST_SKIP() << "built without MUMPS";
  EXPECT_GT(SparseFactors(laplacian(5), SparseSolver::mumps).entries(), 0.0);
  load_mpi_module();
  if (!IsSkipped()) expect_both_in_place();
}
TEST(MumpsBesideMpi, LoadedAfterMpi) {
  load_mpi_module();
  if (IsSkipped() || !mumps_available()) GTEST_SKIP() << "built without MPI or without MUMPS";
  expect_both_in_place();
}

}  // namespace
}  // namespace floatframe::test
