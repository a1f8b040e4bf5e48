#pragma once
// Options for reducing a frame of bars: those of a description of the frame and those of `reduce`.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/body/modal_damping.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Degrees of freedom of one node, along the axes of the body frame.
struct NodeDofs {
  std::string node;    ///< its name; empty: by its index
  unsigned mask = 0;   ///< bit 0..5 = ux uy uz rx ry rz
  int index = -1;      ///< of a node without a name, in `reduce` of an FeModel only
  Origin origin = {};  ///< where it is written
};

inline constexpr unsigned all_dofs = 63u;

/// Analytic shapes of one straight bar clamped at its first point, sampled at the nodes, instead of
/// the finite-element ones: per transverse plane (local y, then local z) the static tip shape and
/// `dynamic_per_plane` clamped-pinned shapes. No coupling in the stiffness.
struct AnalyticShapes {
  int dynamic_per_plane = 0;
};

struct ReductionOptions {
  std::vector<NodeDofs> clamped;     ///< the body reference: dofs that all modes leave at zero
  std::vector<NodeDofs> interfaces;  ///< one static mode per dof, in this order, low bits first
  /// Residual shapes of unit forces on all nodes of bars: `node` is the name of a bar, in `reduce`
  /// of an FeModel `index` a node.
  std::vector<NodeDofs> path = {};
  int normal_modes = 0;  ///< fixed-interface normal modes by number
  /// If positive: all below this [Hz]; with normal_modes at most so many.
  double max_frequency = 0.0;
  std::optional<AnalyticShapes> analytic;  ///< replaces interfaces and normal_modes
  /// Any Rayleigh-Ritz basis: dofs_per_node rows per node (ux..rz), one column per mode.
  std::optional<MatX> basis;
  bool orthonormalise = false;  ///< modes of the reduced (K, M_ff): M_ff = I, K diagonal
  MassModel mass_model = MassModel::isoparametric;
  /// Mass of the eigenproblem; as mass_model if absent (six_dof and hermite: the consistent mass).
  std::optional<MassModel> eigen_mass;
  /// Rotary and torsional inertia of beam sections (six_dof and hermite).
  bool section_inertia = false;
  ModalDamping damping;
};

}  // namespace floatframe
