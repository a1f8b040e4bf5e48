#pragma once
// The part of a marker's motion due to the modal amplitudes of its body only, in body axes; shared
// by the formulations. Node N at p with shapes X, X_theta; marker at p_NM, R_NM on it.
// With theta = X_theta y, E = exp(skew(theta)), o = E p_NM:
//   p_B    = p + X y + o              R_B = E R_NM
//   pdot_B = X ydot + zeta_B x o      zeta_B = H thetadot,  H the tangent of the exponential
// and, with yddot = 0,
//   pddot_B = zetadot_B x o + zeta_B x (zeta_B x o),  zetadot_B = Hdot thetadot.
// A modal rate moves the marker, in world axes, by
//   Jw = A H X_theta,   Jr = A X + Jw x (A o).
// With geometric stiffening (SecondOrderNode) X + e_j y^T h_j and X_theta + e_j y^T theta_j replace
// X and X_theta in rates and gradients, p_B and theta contain half of these terms, and pddot_B and
// the second derivative of theta contain e_j ydot^T h_j ydot and e_j ydot^T theta_j ydot.
#include <cassert>
#include <memory>

#include "floatframe/formulation/bent_columns.hpp"
#include "floatframe/formulation/sliding_point.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct LocalMarker {
  int body = -1;
  bool local = false;    ///< deforms with modes
  bool rotates = false;  ///< the node's rotation enters
  bool turns = false;    ///< with `second`: theta enters
  // Body axes, from the body frame.
  Vec3 p_B = Vec3::Zero();                               ///< position [m]
  Vec3 pdot_B = Vec3::Zero(), pddot_B = Vec3::Zero();    ///< relative to the body [m/s, m/s2]
  Mat3 R_B = Mat3::Identity();                           ///< orientation
  Vec3 zeta_B = Vec3::Zero(), zetadot_B = Vec3::Zero();  ///< the same of turning [rad/s, rad/s2]
  Vec3 theta = Vec3::Zero();                             ///< rotation vector of the node [rad]
  Vec3 o_B = Vec3::Zero();                               ///< o, from the node [m]
  Mat3 H = Mat3::Identity();                             ///< at theta
  // Fixed.
  Vec3 node_p = Vec3::Zero();            ///< p [m]
  Pose X_NM;                             ///< p_NM, R_NM
  Mat3X X, X_theta;                      ///< 3 x nm; with `second` at y
  std::unique_ptr<BentNode> second;      ///< of a node with h or theta on a body that stiffens
  std::unique_ptr<SlidingPoint> slides;  ///< of one that slides, with `guide`
  int guide = -1;                        ///< the marker that it is at the foot of
  /// World axes (`world_gradients`), 3 x nm: velocity and angular velocity per modal rate.
  Mat3X Jr, Jw;

  LocalMarker() = default;
  LocalMarker(const Model& model, const Marker& m) : body(m.body), X_NM(m.X_NM) {
    p_B = m.X_NM.p;
    R_B = m.X_NM.R;
    if (m.body < 0) return;
    const FlexibleBody& data = *model.bodies[m.body].data;
    assert(is_rotation(m.X_NM.R));
    X = X_theta = Jr = Jw = Mat3X::Zero(3, data.modes());
    if (m.path) {  // no terms of second order: those are along the path
      slides = std::make_unique<SlidingPoint>(*m.path, data);
      guide = m.guide;
      local = true;
      return;
    }
    if (m.node < 0) return;
    const ModalNode& node = data.nodes[m.node];
    assert(node.X.cols() == data.modes() && node.X_theta.cols() == data.modes());
    node_p = node.p;
    p_B = node.p + m.X_NM.p;
    X = node.X;
    X_theta = node.X_theta;
    rotates = m.rotates && !node.X_theta.isZero(0.0);
    local = !node.X.isZero(0.0) || rotates;
    const SecondOrderNode* h = second_order_of(model, m);
    if (!h) return;
    BentNode bent{h, BentColumns(X, h->h), BentColumns(X_theta, h->theta)};
    turns = m.rotates && bent.turn.bends();
    if (!bent.place.bends() && !turns) return;
    second = std::make_unique<BentNode>(std::move(bent));
    rotates = rotates || turns;
    local = true;
  }

  /// Only for markers with `local`. `stiffens`: there may be markers with `second`.
  template <bool stiffens>
  void deform(const VecX& y) noexcept {
    assert(local && y.size() == X.cols());
    if (slides) return;  // when its guide has been found
    if (stiffens && second) {
      p_B = second->place.bend(y.data(), X.data());
    } else {
      p_B.noalias() = X * y;
    }
    p_B += node_p;
    if (rotates) {
      if (stiffens && turns)
        theta = second->turn.bend(y.data(), X_theta.data());
      else
        theta.noalias() = X_theta * y;
      const Mat3 e = rotation_exp(theta);
      H = rotation_tangent(theta);
      Jw.noalias() = H * X_theta;
      o_B.noalias() = e * X_NM.p;
      p_B += o_B;
      R_B.noalias() = e * X_NM.R;
    } else {
      p_B += X_NM.p;
    }
  }
  /// Of a marker that slides, its guide at `p`, body axes.
  void slide(const Vec3& p, const VecX& y) noexcept {
    assert(slides);
    slides->find(p, y, p_B, X);
  }
  /// p_B for other amplitudes, y + dy.
  template <bool stiffens>
  Vec3 position(const double* y, const double* dy) const noexcept {
    Vec3 p = node_p, turn = Vec3::Zero();
    if (stiffens && second) {
      p += second->place.at(y, dy);
      if (rotates) turn = second->turn.at(y, dy);
      return p + (rotates ? Vec3(rotation_exp(turn) * X_NM.p) : X_NM.p);
    }
    for (Eigen::Index k = 0; k < X.cols(); ++k) {
      p += (y[k] + dy[k]) * X.col(k);
      if (rotates) turn += (y[k] + dy[k]) * X_theta.col(k);
    }
    return p + (rotates ? Vec3(rotation_exp(turn) * X_NM.p) : X_NM.p);
  }
  template <bool stiffens>
  void deform_rate(const VecX& yd) noexcept {
    assert(local && yd.size() == X.cols());
    if (slides) return slides->find_rates(yd, pdot_B);
    pdot_B.noalias() = X * yd;
    if (stiffens && second) pddot_B = second->place.quadratic(yd.data());
    if (!rotates) return;
    const Vec3 rate = X_theta * yd;
    zeta_B.noalias() = H * rate;
    zetadot_B = rotation_tangent_bias(theta, rate);
    if (stiffens && turns) zetadot_B += H * second->turn.quadratic(yd.data());
    const Vec3 o_dot = zeta_B.cross(o_B);
    pdot_B += o_dot;
    if (stiffens && second)
      pddot_B += zetadot_B.cross(o_B) + zeta_B.cross(o_dot);
    else
      pddot_B = zetadot_B.cross(o_B) + zeta_B.cross(o_dot);
  }
  /// out += weight times the derivative of Jr^T force + Jw^T torque, body axes, by h and theta.
  void add_stiffness(const Vec3& force, const Vec3& torque, double weight,
                     MatX& out) const noexcept {
    assert(second && out.rows() == X.cols() && out.cols() == X.cols());
    add_weighted(second->h->h, weight * force, out);
    if (turns) add_weighted(second->h->theta, weight * (torque + o_B.cross(force)), out);
  }
  /// Jr, Jw for the body rotation A, once after `deform`.
  void world_gradients(const Mat3& A) noexcept {
    assert(local && Jr.cols() == X.cols() && Jw.cols() == X.cols());
    Jr.noalias() = A * X;
    if (!rotates) return;
    const Vec3 o = A * o_B;
    for (Eigen::Index k = 0; k < Jr.cols(); ++k) {
      const Vec3 turn = A * Jw.col(k);
      Jw.col(k) = turn;
      Jr.col(k) += turn.cross(o);
    }
  }

 private:
  static void add_weighted(const std::array<MatX, 3>& h, const Vec3& w, MatX& out) noexcept {
    const double *h0 = h[0].data(), *h1 = h[1].data(), *h2 = h[2].data();
    double* o = out.data();
    const Eigen::Index n = out.size();
    assert(h[0].size() == n && h[1].size() == n && h[2].size() == n);
    for (Eigen::Index k = 0; k < n; ++k) o[k] += w[0] * h0[k] + w[1] * h1[k] + w[2] * h2[k];
  }
  /// The node of a marker on a stiffening body; null if it has no second-order terms.
  static const SecondOrderNode* second_order_of(const Model& model, const Marker& m) {
    if (!model.bodies[m.body].stiffens()) return nullptr;
    for (const SecondOrderNode& n : model.bodies[m.body].data->second_order->nodes)
      if (n.node == m.node) return &n;
    return nullptr;
  }
};

}  // namespace floatframe
