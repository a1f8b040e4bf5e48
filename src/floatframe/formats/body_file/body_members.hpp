#pragma once
// The members of a body file that hold its matrices, for ArrayWriter and ArrayReader.
//
// Are the numbers of a body file those of a body, and are duplicate data consistent
// (arrays, header, health report)?
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/body_file/body_arrays.hpp"
#include "floatframe/formats/body_file/body_file.hpp"

namespace floatframe {

/// MassModel as the header names it.
inline constexpr std::array body_mass_models = {"isoparametric", "six_dof", "hermite"};
/// Degrees of freedom of an interface, as the header names them.
inline constexpr std::array interface_directions = {"x", "y", "z", "rx", "ry", "rz"};

template <class IO, class Body>
void body_matrices(IO& io, Body& body, Eigen::Index nm) {
  auto& v = body.invariants;
  io.number("m", v.m);
  io.list("m_u", v.m_u);
  io.matrix("P_u", v.P_u, 3, 3);
  io.matrix("S", v.S, 3, nm);
  for (std::size_t i = 0; i < 3; ++i) io.matrix(fmt::format("S{}", i + 1), v.Si[i], 3, nm);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      io.matrix(fmt::format("S{}{}", i + 1, j + 1), v.Sij[i][j], nm, nm);
  io.matrix("K", body.K, nm, nm);
  io.matrix("D", body.D, nm, nm);
  io.list("frequencies", body.fixed_interface_frequencies);
}

template <class IO, class Nodes>
void marker_matrices(IO& io, Nodes& nodes, Eigen::Index nm) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  io.rows(
      "marker_p", n, [&](std::size_t k) -> auto& { return nodes[k].p; });
  io.stack(
      "marker_X", n, 3, nm, [&](std::size_t k) -> auto& { return nodes[k].X; });
  io.stack(
      "marker_X_theta", n, 3, nm, [&](std::size_t k) -> auto& { return nodes[k].X_theta; });
}

/// M_6 or M_s follow.
template <class IO, class Data>
void projection_matrices(IO& io, Data& data, Eigen::Index n, Eigen::Index nm) {
  io.points("projection_p", data.p, n);
  io.grouped("projection_X", data.X, n, 3, nm);
  if (io.wants("projection_X_theta", data.six_dof()))
    io.grouped("projection_X_theta", data.X_theta, n, 3, nm);
}

// Displacements of second order (body/second_order.hpp) as members of a body file: matrices
// nm x nm one after the other.
//   second_order_S      3: S2[j]
//   second_order_Si     9: S2i[i][j] at index 3 i + j
//   second_order_nodes  markers that have h and theta, ascending
//   second_order_h, second_order_theta  3 of each of these markers
// All or none of them. Displacements of points that turn with the nodes (FlexibleBody::turning)
//   turning_S, turning_Si   as second_order_S, second_order_Si
// In addition to the projection data:
//   projection_h            3 of each of its nodes
//   projection_turning      point and rotation of each ProjectionData::turning, k x 2
//   projection_arms         k x 3
//   projection_rotations    rotations x 3 x nm
//   projection_twist_S, projection_twist_Si

void add_second_order(const FlexibleBody& body, ArrayWriter& out);
/// Null if the file has none. `markers`: how many the file has.
std::shared_ptr<const SecondOrder> read_second_order(ArrayReader& arrays, Eigen::Index nm,
                                                     Eigen::Index markers);
/// FlexibleBody::turning; null if the file has none.
std::shared_ptr<const SecondOrder> read_turning(ArrayReader& arrays, Eigen::Index nm);
/// The second-order part of the projection data.
void read_projection_second_order(ArrayReader& arrays, Eigen::Index nm, ProjectionData& data);
/// Adds an error if a matrix is not symmetric.
void check_second_order(const FlexibleBody& body, ArrayReader& arrays);

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

/// Content of the header.
struct StressNames {
  std::vector<std::string> groups, beams;  ///< beams: one per section
};

void add_stress(const FlexibleBody& body, ArrayWriter& out);
/// Null if the file has none. `nodes`, `positions`: of the surface.
std::shared_ptr<const BodyStress> read_stress(ArrayReader& arrays, Eigen::Index nm,
                                              const std::vector<int>& nodes, const Mat3X& positions,
                                              const StressNames& names);

/// Numbers of the header that are not part of the body.
struct BodyHeader {
  std::vector<double> frequencies;                    ///< of each mode [Hz]; -1: not given
  std::vector<std::vector<std::int64_t>> moves_with;  ///< surface points of each marker
  StressNames stress;
};

/// `content`: complete, of sizes that fit. `name`: of the file.
void check_body_numbers(const BodyFile& content, const BodyHeader& header, ArrayReader& arrays,
                        ErrorList& errors, const std::string& name);

}  // namespace floatframe
