#pragma once
// The state a run starts from, found once at load time in relative coordinates (allocates, throws;
// theory section 12):
//
//   close_loops           q and v with
//                           Phi(q) = 0,  Phi_q v + Phi_t = 0                               (1)
//                         and the start values, along a path from the drawn configuration; where
//                         they contradict, those that are kept never change
//   find_equilibrium      r(q, lambda) = 0, Phi(q) = 0 at rest by Newton with pseudo-transient
//                         regularisation mu [1/s2],
//                           (mu M + K) x + J^T dlambda = -r,  J x = -Phi                   (2)
//                         with the factorised tangent of steps, or K by finite differences
//   start_accelerations   in any formulation
//                           M a + Phi_q^T lambda = Q,  Phi_q a = gamma                     (3)
//                         with gamma = -((Phi_q)dot v + Phi_tt): by the factorised tangent with a
//                         penalty and iterative correction, or by dense linear algebra where M is
//                         singular on the motions that satisfy the constraints
#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/simulation/linearization.hpp"
#include "floatframe/simulation/mass_scale.hpp"
#include "floatframe/simulation/massless.hpp"
#include "floatframe/simulation/overflow.hpp"
#include "floatframe/simulation/results.hpp"

namespace floatframe {

/// At time t. Throws RunError naming the joint or rod that has a gap, or the joints that keep their
/// values if these are the reason. Without `as_given` the positions differ from those of the model,
/// so no joint is held at its given value.
void close_loops(RelativeFormulation& f, VecX& q, VecX& v, bool positions, double t = 0.0,
                 bool as_given = true);

struct Equilibrium {
  int iterations = 0;
  double residual = 0.0;
  VecX lambda;
};
/// Throws RunError naming the coordinate with the largest unbalanced force.
Equilibrium find_equilibrium(RelativeFormulation& f, VecX& q);
/// Message about an equilibrium that a small disturbance would leave for good; empty: it is stable,
/// or its matrices are too large to check. Moves `f`.
std::string unstable_equilibrium(RelativeFormulation& f, const VecX& q, const VecX& lambda);

/// Start of a run in relative coordinates: the start values of the model with loops closed, or the
/// equilibrium with the start velocities of the model. `start_state` handles states and offsets,
/// too. `report`, if given, receives the changes of start values given by the user, and redundant
/// directions of joints.
State relative_start(RelativeFormulation& f, Start start, StartReport* report = nullptr);

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

/// Below it, inertias of parts of the body become denormal numbers [kg].
inline constexpr double smallest_mass = 1e-300;

/// Throws RunError if a mass is too small to compute with, or with the text about a number that is
/// too large (`overflow_text`).
void check_numbers(const Model& model, const std::string& overflow, double t);

/// Throws RunError naming a coordinate whose generalised force at the start is not finite or above
/// `largest_magnitude`: an overflow must not be reported as a singular matrix.
void check_magnitudes(const VecX& force, const std::function<std::string(int)>& owner);

/// The same for the diagonal of the mass matrix.
void check_masses(const VecX& diagonal, const std::function<std::string(int)>& owner);

/// The system at a small distance along a direction: residual without acceleration (nv), and the
/// products of its mass matrix and constraint Jacobian with directions Z (nv x k, nc x k).
struct Neighbour {
  VecX r;
  MatX MZ, JZ;
};
/// The system at the positions retracted by the increment `x`.
using NeighbourAt = std::function<Neighbour(const VecX& x, const MatX& Z)>;

/// Start accelerations by dense linear algebra, for singular mass matrices: on the null space of
/// the constraints mass may be zero where stiffness acts. `mass`: nv x nv, `possible`: see
/// mass_scale.hpp, `J`: nc x nv. Throws RunError if a direction has neither; `loose` returns the
/// sentence about unrestrained directions (columns).
void dense_start(const MatX& mass, const VecX& possible, const MatX& J, const VecX& force,
                 const VecX& gamma, const NeighbourAt& neighbour,
                 const std::function<std::string(const MatX&)>& loose, VecX& a, VecX& lambda);

/// "body 'a'", "bodies 'a', 'b' and 'c'".
std::string named_text(const char* one, const char* many, const std::vector<std::string>& names);

/// The message that bodies move without mass, stiffness or constraint, and what is missing; without
/// any body, `owner` names the moving coordinate.
std::string loose_sentence(const Model& model, const std::vector<std::size_t>& bodies,
                           const std::string& owner);

/// The bodies that move when the velocities are a column of `directions`, by their indices.
inline std::vector<std::size_t> bodies_moved(Formulation& f, const State& state,
                                             const MatX& directions) {
  const Model& model = f.model();
  VecX speed = VecX::Zero(static_cast<Eigen::Index>(model.bodies.size()));
  f.positions(state.t, state.q);
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    f.velocities(directions.col(k).normalized());
    const SystemMotion& motion = f.motion();
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      double v = motion.bodies[i].w_WB.norm() * model.bodies[i].length;
      for (std::size_t m = 0; m < model.markers.size(); ++m)
        if (model.markers[m].body == static_cast<int>(i))
          v = std::max(v, motion.markers[m]->v.norm());
      speed[i] = std::max(speed[i], v);
    }
  }
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (speed[i] > 1e-3 * speed.maxCoeff()) moved.push_back(i);
  return moved;
}

