#include "floatframe/export/body_motion.hpp"

#include "floatframe/body/surface_points.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {

BodyInstant body_motion(const SystemMotion& motion, int body) {
  BodyInstant m;
  const BodyKinematics& b = motion.body(body);
  m.p = b.p_WB;
  m.v = b.v_WB;
  m.a = b.a_WB;
  m.R = b.R_WB;
  m.w = b.w_WB;
  m.alpha = b.alpha_WB;
  m.y = b.y;
  m.yd = b.yd;
  m.ydd = b.ydd;
  return m;
}

NodeMotion node_motion(const Body& body, int node, const BodyInstant& motion) {
  const ModalNode& n = body.data->nodes[static_cast<std::size_t>(node)];
  Vec3 u = n.X * motion.y, ud = n.X * motion.yd;
  Vec3 theta = n.X_theta * motion.y, thetad = n.X_theta * motion.yd;
  if (const SecondOrderNode* h = second_order_of_node(body, node)) {
    u += 0.5 * second_order_product(h->h, motion.y, motion.y);
    ud += second_order_product(h->h, motion.y, motion.yd);
    theta += 0.5 * second_order_product(h->theta, motion.y, motion.y);
    thetad += second_order_product(h->theta, motion.y, motion.yd);
  }
  NodeMotion out;
  const Vec3 arm = motion.R * (n.p + u);
  out.p = motion.p + arm;
  out.v = motion.v + motion.w.cross(arm) + motion.R * ud;
  out.R = motion.R * rotation_exp(theta);
  out.w = motion.w + motion.R * (rotation_tangent(theta) * thetad);
  out.deformation = motion.R * u;
  return out;
}

std::vector<int> named_nodes(const FlexibleBody& body) {
  std::vector<int> out;
  for (std::size_t k = 0; k < body.nodes.size(); ++k)
    if (!body.nodes[k].name.empty() && !is_surface_point(body.nodes[k]))
      out.push_back(static_cast<int>(k));
  return out;
}

const SecondOrderNode* second_order_of_node(const Body& body, int node) {
  if (!body.stiffens()) return nullptr;
  for (const SecondOrderNode& n : body.data->second_order->nodes)
    if (n.node == node) return &n;
  return nullptr;
}

Vec3 second_order_product(const std::array<MatX, 3>& h, const VecX& a, const VecX& b) {
  return {a.dot(h[0] * b), a.dot(h[1] * b), a.dot(h[2] * b)};
}

Eigen::Quaterniond continued_quaternion(const Mat3& R, const Eigen::Quaterniond& before) {
  Eigen::Quaterniond q(R);
  q.normalize();
  if (q.dot(before) < 0.0) q.coeffs() *= -1.0;
  return q;
}

}  // namespace floatframe
