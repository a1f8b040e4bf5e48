// Bushing: elastic connection of two frames in all six directions. Marker a (`from`) carries the
// axes e_1..3 = columns of R_a; both markers have the same orientation in the design configuration.
//   displacements  s_i = e_i.d, d = r_b - r_a                        (axis_measure.hpp)
//   rotations      theta = rotation vector of R_ab = R_a^T R_b = exp(skew(theta)), |theta| <= pi
// Each measure has a separate spring and damper:
//   energy         U = sum_i int spring_i(s_i) ds_i + sum_i int spring_i(theta_i) dtheta_i
//   forces         f_i = spring_i(s_i) + damper_i(sdot_i),  tau_i likewise of theta_i
//   wrench         Q = -sum f_i g_i - sum tau_i h_i with the gradients g_i of s_i, h_i of theta_i,
//                  so that springs keep U, dampers only take energy out, and the wrench on a is
//                  minus that on b about any common point
// Rotations. With u = R_a^T (w_b - w_a), the angular velocity of b in axes of a, u = H(theta)
// thetadot (so3.hpp), so
//   thetadot = B u,  B = H^-1 = I - 1/2 T + beta T^2,  T = skew(theta),
//   beta = (1 - (t/2) cot(t/2)) / t^2,  t = |theta|,   h_i = (0, -R_a B^T i, 0, R_a B^T i)
// The moment R_a B^T tau is not along the axes of either frame: three moments about the axes of a,
// each a function of one angle, are the gradient of no energy beyond small angles.
// Derivatives, with dphi = R_a^T (dpi_b - dpi_a), dtheta = B dphi, gamma = beta'(t)/t:
//   d(B u)     = E(u) dtheta,    E(u)   =  1/2 skew(u)   + N(u)     (u held)
//   d(B^T tau) = D(tau) dtheta,  D(tau) = -1/2 skew(tau) + N(tau)   (tau held)
//   N(x) = gamma (T T x) theta^T - beta (skew(T x) + T skew(x))
//   d(thetadot)    = E(u) B dphi + B R_a^T skew(w_b - w_a) dpi_a
//   d(R_a B^T tau) = dpi_a x (R_a B^T tau) + R_a D(tau) B dphi
//   stiffness  sum f_s g g^T + f_sdot g (dsdot/d(motion))^T + f dg/d(motion),  damping f_sdot g g^T
// over all six; the rows of the step contain f_s g g^T and the damping. At |theta| = pi the
// rotation vector jumps: a bushing must stay below it.
// Dampers of rotations are laws of thetadot_i, or with `rotation_rate: angular_velocity` of the
// components u_i themselves, moments about the axes of a: with equal ones -c (w_b - w_a), a viscous
// ball joint, which turns without end. Then
//   moment     R_a tau^d, tau^d_i = damper_i(u_i), gradients (0, -e_i, 0, e_i)
//   d(u)       = R_a^T skew(w_b - w_a) dpi_a,   d(R_a tau^d) = dpi_a x (R_a tau^d) + R_a d(tau^d)
// and the rows of the dampers are added to those of the springs.
// Mirrored: axis and axis_2 are polar, so e_2 = e_3 x e_1 and the axial theta reflect such that,
// for an odd number of planes, s_2, theta_1 and theta_3 change their signs: their laws become
// -f(-x).
#include <cmath>

#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/force_kind.hpp"

