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
#include <optional>
#include <string>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Degrees of freedom of one node, chosen by its name or, if the name is empty, by its index.
struct DofSelection {
  std::string node;
  int index = -1;
  unsigned mask = 0;  ///< bit 0..5 = ux uy uz rx ry rz, body axes
};

inline constexpr unsigned all_translations = 7u;
inline constexpr unsigned all_dofs = 63u;

struct ReductionOptions {
  std::vector<DofSelection> clamped;
  std::vector<DofSelection> interfaces;  ///< one static mode a dof, in this order, low bits first
  int normal_modes = 0;                  ///< fixed-interface modes by number
  /// If positive: all below this [Hz]; with normal_modes at most so many.
  double max_frequency = 0.0;
  /// Straight bar clamped at its first node: analytic shapes, sampled at the nodes, instead of the
  /// finite-element ones: per transverse plane (local y, then local z) the static tip shape, then
  /// this number of clamped-pinned shapes per plane. No coupling in the stiffness.
  std::optional<int> analytic_dynamic_per_plane;
  /// Any Rayleigh-Ritz basis: dofs_per_node rows per node, one column per mode.
  std::optional<MatX> basis;
  bool orthonormalise = false;  ///< modes of the reduced (K, M_ff): M_ff = I, K diagonal
  MassModel mass_model = MassModel::isoparametric;
  /// Mass of the eigenproblem; as mass_model if absent (six_dof and hermite: the consistent mass).
  std::optional<MassModel> eigen_mass;
  /// Rotary and torsional inertia of beam sections (six_dof, hermite).
  bool section_inertia = false;
  double damping_ratio = 0.0;  ///< of every mode of (K, M_ff), fraction of critical
};

/// Throws InputError: unknown nodes, a dof both clamped and interface, a reference that leaves a
/// rigid motion, loose parts, more modes than there are massive dofs.
FlexibleBody reduce(const FeModel& model, const ReductionOptions& options);

/// Full mode shapes and what is known about them, before the body is made.
struct ModeSet {
  MatX X;            ///< dofs x nm
  MatX K;            ///< nm x nm
  VecX frequencies;  ///< of the dynamic modes [Hz]
  std::vector<std::string> names;
};

/// Craig-Bampton modes of a validated model.
ModeSet craig_bampton_modes(const FeModel& model, const ReductionOptions& options);
/// Analytic shapes of a straight bar of beams clamped at its first node.
ModeSet analytic_bar_modes(const FeModel& model, int dynamic_per_plane);
/// Roots of tan(beta) = tanh(beta), n = 1, 2, ...: 3.9266023, 7.0685827, ...
double clamped_pinned_root(int n);

}  // namespace floatframe
