#pragma once
// The part of a marker's motion that only its own body's modal amplitudes decide, in body axes;
// shared by the formulations. Node N at p with shapes X, X_theta; the marker at p_NM, R_NM on it.
// With theta = X_theta y, E = exp(skew(theta)), o = E p_NM:
//   p_B    = p + X y + o              R_B = E R_NM
//   pdot_B = X ydot + zeta_B x o      zeta_B = H thetadot,  H the tangent of the exponential
// and, with yddot = 0,
//   pddot_B = zetadot_B x o + zeta_B x (zeta_B x o),  zetadot_B = Hdot thetadot.
// A modal rate moves the marker, in world axes, by
//   Jw = A H X_theta,   Jr = A X + Jw x (A o).
#include "floatframe/math/so3.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct LocalMarker {
  int body = -1;
  bool local = false;    ///< deforms with modes
  bool rotates = false;  ///< the node's rotation enters
  // Body axes, from the body frame.
  Vec3 p_B = Vec3::Zero();                               ///< position [m]
  Vec3 pdot_B = Vec3::Zero(), pddot_B = Vec3::Zero();    ///< relative to the body [m/s, m/s2]
  Mat3 R_B = Mat3::Identity();                           ///< orientation
  Vec3 zeta_B = Vec3::Zero(), zetadot_B = Vec3::Zero();  ///< the same of turning [rad/s, rad/s2]
  Vec3 theta = Vec3::Zero();                             ///< rotation vector of the node [rad]
  Vec3 o_B = Vec3::Zero();                               ///< o, from the node [m]
  Mat3 H = Mat3::Identity();                             ///< at theta
  // Fixed.
  Vec3 node_p = Vec3::Zero();  ///< p [m]
  Pose X_NM;                   ///< p_NM, R_NM
  Mat3X X, X_theta;            ///< 3 x nm
  Mat3X HX;                    ///< 3 x nm, H X_theta at theta
  /// World axes (`world_gradients`), 3 x nm: velocity and angular velocity per modal rate.
  Mat3X Jr, Jw;

  LocalMarker() = default;
  LocalMarker(const Model& model, const Marker& m) : body(m.body), X_NM(m.X_NM) {
    p_B = m.X_NM.p;
    R_B = m.X_NM.R;
    if (m.body < 0) return;
    const FlexibleBody& data = *model.bodies[m.body].data;
    X = X_theta = HX = Jr = Jw = Mat3X::Zero(3, data.modes());
    if (m.node < 0) return;
    const ModalNode& node = data.nodes[m.node];
    node_p = node.p;
    p_B = node.p + m.X_NM.p;
    X = node.X;
    X_theta = node.X_theta;
    rotates = m.rotates && !node.X_theta.isZero(0.0);
    local = !node.X.isZero(0.0) || rotates;
  }

  /// Only for markers with `local`.
  void deform(const VecX& y) noexcept {
    p_B.noalias() = X * y;
    p_B += node_p;
    if (rotates) {
      theta.noalias() = X_theta * y;
      const Mat3 e = rotation_exp(theta);
      H = rotation_tangent(theta);
      HX.noalias() = H * X_theta;
      o_B.noalias() = e * X_NM.p;
      p_B += o_B;
      R_B.noalias() = e * X_NM.R;
    } else {
      p_B += X_NM.p;
    }
  }
  /// p_B for other amplitudes, y + dy.
  Vec3 position(const double* y, const double* dy) const noexcept {
    Vec3 p = node_p, turn = Vec3::Zero();
    for (Eigen::Index k = 0; k < X.cols(); ++k) {
      p += (y[k] + dy[k]) * X.col(k);
      if (rotates) turn += (y[k] + dy[k]) * X_theta.col(k);
    }
    return p + (rotates ? Vec3(rotation_exp(turn) * X_NM.p) : X_NM.p);
  }
  void deform_rate(const VecX& yd) noexcept {
    pdot_B.noalias() = X * yd;
    if (!rotates) return;
    const Vec3 rate = X_theta * yd;
    zeta_B.noalias() = H * rate;
    zetadot_B = rotation_tangent_bias(theta, rate);
    const Vec3 o_dot = zeta_B.cross(o_B);
    pdot_B += o_dot;
    pddot_B = zetadot_B.cross(o_B) + zeta_B.cross(o_dot);
  }
  /// Jr, Jw for the body rotation A.
  void world_gradients(const Mat3& A) noexcept {
    Jr.noalias() = A * X;
    if (!rotates) return;
    Jw.noalias() = A * HX;
    const Vec3 o = A * o_B;
    for (Eigen::Index k = 0; k < Jr.cols(); ++k) Jr.col(k) += Jw.col(k).cross(o);
  }
};

}  // namespace floatframe
