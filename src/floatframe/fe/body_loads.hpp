#pragma once
// Loads of a body's mass: densities rho e_j and rho r_i e_j, which make up the inertia forces and
// the weight of a rigid body, with the consistent masses of the elements. Column j:
// rho e_j; column 3 + 3 i + j: rho r_i e_j, r from the origin of the body.
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/integration.hpp"
#include "floatframe/fe/stress_stiffness.hpp"

namespace floatframe {

struct ElementInput;
struct ElementKernel;

inline constexpr int linear_load_cases = 12;

/// The fields e_j and r_i e_j at the nodes of an element, its degrees of freedom x 12: exact for
/// beams (slopes of the axis) and solids; for shells and about a beam's axis half the curl.
void linear_fields(const ElementInput& input, int nodes, int dofs_per_node, bool beam,
                   MatX& fields);

/// Displacement field on which the mass of an element acts.
enum class ElementMass {
  linear,          ///< linear displacements between the nodes: forces only
  consistent,      ///< the shape functions
  section_inertia  ///< with the rotary and torsional inertia of beam sections
};
void element_mass(const ElementKernel& kernel, const ElementInput& input, ElementMass mass,
                  MatX& M);

/// Forces and moments at all nodes, 3 nodes() x 12 each, including point masses.
NodalShapes linear_loads(const FeModel& model, ElementMass mass = ElementMass::section_inertia,
                         Integration integration = Integration::exact);

}  // namespace floatframe
