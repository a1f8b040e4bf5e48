// The dense linear algebra of start accelerations, and its error messages.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/core/plural.hpp"
#include "floatframe/integrator/load_iteration.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/light_motion.hpp"

namespace floatframe {

namespace {

/// Below it, inertias of parts of the body become denormal numbers [kg].
constexpr double smallest_mass = 1e-300;

/// The system at a small distance along a direction: residual without acceleration (nv), and the
/// products of its mass matrix and constraint Jacobian with directions Z (nv x k, nc x k).
struct Neighbour {
  VecX r;
  MatX MZ, JZ;
};
/// The system at the positions retracted by the increment `x`.
using NeighbourAt = std::function<Neighbour(const VecX& x, const MatX& Z)>;

/// Index of the first entry that is not finite or too large, -1 if there is none.
int out_of_range(const VecX& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!(std::abs(x[i]) < largest_magnitude)) return static_cast<int>(i);
  return -1;
}

std::string magnitude_text(double x) {
  return std::isfinite(x) ? fmt::format("{:.3g}", x) : "not a finite number";
}

/// All a with J a = gamma: a_p + N z.
struct Motions {
  VecX a_p;
  MatX N;
};

Motions motions(const MatX& J, const VecX& gamma, const VecX& possible) {
  const Eigen::Index nv = possible.size();
  // In coordinates of similar magnitude: rows of lengths, angles and amplitudes would mix scales.
  const VecX unit = possible.cwiseSqrt().cwiseInverse();
  if (J.rows() == 0 || nv == 0) return {VecX::Zero(nv), unit.asDiagonal()};
  // J^T P = Q R: the leading columns of Q span the rows of J, the others its null space.
  const MatX scaled = J * unit.asDiagonal();
  const PivotedQr qr = pivoted_qr(scaled.transpose(), 1e-11);
  if (qr.rank == 0) return {VecX::Zero(nv), unit.asDiagonal() * qr.Q};
  const MatX rows = qr.Q.leftCols(qr.rank);
  const VecX a_p = rows * qr_solve(scaled * rows, gamma);
  return {unit.cwiseProduct(a_p), unit.asDiagonal() * qr.Q.rightCols(nv - qr.rank)};
}

/// Unrestrained massless directions among the columns of Z: N^T M N z = 0 for each of them.
///
/// The stiffness of a direction n is the change of the work n^T r along the motion, and the
/// direction rotates with it: while J n = 0 and M n = 0 hold, a point mass with a distant body
/// frame can rotate freely, although gravity has a moment about its frame. So with ' along Z_j
///   H_ij = Z_i^T r' + n_i'^T r,   n_i' = nJ + N y,   J nJ = -J' Z_i,
///   N^T M N y = -N^T (M' Z_i + M nJ).
/// Single directions are not sufficient: a combination of two restrained ones may be free.
MatX loose_directions(const MatX& mass, const MatX& J, const VecX& force, const MatX& N,
                      const MatX& half_inverse, const MatX& Z, const NeighbourAt& neighbour) {
  constexpr double step = 1e-6;
  const Eigen::Index k = Z.cols();
  const VecX r = -force;
  // (N y)^T r = -w^T (M' Z_i + M nJ) and nJ = -J^+ J' Z_i: two vectors for all pairs.
  const VecX w = N * (half_inverse * (half_inverse.transpose() * (N.transpose() * r)));
  const VecX u = J.rows() > 0 ? LeastNorm(J.transpose(), 1e-11).solve(VecX(r - mass * w)) : VecX();
  MatX H(k, k);
  for (Eigen::Index j = 0; j < k; ++j) {
    // On both sides: along the bend of a bar that rotates about itself the parts of H cancel, and
    // the error of a one-sided difference would be amplified by the lightest of the other motions.
    const Neighbour there = neighbour(step * Z.col(j), Z), back = neighbour(-step * Z.col(j), Z);
    H.col(j) = Z.transpose() * (there.r - back.r) - (there.MZ - back.MZ).transpose() * w;
    if (J.rows() > 0) H.col(j) -= (there.JZ - back.JZ).transpose() * u;
  }
  H /= 2.0 * step;
  // Finite differences have noise of the magnitude of the forces times the step.
  const double noise = 1e-5 * (1.0 + r.lpNorm<Eigen::Infinity>()) + 1e-9 * H.cwiseAbs().maxCoeff();
  const SymmetricEigen eig = symmetric_eigen(0.5 * (H + H.transpose()));
  Eigen::Index loose = 0;
  while (loose < k && !(eig.values[loose] > noise)) ++loose;
  return Z * eig.vectors.leftCols(loose);
}

/// The z of the free accelerations N z: N^T M N z = N^T (force - M a_p).
VecX free_accelerations(const MatX& mass, const VecX& possible, const MatX& J, const VecX& force,
                        const Motions& m, const NeighbourAt& neighbour,
                        const std::function<std::string(const MatX&)>& sentence) {
  const MatX Mr = m.N.transpose() * mass * m.N;
  const MatX scale = m.N.transpose() * mass_scale(mass.diagonal(), possible).asDiagonal() * m.N;
  const SymmetricEigen eig = generalised_eigen(0.5 * (Mr + Mr.transpose()), scale);
  const MatX& V = eig.vectors;
  Eigen::Index massless = 0;  // ascending eigenvalues
  while (massless < V.cols() && !(eig.values[massless] > no_mass)) ++massless;
  const Eigen::Index heavy = V.cols() - massless;
  const MatX half_inverse =
      V.rightCols(heavy) * eig.values.tail(heavy).cwiseSqrt().cwiseInverse().asDiagonal();
  if (massless > 0) {
    const MatX Z = (m.N * V.leftCols(massless)).colwise().normalized();
    const MatX loose = loose_directions(mass, J, force, m.N, half_inverse, Z, neighbour);
    if (loose.cols() > 0) throw RunError(ErrorCode::singular, sentence(loose));
  }
  // Massless but stiff: the minimum-norm solution.
  return half_inverse * (half_inverse.transpose() * (m.N.transpose() * (force - mass * m.a_p)));
}

/// Throws RunError if a mass is too small to compute with, or with the text about a number that is
/// too large (`overflow_text`).
void check_numbers(const Model& model, const std::string& overflow, double t) {
  for (const Body& b : model.bodies)
    if (const double m = b.data->invariants.m; m > 0.0 && m < smallest_mass)
      throw RunError(ErrorCode::not_finite,
                     fmt::format("the numbers of the model overflow: the mass of body '{}' is {:g} "
                                 "kg, expected 0 or at least {:g}",
                                 b.name, m, smallest_mass));
  if (!overflow.empty())
    throw RunError(ErrorCode::not_finite, overflow_sentence(overflow, t, largest_magnitude));
}

/// The message that bodies move without mass, stiffness or constraint, and what is missing; without
/// any body, `owner` names the moving coordinate.
std::string loose_sentence(const Model& model, const std::vector<std::size_t>& bodies,
                           const std::string& owner) {
  std::vector<std::string> names, points;
  bool bars = false;  // or bodies like bars
  for (const std::size_t i : bodies) {
    const Body& b = model.bodies[i];
    const InertiaInvariants& v = b.data->invariants;
    names.push_back(b.name);
    const double inertia = v.inertia_about_centre().trace();
    if (b.modes() == 0 && v.m > 0.0 && !(inertia > 1e-12 * v.m * b.length * b.length))
      points.push_back(b.name);
    else
      bars = bars || v.m > 0.0;
  }
  std::string remedy = "give mass or inertia";
  if (!points.empty())
    remedy =
        fmt::format("{} no inertia: the key 'inertia' is missing or zero, give it [kg m2]",
                    named_text("body", "bodies", points) + (points.size() == 1 ? " has" : " have"));
  else if (bars)
    remedy +=
        " (a straight bar has no inertia about its own axis unless mass_model is hermite or "
        "six_dof with section_inertia)";
  return fmt::format(
      "the mass matrix is singular where nothing holds it: {} can move without mass, stiffness or "
      "constraint; {}, or remove the freedom",
      names.empty() ? owner : named_text("body", "bodies", names), remedy);
}

/// The owner of the largest component of the first direction.
std::string coordinate_moved(Formulation& f, const MatX& directions) {
  Eigen::Index worst = 0;
  directions.col(0).cwiseAbs().maxCoeff(&worst);
  return f.coordinate_owner(static_cast<int>(worst));
}

}  // namespace

