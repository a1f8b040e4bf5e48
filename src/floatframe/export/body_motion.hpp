#pragma once
// The motion of a body and of its nodes at an instant, as stored in files for other programs. With
// the body frame at p, R and the amplitudes y a point at p_0 of the body is at
//   x = p + R (p_0 + u),   u = X y + 1/2 e_j y^T h_j y,
//   v = p' + w x (x - p) + R (X + e_j y^T h_j) y',
// the terms with h_j only for a body with geometric stiffening, at nodes with second-order data
// (SecondOrder). A node rotates by exp(skew(theta)), theta = X_theta y plus its second order.
#include "floatframe/model/system_motion.hpp"

namespace floatframe {

struct BodyInstant {
  Vec3 p, v, a;     ///< of the origin of the body frame, world axes [m, m/s, m/s2]
  Mat3 R;           ///< R_WB
  Vec3 w, alpha;    ///< world axes [rad/s, rad/s2]
  VecX y, yd, ydd;  ///< amplitudes, rates, accelerations
};
BodyInstant body_motion(const SystemMotion& motion, int body);

struct NodeMotion {
  Vec3 p, v;         ///< world axes [m, m/s]
  Mat3 R;            ///< of the node; equals that of the body if undeformed
  Vec3 w;            ///< world axes [rad/s]
  Vec3 deformation;  ///< R u, world axes [m]
};
/// `node`: index in FlexibleBody::nodes.
NodeMotion node_motion(const Body& body, int node, const BodyInstant& motion);

/// Indices in FlexibleBody::nodes of the nodes named by the model.
std::vector<int> named_nodes(const FlexibleBody& body);

/// The second order of a node of a body with geometric stiffening; null: it has none.
const SecondOrderNode* second_order_of_node(const Body& body, int node);
/// e_j a^T h_j b
Vec3 second_order_product(const std::array<MatX, 3>& h, const VecX& a, const VecX& b);

/// Unit quaternion of a rotation with the sign closest to `before`: it does not jump to its
/// negative between instants.
Eigen::Quaterniond continued_quaternion(const Mat3& R, const Eigen::Quaterniond& before);

}  // namespace floatframe
