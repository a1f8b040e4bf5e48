#pragma once
// Displacements of second order (body/second_order.hpp) of frames of 2-node beams. A beam that
// bends draws its ends together by
//   1/2 y^T gamma y,   gamma = int v'^T v' + w'^T w' dx = X_e^T G_e X_e
// with G_e the stress stiffness of a unit axial force, per plane
//   1/(30 L) [36 3L -36 3L; 3L 4L^2 -3L -L^2; -36 -3L 36 -3L; 3L -L^2 -3L 4L^2]
// and the frame follows, held by its body reference, with the least strain energy:
//   K h = -sum_e L_e^T (EA/L) gamma_e,  L_e: stretch of the element
// Frames without loops that are held by six conditions follow without strain: from node to node
// h changes by -gamma along the element. Of a straight bar clamped at its start this is theory,
// section 8: h_1(k) = -sum over the elements up to k of gamma.
//
// Only the stretch is looked at: of the strains of second order those that an axial force works
// on. What torsion, bending moments and shear forces of a load do to bending (lateral buckling) is
// left out; so theta is that of the frame that follows, and zero where it follows without turning.
//
// The integrals S2 and S2i belong to the mass model: isoparametric h_j between nodes is linear,
// else with the foreshortening inside of the elements, and with the section inertia (and the rotary
// inertia of point masses) with the second order of their rotation, 1/2 theta x (theta x r).
#include <memory>
#include <optional>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/reduction/reduction_options.hpp"

namespace floatframe {

/// Of all nodes: rows nm (3 k + j) and on are h_j (theta_j) of node k.
struct BarSecondOrder {
  MatX h, theta;
};

/// Rows that the body reference holds, ascending; empty: not known. X: six rows per node.
std::vector<int> held_dofs(const FeModel& model, const MatX& X, const ReductionOptions& options);

/// X: six rows per node. Nothing if an element is no 2-node beam, if it is not known what holds the
/// body (a given basis without clamped nodes), or for frames of very many elements with loops.
std::optional<BarSecondOrder> bar_second_order(const FeModel& model, const MatX& X,
                                               const ReductionOptions& options);

/// The integrals, and the nodes: all, or those with a name if there are very many.
std::shared_ptr<const SecondOrder> second_order_of(const FeModel& model, const MatX& X,
                                                   const BarSecondOrder& field,
                                                   const ReductionOptions& options);

}  // namespace floatframe
