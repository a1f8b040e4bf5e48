#include "floatframe/body/surface_points.hpp"

#include <set>

namespace floatframe {

bool is_surface_point(const ModalNode& node) noexcept { return node.name == surface_point_name; }

std::vector<ModalNode> surface_points(const Mat3X& positions, const MatX& modes) {
  std::set<Eigen::Index> chosen;
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    double most = 0.0;
    Eigen::Index furthest = -1;
    for (Eigen::Index n = 0; n < positions.cols() && 3 * n + 2 < modes.rows(); ++n) {
      const double move = modes.col(k).segment<3>(3 * n).norm();
      if (move > most) {
        most = move;
        furthest = n;
      }
    }
    if (furthest >= 0) chosen.insert(furthest);
  }
  std::vector<ModalNode> points;
  for (const Eigen::Index n : chosen)
    points.push_back({surface_point_name, positions.col(n), modes.middleRows<3>(3 * n),
                      Mat3X::Zero(3, modes.cols())});
  return points;
}

void remove_surface_points(FlexibleBody& body) { std::erase_if(body.nodes, is_surface_point); }

}  // namespace floatframe