/// The owner of the largest component of the first direction.
inline std::string coordinate_moved(Formulation& f, const MatX& directions) {
  Eigen::Index worst = 0;
  directions.col(0).cwiseAbs().maxCoeff(&worst);
  return f.coordinate_owner(static_cast<int>(worst));
}

/// The names of the moving bodies; without any, the owner of that coordinate.
inline std::string moving_bodies(Formulation& f, const State& state, const MatX& directions) {
  std::vector<std::string> names;
  for (const std::size_t i : bodies_moved(f, state, directions))
    names.push_back(f.model().bodies[i].name);
  return names.empty() ? coordinate_moved(f, directions) : named_text("body", "bodies", names);
}

/// Fills state.a and state.lambda by dense linear algebra.
inline void start_accelerations_dense(Formulation& f, State& state) {
  const int nv = f.velocities();
  const VecX no_lambda = VecX::Zero(f.constraints());
  const VecX possible = possible_masses(f, state);
  const VecX r0 = residual_at(f, state.t, state.q, state.v, no_lambda);
  check_magnitudes(r0, [&](int i) { return f.coordinate_owner(i); });
  const MatX mass = mass_matrix(f, test_accelerations(r0, possible), r0, no_lambda);
  const MatX J = f.constraint_jacobian();
  VecX gamma(f.constraints()), q1(state.q.size());
  f.constraint_accelerations(VecX::Zero(nv), gamma);
  const auto neighbour = [&](const VecX& increment, const MatX& Z) {
    Neighbour n;
    f.retract(state.q, increment, q1);
    n.r = residual_at(f, state.t, q1, state.v, no_lambda);
    n.MZ.resize(nv, Z.cols());
    const double size = std::max(1.0, n.r.cwiseAbs().maxCoeff());
    for (Eigen::Index k = 0; k < Z.cols(); ++k)
      n.MZ.col(k) = mass_times(f, Z.col(k), size, n.r, no_lambda);
    n.JZ = f.constraint_rows() * Z;
    return n;
  };
  dense_start(
      mass, possible, J, -r0, -gamma, neighbour,
      [&](const MatX& directions) {
        return loose_sentence(f.model(), bodies_moved(f, state, directions),
                              coordinate_moved(f, directions));
      },
      state.a, state.lambda);
}

/// Fills state.a, state.a_alg and state.lambda at state.q, state.v, state.t. True if some direction
/// has no mass.
inline bool start_accelerations(Formulation& f, State& state, double penalty_mass) {
  state.a = VecX::Zero(f.velocities());
  state.lambda = VecX::Zero(f.constraints());
  check_numbers(f.model(), overflow_text(f, state, state.t, largest_magnitude), state.t);
  const VecX possible = possible_masses(f, state);
  dynamics_at(f, state);
  const VecX diagonal = mass_diagonal(f, state);
  // A coordinate whose mass is round-off may pass the pivot test by chance: check it first.
  const double growth = growth_by_mass(f, diagonal, possible, penalty_mass);
  // Dense linear algebra also detects directions that preloaded springs do not hold, as fast.
  const bool small = diagonal.size() <= few_dense;
  const bool good = may_lack_mass(growth)
                        ? !small && start_held_by_stiffness(
                                        f, state, mass_scale(diagonal, possible), penalty_mass)
                        : start_by_passes(f, state, no_stiffness, penalty_mass, false, false);
  if (!good) start_accelerations_dense(f, state);
  state.a_alg = state.a;
  dynamics_at(f, state);
  return lacks_mass(growth);
}

}  // namespace floatframe
