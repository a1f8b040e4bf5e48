#pragma once
// Displacements of second order (body/second_order.hpp) of frames of 2-node beams: what turns with
// nodes, and how the frame follows the strains of second order of its modes (following_frame.hpp).
//
// Looked at are the stretch and the twist of the elements: of the strains of second order those
// that axial forces and torques work on. What torsion under bending moments, and shear forces of a
// load do to bending (lateral buckling) is left out.
//
// The integrals S2 and S2i belong to the mass model: isoparametric h_j between nodes is linear,
// else with the foreshortening inside of the elements. `turning` has with mass_model hermite
// 1/2 theta x (theta x r) of sections (section_inertia) and of point masses with inertia, and the
// twist of second order. Where no mass turns the twist, which moves what lies beside the axis of an
// element, is in `second_order`; the nodes always have it there.
#include <memory>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/reduction/reduction_options.hpp"

namespace floatframe {

struct BarSecondOrder {
  std::shared_ptr<const SecondOrder> turning;       ///< null: no mass turns
  std::shared_ptr<const SecondOrder> second_order;  ///< null: not known
  MatX h;  ///< as ProjectionData::h; not of mass_model hermite, and only with all nodes
};

/// Rows that the body reference holds, ascending; empty: not known. X: six rows per node.
std::vector<int> held_dofs(const FeModel& model, const MatX& X, const ReductionOptions& options);

/// X: six rows per node. `second_order` is not known if an element is no 2-node beam, if it is not
/// known what holds the body (a given basis without clamped nodes), or for frames of very many
/// elements with loops. all_nodes: of all nodes, or of those with a name if there are very many;
/// else of all only if this takes little memory.
BarSecondOrder bar_second_order(const FeModel& model, const MatX& X,
                                const ReductionOptions& options, bool all_nodes);

}  // namespace floatframe
