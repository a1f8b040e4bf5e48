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
// With geometric stiffening (SecondOrderNode) X + e_j y^T h_j and X_theta + e_j y^T theta_j stand
// for X and X_theta in rates and gradients, p_B and theta have half of these terms, and pddot_B
// and the second derivative of theta e_j ydot^T h_j ydot and e_j ydot^T theta_j ydot.
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
  Vec3 node_p = Vec3::Zero();               ///< p [m]
  Pose X_NM;                                ///< p_NM, R_NM
  Mat3X X, X_theta;                         ///< 3 x nm; with `second` at y
  const SecondOrderNode* second = nullptr;  ///< of a body that stiffens; then `rotates` is set
  const ModalNode* node = nullptr;          ///< with `second`
  bool turns = false;                       ///< with `second`: theta enters
  Mat3X HX;                                 ///< 3 x nm, H X_theta at theta
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
    second = second_order_of(model, m);
    if (!second) return;
    this->node = &node;
    turns = m.rotates;
    if (!turns) X_theta.setZero();
    local = rotates = true;
  }

  /// Only for markers with `local`.
  void deform(const VecX& y) noexcept {
    p_B.noalias() = X * y;
    p_B += node_p;
    if (rotates) {
      theta.noalias() = X_theta * y;
      if (second) bend(y);
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
    if (second) return stiffened_position(y, dy);
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
    if (second && turns) zetadot_B += H * quadratic(second->theta, yd);
    const Vec3 o_dot = zeta_B.cross(o_B);
    pdot_B += o_dot;
    pddot_B = zetadot_B.cross(o_B) + zeta_B.cross(o_dot);
    if (second) pddot_B += quadratic(second->h, yd);
  }
  /// out += weight times the derivative of Jr^T force + Jw^T torque, body axes, by h and theta.
  void add_stiffness(const Vec3& force, const Vec3& torque, double weight,
                     MatX& out) const noexcept {
    const Vec3 moment = torque + o_B.cross(force);
    for (int j = 0; j < 3; ++j) {
      out += (weight * force[j]) * second->h[j];
      if (turns) out += (weight * moment[j]) * second->theta[j];
    }
  }
  /// Jr, Jw for the body rotation A.
  void world_gradients(const Mat3& A) noexcept {
    Jr.noalias() = A * X;
    if (!rotates) return;
    Jw.noalias() = A * HX;
    const Vec3 o = A * o_B;
    for (Eigen::Index k = 0; k < Jr.cols(); ++k) Jr.col(k) += Jw.col(k).cross(o);
  }

 private:
  /// The node of a marker on a body that stiffens; null if it has no second order.
  static const SecondOrderNode* second_order_of(const Model& model, const Marker& m) {
    if (!model.bodies[m.body].stiffens()) return nullptr;
    for (const SecondOrderNode& n : model.bodies[m.body].data->second_order->nodes)
      if (n.node == m.node) return &n;
    return nullptr;
  }
  static Vec3 quadratic(const std::array<MatX, 3>& h, const VecX& x) noexcept {
    Vec3 q = Vec3::Zero();
    for (int j = 0; j < 3; ++j)
      for (Eigen::Index k = 0; k < x.size(); ++k) q[j] += x[k] * h[j].col(k).dot(x);
    return q;
  }
  /// X, X_theta, p_B and theta at y.
  void bend(const VecX& y) noexcept {
    const Eigen::Index nm = y.size();
    p_B = node_p;
    theta.setZero();
    for (Eigen::Index k = 0; k < nm; ++k) {
      for (int j = 0; j < 3; ++j) {
        X(j, k) = node->X(j, k) + second->h[j].col(k).dot(y);
        if (turns) X_theta(j, k) = node->X_theta(j, k) + second->theta[j].col(k).dot(y);
      }
      p_B += (0.5 * y[k]) * (node->X.col(k) + X.col(k));
      if (turns) theta += (0.5 * y[k]) * (node->X_theta.col(k) + X_theta.col(k));
    }
  }
  Vec3 stiffened_position(const double* y, const double* dy) const noexcept {
    Vec3 p = node_p, turn = Vec3::Zero();
    for (Eigen::Index k = 0; k < X.cols(); ++k) {
      const double yk = y[k] + dy[k];
      p += yk * node->X.col(k);
      if (turns) turn += yk * node->X_theta.col(k);
      for (Eigen::Index l = 0; l < X.cols(); ++l) {
        const double half = 0.5 * yk * (y[l] + dy[l]);
        for (int j = 0; j < 3; ++j) {
          p[j] += half * second->h[j](k, l);
          if (turns) turn[j] += half * second->theta[j](k, l);
        }
      }
    }
    return p + (turns ? Vec3(rotation_exp(turn) * X_NM.p) : X_NM.p);
  }
};

}  // namespace floatframe
