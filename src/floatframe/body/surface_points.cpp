#include "floatframe/body/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace floatframe {
namespace {

/// Motions of points per unit of strain energy, in combinations of modes not yet observed.
class Hidden {
 public:
  Hidden(const FlexibleBody& body, const MatX& modes) : left_(modes), scale_(modes.cols()) {
    for (Eigen::Index k = 0; k < scale_.size(); ++k)
      scale_[k] = body.K(k, k) > 0.0 ? 1.0 / std::sqrt(body.K(k, k)) : 0.0;
    left_ = left_ * scale_.asDiagonal();
    furthest(first_);
    for (const ModalNode& n : body.nodes)
      for (Eigen::Index r = 0; r < 3; ++r) see(n.X.row(r).transpose().cwiseProduct(scale_));
  }

  /// The point that moves most; -1 if none moves by a twentieth of what the first did.
  Eigen::Index next() {
    double most = 0.0;
    const Eigen::Index point = furthest(most);
    if (!(most > 0.05 * first_)) return -1;
    for (Eigen::Index r = 0; r < 3; ++r) see(left_.row(3 * point + r).transpose());
    return point;
  }

 private:
  Eigen::Index furthest(double& most) const {
    Eigen::Index point = -1;
    for (Eigen::Index n = 0; 3 * n + 2 < left_.rows(); ++n) {
      const double move = left_.middleRows<3>(3 * n).norm();
      if (move > most) {
        most = move;
        point = n;
      }
    }
    return point;
  }
  /// Removes the combination of modes that moves a point in one direction.
  void see(VecX direction) {
    for (const VecX& q : seen_) direction -= q.dot(direction) * q;
    const double length = direction.norm();
    if (!(length > 1e-3 * first_)) return;
    seen_.push_back(direction / length);
    const VecX along = left_ * seen_.back();
    left_ -= along * seen_.back().transpose();
  }

  MatX left_;
  VecX scale_;
  std::vector<VecX> seen_;  ///< orthonormal
  double first_ = 0.0;
};

}  // namespace

bool is_surface_point(const ModalNode& node) noexcept { return node.name == surface_point_name; }

std::vector<ModalNode> surface_points(const FlexibleBody& body, const Mat3X& positions,
                                      const MatX& modes) {
  if (positions.cols() == 0 || modes.cols() == 0) return {};
  std::set<Eigen::Index> chosen;
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    double most = 0.0;
    Eigen::Index furthest = -1;
    for (Eigen::Index n = 0; n < positions.cols(); ++n) {
      const double move = modes.col(k).segment<3>(3 * n).norm();
      if (move > most) {
        most = move;
        furthest = n;
      }
    }
    if (furthest >= 0) chosen.insert(furthest);
  }
  Hidden hidden(body, modes);
  for (int k = 0; k < most_hidden_points; ++k) {
    const Eigen::Index n = hidden.next();
    if (n < 0) break;
    chosen.insert(n);
  }
  std::vector<ModalNode> points;
  for (const Eigen::Index n : chosen)
    points.push_back({surface_point_name, positions.col(n), modes.middleRows<3>(3 * n),
                      Mat3X::Zero(3, modes.cols())});
  return points;
}

void remove_surface_points(FlexibleBody& body) { std::erase_if(body.nodes, is_surface_point); }

}  // namespace floatframe
