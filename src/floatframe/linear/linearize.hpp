#pragma once
// A model as a linear system about a state, for vibrations, stability and controllers.
//
// In the coordinates of the options, with small changes x of the configuration from the state and
// dlambda of the constraint forces there,
//   M xddot + C xdot + K x + J^T dlambda = -r,   J x = 0.                                       (1)
// In equilibrium r = 0. The motions that satisfy the constraints are x = N y, N null space of J:
//   (N^T M N) yddot + (N^T C N) ydot + (N^T K N) y = 0                                          (2)
// has the vibrations of the model, the same in all coordinates.
//
// K = dr/dx is complete: it includes d(M a - Q_v)/dx at the accelerations a of the state, and all
// of J^T lambda. In motion N changes with the state, and (2) holds in equilibrium
// (`Start::equilibrium`) only; `linear_system` describes the motion itself in that case, too. Time
// and inputs are constant. Derivatives are differences over two steps, extrapolated: a kink of a
// law within them is averaged.
#include <string>
#include <vector>

#include "floatframe/description/system_state.hpp"
#include "floatframe/loops/start_report.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/stepping/stepping.hpp"

namespace floatframe {

struct Linearization {
  /// Mass; damping and gyroscopic terms; stiffness with the geometric one of gravity, of applied
  /// and of constraint forces and the centrifugal terms. Not symmetrised, n x n: nv coordinates and
  /// behind them the states z of elements, with the equations zdot = f(x, xdot, z).
  MatX M, C, K;
  MatX J;                                ///< constraint Jacobian, nc x n
  VecX r;                                ///< unbalanced forces: -M times the accelerations
  std::vector<std::string> coordinates;  ///< n: "joint 'crank'", "mode 2 of body 'beam'"
  std::vector<std::string> constraints;  ///< nc: "joint 'guide'"
  SystemState state;                     ///< the state: joints, bodies, time
  StartReport start;                     ///< changes of the start values
  /// Bodies whose geometric stiffening is included without an explicit option.
  std::vector<std::string> stiffened;
};

/// At the start state given by the options: given values with loops closed, the equilibrium, or a
/// state (`.state = std::make_shared<SystemState>(simulation.state())`). Relative coordinates are
/// those of joints and modes; absolute ones 12 for each body frame (position, then the three axes),
/// modes and outer points, with J that keeps the axes orthonormal. Dense, 4 evaluations of the
/// system for each coordinate. Throws InputError for invalid options and for a state of another
/// model, RunError if there is no start state.
Linearization linearize(const Model& model, const SimulationOptions& options = {});

}  // namespace floatframe
