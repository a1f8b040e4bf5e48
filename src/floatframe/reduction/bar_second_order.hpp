#pragma once
// Displacements of second order (body/second_order.hpp) of frames of 2-node beams: masses rotating
// with nodes, and following of the second-order strains of the modes (following_frame.hpp).
//
// Included are the stretch and the twist of the elements: the strains of second order on which
// axial forces and torques do work. Torsion under bending moments, and the effect of shear forces
// of a load on bending (lateral buckling) are neglected.
//
// The integrals S2 and S2i belong to the mass model: isoparametric h_j between nodes is linear,
// else with the foreshortening inside of the elements. `turning` has with mass_model hermite
// 1/2 theta x (theta x r) of sections (section_inertia) and of point masses with inertia, and the
// twist of second order. If no mass resists the twist, which moves points off the axis of an
// element, it is in `second_order`; the nodes always have it there.
#include <memory>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/reduction/reduction_options.hpp"

namespace floatframe {

struct BarSecondOrder {
  std::shared_ptr<const SecondOrder> turning;       ///< null: no rotating mass
  std::shared_ptr<const SecondOrder> second_order;  ///< null: unknown
  MatX h;  ///< as ProjectionData::h; not of mass_model hermite, and only with all nodes
};

/// Rows held by the body reference, ascending; empty: unknown. X: six rows per node.
std::vector<int> held_dofs(const FeModel& model, const MatX& X, const ReductionOptions& options);

/// X: six rows per node. `second_order` is unknown if an element is not a 2-node beam, if the
/// support of the body is unknown (a given basis without clamped nodes), or for frames of very many
/// elements with loops. all_nodes: of all nodes, or of those with a name if there are very many;
/// else of all only if this takes little memory.
BarSecondOrder bar_second_order(const FeModel& model, const MatX& X,
                                const ReductionOptions& options, bool all_nodes);

}  // namespace floatframe
