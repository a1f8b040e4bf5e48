#pragma once
// A 2-node beam as points with mass. Its displacement is cubic across and linear along the axis
// (Hermite), with the turn of the section theta = (rx, -w', v'), so its mass matrix differs between
// directions and no scalar mass of the nodes represents it. Points do: at five Gauss stations along
// the axis, four a station,
//   p +- h_y e_y, p +- h_z e_z  with  h_y^2 = 2 Iz / A,  h_z^2 = 2 Iy / A,  a quarter of the mass
//   each
// whose kinetic energy is that of the consistent mass with section inertia, exactly.
#include <array>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct BeamPoint {
  Vec3 p = Vec3::Zero();
  double mass = 0.0;
  /// Its displacement from (u, theta) of the first node and (u, theta) of the second, body axes.
  Eigen::Matrix<double, 3, 12> motion = Eigen::Matrix<double, 3, 12>::Zero();
};

std::array<BeamPoint, 20> beam_points(const FeModel& model, const Element& element);

}  // namespace floatframe
