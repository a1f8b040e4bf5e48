#pragma once
// The state a run starts from, with loops closed (loops/close_loops.hpp), found once at load time
// in relative coordinates (allocates, throws; theory section 12):
//
//   find_equilibrium      r(q, lambda) = 0, Phi(q) = 0 at rest by Newton with pseudo-transient
//                         regularisation mu [1/s2],
//                           (mu M + K) x + J^T dlambda = -r,  J x = -Phi                   (1)
//                         with the factorised tangent of steps, or K by finite differences
//   start_accelerations   in any formulation
//                           M a + Phi_q^T lambda = Q,  Phi_q a = gamma                     (2)
//                         with gamma = -((Phi_q)dot v + Phi_tt): by the factorised tangent with a
//                         penalty and iterative correction, or by dense linear algebra where M is
//                         singular on the motions that satisfy the constraints
#include <functional>
#include <string>
#include <vector>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/loops/close_loops.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/loops/start_report.hpp"
#include "floatframe/start/massless.hpp"
#include "floatframe/tangents/linearization.hpp"
#include "floatframe/tangents/mass_scale.hpp"
#include "floatframe/tangents/overflow.hpp"

namespace floatframe {

struct Equilibrium {
  int iterations = 0;
  double residual = 0.0;
  double rolling = 0.0;  ///< what would roll a vehicle that nothing holds; left out [N]
  VecX lambda;
};
/// Throws RunError naming the coordinate with the largest unbalanced force.
Equilibrium find_equilibrium(RelativeFormulation& f, VecX& q);
/// Messages about elements that rest at a limit in this equilibrium, at which `f` is, about those
/// that read what is not known there, and about wheels that nothing holds.
std::vector<std::string> equilibrium_notes(RelativeFormulation& f, const Equilibrium& e);
/// Message about an equilibrium that a small disturbance would leave for good; empty: it is stable,
/// or its matrices are too large to check. Moves `f`.
std::string unstable_equilibrium(RelativeFormulation& f, const VecX& q, const VecX& lambda);

/// Start of a run in relative coordinates: the start values of the model with loops closed, or the
/// equilibrium with the start velocities of the model. `start_state` handles states and offsets,
/// too. `report`, if given, receives the changes of start values given by the user, and redundant
/// directions of joints.
State relative_start(RelativeFormulation& f, Start start, StartReport* report = nullptr);

/// The states of elements at t, q, v of the state: those that the model gives, else those of each
/// kind. Moves `f`.
void set_element_states(Formulation& f, State& state, StateStart of = StateStart::all);
/// While this exists, states of elements follow every evaluation as they are at rest; afterwards
/// they are those before it, or `keeps` the last ones.
struct RestingStates {
  explicit RestingStates(Formulation& formulation, bool keeps)
      : f(formulation), keeps_last(keeps), before(f.element_states().values()) {
    f.element_states().rest();
  }
  ~RestingStates() { keeps_last ? f.element_states().stop() : f.element_states().give(before); }
  RestingStates(const RestingStates&) = delete;
  RestingStates& operator=(const RestingStates&) = delete;
  Formulation& f;
  const bool keeps_last;
  const VecX before;
};

/// Start values of a joint with rotation vectors of at most half a turn, as they are measured.
std::vector<double> joint_coordinates_in_range(const Joint& joint,
                                               const std::vector<double>& values);

/// Adds the start values that differ from the given ones, and the corresponding messages.
void report_changes(const SystemMotion& motion, Start start, StartReport& report);

/// s alpha of the integrator if the user gives no penalty: 1e5 mean body masses, in absolute
/// coordinates 1e8. There multipliers are unknowns, so that a large penalty costs no digits, and
/// near singular configurations, where a constraint has hardly any effect on its coordinates, only
/// a large penalty converges.
double default_penalty_mass(const Model& model, Coordinates coordinates);

/// The options of the integrator for a simulation description.
StepOptions step_options(const Model& model, const SimulationDescription& o);

/// Throws RunError naming a coordinate whose generalised force at the start is not finite or above
/// `largest_magnitude`: an overflow must not be reported as a singular matrix.
void check_magnitudes(const VecX& force, const std::function<std::string(int)>& owner);

/// The same for the diagonal of the mass matrix.
void check_masses(const VecX& diagonal, const std::function<std::string(int)>& owner);

/// The bodies that move when the velocities are a column of `directions`, by their indices.
std::vector<std::size_t> bodies_moved(Formulation& f, const State& state, const MatX& directions);

/// The names of the moving bodies; without any, the owner of that coordinate.
std::string moving_bodies(Formulation& f, const State& state, const MatX& directions);

/// Fills state.a and state.lambda by dense linear algebra, for singular mass matrices: on the null
/// space of the constraints mass may be zero where stiffness acts. Throws RunError if a direction
/// has neither.
void start_accelerations_dense(Formulation& f, State& state);
/// Fills state.a, state.a_alg and state.lambda at state.q, state.v, state.t. True if some direction
/// has no mass.
bool start_accelerations(Formulation& f, State& state, double penalty_mass);

}  // namespace floatframe
