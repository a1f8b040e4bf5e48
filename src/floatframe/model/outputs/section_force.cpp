// Section forces at the end of a beam element, local axes of the beam (model/gauge.hpp): N, Vy, Vz
// [N], T, My, Mz [N m] on the face whose normal is x.
#include <cassert>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

constexpr const char* section_words[] = {"N", "Vy", "Vz", "T", "My", "Mz"};

const char* section_unit(const Model&, const Output& output) {
  return output.component < 3 ? "N" : "N m";
}

}  // namespace

template <>
double output_value_of<OutputType::section_force>(const SystemMotion& motion, const Output& output,
                                                  FollowedOutput&) noexcept {
  assert(is_index(output.gauge, motion.model.gauges));
  return gauge_values(motion, motion.model.gauges[output.gauge])(output.component);
}

constinit const OutputKind section_force_output = {
    .about = "of a beam at one of its nodes, local axes of the beam",
    .of = OutputOf::gauge,
    .components = {"component", section_words},
    .unit = "N or N m",
    .unit_of = section_unit,
    .needs_of_motion = {.accelerations = true}};

}  // namespace floatframe
