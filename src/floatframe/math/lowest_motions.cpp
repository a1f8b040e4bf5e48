#include "floatframe/math/lowest_motions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <vector>

#include "floatframe/core/work_progress.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/second_order_subspace.hpp"

namespace floatframe {
namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;
using Subspace = SecondOrderSubspace;

/// Ritz pairs, the slowest first.
struct RitzPairs {
  MatX H;
  Eigen::VectorXcd lambda;
  VecX error;                ///< of x over its size, and about that of lambda
  Eigen::MatrixXcd vectors;  ///< of x in the basis U
  bool found = false;

  /// Up to the digits limited by rounding: the error is small, or no longer decreases.
  bool has_converged(Index k, const RitzPairs& before) const {
    constexpr double accuracy = 1e-9, noise = 1e-5;
    if (error[k] <= accuracy) return true;
    if (!(error[k] <= noise)) return false;
    for (Index j = 0; j < before.lambda.size(); ++j)
      if (std::abs(before.lambda[j] - lambda[k]) <= noise * std::abs(lambda[k]))
        return error[k] > 0.5 * before.error[j];
    return false;
  }
};

/// The number of pairs among the `count` slowest motions, both of a pair.
RitzPairs ritz_pairs(const Subspace& space, double sigma, Index count) {
  RitzPairs pairs;
  pairs.H = space.projected();
  const GeneralEigen e = general_eigen(pairs.H);
  if (!e.found) return pairs;
  const Eigen::VectorXcd lambda = sigma * (1.0 + e.values.array().inverse());
  const Index m = space.size();
  std::vector<Index> order;
  for (Index k = 0; k < 2 * m; ++k)
    if (std::abs(e.values[k]) > 1e-14) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(lambda[a]) < std::abs(lambda[b]); });
  Index once = 0;  // pairs once
  const auto end = std::find_if(order.begin(), order.end(),
                                [&](Index k) { return lambda[k].imag() >= 0.0 && ++once > count; });
  order.erase(end, order.end());
  pairs.lambda = lambda(order);
  pairs.vectors.resize(m, pairs.lambda.size());
  for (Index at = 0; const Index k : order) {
    // x and w are parallel: the larger one has more digits.
    const auto x = e.vectors.col(k).head(m), w = e.vectors.col(k).tail(m);
    pairs.vectors.col(at++) = (x.squaredNorm() >= w.squaredNorm() ? x : w).normalized();
  }
  pairs.error = space.corrections(pairs.vectors, pairs.lambda).colwise().norm();
  pairs.found = true;
  return pairs;
}

/// The wanted motions, and the shift.
struct Search {
  Index count = 0;
  double sigma = 0.0, still = 0.0, fastest = 0.0;
};

/// The converged ones, up to the first that is not; a pair once (Im >= 0).
std::vector<Index> slow_pairs(const RitzPairs& pairs, const RitzPairs& before, bool complete) {
  std::vector<Index> slow;
  for (Index k = 0; k < pairs.lambda.size(); ++k) {
    if (!complete && !pairs.has_converged(k, before)) break;
    if (pairs.lambda[k].imag() >= 0.0) slow.push_back(k);
  }
  return slow;
}

/// A fraction of the magnitude of the middle one of the known slowest motions: close to zero the
/// slowest ones are the nearest, and farther away rounding leaves more digits.
double better_shift(const RitzPairs& pairs, const Search& search) {
  std::vector<double> sizes;
  for (Index k = 0; k < pairs.lambda.size(); ++k)
    if (pairs.lambda[k].imag() >= 0.0)
      sizes.push_back(
          std::max(std::abs(pairs.lambda[k]), std::min(pairs.error[k], 1.0) * search.sigma));
  std::sort(sizes.begin(), sizes.end());
  if (std::ssize(sizes) > search.count) sizes.erase(sizes.begin() + search.count, sizes.end());
  std::erase_if(sizes, [&](double size) { return size <= search.still; });
  return sizes.empty() ? search.sigma : std::max(0.1 * sizes[sizes.size() / 2], 2.0 * search.still);
}

