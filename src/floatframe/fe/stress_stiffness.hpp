#pragma once
// Stress stiffness of load cases in modes: what the stress of a linear static solution does to
// further displacements,
//   u^T K_sigma u = int sigma : grad u^T grad u dV = sum over points sum_i grad u_i^T s grad u_i
// s: stress times volume (StressedPoint). Of solids all stresses; of shells the membrane forces on
// displacements that are linear in each triangle; of beams the axial force on the slopes across the
// axis. One pass over the elements for all cases: with the products of the gradients of all pairs
// of modes in the columns of P and the stresses of all cases in S,
//   K_sigma = sum P S^T
// is one dense product. Source: Cook, Malkus, Plesha, Witt, Concepts and Applications of Finite
// Element Analysis (2002), section 18.4.
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/integration.hpp"

namespace floatframe {

/// Translations and rotations of all nodes, 3 rows per node; one column a shape.
struct NodalShapes {
  MatX U, Theta;
};

struct ElementKernel;
/// Of the nodes of an element, one row a degree of freedom.
void element_displacements(const Element& e, const ElementKernel& kernel, const NodalShapes& shapes,
                           MatX& q);

/// One column a case: the lower half of X^T K_sigma X, row by row. Models given by matrices have no
/// elements and none.
MatX stress_stiffness(const FeModel& model, const NodalShapes& modes, const NodalShapes& cases,
                      Integration integration = Integration::exact);

/// A column of it as a matrix.
MatX symmetric_of(const Eigen::Ref<const VecX>& packed);

}  // namespace floatframe
