// Power of a force element, positive into the bodies it acts on [W]: the sum of F . v + T . w over
// its markers.
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

template <>
double output_value_of<OutputType::power>(const SystemMotion& motion, const Output& output,
                                          FollowedOutput&) noexcept {
  const Force& force = motion.model.forces[output.force];
  const WrenchRow& w = motion.force(output.force).wrench;
  const MarkerState& b = motion.marker(force.b);
  double power = w.Fb.dot(b.v) + w.Tb.dot(b.w);
  if (force.a < 0) return power;
  const MarkerState& a = motion.marker(force.a);
  power += w.Fa.dot(a.v) + w.Ta.dot(a.w);
  return power;
}

constinit const OutputKind power_output = {
    .about = "power of its force, positive into the bodies", .of = OutputOf::force, .unit = "W"};

}  // namespace floatframe
