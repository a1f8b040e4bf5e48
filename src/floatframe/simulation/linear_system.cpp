#include "floatframe/simulation/linear_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/formulation/owners.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/simulation/body_energy.hpp"
#include "floatframe/simulation/simulation_options.hpp"
#include "floatframe/simulation/small_motions.hpp"
#include "floatframe/simulation/start_up.hpp"

namespace floatframe {

namespace {

/// Which coordinates are free, and what follows from them: (1).
struct FreeCoordinates {
  std::vector<Eigen::Index> free;
  MatX N, P, R, T;  ///< nv x n
};

/// The solution X of J X = B that is zero in the free coordinates.
MatX in_decided(const MatX& J_D, const std::vector<Eigen::Index>& decided, Eigen::Index nv,
                const MatX& B) {
  MatX X = MatX::Zero(nv, B.cols());
  if (decided.empty()) return X;
  const MatX x = qr_solve(J_D, B);  // rows may be redundant
  for (std::size_t k = 0; k < decided.size(); ++k)
    X.row(decided[k]) = x.row(static_cast<Eigen::Index>(k));
  return X;
}

FreeCoordinates free_coordinates(const SmallMotions& m) {
  const Eigen::Index nv = m.M.rows();
  // In coordinates of like size; rows of lengths and angles are of like size already.
  const VecX unit = m.scale.cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  std::vector<Eigen::Index> decided;
  std::vector<bool> is_free(static_cast<std::size_t>(nv), true);
  if (m.J.rows() > 0) {
    const PivotedQr qr = pivoted_qr(m.J * unit.asDiagonal(), 1e-11);
    for (Eigen::Index k = 0; k < qr.rank; ++k) {
      decided.push_back(qr.pivots[k]);
      is_free[static_cast<std::size_t>(qr.pivots[k])] = false;
    }
  }
  FreeCoordinates c;
  for (Eigen::Index j = 0; j < nv; ++j)
    if (is_free[static_cast<std::size_t>(j)]) c.free.push_back(j);
  const auto n = static_cast<Eigen::Index>(c.free.size());
  MatX J_D(m.J.rows(), static_cast<Eigen::Index>(decided.size())), J_I(m.J.rows(), n);
  for (std::size_t k = 0; k < decided.size(); ++k)
    J_D.col(static_cast<Eigen::Index>(k)) = m.J.col(decided[k]);
  MatX S = MatX::Zero(nv, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    J_I.col(k) = m.J.col(c.free[static_cast<std::size_t>(k)]);
    S(c.free[static_cast<std::size_t>(k)], k) = 1.0;
  }
  const auto follow = [&](const MatX& B) { return in_decided(J_D, decided, nv, B); };
  c.N = S + follow(-J_I);
  c.P = follow(-(m.G * c.N));
  c.R = follow(-(m.H * c.N + m.D * c.P));
  c.T = follow(-(m.D * c.N));
  return c;
}

/// (2): M wdot + C w + K y = 0, ydot = w + Gamma y; x = X y, v = V y + W w,
/// a = W wdot + R y + T w.
struct SecondOrderSystem {
  MatX M, C, K, Gamma, X, V, W, R, T;
};

/// y = B eta, w = B eta', for a B with the inverse `inverse`.
SecondOrderSystem transformed(const SecondOrderSystem& s, const MatX& B, const MatX& inverse) {
  const MatX Bt = B.transpose();
  return {Bt * s.M * B, Bt * s.C * B, Bt * s.K * B, inverse * s.Gamma * B, s.X * B, s.V * B,
          s.W * B,      s.R * B,      s.T * B};
}

/// Rows and columns without mass, of which the last `without` are also without damping.
struct Masslessness {
  Eigen::Index heavy = 0, damped = 0, without = 0;
};

/// The system in directions ordered by what holds them: with mass, damped without mass, neither.
Masslessness order_by_mass(SecondOrderSystem& s, const VecX& possible) {
  const Eigen::Index n = s.M.rows();
  Masslessness kinds{n, 0, 0};
  if (n == 0) return kinds;
  const MatX scale = s.W.transpose() * possible.asDiagonal() * s.W;
  const SymmetricEigen mass = generalised_eigen(0.5 * (s.M + s.M.transpose()), scale);
  if (!mass.found) return kinds;
  Eigen::Index light = 0;
  while (light < n && !(mass.values[light] > no_mass)) ++light;
  if (light == 0) return kinds;
  MatX B(n, n);
  B << mass.vectors.rightCols(n - light), mass.vectors.leftCols(light);
  const MatX L = B.rightCols(light);
  const MatX damping = L.transpose() * (0.5 * (s.C + s.C.transpose())) * L;
  const SymmetricEigen d = symmetric_eigen(damping);
  const double size = (B.transpose() * s.C * B).cwiseAbs().maxCoeff();
  Eigen::Index undamped = 0;
  std::vector<Eigen::Index> order;
  for (Eigen::Index k = light; k-- > 0;)
    if (std::abs(d.values[k]) > 1e-9 * size) order.push_back(k);
  for (Eigen::Index k = 0; k < light; ++k)
    if (!(std::abs(d.values[k]) > 1e-9 * size)) order.push_back(k), ++undamped;
  MatX sorted(light, light);
  for (std::size_t k = 0; k < order.size(); ++k)
    sorted.col(static_cast<Eigen::Index>(k)) = d.vectors.col(order[k]);
  B.rightCols(light) = L * sorted;
  s = transformed(s, B, B.transpose() * scale);
  return {n - light, light - undamped, undamped};
}

/// Directions with neither mass nor damping follow the others: y_u = E y, w_u = E w.
void follow_statics(SecondOrderSystem& s, Eigen::Index without) {
  if (without == 0) return;
  const Eigen::Index n = s.M.rows() - without;
  const MatX K_uu = s.K.bottomRightCorner(without, without);
  const Singular values = singular_values(K_uu);
  const double stiffest = s.K.cwiseAbs().maxCoeff();
  if (!(values.values[without - 1] > 1e-12 * stiffest))
    throw RunError(
        "a motion has neither mass nor damping nor stiffness where the system was linearised; give "
        "mass or inertia, or remove the freedom");
  MatX B(n + without, n);
  B << MatX::Identity(n, n), -lu_solve(K_uu, s.K.bottomLeftCorner(without, n));
  MatX left = MatX::Zero(n, n + without);
  left.leftCols(n).setIdentity();
  s = transformed(s, B, left);
}

/// z = (y, w of what has mass).
LinearSystem first_order(const SecondOrderSystem& s, Eigen::Index heavy) {
  const Eigen::Index n = s.M.rows(), light = n - heavy, nz = n + heavy;
  LinearSystem out;
  // w of what has no mass: C_ll w_l = -(C_lh w_h + K_l y).
  MatX w = MatX::Zero(n, nz);
  w.block(0, n, heavy, heavy).setIdentity();
  if (light > 0) {
    MatX rows(light, nz);
    rows << s.K.bottomRows(light), s.C.bottomLeftCorner(light, heavy);
    w.bottomRows(light) = -lu_solve(s.C.bottomRightCorner(light, light), rows);
  }
  MatX y = MatX::Zero(n, nz);
  y.leftCols(n).setIdentity();
  out.A.resize(nz, nz);
  out.A.topRows(n) = w + s.Gamma * y;
  if (heavy > 0)
    out.A.bottomRows(heavy) =
        -lu_solve(s.M.topLeftCorner(heavy, heavy), s.C.topRows(heavy) * w + s.K.topRows(heavy) * y);
  out.x_of = s.X * y;
  out.v_of = s.V * y + s.W * w;
  out.a_of = s.W * (w * out.A) + s.R * y + s.T * w;
  return out;
}

/// From derivatives, for the coordinates named. Throws RunError where a direction has neither mass
/// nor stiffness nor damping.
LinearSystem reduced_system(const SmallMotions& m, const std::vector<std::string>& coordinates) {
  const FreeCoordinates c = free_coordinates(m);
  const auto n = static_cast<Eigen::Index>(c.free.size());
  const MatX Nt = c.N.transpose();
  SecondOrderSystem s{Nt * m.M * c.N,
                      Nt * (m.M * c.T + m.C * c.N),
                      Nt * (m.M * c.R + m.C * c.P + m.K * c.N),
                      MatX(n, n),
                      c.N,
                      c.P,
                      c.N,
                      c.R,
                      c.T};
  const MatX turned = m.Gamma * c.N;
  for (Eigen::Index k = 0; k < n; ++k)
    s.Gamma.row(k) = turned.row(c.free[static_cast<std::size_t>(k)]);
  const Masslessness kinds = order_by_mass(s, m.scale);
  follow_statics(s, kinds.without);
  LinearSystem out = first_order(s, kinds.heavy);
  out.xdot_of = out.v_of + m.Gamma * out.x_of;
  out.degrees = static_cast<int>(n);
  out.massless = static_cast<int>(kinds.damped + kinds.without);
  for (Eigen::Index k = 0; k < out.A.rows(); ++k) {
    const bool rate = k >= s.M.rows();
    if (out.massless > 0)
      out.states.push_back(fmt::format("combination {}", k + 1));
    else
      out.states.push_back((rate ? "rate of " : "") +
                           coordinates[static_cast<std::size_t>(
                               c.free[static_cast<std::size_t>(rate ? k - n : k)])]);
  }
  return out;
}

/// What the motions of each state are of bodies and force elements.
template <class F>
void describe_motions(F& f, const State& state, LinearSystem& system) {
  const Model& model = f.model();
  Eigen::Index rates = 0, bends = 0;
  for (const Body& b : model.bodies) rates += 6 + b.modes(), bends += b.modes();
  const Eigen::Index nz = system.A.rows(), forces = static_cast<Eigen::Index>(model.forces.size());
  system.rates_of = MatX::Zero(rates, nz);
  system.bends_of = MatX::Zero(bends, nz);
  system.springs_of = MatX::Zero(6 * forces, nz);
  system.places_of = MatX::Zero(6 * static_cast<Eigen::Index>(model.bodies.size()), nz);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    VecX y(model.bodies[i].modes());
    for (int m = 0; m < y.size(); ++m) y[m] = f.amplitude(state.q, static_cast<int>(i), m);
    system.amplitudes.push_back(std::move(y));
  }
  // The stiffness of forces where they are; their measures in the motions, below.
  f.positions(state.t, state.q);
  f.velocities(state.v);
  f.dynamics();
  std::vector<ForceState> found;
  for (Eigen::Index k = 0; k < forces; ++k) found.push_back(f.force(static_cast<int>(k)));
  for (Eigen::Index z = 0; z < nz; ++z) {
    f.velocities(VecX(system.v_of.col(z)));
    Eigen::Index row = 0, bend = 0;
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      const int k = static_cast<int>(i);
      const Mat3 to_body = f.body_rotation(k).transpose();
      system.rates_of.block<3, 1>(row, z) = to_body * f.body_velocity(k);
      system.rates_of.block<3, 1>(row + 3, z) = to_body * f.body_angular_velocity(k);
      row += 6;
      for (int m = 0; m < model.bodies[i].modes(); ++m, ++row)
        system.rates_of(row, z) = f.amplitude_rate(VecX(system.v_of.col(z)), k, m);
    }
    // Increments move markers as velocities do.
    const VecX x = system.x_of.col(z);
    f.velocities(x);
    for (int k = 0; k < static_cast<int>(model.bodies.size()); ++k) {
      system.places_of.block<3, 1>(6 * k, z) = f.body_velocity(k);
      system.places_of.block<3, 1>(6 * k + 3, z) = f.body_angular_velocity(k);
      for (int m = 0; m < model.bodies[static_cast<std::size_t>(k)].modes(); ++m, ++bend)
        system.bends_of(bend, z) = f.amplitude_rate(x, k, m);
    }
    for (Eigen::Index k = 0; k < forces; ++k) {
      const Force& force = model.forces[static_cast<std::size_t>(k)];
      const MarkerState& b = f.marker(force.b);
      const MarkerState& a = force.a >= 0 ? f.marker(force.a) : b;
      Vec12 motion;
      motion << a.v, a.w, b.v, b.w;
      const ForceState& s = found[static_cast<std::size_t>(k)];
      for (int r = 0; r < s.row_count; ++r)
        if (s.rows[r].k > 0.0)
          system.springs_of(6 * k + r, z) =
              std::sqrt(s.rows[r].k) * stacked(s.rows[r].g).dot(motion);
    }
  }
  f.positions(state.t, state.q);
  f.velocities(state.v);
  f.dynamics();
}

