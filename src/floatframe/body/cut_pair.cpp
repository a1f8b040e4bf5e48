#include "floatframe/body/cut_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// sum over the nodes of x x^T, x their displacements in mode k.
Mat3 motion_directions(const FlexibleBody& body, Eigen::Index k) {
  Mat3 sum = Mat3::Zero();
  for (const ModalNode& n : body.nodes) {
    const Vec3 x = n.X.col(k);
    sum += x * x.transpose();
  }
  return sum;
}

/// The axis across which both modes of a pair move, alike in two directions.
std::optional<Vec3> axis_of_pair(const Mat3& directions) {
  const SymmetricEigen e = symmetric_eigen(directions);
  if (!e.found || !(e.values[0] <= 1e-4 * e.values[2]) || !(e.values[1] >= 0.5 * e.values[2]))
    return std::nullopt;
  return Vec3(e.vectors.col(0));
}

}  // namespace

std::optional<CutPair> cut_pair(const FlexibleBody& body, const std::optional<Vec3>& axis) {
  const VecX& f = body.fixed_interface_frequencies;
  const Eigen::Index kept = f.size(), first = body.modes() - kept;
  if (kept == 0 || first < 0 || body.nodes.empty()) return std::nullopt;
  for (Eigen::Index k = 0; k < kept; ++k)
    if (body.mode_names[static_cast<std::size_t>(first + k)].rfind("normal ", 0) != 0)
      return std::nullopt;
  Eigen::Index begin = kept - 1;  // of those as high as the last
  while (begin > 0 && equal_frequency(f[begin - 1], f[kept - 1])) --begin;
  std::optional<Vec3> across = axis;
  for (Eigen::Index k = 0; k + 1 < begin && !across; ++k)
    if (equal_frequency(f[k], f[k + 1]))
      across =
          axis_of_pair(motion_directions(body, first + k) + motion_directions(body, first + k + 1));
  if (!across) return std::nullopt;
  int bending = 0;
  for (Eigen::Index k = begin; k < kept; ++k) {
    const Mat3 d = motion_directions(body, first + k);
    bending += across->dot(d * *across) < 0.5 * d.trace() ? 1 : 0;
  }
  if (bending % 2 == 0) return std::nullopt;
  return CutPair{static_cast<int>(kept), f[kept - 1]};
}

std::string cut_pair_text(const CutPair& pair, const std::string& key) {
  return fmt::format("{}: {} cuts a pair of modes of equal frequency ({:.6g} Hz), take {} or {}",
                     key, pair.kept, pair.frequency, pair.kept - 1, pair.kept + 1);
}

}  // namespace floatframe
