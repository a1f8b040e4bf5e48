#pragma once
// Linear-algebra aliases. One scalar type: double. SI units, angles in radians, quaternions scalar
// first.
#include <Eigen/Core>
#include <Eigen/Geometry>

#ifndef FLOATFRAME_WITHOUT_ABI_GUARD  // a module that shares no matrices with the library
#include "floatframe/math/abi_guard.hpp"
#endif

namespace floatframe {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat3 = Eigen::Matrix3d;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;
using Mat3X = Eigen::Matrix<double, 3, Eigen::Dynamic>;
using Mat6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Read-only view of a contiguous vector (no copy for contiguous arguments).

}  // namespace floatframe