template <class F>
LinearSystem system_of(const Model& model, const SimulationDescription& options) {
  StartedModel<F> started(model, options);
  F& f = started.formulation();
  const State& state = started.state();
  const double speed = largest(state.v);
  constexpr bool relative = std::is_same_v<F, RelativeFormulation>;
  if (!relative && speed > 1e-6)
    throw RunError(
        "the state moves: its linear system needs relative coordinates, since those of the "
        "absolute formulation turn with the bodies");
  const SmallMotions m = small_motions(f, state);
  LinearSystem system = reduced_system(m, coordinate_owners(f));
  describe_motions(f, state, system);
  system.speed = speed;
  system.acceleration = largest(state.a);
  if (system.acceleration > 1e-3)
    system.notes.push_back(fmt::format(
        "the state is no {}: coordinates accelerate by up to {:.3g} [m/s2, rad/s2]; the linear "
        "system holds for a short time only",
        speed > 1e-6 ? "steady motion" : "equilibrium", system.acceleration));
  std::vector<std::string> owners;
  for (const int k : m.kinks) {
    std::string owner = f.coordinate_owner(k);
    if (std::find(owners.begin(), owners.end(), owner) != owners.end()) continue;
    system.notes.push_back(fmt::format(
        "along {} a force has no one slope here: a mean of both sides was taken", owner));
    owners.push_back(std::move(owner));
  }
  return system;
}

}  // namespace