void check_magnitudes(const VecX& force, const std::function<std::string(int)>& owner) {
  const int i = out_of_range(force);
  if (i < 0) return;
  throw RunError(ErrorCode::not_finite,
                 fmt::format("the numbers of the model overflow: the generalised force on {} at "
                             "the start is {} [N, N m], expected less than {:g}; look at masses, "
                             "inertias, gravity, forces and start velocities",
                             owner(i), magnitude_text(force[i]), largest_magnitude));
}

void check_masses(const VecX& diagonal, const std::function<std::string(int)>& owner) {
  const int i = out_of_range(diagonal);
  if (i < 0) return;
  throw RunError(ErrorCode::not_finite,
                 fmt::format("the numbers of the model overflow: the mass or inertia that {} moves "
                             "is {} [kg, kg m2], expected less than {:g}",
                             owner(i), magnitude_text(diagonal[i]), largest_magnitude));
}

MatX free_motions(const MatX& J, const VecX& possible) {
  return motions(J, VecX::Zero(J.rows()), possible).N;
}

std::vector<std::size_t> bodies_moved(Formulation& f, const State& state, const MatX& directions) {
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

std::string moving_bodies(Formulation& f, const State& state, const MatX& directions) {
  std::vector<std::string> names;
  for (const std::size_t i : bodies_moved(f, state, directions))
    names.push_back(f.model().bodies[i].name);
  return names.empty() ? coordinate_moved(f, directions) : named_text("body", "bodies", names);
}

void start_accelerations_dense(Formulation& f, State& state) {
  const int nv = f.velocities(), nc = f.constraints();
  const VecX no_lambda = VecX::Zero(nc);
  const VecX possible = possible_masses(f, state);
  const VecX r0 = residual_at(f, state.t, state.q, state.v, no_lambda), force = -r0;
  check_magnitudes(r0, [&](int i) { return f.coordinate_owner(i); });
  const MatX mass = mass_matrix(f, test_accelerations(r0, possible), r0, no_lambda);
  const MatX J = f.constraint_jacobian();
  VecX gamma(nc), q1(state.q.size());
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
  const auto loose = [&](const MatX& directions) {
    return loose_sentence(f.model(), bodies_moved(f, state, directions),
                          coordinate_moved(f, directions));
  };
  const Motions m = motions(J, -gamma, possible);
  state.a = m.a_p;
  // The constraints prescribe all motion: the masses do not matter.
  if (m.N.cols() > 0)
    state.a += m.N * free_accelerations(mass, possible, J, force, m, neighbour, loose);
  state.lambda = VecX::Zero(nc);
  if (nc == 0 || nv == 0) return;
  state.lambda = LeastNorm(J.transpose(), 1e-11).solve(VecX(force - mass * state.a));
}

namespace {

/// With the present states of elements.
bool accelerations_at(Formulation& f, State& state, double penalty_mass) {
  state.a = VecX::Zero(f.velocities());
  state.lambda = VecX::Zero(f.constraints());
  const std::string overflow = overflow_text(f, state, state.t, largest_magnitude);
  require_laws(f, state.t);
  check_numbers(f.model(), overflow, state.t);
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

}  // namespace

bool start_accelerations(Formulation& f, State& state, double penalty_mass) {
  const bool lacking = accelerations_at(f, state, penalty_mass);
  if (f.load_count() == 0) return lacking;
  // Loads of joints that friction reads depend on the accelerations, and these on the friction.
  constexpr int most_rounds = 100;
  constexpr double enough = 1e-9, most_left = 1e-4;
  LoadIteration loads(f);
  loads.begin();
  for (int round = 0; round == 0 || (round < most_rounds && loads.change() > enough); ++round) {
    loads.iterate(f, state.a, state.lambda);
    state.z = f.element_states().values();
    accelerations_at(f, state, penalty_mass);
  }
  if (loads.change() < most_left) return lacking;
  throw RunError(ErrorCode::no_convergence,
                 "the friction from reactions at the start grows with itself: the mechanism jams; "
                 "make friction or the angles of pressure smaller");
}

}  // namespace floatframe
