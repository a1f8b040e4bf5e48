#pragma once
// The path of the double lane change: of all paths y(x) on which the rectangle of the vehicle,
// turned to its heading, keeps a margin from every edge of the gates, the one with the least
//   sum over i of w_i (y''_i)^2,   y''_i = (y_{i-1} - 2 y_i + y_{i+1}) / h^2                    (1)
// at stations with the distance h = 1 m. It begins straight, and is free at its end. Weights
// w_i = |y''_i|^2 of the solution before, from 1 on, lead to the least sum of y''^4: the largest
// lateral acceleration falls.
//
// The heading is y' - l y'' with the length l of the sideslip, beta = l kappa: a slowly driven
// vehicle has the distance of its rear axle from its point. The corner at the distance X ahead of
// the point is at y + X (y' - l y'') +- b/2 for small angles, and linear in X: conditions stand at
// the ends of the part of a side that is within a gate. With the conditions A y <= c the
// multipliers are the nonnegative ones with the least
//   lambda.G lambda / 2 + c.lambda,  G = A Q^-1 A^T,  y = -Q^-1 A^T lambda                      (2)
// found by active sets (Lawson and Hanson, Solving Least Squares Problems, 1974, chapter 23).
#include <vector>

#include "floatframe/model/driven_path.hpp"
#include "floatframe/vehicle/lane_gates.hpp"

namespace floatframe {

/// Points from x = -20 m to the end of the track and the length of the vehicle beyond, in the axes
/// of the track. `sideslip`: l [m]; `margin` [m], at most a quarter of what is free.
std::vector<PathPoint> lane_change_path(const VehicleOutline& vehicle, double sideslip = 0.0,
                                        double margin = 0.07);

}  // namespace floatframe
