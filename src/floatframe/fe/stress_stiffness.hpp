#pragma once
// Stress stiffness of load cases in modes: the effect of the stress of a linear static solution on
// further displacements,
//   u^T K_sigma u = int sigma : grad u^T grad u dV = sum over points sum_i grad u_i^T s grad u_i
// s: stress times volume (StressedPoint). Solids: all stresses; shells: the membrane forces on
// displacements that are linear in each triangle; beams: the axial force on the slopes across the
// axis and on the twist (torsion stiffened by tension), and the torque on the twist of second order
// of a beam that is bent in two planes. One pass over the elements for all cases (PairProducts).
// Source: Cook, Malkus, Plesha, Witt, Concepts and Applications of Finite
// Element Analysis (2002), section 18.4.
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/integration.hpp"
#include "floatframe/fe/pair_products.hpp"

namespace floatframe {

/// Translations and rotations of all nodes, 3 rows per node; one column per shape.
struct NodalShapes {
  MatX U, Theta;
};

struct ElementKernel;
/// Of the nodes of an element, one row per degree of freedom.
void element_displacements(const FeElement& e, const ElementKernel& kernel,
                           const NodalShapes& shapes, MatX& q);

/// One column per case: the lower half of X^T K_sigma X, row by row. Zero for models given by
/// matrices, which have no elements.
MatX stress_stiffness(const FeModel& model, const NodalShapes& modes, const NodalShapes& cases,
                      Integration integration = Integration::exact);

/// The same in two shares.
struct StressStiffness {
  MatX direct;  ///< from stresses and axial forces
  MatX twist;   ///< from torques on the twist of second order; empty without beams
};
StressStiffness shares_of_stress_stiffness(const FeModel& model, const NodalShapes& modes,
                                           const NodalShapes& cases, Integration integration);

}  // namespace floatframe
