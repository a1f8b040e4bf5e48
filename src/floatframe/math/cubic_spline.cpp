#include "floatframe/math/cubic_spline.hpp"

#include <cassert>
#include <string>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

/// A row of a tridiagonal system.
struct SplineRow {
  double left = 0.0, middle = 0.0, right = 0.0;
};

/// x with A x = b: elimination without pivoting, which diagonally dominant rows allow.
std::vector<double> solve_rows(std::vector<SplineRow> A, std::vector<double> b) {
  const std::size_t n = A.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = A[i].left / A[i - 1].middle;
    A[i].middle -= factor * A[i - 1].right;
    b[i] -= factor * b[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) b[i] -= A[i].right * b[i + 1];
    b[i] /= A[i].middle;
  }
  return b;
}

struct SplineKnots {
  std::vector<double> h, d;
  explicit SplineKnots(const std::vector<TablePoint>& p) {
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
      h.push_back(p[i + 1].x - p[i].x);
      d.push_back((p[i + 1].f - p[i].f) / h.back());
    }
  }
};

/// M of an open spline: M_0 = ((h_0 + h_1) M_1 - h_0 M_2) / h_1, and the same at the end, put into
/// (1).
std::vector<double> open_curvatures(const SplineKnots& k) {
  const auto& [h, d] = k;
  const std::size_t n = h.size() + 1;
  if (n == 2) return {0.0, 0.0};
  if (n == 3) return std::vector<double>(3, 2.0 * (d[1] - d[0]) / (h[0] + h[1]));
  std::vector<SplineRow> A(n - 2);
  std::vector<double> b(n - 2);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    A[i - 1] = {h[i - 1], 2.0 * (h[i - 1] + h[i]), h[i]};
    b[i - 1] = 6.0 * (d[i] - d[i - 1]);
  }
  const double first = h[0], second = h[1], last = h[n - 2], before = h[n - 3];
  A.front().middle += first * (first + second) / second;
  A.front().right -= first * first / second;
  A.back().middle += last * (last + before) / before;
  A.back().left -= last * last / before;
  std::vector<double> M = solve_rows(std::move(A), std::move(b));
  M.insert(M.begin(), ((first + second) * M[0] - first * M[1]) / second);
  const std::size_t m = M.size();
  M.push_back(((last + before) * M[m - 1] - last * M[m - 2]) / before);
  return M;
}

/// M of a closed spline: (1) for all i with indices modulo n - 1. The two entries in the corners
/// are a correction of rank one (Sherman and Morrison 1950).
std::vector<double> closed_curvatures(const SplineKnots& k) {
  const auto& [h, d] = k;
  const std::size_t n = h.size();  // unknowns: the last point is the first one
  std::vector<SplineRow> A(n);
  std::vector<double> b(n), u(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i == 0 ? n - 1 : i - 1;
    A[i] = {h[before], 2.0 * (h[before] + h[i]), h[i]};
    b[i] = 6.0 * (d[i] - d[before]);
  }
  if (n == 2) {  // the neighbours of a point are one
    const double a = A[0].left + A[0].right, det = A[0].middle * A[1].middle - a * a;
    const double M0 = (A[1].middle * b[0] - a * b[1]) / det,
                 M1 = (A[0].middle * b[1] - a * b[0]) / det;
    return {M0, M1, M0};
  }
  const double corner = h[n - 1], gamma = -A[0].middle;
  A[0].middle -= gamma;
  A[n - 1].middle -= corner * corner / gamma;
  u[0] = gamma;
  u[n - 1] = corner;
  std::vector<double> M = solve_rows(A, std::move(b));
  const std::vector<double> z = solve_rows(std::move(A), std::move(u));
  const double factor =
      (M[0] + corner * M[n - 1] / gamma) / (1.0 + z[0] + corner * z[n - 1] / gamma);
  for (std::size_t i = 0; i < n; ++i) M[i] -= factor * z[i];
  M.push_back(M[0]);
  return M;
}

}  // namespace

PiecewisePolynomial cubic_spline(const std::vector<TablePoint>& p, SplineEnds ends) {
  const bool closed = ends == SplineEnds::closed;
  const std::size_t least = closed ? 3 : 2;
  if (p.size() < least)
    throw InputError(ErrorCode::wrong_count, "found " + std::to_string(p.size()) +
                                                 " points of a spline, expected at least " +
                                                 std::to_string(least));
  for (std::size_t i = 1; i < p.size(); ++i)
    if (!(p[i].x > p[i - 1].x))
      throw InputError(ErrorCode::contradiction,
                       "point " + std::to_string(i + 1) +
                           " of a spline: found an x that is not above the one before it, expected "
                           "ascending x");
  const SplineKnots k(p);
  const std::vector<double> M = closed ? closed_curvatures(k) : open_curvatures(k);
  std::vector<double> breaks;
  std::vector<PiecewisePolynomial::Piece> pieces(1);
  for (std::size_t i = 0; i < p.size(); ++i) breaks.push_back(p[i].x);
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    pieces.push_back({p[i].x,
                      {p[i].f, k.d[i] - k.h[i] * (2.0 * M[i] + M[i + 1]) / 6.0, 0.5 * M[i],
                       (M[i + 1] - M[i]) / (6.0 * k.h[i])}});
  const PiecewisePolynomial::Piece& last = pieces.back();
  const double h = k.h.back();
  const double slope =
      last.coefficients[1] + h * (2.0 * last.coefficients[2] + 3.0 * h * last.coefficients[3]);
  pieces.front() = {p.front().x, {p.front().f, pieces[1].coefficients[1]}};
  pieces.push_back({p.back().x, {p.back().f, slope}});
  return PiecewisePolynomial(std::move(breaks), std::move(pieces));
}

}  // namespace floatframe
