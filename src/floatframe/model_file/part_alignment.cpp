// The rigid motion that maps markers of a part to points of the model, by least squares:
//   H = sum_k (p_k - p_mean) (w_k - w_mean)^T = U S V^T,  R = V diag(1, 1, det(V U^T)) U^T
#include <Eigen/SVD>

#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

using Points = Mat3X;

/// Points on a line (or at one place) leave a rotation undetermined.
bool on_a_line(const Points& centred) {
  const Vec3 s = Eigen::JacobiSVD<Mat3>(centred * centred.transpose()).singularValues();
  return !(s[1] > 1e-10 * s[0]);  // squares: 1e-5 of the length
}

}  // namespace

std::optional<Pose> read_alignment(const ModelInstance& self, const YamlValue& value,
                                   double tolerance, const FlexibleBody& part) {
  struct Pair {
    YamlValue value;
    Vec3 p, w;
  };
  std::vector<Pair> pairs;
  bool good = true;
  std::map<std::string, const ModalNode*> named;
  for (const ModalNode& n : part.nodes)
    if (!n.name.empty()) named.insert_or_assign(n.name, &n);
  for (const auto& [name, point] : value.named("a map of markers to points", true)) {
    const auto at = named.find(name);
    const ModalNode* node = at == named.end() ? nullptr : at->second;
    if (!node)
      point.entity_error(ErrorCode::not_found,
                         "the part has no marker '" + name + "'" +
                             self.context.errors->suggestion(name, [&] { return keys_of(named); }));
    const auto w = self.read_point(point);
    good = good && node && w;
    if (node && w) pairs.push_back({point, node->p, *w});
  }
  if (!good || !value.is_map()) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(pairs.size());
  if (n < 3) {
    value.error(ErrorCode::wrong_count, "found " + std::to_string(n) +
                                            (n == 1 ? " marker" : " markers") +
                                            ", expected at least three that do not lie on a line");
    return std::nullopt;
  }
  Points p(3, n), w(3, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    p.col(k) = pairs[k].p;
    w.col(k) = pairs[k].w;
  }
  const Vec3 p_mean = p.rowwise().mean(), w_mean = w.rowwise().mean();
  p.colwise() -= p_mean;
  w.colwise() -= w_mean;
  for (const bool of_part : {true, false})
    if (on_a_line(of_part ? p : w)) {
      value.error(ErrorCode::geometry,
                  std::string("found ") + (of_part ? "markers" : "points") +
                      " on a line, expected at least three that do not lie on a line");
      return std::nullopt;
    }
  const Mat3 H = p * w.transpose();
  const Eigen::JacobiSVD<Mat3> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double det = (svd.matrixV() * svd.matrixU().transpose()).determinant();
  Pose X;
  X.R = svd.matrixV() * Vec3(1.0, 1.0, det < 0.0 ? -1.0 : 1.0).asDiagonal() *
        svd.matrixU().transpose();
  X.p = w_mean - X.R * p_mean;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double distance = (X.R * p.col(k) - w.col(k)).norm();
    if (distance <= tolerance) continue;
    pairs[k].value.error(ErrorCode::out_of_range,
                         "the marker stays " + number_text(std::round(distance * 1e9) / 1e9) +
                             " m away from its point, expected at most " + number_text(tolerance) +
                             " m (align_tolerance)");
    good = false;
  }
  return good ? std::optional<Pose>(X) : std::nullopt;
}

}  // namespace floatframe
