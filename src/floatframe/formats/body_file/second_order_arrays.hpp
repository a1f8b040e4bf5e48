#pragma once
// Displacements of second order (body/second_order.hpp) as members of a body file: matrices
// nm x nm one behind the other.
//   second_order_S      3: S2[j]
//   second_order_Si     9: S2i[i][j] in place 3 i + j
//   second_order_nodes  markers that have h and theta, ascending
//   second_order_h, second_order_theta  3 of each of these markers
// All or none of them. Of displacements of what turns with the nodes (FlexibleBody::turning)
//   turning_S, turning_Si   as second_order_S, second_order_Si
// Beside the projection data:
//   projection_h            3 of each of its nodes
//   projection_turning      point and rotation of each ProjectionData::turning, k x 2
//   projection_arms         k x 3
//   projection_rotations    rotations x 3 x nm
//   projection_twist_S, projection_twist_Si
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/formats/body_file/body_arrays.hpp"

namespace floatframe {

using NamedBytes = std::vector<std::pair<std::string, std::string>>;

void add_second_order(const FlexibleBody& body, NamedBytes& arrays);
/// Null if the file has none. `markers`: how many the file has.
std::shared_ptr<const SecondOrder> read_second_order(ArrayReader& arrays, Eigen::Index nm,
                                                     Eigen::Index markers);
/// FlexibleBody::turning; null if the file has none.
std::shared_ptr<const SecondOrder> read_turning(ArrayReader& arrays, Eigen::Index nm);
/// What of the projection data is of second order.
void read_projection_second_order(ArrayReader& arrays, Eigen::Index nm, ProjectionData& data);
/// Adds an error if a matrix is not symmetric.
void check_second_order(const FlexibleBody& body, ArrayReader& arrays);

}  // namespace floatframe
