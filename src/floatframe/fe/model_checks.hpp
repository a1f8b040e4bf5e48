#pragma once
// Suspicious properties of a finite-element model, and its volume: for health reports.
// The model must be valid (`validate`).
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Quality of a solid's shape at its worst corner: the Jacobian over the lengths of the three edges
/// there (their tangents), divided by its value in the regular element. 1: regular; 0: flat;
/// negative: inverted there. Shells and beams: 1.
double corner_quality(const FeModel& model, const FeElement& element);
/// Longest over shortest edge (straight); 1 for beams.
double aspect_ratio(const FeModel& model, const FeElement& element);

/// Badly shaped elements with their numbers, worst first: corner quality below 0.01, aspect ratio
/// above 20. At most one sentence of each kind, listing five elements.
std::vector<std::string> shape_warnings(const FeModel& model);

/// Nodes that no element, point mass, spider, equation or matrix uses, ascending.
std::vector<int> unreferenced_nodes(const FeModel& model);

/// All suspicious properties, one sentence each: shapes, materials in use without density, unused
/// nodes, elements on the same nodes.
std::vector<std::string> model_warnings(const FeModel& model);

/// Of all elements [m3]: beams A L, shells area times thickness.
double volume(const FeModel& model);
/// Volume times density and point masses [kg].
double volume_times_density(const FeModel& model);

}  // namespace floatframe
