#include "floatframe/linear/linear_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/lowest_motions.hpp"
#include "floatframe/run/results.hpp"
#include "floatframe/tangents/mass_scale.hpp"

namespace floatframe {

namespace {

constexpr const char* held_by_nothing =
    "a motion has neither mass nor damping nor stiffness where the system was linearised; give "
    "mass or inertia, or remove the freedom";

/// Free coordinates, and the matrices of the dependent ones (linear_system.hpp).
struct FreeCoordinates {
  std::vector<Eigen::Index> free;
  MatX N, P, R, T;    ///< nv x n
  LinearInputs held;  ///< effect of inputs at constant free coordinates: all but B
};

/// The solution X of J X = B that is zero in the free coordinates.
MatX in_decided(const MatX& J_D, const std::vector<Eigen::Index>& decided, Eigen::Index nv,
                const MatX& B) {
  MatX X = MatX::Zero(nv, B.cols());
  if (decided.empty() || B.cols() == 0) return X;
  X(decided, Eigen::all) = qr_solve(J_D, B);  // rows may be redundant
  return X;
}

FreeCoordinates free_coordinates(const SmallMotions& m, const InputMotions& u) {
  const Eigen::Index nv = m.M.rows();
  // In coordinates of similar magnitude; rows of lengths and angles are already similar.
  VecX unit = VecX::Ones(nv);
  unit.head(m.scale.size()) = m.scale.cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  std::vector<Eigen::Index> decided;
  std::vector<bool> is_free(static_cast<std::size_t>(nv), true);
  if (m.J.rows() > 0) {
    const PivotedQr qr = pivoted_qr(m.J * unit.asDiagonal(), 1e-11);
    for (Eigen::Index k = 0; k < qr.rank; ++k) {
      decided.push_back(qr.pivots[k]);
      is_free[qr.pivots[k]] = false;
    }
  }
  FreeCoordinates c;
  for (Eigen::Index j = 0; j < nv; ++j)
    if (is_free[j]) c.free.push_back(j);
  const auto n = static_cast<Eigen::Index>(c.free.size());
  const MatX J_D = m.J(Eigen::all, decided), J_I = m.J(Eigen::all, c.free);
  MatX S = MatX::Zero(nv, n);
  for (Eigen::Index k = 0; k < n; ++k) S(c.free[k], k) = 1.0;
  const auto follow = [&](const MatX& B) { return in_decided(J_D, decided, nv, B); };
  c.N = S + follow(-J_I);
  c.P = follow(-(m.G * c.N));
  c.R = follow(-(m.H * c.N + m.D * c.P));
  c.T = follow(-(m.D * c.N));
  LinearInputs& h = c.held;
  h.x = follow(-u.value);
  h.v[0] = follow(-(m.G * h.x + u.rate[0]));
  h.v[1] = follow(-u.rate[1]);
  h.a[0] = follow(-(m.H * h.x + m.D * h.v[0] + u.acceleration[0]));
  h.a[1] = follow(-(m.D * h.v[1] + u.acceleration[1]));
  h.a[2] = follow(-u.acceleration[2]);
  return c;
}

/// W B, where W is often the identity: for a model without constraints.
MatX times(const MatX& W, const MatX& B) {
  return W.rows() == W.cols() && W.isIdentity(0.0) ? B : MatX(W * B);
}

/// M wdot + C w + K y + sum F_k u^(k) = 0, ydot = w + Gamma y + turned u; x = X y, v = V y + W w, a
/// = W wdot + R y + T w, each plus contributions of the inputs.
struct SecondOrderSystem {
  MatX M, C, K, Gamma, X, V, W, R, T;
  MatX F[3], turned;
  LinearInputs u;
};

/// y = B eta, w = B eta', for a B with the inverse `inverse`.
SecondOrderSystem transformed(const SecondOrderSystem& s, const MatX& B, const MatX& inverse) {
  const MatX Bt = B.transpose();
  return {Bt * s.M * B,
          Bt * s.C * B,
          Bt * s.K * B,
          inverse * s.Gamma * B,
          s.X * B,
          s.V * B,
          s.W * B,
          s.R * B,
          s.T * B,
          {Bt * s.F[0], Bt * s.F[1], Bt * s.F[2]},
          inverse * s.turned,
          s.u};
}

/// Rows and columns without mass, the last `without` of them also without damping.
struct Masslessness {
  Eigen::Index heavy = 0, damped = 0, without = 0;
};

/// Below this fraction of the possible mass a direction is massless. Long chains fold with 1e-10 of
/// their mass.
double least_mass(Eigen::Index degrees) { return degrees > few_degrees ? 1e-13 : no_mass; }

/// The system in directions sorted by type: with mass; damped without mass, states of elements;
/// neither. The last `states` unknowns are these states.
Masslessness order_by_mass(SecondOrderSystem& s, const VecX& possible, Eigen::Index states) {
  const Eigen::Index all = s.M.rows(), n = all - states;
  Masslessness kinds{n, states, 0};
  if (n == 0) return kinds;
  const MatX W = s.W.leftCols(n);
  const MatX scale = times(MatX(W.transpose()), possible.asDiagonal() * W);
  const MatX own = s.M.topLeftCorner(n, n), M = 0.5 * (own + own.transpose());
  if (is_positive_definite(M - least_mass(n) * scale)) return kinds;
  const SymmetricEigen mass = generalised_eigen(M, scale);
  if (!mass.found) return kinds;
  Eigen::Index light = 0;
  while (light < n && !(mass.values[light] > least_mass(n))) ++light;
  if (light == 0) return kinds;
  const Eigen::Index heavy = n - light;
  const MatX L = mass.vectors.leftCols(light), C = s.C.topLeftCorner(n, n);
  const MatX damping = L.transpose() * (0.5 * (C + C.transpose())) * L;
  const SymmetricEigen d = symmetric_eigen(damping);
  const double size = (mass.vectors.transpose() * C * mass.vectors).cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> damped, undamped;
  for (Eigen::Index k = light; k-- > 0;)
    if (std::abs(d.values[k]) > 1e-9 * size) damped.push_back(k);
  for (Eigen::Index k = 0; k < light; ++k)
    if (!(std::abs(d.values[k]) > 1e-9 * size)) undamped.push_back(k);
  const Eigen::Index slow = std::ssize(damped);
  MatX B = MatX::Zero(all, all), Bt_scale = MatX::Zero(all, all);
  B.block(0, 0, n, heavy) = mass.vectors.rightCols(heavy);
  B.block(0, heavy, n, slow) = L * d.vectors(Eigen::all, damped);
  B.block(n, heavy + slow, states, states).setIdentity();
  B.topRightCorner(n, light - slow) = L * d.vectors(Eigen::all, undamped);
  Bt_scale.leftCols(n) = B.topRows(n).transpose() * scale;
  Bt_scale.block(heavy + slow, n, states, states).setIdentity();
  s = transformed(s, B, Bt_scale);
  return {heavy, slow + states, light - slow};
}

/// y = y_rest + Y u, w = w_rest + Y u': the following equations are in the rest.
void take_out(SecondOrderSystem& s, const MatX& Y) {
  s.F[0] += s.K * Y;
  s.F[1] += s.C * Y;
  s.F[2] += s.M * Y;
  s.turned += s.Gamma * Y;
  s.u.x += s.X * Y;
  s.u.v[0] += s.V * Y;
  s.u.v[1] += s.W * Y;
  s.u.a[0] += s.R * Y;
  s.u.a[1] += s.T * Y;
  s.u.a[2] += s.W * Y;
}

/// Directions with neither mass nor damping follow the others and the inputs:
/// y_u = E y + Y u, w_u = E w + Y u'.
void follow_statics(SecondOrderSystem& s, Eigen::Index without) {
  if (without == 0) return;
  const Eigen::Index n = s.M.rows() - without;
  const MatX K_uu = s.K.bottomRightCorner(without, without);
  const Singular values = singular_values(K_uu);
  const double stiffest = s.K.cwiseAbs().maxCoeff();
  if (!(values.values[without - 1] > 1e-12 * stiffest))
    throw RunError(ErrorCode::singular, held_by_nothing);
  MatX Y = MatX::Zero(n + without, s.turned.cols());
  if (Y.cols() > 0) Y.bottomRows(without) = -lu_solve(K_uu, s.F[0].bottomRows(without));
  take_out(s, Y);
  MatX B(n + without, n);
  B << MatX::Identity(n, n), -lu_solve(K_uu, s.K.bottomLeftCorner(without, n));
  MatX left = MatX::Zero(n, n + without);
  left.leftCols(n).setIdentity();
  s = transformed(s, B, left);
}

/// z = (y, w of directions with mass).
LinearSystem first_order(SecondOrderSystem& s, Eigen::Index heavy) {
  const Eigen::Index n = s.M.rows(), light = n - heavy, nz = n + heavy, nu = s.turned.cols();
  LinearSystem out;
  // w of massless directions: C_ll w_l = -(C_lh w_h + K_l y + F0_l u + F1_l u').
  MatX w = MatX::Zero(n, nz), w_u[2] = {MatX::Zero(n, nu), MatX::Zero(n, nu)};
  w.topRightCorner(heavy, heavy).setIdentity();
  if (light > 0) {
    MatX rows(light, nz + 2 * nu);
    rows << s.K.bottomRows(light), s.C.bottomLeftCorner(light, heavy), s.F[0].bottomRows(light),
        s.F[1].bottomRows(light);
    rows = -lu_solve(s.C.bottomRightCorner(light, light), rows);
    w.bottomRows(light) = rows.leftCols(nz);
    for (int k = 0; k < 2; ++k) w_u[k].bottomRows(light) = rows.middleCols(nz + k * nu, nu);
  }
  // Quantities by_y y + by_w w: y is the first part of z, and w the second if all has mass.
  const auto of_z = [&](const auto& by_y, const auto& by_w) {
    MatX columns = MatX::Zero(by_y.rows(), nz);
    columns.leftCols(n) = by_y;
    if (light == 0)
      columns.rightCols(n) += by_w;
    else
      columns += by_w * w;
    return columns;
  };
  const auto rates_of_heavy = [&](const MatX& force) {
    return MatX(-lu_solve(s.M.topLeftCorner(heavy, heavy), force));
  };
  out.A.resize(nz, nz);
  out.A.topRows(n) = w;
  out.A.topLeftCorner(n, n) += s.Gamma;
  if (heavy > 0)
    out.A.bottomRows(heavy) = rates_of_heavy(of_z(s.K.topRows(heavy), s.C.topRows(heavy)));
  out.x_of = of_z(s.X, MatX::Zero(s.X.rows(), n));
  out.v_of = of_z(s.V, s.W);
  out.a_of =
      times(s.W, light == 0 ? MatX(out.A.bottomRows(heavy)) : MatX(w * out.A)) + of_z(s.R, s.T);
  for (MatX& B : s.u.B) B = MatX::Zero(nz, nu);
  if (nu == 0) return out;

  for (int k = 0; k < 3; ++k) {
    MatX& B = s.u.B[k];
    MatX force = s.F[k].topRows(heavy);
    if (k < 2) {
      B.topRows(n) = w_u[k];
      force += s.C.topRows(heavy) * w_u[k];
      s.u.v[k] += s.W * w_u[k];
    }
    if (k == 0) B.topRows(n) += s.turned;
    if (heavy > 0) B.bottomRows(heavy) = rates_of_heavy(force);
    s.u.a[k] += s.W * (w * B);
    if (k < 2) s.u.a[k] += s.T * w_u[k];
    if (k > 0) s.u.a[k] += s.W * w_u[k - 1];
  }
  return out;
}

InputMotions no_inputs(Eigen::Index nv, Eigen::Index nc) {
  InputMotions u;
  u.value = MatX(nc, 0);
  for (int k = 0; k < 3; ++k) {
    u.residual[k] = MatX(nv, 0);
    u.rate[k] = u.acceleration[k] = MatX(nc, 0);
  }
  return u;
}

SecondOrderSystem second_order(const SmallMotions& m, const InputMotions& u,
                               const FreeCoordinates& c) {
  const LinearInputs& h = c.held;
  if (m.J.rows() == 0)
    return {m.M,           m.C, m.K, m.Gamma, c.N,
            c.P,           c.N, c.R, c.T,     {u.residual[0], u.residual[1], u.residual[2]},
            m.Gamma * h.x, h};
  const MatX Nt = c.N.transpose();
  return {Nt * m.M * c.N,
          Nt * (m.M * c.T + m.C * c.N),
          Nt * (m.M * c.R + m.C * c.P + m.K * c.N),
          MatX(m.Gamma * c.N)(c.free, Eigen::all),
          c.N,
          c.P,
          c.N,
          c.R,
          c.T,
          {Nt * (m.M * h.a[0] + m.C * h.v[0] + m.K * h.x + u.residual[0]),
           Nt * (m.M * h.a[1] + m.C * h.v[1] + u.residual[1]), Nt * (m.M * h.a[2] + u.residual[2])},
          MatX(m.Gamma * h.x)(c.free, Eigen::all),
          h};
}

/// Degrees of freedom up to which all eigenvalues take at most a few minutes.
constexpr Eigen::Index all_in_minutes = 1000;

/// Only the slowest motions, or nothing if computing all is faster: with w = y' - Gamma y,
///   M y'' + (C - M Gamma) y' + (K - C Gamma) y = 0.
LinearSystem slowest_of(const SecondOrderSystem& s, const VecX& possible, int count) {
  const MatX damping = s.C - s.M * s.Gamma, stiffness = s.K - s.C * s.Gamma;
  const LowestMotions low = lowest_motions(s.M, damping, stiffness, count);
  if (low.singular) throw RunError(ErrorCode::singular, held_by_nothing);
  if (!low.converged && s.M.rows() <= all_in_minutes) return {};
  if (!low.converged)
    throw RunError(ErrorCode::no_convergence,
                   fmt::format("the {} slowest of {} motions do not converge: too many frequencies "
                               "lie close together for the search among so many",
                               count, s.M.rows()));
  LinearSystem out;
  const MatX w = low.rate - s.Gamma * low.X;
  out.A = low.A;
  out.x_of = s.X * low.X;
  out.v_of = s.V * low.X + s.W * w;
  out.a_of = s.W * (w * low.A) + s.R * low.X + s.T * w;
  out.fastest = low.fastest;
  out.degrees = static_cast<int>(s.M.rows());
  for (Eigen::Index k = 0; k < low.A.rows(); ++k)
    out.states.push_back(fmt::format("slow motion {}", k + 1));
  const VecX scale =
      (s.W.cwiseAbs2().transpose() * possible).cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const MatX mass = scale.asDiagonal() * s.M * scale.asDiagonal();
  const double least = least_mass(mass.rows());
  if (!is_positive_definite(mass - least * MatX::Identity(mass.rows(), mass.rows())))
    out.massless = static_cast<int>((symmetric_eigenvalues(mass).array() < least).count());
  return out;
}

}  // namespace

std::vector<std::string> disambiguated_names(const std::vector<std::string>& owners) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const auto same = std::count(owners.begin(), owners.end(), owners[k]);
    const auto before =
        std::count(owners.begin(), owners.begin() + static_cast<long>(k), owners[k]);
    names.push_back(same == 1 ? owners[k]
                              : fmt::format("{}, coordinate {}", owners[k], before + 1));
  }
  return names;
}