double LinearMode::frequency() const noexcept {
  return std::abs(lambda) / (2.0 * std::numbers::pi);
}
double LinearMode::damped() const noexcept {
  return std::abs(lambda.imag()) / (2.0 * std::numbers::pi);
}
double LinearMode::damping() const noexcept {
  const double size = std::abs(lambda);
  return size > 0.0 ? -lambda.real() / size : 0.0;
}

std::vector<LinearMode> linear_modes(const LinearSystem& system) {
  const GeneralEigen e = general_eigen(system.A);
  if (!e.found) throw RunError("the eigenvalues of the linear system do not converge");
  std::vector<LinearMode> modes;
  for (Eigen::Index k = 0; k < e.values.size(); ++k)
    if (e.values[k].imag() >= 0.0) modes.push_back({e.values[k], e.vectors.col(k)});
  std::stable_sort(modes.begin(), modes.end(), [](const LinearMode& a, const LinearMode& b) {
    return std::abs(a.lambda) < std::abs(b.lambda);
  });
  return modes;
}

ModeParts mode_parts(const Model& model, const LinearSystem& system, const LinearMode& mode) {
  ModeParts parts;
  const VecX z[2] = {mode.z.real(), mode.z.imag()};
  const std::size_t bodies = model.bodies.size(), forces = model.forces.size();
  parts.kinetic.assign(bodies, 0.0);
  parts.bending.assign(bodies, 0.0);
  parts.springs.assign(forces, 0.0);
  for (const VecX& part : z) {
    const VecX rates = system.rates_of * part, bends = system.bends_of * part,
               springs = system.springs_of * part;
    Eigen::Index row = 0, bend = 0;
    for (std::size_t i = 0; i < bodies; ++i) {
      const Body& b = model.bodies[i];
      const int nm = b.modes();
      parts.kinetic[i] += BodyEnergy(b.data->invariants)
                              .kinetic(rates.segment<3>(row), rates.segment<3>(row + 3),
                                       system.amplitudes[i].data(), rates.data() + row + 6);
      const VecX y = bends.segment(bend, nm);
      if (nm > 0) parts.bending[i] += 0.5 * y.dot(b.data->K * y);
      row += 6 + nm;
      bend += nm;
    }
    for (std::size_t k = 0; k < forces; ++k)
      parts.springs[k] += 0.5 * springs.segment<6>(6 * static_cast<Eigen::Index>(k)).squaredNorm();
  }
  double kinetic = 0.0, potential = 0.0;
  for (const double t : parts.kinetic) kinetic += t;
  for (const double u : parts.bending) potential += u;
  for (const double u : parts.springs) potential += u;
  for (double& t : parts.kinetic) t = kinetic > 0.0 ? t / kinetic : 0.0;
  for (double& u : parts.bending) u = potential > 0.0 ? u / potential : 0.0;
  for (double& u : parts.springs) u = potential > 0.0 ? u / potential : 0.0;
  parts.potential = kinetic > 0.0 ? potential / kinetic : 0.0;
  return parts;
}

LinearSystem linear_system(const Model& model, const SimulationOptions& options) {
  const SimulationDescription d = described(built(model), options);
  return d.coordinates == Coordinates::relative ? system_of<RelativeFormulation>(model, d)
                                                : system_of<AbsoluteFormulation>(model, d);
}

}  // namespace floatframe
