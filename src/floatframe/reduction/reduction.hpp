#pragma once
// From a finite-element model to a flexible body: mode shapes, modal stiffness and damping, inertia
// integrals.
//
// Craig-Bampton: with the dofs split into clamped (body reference, zero in every mode), interface b
// and inner i,
//   constraint modes        X_i = -K_ii^-1 K_ib   one for each interface dof, the others held
//   fixed-interface modes   K_ii x = w^2 M_ii x   clamped and interface dofs held,
//                                                 x^T M x = 1, w > 0
// Isoparametric masses give rotations no inertia, so M_ii is singular; K_ii is not, and the
// eigenproblem is solved in the form M_ii x = (1/w^2) K_ii x. The largest component of each dynamic
// mode is positive.
//
// The body reference must remove the six rigid motions: a node with all six dofs clamped gives a
// frame that follows this node (tangent frame); for rods the translations of both ends and one
// rotation about the axis (chord frame). The finite-element nodes are given in the body frame. Load
// time: allocates and throws InputError.
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/reduction/mode_set.hpp"
#include "floatframe/reduction/reduction_options.hpp"

namespace floatframe {

/// Which nodes have displacements of second order (SecondOrder::nodes, ProjectionData::h).
enum class SecondOrderOf {
  all_nodes,   ///< of geometric stiffening in runs, also by projection
  named_nodes  ///< for the stiffness of loads: others only if this takes little memory
};

/// Throws InputError: unknown nodes, a dof both clamped and interface, a reference that leaves a
/// rigid motion, loose parts, more modes than there are massive dofs.
FlexibleBody reduce(const FeModel& model, const ReductionOptions& options,
                    SecondOrderOf second_order = SecondOrderOf::all_nodes);

/// Craig-Bampton modes of a validated model.
ModeSet craig_bampton_modes(const FeModel& model, const ReductionOptions& options);
/// Analytic shapes of a straight bar of beams clamped at its first node.
ModeSet analytic_bar_modes(const FeModel& model, int dynamic_per_plane);
/// Roots of tan(beta) = tanh(beta), n = 1, 2, ...: 3.9266023, 7.0685827, ...
double clamped_pinned_root(int n);

}  // namespace floatframe
