#pragma once
// Stress of a body (body/body_stress.hpp) as members of a body file.
//   stress_places     places x 6: point of the surface + 1 (0: none), node, its number in the file
//                     (0: none), layer (0 solid, 1 top, 2 bottom, 3 section), group, doubtful
//   stress_p          places x 3
//   stress_modes      places x 6 x nm;  stress_loads: places x 6 x (12 + nm), or absent
//   stress_groups     groups x 2: Young's modulus, Poisson's ratio
//   stress_sections   sections x 5: element, node, number, end, first place; absent without beams
//   section_p         sections x 3
//   section_modes, section_loads  sections x 6 x nm, x (12 + nm)
// Names of groups and beams are in the header. Files once had `surface_stress` of solids alone,
// points x 6 x nm.
#include <memory>
#include <string>
#include <vector>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/formats/body_file/second_order_arrays.hpp"

namespace floatframe {

/// What the header holds.
struct StressNames {
  std::vector<std::string> groups, beams;  ///< beams: one a section
};

void add_stress(const FlexibleBody& body, NamedBytes& arrays);
/// Null if the file has none. `nodes`, `positions`: of the surface.
std::shared_ptr<const BodyStress> read_stress(ArrayReader& arrays, Eigen::Index nm,
                                              const std::vector<int>& nodes, const Mat3X& positions,
                                              const StressNames& names);

}  // namespace floatframe