/// The directions of H with nu = -1 (lambda zero), with all vectors of their Jordan blocks:
/// subspace iteration with the inverse close to -1.
MatX still_directions(const MatX& H, Index count) {
  const Index m = H.rows();
  const Eigen::PartialPivLU<MatX> near(H + (1.0 + 1e-6) * MatX::Identity(m, m));
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  MatX N(m, count);
  for (double& x : N.reshaped()) x = uniform(generator);
  for (int k = 0; k < 8; ++k)
    N = Eigen::HouseholderQR<MatX>(near.solve(N)).householderQ() * MatX::Identity(m, count);
  return N;
}

/// In coordinates x = d * scaled ones. `slow`: at least as many as requested, or all.
LowestMotions collected(const Subspace& space, const RitzPairs& pairs,
                        const std::vector<Index>& slow, const Search& search, const VecX& d) {
  const auto is_still = [&](Complex lambda) { return std::abs(lambda) <= search.still; };
  Index at = 0;  // columns of unrestrained motions, both of a pair
  for (const Complex lambda : pairs.lambda) at += is_still(lambda) ? 1 : 0;
  std::vector<Index> chosen;
  Index columns = at;
  LowestMotions out;
  out.fastest = search.fastest;
  for (const Index k : slow) {
    const Complex lambda = pairs.lambda[k];
    if (!is_still(lambda) && out.found >= search.count) break;
    ++out.found;
    if (is_still(lambda)) continue;
    chosen.push_back(k);
    columns += lambda.imag() > 0.0 ? 2 : 1;
  }
  const Index n = d.size(), m = space.size();
  out.A = MatX::Zero(columns, columns);
  out.X.resize(n, columns);
  out.rate.resize(n, columns);
  if (at > 0) {
    const MatX N = still_directions(pairs.H, at);
    const MatX T = N.transpose() * pairs.H * N;
    out.A.topLeftCorner(at, at) = MatX::Identity(at, at) + lu_solve(T, MatX::Identity(at, at));
    out.A *= search.sigma;
    out.X.leftCols(at) = space.U() * N.topRows(m);
    out.rate.leftCols(at) = search.sigma * (space.U() * N.bottomRows(m));
  }
  for (const Index k : chosen) {
    const Complex lambda = pairs.lambda[k];
    const Eigen::VectorXcd x = (space.U() * pairs.vectors.col(k)).normalized(), rate = lambda * x;
    out.A(at, at) = lambda.real();
    out.X.col(at) = x.real();
    out.rate.col(at++) = rate.real();
    if (!(lambda.imag() > 0.0)) continue;
    out.A(at - 1, at) = lambda.imag();
    out.A(at, at - 1) = -lambda.imag();
    out.A(at, at) = lambda.real();
    out.X.col(at) = x.imag();
    out.rate.col(at++) = rate.imag();
  }
  out.X = d.asDiagonal() * out.X;
  out.rate = d.asDiagonal() * out.rate;
  out.converged = true;
  return out;
}

/// Estimate of the largest undamped frequency, by power iteration; with massless directions, of the
/// coordinates with mass. 0: no stiffness.
double largest_rate(const MatX& M, const MatX& K) {
  const Eigen::LLT<MatX> mass(M);
  if (mass.info() != Eigen::Success) {
    double most = 0.0;
    for (Index i = 0; i < M.rows(); ++i)
      if (M(i, i) > 1e-10 * M.diagonal().maxCoeff())
        most = std::max(most, std::sqrt(std::abs(K(i, i)) / M(i, i)));
    return most;
  }
  VecX x = VecX::Ones(M.rows());
  for (Index i = 1; i < x.size(); i += 2) x[i] = -1.0;
  double size = 0.0;
  for (int pass = 0; pass < 30; ++pass) {
    x = mass.solve(K * x).eval();
    size = x.norm();
    if (!(size > 0.0)) return 0.0;
    x /= size;
  }
  return std::sqrt(size);
}