namespace floatframe {

namespace {

/// beta and gamma. Below |theta| = 0.3 by their series, with a truncation error below 1e-12; above
/// it the formulas keep ten digits or more.
struct AngleCoefficients {
  double beta, gamma;
  explicit AngleCoefficients(double t2) noexcept {
    if (t2 < 0.09) {
      beta = 1.0 / 12.0 +
             t2 * (1.0 / 720.0 + t2 * (1.0 / 30240.0 + t2 * (1.0 / 1209600.0 + t2 / 47900160.0)));
      gamma = 1.0 / 360.0 +
              t2 * (1.0 / 7560.0 + t2 * (1.0 / 201600.0 + t2 * (1.0 / 5987520.0 + t2 / 1.8919e8)));
      return;
    }
    const double t = std::sqrt(t2), sine = std::sin(0.5 * t), cot = std::cos(0.5 * t) / sine;
    beta = (1.0 - 0.5 * t * cot) / t2;
    gamma = (-2.0 / t2 + 0.5 * cot / t + 0.25 / (sine * sine)) / t2;
  }
};

/// theta, its rate and B.
struct Turn {
  Vec3 theta, u, rate;
  Mat3 T, B;
  double beta, gamma;
  explicit Turn(const ForceInput& in) noexcept
      : theta(quaternion_log(Eigen::Quaterniond(Mat3(in.a.R.transpose() * in.b.R)))),
        u(in.a.R.transpose() * (in.b.w - in.a.w)),
        T(skew(theta)) {
    const AngleCoefficients c(theta.squaredNorm());
    beta = c.beta;
    gamma = c.gamma;
    B = Mat3::Identity() - 0.5 * T;
    B.noalias() += beta * (T * T);
    rate = B * u;
  }
  /// N(x)
  Mat3 change(const Vec3& x) const noexcept {
    const Vec3 Tx = theta.cross(x);
    Mat3 n = gamma * theta.cross(Tx) * theta.transpose();
    n -= beta * skew(Tx);
    n.noalias() -= beta * (T * skew(x));
    return n;
  }
};

/// Springs of the six measures, then their dampers.
const PiecewisePolynomial& spring(const ForceInput& in, int i) noexcept { return in.force.laws[i]; }
const PiecewisePolynomial& damper(const ForceInput& in, int i) noexcept {
  return in.force.laws[6 + i];
}

/// True if dampers of rotations are laws of the angular velocity.
bool of_angular_velocity(const Force& force) noexcept { return !force.numbers.empty(); }

/// The measure i with its gradient.
AxisMeasure bushing_measure(const ForceInput& in, const Turn& turn, int i) noexcept {
  if (i < 3) return axis_measure(in.a.R.col(i), in.a, in.b);
  const Vec3 h = in.a.R * turn.B.row(i - 3).transpose();
  return {turn.theta[i - 3], turn.rate[i - 3], {Vec3::Zero(), -h, Vec3::Zero(), h}};
}

/// The argument of the law of damper i, with its gradient; `m`: the measure i.
AxisMeasure damped_measure(const ForceInput& in, const Turn& turn, int i,
                           const AxisMeasure& m) noexcept {
  if (i < 3 || !of_angular_velocity(in.force)) return m;
  const Vec3 e = in.a.R.col(i - 3);
  return {0.0, turn.u[i - 3], {Vec3::Zero(), -e, Vec3::Zero(), e}};
}

void take_off(double f, const WrenchRow& g, WrenchRow& w) noexcept {
  w.Fa -= f * g.Fa;
  w.Ta -= f * g.Ta;
  w.Fb -= f * g.Fb;
  w.Tb -= f * g.Tb;
}

}  // namespace

template <>
void force_of<ForceType::bushing>(const ForceInput& in, ForceState& out) noexcept {
  const Turn turn(in);
  const bool apart = of_angular_velocity(in.force);
  Vec3 force = Vec3::Zero(), s = Vec3::Zero(), rate = Vec3::Zero();
  for (int i = 0; i < 6; ++i) {
    const AxisMeasure m = bushing_measure(in, turn, i), d = damped_measure(in, turn, i, m);
    const PiecewisePolynomial::Value k = spring(in, i)(m.s), c = damper(in, i)(d.rate);
    const double f = k.f + c.f;
    if (i < 3 || !apart) {
      take_off(f, m.g, out.wrench);
      out.rows[i] = {m.g, k.df, c.df};
    } else {
      take_off(k.f, m.g, out.wrench);
      take_off(c.f, d.g, out.wrench);
      out.rows[i] = {m.g, k.df, 0.0};
      out.rows[i + 3] = {d.g, 0.0, c.df};
    }
    out.energy += law_energy(spring(in, i), m.s);
    out.energy_rate += k.f * m.rate;
    out.damping += c.f * d.rate;
    if (i >= 3) continue;
    force[i] = f;
    s[i] = m.s;
    rate[i] = m.rate;
  }
  out.row_count = apart ? 9 : 6;
  out.force = force.norm();
  out.length = s.norm();
  out.rate = out.length > 0.0 ? s.dot(rate) / out.length : 0.0;
}

template <>
void force_tangent_of<ForceType::bushing>(const ForceInput& in, ForceTangent& out) noexcept {
  using namespace part_of;
  const Turn turn(in);
  const Mat3 to_a = in.a.R.transpose(), B_to_a = turn.B * to_a;
  const Mat3 E = 0.5 * skew(turn.u) + turn.change(turn.u);
  const Mat3 of_b = E * B_to_a, of_a = B_to_a * skew(in.b.w - in.a.w) - of_b;
  const bool apart = of_angular_velocity(in.force);
  const Vec3 w = in.b.w - in.a.w;
  Vec3 tau = Vec3::Zero(), tau_d = Vec3::Zero();  // by the gradients of theta, and by e_i
  for (int i = 0; i < 6; ++i) {
    const AxisMeasure m = bushing_measure(in, turn, i), d = damped_measure(in, turn, i, m);
    const PiecewisePolynomial::Value k = spring(in, i)(m.s), c = damper(in, i)(d.rate);
    const Vec12 g = stacked(m.g), g_d = stacked(d.g);
    out.K.noalias() += k.df * g * g.transpose();
    out.C.noalias() += c.df * g_d * g_d.transpose();
    Vec12 rate_gradient = Vec12::Zero();
    if (i < 3) {
      const Vec3 e = in.a.R.col(i);
      rate_gradient = axis_rate_gradient(e, in.a, in.b);
      add_axis_curvature(e, in.a, in.b, k.f + c.f, out.K);
    } else if (apart) {
      tau[i - 3] = k.f;
      tau_d[i - 3] = c.f;
      rate_gradient.segment<3>(pi_a) = in.a.R.col(i - 3).cross(w);
    } else {
      tau[i - 3] = k.f + c.f;
      rate_gradient.segment<3>(pi_a) = of_a.row(i - 3).transpose();
      rate_gradient.segment<3>(pi_b) = of_b.row(i - 3).transpose();
    }
    out.K.noalias() += c.df * g_d * rate_gradient.transpose();
  }
  const Mat3 D = turn.change(tau) - 0.5 * skew(tau);
  const Mat3 W = in.a.R * D * B_to_a;
  const Mat3 along_a = -W - skew(B_to_a.transpose() * tau + in.a.R * tau_d);
  out.K.block<3, 3>(pi_b, pi_a) += along_a;
  out.K.block<3, 3>(pi_b, pi_b) += W;
  out.K.block<3, 3>(pi_a, pi_a) -= along_a;
  out.K.block<3, 3>(pi_a, pi_b) -= W;
}

namespace {

constexpr const char* rotation_rates[] = {"rotation_vector", "angular_velocity"};
constexpr ForceKeyKind spring_law = ForceKeyKind::spring, damper_law = ForceKeyKind::damper;
constexpr ForceAxis about_axis = ForceAxis::about;
constexpr ForceKey bushing_keys[] = {
    place_key("from", "on the body that carries the axes"),
    place_key("to", "on the other body"),
    {.name = "axis", .kind = ForceKeyKind::direction, .about = "the third axis, e₃"},
    axis_2_key,
    law_key("spring_x", spring_law, "of the displacement along e₁"),
    law_key("spring_y", spring_law, "along e₂"),
    law_key("spring_z", spring_law, "along e₃"),
    law_key("spring_rx", spring_law, "of the rotation about e₁", {}, about_axis),
    law_key("spring_ry", spring_law, "about e₂", {}, about_axis),
    law_key("spring_rz", spring_law, "about e₃", {}, about_axis),
    law_key("damper_x", damper_law, "of the rate of the displacement along e₁"),
    law_key("damper_y", damper_law, "along e₂"),
    law_key("damper_z", damper_law, "along e₃"),
    law_key("damper_rx", damper_law, "of the rate of the rotation about e₁", {}, about_axis),
    law_key("damper_ry", damper_law, "about e₂", {}, about_axis),
    law_key("damper_rz", damper_law, "about e₃", {}, about_axis),
    {.name = "rotation_rate",
     .kind = ForceKeyKind::word,
     .about = "what `damper_rx`, `damper_ry` and `damper_rz` are laws of: the rates of the "
              "components of the rotation vector, or the components of the angular velocity of "
              "`to` relative to `from`, which may then turn without end",
     .words = rotation_rates}};
constexpr int first_law = 4;

/// Displacements count from the design configuration.
double design_displacement(const ForceView& values, const ForceKey& key) {
  const auto i = &key - &bushing_keys[first_law];
  if (i >= 3) return 0.0;
  return element_axes(values).col(i).dot(values.place("to").point - values.place("from").point);
}

bool bushing_build(ForceBuild& b) {
  const Mat3 R = element_axes(b);
  b.force.a = b.marker("from", true, R);
  b.force.b = b.marker("to", true, R);
  for (int i = 0; i < 12; ++i) b.force.laws.push_back(b.law(bushing_keys[first_law + i].name));
  if (b.word("rotation_rate") == 1) b.force.numbers = {1.0};
  return b.has_ends();
}

bool bushing_ends(const Force& f) noexcept {
  for (std::size_t i = 3; i < (of_angular_velocity(f) ? 6u : 12u); ++i) {
    if (i >= 6 && i < 9) continue;
    for (const PiecewisePolynomial::Piece& p : f.laws[i].pieces())
      for (const double c : p.coefficients)
        if (c != 0.0) return true;
  }
  return false;
}

/// -f(-x)
PiecewisePolynomial reflected(const PiecewisePolynomial& f) {
  std::vector<double> breaks(f.breaks().rbegin(), f.breaks().rend());
  for (double& x : breaks) x = -x;
  std::vector<PiecewisePolynomial::Piece> pieces(f.pieces().rbegin(), f.pieces().rend());
  for (PiecewisePolynomial::Piece& p : pieces) {
    p.centre = -p.centre;
    for (std::size_t j = 0; j < p.coefficients.size(); j += 2)
      p.coefficients[j] = -p.coefficients[j];
  }
  return {std::move(breaks), std::move(pieces)};
}

void bushing_mirror(ForceDescription& force, const Placement& x) {
  if (x.det() > 0.0) return;
  const ForceView values(force);
  for (const char* name :
       {"spring_y", "spring_rx", "spring_rz", "damper_y", "damper_rx", "damper_rz"})
    if (values.has(name)) set_force_value(force, values.key(name), reflected(values.law(name)));
}

constexpr const char* turning_axes = "the turning of the axes with the body and of the moments";
constexpr ForceRegime bushing_regimes[] = {
    {.name = "anywhere", .rows_leave_out = turning_axes},
    {.name = "almost_aligned", .rows_leave_out = turning_axes},
    {.name = "far_turned", .rows_leave_out = turning_axes},
    {.name = "angular_velocity", .rows_leave_out = turning_axes},
};

ForceExample bushing_example(std::size_t regime, ExampleNumbers& numbers) {
  ForceExample x;
  x.force.type = ForceType::bushing;
  for (int i = 0; i < 6; ++i) {
    const double k = i < 3 ? 10.0 : 1.0;
    x.force.laws.push_back(PiecewisePolynomial::polynomial(
        {k * numbers(-2.0, 2.0), k * numbers(5.0, 20.0), k * numbers(-1.0, 1.0), k * 0.5}));
  }
  for (int i = 0; i < 6; ++i) x.force.laws.push_back(example_damper(numbers));
  x.a = numbers.marker();
  x.b = numbers.marker();
  if (regime == 3) x.force.numbers = {1.0};
  const double angles[] = {numbers(0.3, 2.0), numbers(0.0, 1e-3), numbers(2.5, 3.0),
                           numbers(0.3, 3.0)};
  x.b.R = x.a.R * rotation_exp(angles[regime] * numbers.direction());
  return x;
}

}  // namespace

constinit const ForceKind bushing_element = {
    .about =
        "elastic connection of two bodies with a law for each displacement along and each rotation "
        "about axes fixed in the body of `from`; the rotations are the components of the rotation "
        "vector of the other body in these axes, of less than half a turn, and the dampers of "
        "rotations are laws of its rates unless `rotation_rate` is given. Displacements of "
        "laws that are a number count from the design configuration; a preload goes into the law. "
        "Results: size of the force, distance of the points and its rate",
    .keys = bushing_keys,
    .free_value = design_displacement,
    .validate = validate_framed,
    .build = bushing_build,
    .mirror = bushing_mirror,
    .ends_at_half_turn = bushing_ends,
    .regimes = bushing_regimes,
    .example = bushing_example};

}  // namespace floatframe
