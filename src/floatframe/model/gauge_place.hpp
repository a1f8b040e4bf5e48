#pragma once
// Where a gauge is: the place of a body's stress, or the end of a beam element, that a description
// means. What a description does not tell apart is asked for, never chosen by rounding.
#include <string>

#include "floatframe/math/types.hpp"
#include "floatframe/model/description.hpp"

namespace floatframe {

struct FlexibleBody;

/// Throws nothing; what is wrong is the sentence.
struct GaugeChoice {
  int place = -1, section = -1;  ///< of BodyStress: one of the two
  std::string error;
};
/// `gauge`: its directions in body axes. `point`: of `at`, in body axes; null: by `node_name` or
/// the number of the description.
GaugeChoice find_place(const FlexibleBody& body, const std::string& name,
                       const GaugeDescription& gauge, const Vec3* point,
                       const std::string& node_name, bool section);

}  // namespace floatframe
