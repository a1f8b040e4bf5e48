#include "floatframe/model/system_motion.hpp"

#include <cassert>

#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

double elastic_energy(const Body& body, const BodyKinematics& motion) noexcept {
  const MatX& K = body.data->K;
  assert(motion.y.size() == K.rows() && K.rows() == K.cols());
  double sum = 0.0;
  for (Eigen::Index k = 0; k < motion.y.size(); ++k)
    sum += 0.5 * motion.y[k] * K.col(k).dot(motion.y);
  return sum;
}

double elastic_energy(const SystemMotion& motion) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < motion.bodies.size(); ++i)
    sum += elastic_energy(motion.model.bodies[i], motion.bodies[i]);
  return sum;
}

double modal_damping_power(const SystemMotion& motion) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const VecX::ConstMapType& rate = motion.bodies[i].yd;
    const MatX& D = motion.model.bodies[i].data->D;
    assert(D.rows() == rate.size() && D.cols() == rate.size());
    for (Eigen::Index k = 0; k < rate.size(); ++k)
      for (Eigen::Index l = 0; l < rate.size(); ++l) sum += rate[k] * D(l, k) * rate[l];
  }
  return sum;
}

double SystemMotion::start_position(int joint, int component) const noexcept {
  for (const CountedAngle& c : counted)
    if (c.joint == joint && c.component == component) return *c.angle;
  const Joint& j = model.joints[joint];
  if (const TimeFunction* f = model.motion_of(j, component)) return evaluate(*f, t).f;
  const std::size_t k = component;
  return k < j.position.size() ? j.position[k] : 0.0;
}

double SystemMotion::power(int element) const noexcept {
  const std::vector<int>& markers = model.elements[static_cast<std::size_t>(element)].markers;
  const Efforts& e = effort(element);
  double power = 0.0;
  for (std::size_t i = e.markers(); i-- > 0;) {
    const MarkerState& m = marker(markers[i]);
    power += e.wrench[i].F.dot(m.v) + e.wrench[i].T.dot(m.w);
  }
  return power;
}

}  // namespace floatframe
