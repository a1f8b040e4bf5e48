#pragma once
// Measures: outputs that follow from poses and velocities of markers alone, over any scalar, so
// that formulas read them within an iteration and have their derivatives. With the marker P, the
// frame F that its motion is relative to and the axes A (null: the world):
//   position            d = p_P - p_F
//   velocity            v_P - v_F - w_F x d: the derivative of d as seen in F
//   angular velocity    w_P - w_F
//   rotation            R_A^T (R_P R_F^T) R_A; with A = F it is R_F^T R_P
// Components of the first three are those in the axes A.
#include <array>
#include <type_traits>

#include "floatframe/math/dual.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// What a measure reads of the motion, in one configuration, over double or Dual (math/dual.hpp).
template <class S>
struct MeasurePorts {
  using Marker = std::conditional_t<std::is_same_v<S, double>, MarkerState, MarkerMotion<S>>;
  using V = Eigen::Matrix<S, 3, 1>;
  using M = Eigen::Matrix<S, 3, 3>;

  const Model& model;
  const Output& output;
  const Marker* marker = nullptr;    ///< of a joint its frame F
  const Marker* to = nullptr;        ///< of a joint its frame M
  const Marker* relative = nullptr;  ///< null: the world
  const Marker* axes = nullptr;      ///< null: the world
  Vec3 origin = Vec3::Zero();        ///< marker positions are measured from here [m]
  double reference = 0.0;            ///< angles are within half a turn of it [rad]

  /// The component of the output of a vector in world axes.
  S along(const V& x) const noexcept {
    return axes ? S(axes->R.col(output.component).dot(x)) : x[output.component];
  }
  V position() const noexcept {
    return relative ? V(marker->r - relative->r) : V(marker->r + V(origin.template cast<S>()));
  }
  V velocity() const noexcept {
    if (!relative) return marker->v;
    return marker->v - relative->v - relative->w.cross(position());
  }
  V angular_velocity() const noexcept {
    return relative ? V(marker->w - relative->w) : V(marker->w);
  }
  M rotation() const noexcept {
    if (axes && axes == relative) return axes->R.transpose() * marker->R;
    return axes ? M(axes->R.transpose() * turn() * axes->R) : turn();
  }
  /// w of the rotation: dR/dt = skew(w) R.
  V rotation_velocity() const noexcept {
    V w = marker->w;
    if (relative) w -= turn() * relative->w;
    if (!axes) return w;
    w += turn() * axes->w - axes->w;
    return axes->R.transpose() * w;
  }

 private:
  /// R_P R_F^T
  M turn() const noexcept {
    return relative ? M(marker->R * relative->R.transpose()) : M(marker->R);
  }
};

/// The markers that a measure reads: marker, to, relative, axes; -1: none.
std::array<int, 4> measure_markers(const Model& model, const Output& output) noexcept;

}  // namespace floatframe