/// Scales of coordinates of similar magnitude: their stiffness, and their mass at a middle speed.
VecX like_sizes(const MatX& M, const MatX& K) {
  const VecX mass = M.diagonal().cwiseAbs(), stiffness = K.diagonal().cwiseAbs();
  const double speed2 = std::max(1e-300, stiffness.sum()) / std::max(1e-300, mass.sum());
  VecX d = stiffness + speed2 * mass;
  for (double& size : d) size = size > 0.0 ? 1.0 / std::sqrt(size) : 1.0;
  return d;
}

/// With one shift; sets a better one in `search` and returns nothing if the first pairs suggest it.
LowestMotions found_near(const ShiftedMap& map, Search& search, bool may_shift, const VecX& d) {
  LowestMotions none;
  const Index n = d.size(), start = std::min(n, search.count + 4 * Subspace::block),
              most = std::min(n, 8 * search.count + 500);
  Subspace space(map);
  RitzPairs before;
  double slowest = -1.0;  // |lambda| of the last requested one, once there are so many
  std::ptrdiff_t verified = 0;
  for (Index next = start;; next = std::min(most, space.size() + space.size() / 5)) {
    while (space.size() < next) {
      tell_progress("slowest motions", space.size() / (3.0 * start));
      if (!space.grow()) return none;
    }
    RitzPairs pairs = ritz_pairs(space, search.sigma, search.count);
    if (!pairs.found) return none;
    if (may_shift && slowest < 0.0 && next < 2 * start && !space.complete()) {
      const double better = better_shift(pairs, search);
      if (better > 4.0 * search.sigma || better < 0.6 * search.sigma)
        return search.sigma = better, none;
    }
    const std::vector<Index> slow = slow_pairs(pairs, before, space.complete());
    const auto slower_than = [&](double size) {
      return std::count_if(slow.begin(), slow.end(),
                           [&](Index k) { return std::abs(pairs.lambda[k]) <= size; });
    };
    const bool enough = std::ssize(slow) >= search.count;
    if (space.complete() || (enough && slowest >= 0.0 && slower_than(slowest) == verified))
      return collected(space, pairs, slow, search, d);
    if (!enough && space.size() >= most) return none;
    if (enough) {
      // Again with random directions: a lambda may have more motions than one block can find.
      const Complex last = pairs.lambda[*(slow.begin() + search.count - 1)];
      slowest = (1.0 + 1e-6) * std::max(std::abs(last), search.still);
      verified = slower_than(slowest);
      space.append_random();
    }
    before = std::move(pairs);
  }
}

}  // namespace

LowestMotions lowest_motions(const MatX& M, const MatX& C, const MatX& K, int count) {
  LowestMotions none;
  if (M.rows() == 0) return none;
  const VecX d = like_sizes(M, K);
  const auto scaled = [&](const MatX& A) { return MatX(d.asDiagonal() * A * d.asDiagonal()); };
  ShiftedMap map(scaled(M), scaled(C), scaled(K));
  Search search;
  search.count = count;
  search.fastest = largest_rate(map.M, map.K);
  if (!(search.fastest > 0.0)) search.fastest = 1.0;  // no other scale is known
  search.still = zero_part * search.fastest;
  search.sigma = 1e3 * search.still;
  for (int shifts = 0, tries = 0;;) {
    if (!map.factorise(search.sigma)) {
      // Accidentally an eigenvalue, or no shift helps.
      none.singular = ++tries == 3;
      if (none.singular) return none;
      search.sigma *= 1.3;
      continue;
    }
    LowestMotions found = found_near(map, search, ++shifts < 12, d);
    if (found.converged || search.sigma == map.sigma) return found;
  }
}

}  // namespace floatframe
