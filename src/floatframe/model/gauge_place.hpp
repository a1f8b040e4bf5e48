#pragma once
// The location of a gauge: the stress location of a body, or the end of a beam element, that a
// description refers to. An ambiguous description is an error; rounding never selects one.
#include <string>

#include "floatframe/description/description.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

struct FlexibleBody;

/// Throws nothing; errors are returned as the sentence.
struct GaugeChoice {
  int place = -1, section = -1;  ///< of BodyStress: one of the two
  std::string error;
};
/// `gauge`: its directions in body axes. `point`: from `at`, in body axes; null: by `node_name` or
/// the number in the description.
GaugeChoice find_place(const FlexibleBody& body, const std::string& name,
                       const GaugeDescription& gauge, const Vec3* point,
                       const std::string& node_name, bool section);

}  // namespace floatframe