LinearSystem reduced_system(const SmallMotions& m, const std::vector<std::string>& owners,
                            const InputMotions* inputs, LinearInputs* response, int slowest) {
  const std::vector<std::string> coordinates = disambiguated_names(owners);
  const InputMotions none = no_inputs(m.M.rows(), m.J.rows());
  const InputMotions& u = inputs ? *inputs : none;
  const FreeCoordinates c = free_coordinates(m, u);
  const auto n = static_cast<Eigen::Index>(c.free.size());
  SecondOrderSystem s = second_order(m, u, c);
  if (slowest > 0 && 2 * slowest < n && n > few_degrees) {
    VecX possible = VecX::Ones(m.M.rows());  // of states: any
    possible.head(m.scale.size()) = m.scale;
    LinearSystem out = slowest_of(s, possible, slowest);
    out.degrees -= m.states;
    out.massless = std::max(out.massless - m.states, 0);
    if (out.fastest > 0.0) {
      out.xdot_of = out.v_of + m.Gamma * out.x_of;
      return out;
    }
  }
  VecX possible = VecX::Zero(m.M.rows());
  possible.head(m.scale.size()) = m.scale;
  const Masslessness kinds = order_by_mass(s, possible, m.states);
  follow_statics(s, kinds.without);
  LinearSystem out = first_order(s, kinds.heavy);
  out.xdot_of = out.v_of + m.Gamma * out.x_of;
  out.degrees = n - m.states;
  out.massless = kinds.damped + kinds.without - m.states;
  for (Eigen::Index k = 0; k < out.A.rows(); ++k) {
    const bool rate = k >= s.M.rows();
    if (out.massless > 0)
      out.states.push_back(fmt::format("combination {}", k + 1));
    else
      out.states.push_back((rate ? "rate of " : "") +
                           coordinates[static_cast<std::size_t>(
                               c.free[static_cast<std::size_t>(rate ? k - n : k)])]);
  }
  if (response) *response = s.u;
  return out;
}

}  // namespace floatframe
