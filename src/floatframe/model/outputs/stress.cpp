// Stress at a location of a flexible body, body axes [Pa] (model/gauge.hpp): components, von Mises,
// von Mises with the sign of the principal stress of largest magnitude (for fatigue), principal
// stresses in descending order.
#include <cassert>
#include <cmath>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

constexpr const char* stress_words[] = {
    "xx",          "yy",          "zz",         "xy", "yz", "zx", "von_mises", "signed_von_mises",
    "principal_1", "principal_2", "principal_3"};

}  // namespace

template <>
double output_value_of<OutputType::stress>(const SystemMotion& motion, const Output& output,
                                           FollowedOutput&) noexcept {
  assert(is_index(output.gauge, motion.model.gauges));
  assert(output.component >= 0 && output.component < 11);
  const Vec6 s = gauge_values(motion, motion.model.gauges[output.gauge]);
  if (output.component < 6) return s(output.component);
  if (output.component == 6) return von_mises(s);
  const Vec3 p = principal_stresses(s);
  if (output.component == 7) return std::copysign(von_mises(s), p(0) + p(2));
  return p(output.component - 8);
}

constinit const OutputKind stress_output = {
    .about = "at a place of a flexible body, axes of its part",
    .of = OutputOf::gauge,
    .components = {"component", stress_words},
    .unit = "Pa",
    .needs_of_motion = {.accelerations = true}};

}  // namespace floatframe
