#pragma once
// A point that slides along nodes of a flexible body (model/slide_path.hpp): the material point of
// the body at the foot u of another point p, which moves along the path with that. Body axes.
// Shared by the formulations. Its position, velocity and gradients are those of the material point;
// what follows from the change of u is in the rows that hold p (constraints/on_curve.cpp).
#include <cassert>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/model/slide_path.hpp"

namespace floatframe {

class SlidingPoint {
 public:
  /// Allocates.
  SlidingPoint(const SlidePath& path, const FlexibleBody& body) : path_(path) {
    const Eigen::Index n = path.size(), nm = body.modes();
    shapes_ = MatX::Zero(3 * n, nm);
    for (Eigen::Index k = 0; k < n; ++k)
      shapes_.middleRows<3>(3 * k) = body.nodes[path.nodes()[k]].X;
    places_ = rates_ = path.points();
    N_ = dN_ = ddN_ = VecX::Zero(n);
  }

  /// The foot of p with the amplitudes y, and the shapes there. Step time.
  void find(const Vec3& p, const VecX& y, Vec3& place, Mat3X& X) noexcept {
    const Eigen::Index n = path_.size();
    assert(y.size() == shapes_.cols() && X.cols() == shapes_.cols());
    Eigen::Map<VecX> stacked(places_.data(), 3 * n);
    stacked = Eigen::Map<const VecX>(path_.points().data(), 3 * n);
    stacked.noalias() += shapes_ * y;
    const auto at = [&](double u) {
      path_.weights(u, N_, dN_, ddN_);
      CurveValue v{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
      for (Eigen::Index k = 0; k < n; ++k) {
        v.c += N_[k] * places_.col(k);
        v.dc += dN_[k] * places_.col(k);
        v.ddc += ddN_[k] * places_.col(k);
      }
      return v;
    };
    const double end = path_.last(), widest = end / (n - 1);
    const double u = foot_parameter(path_.knots()[nearest(p)], widest, p, at,
                                    [&](double x) { return x <= 0.0 || x >= end; });
    const CurveValue v = at(u);
    foot = curve_foot(u, p, v, path_.drawn().across());
    place = v.c;
    X.setZero();
    for (Eigen::Index j = 0; j < X.cols(); ++j)
      for (Eigen::Index k = 0; k < n; ++k) X.col(j) += N_[k] * shapes_.block<3, 1>(3 * k, j);
  }
  /// The velocity of the material point with the modal rates yd, after `find`. Step time.
  void find_rates(const VecX& yd, Vec3& velocity) noexcept {
    assert(yd.size() == shapes_.cols());
    Eigen::Map<VecX>(rates_.data(), rates_.size()).noalias() = shapes_ * yd;
    velocity.setZero();
    foot.dc_rate.setZero();
    for (Eigen::Index k = 0; k < path_.size(); ++k) {
      velocity += N_[k] * rates_.col(k);
      foot.dc_rate += dN_[k] * rates_.col(k);
    }
    turn_of_normals(foot, path_.drawn().across(), foot.dc_rate, foot.n_rate);
  }

  CurveFoot foot;

 private:
  std::size_t nearest(const Vec3& p) const noexcept {
    Eigen::Index k = 0;
    (places_.colwise() - p).colwise().squaredNorm().minCoeff(&k);
    return k;
  }

  const SlidePath& path_;
  MatX shapes_;           ///< 3n x nm: those of the nodes
  Mat3X places_, rates_;  ///< of the nodes, 3 x n
  VecX N_, dN_, ddN_;     ///< at the foot
};

}  // namespace floatframe
