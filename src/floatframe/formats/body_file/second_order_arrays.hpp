#pragma once
// Displacements of second order (body/second_order.hpp) as members of a body file: matrices
// nm x nm one behind the other.
//   second_order_S      3: S2[j]
//   second_order_Si     9: S2i[i][j] in place 3 i + j
//   second_order_nodes  markers that have h and theta, ascending
//   second_order_h, second_order_theta  3 of each of these markers
// All or none of them. `projection_h` beside the projection data: 3 of each of its nodes.
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
/// ProjectionData::h; empty if there is none.
MatX read_projection_h(ArrayReader& arrays, Eigen::Index nm, Eigen::Index nodes);
/// Adds an error if a matrix is not symmetric.
void check_second_order(const FlexibleBody& body, ArrayReader& arrays);

}  // namespace floatframe
