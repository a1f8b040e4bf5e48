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
// For dual numbers dtheta = B dphi, dphi = R_a^T (dpi_b - dpi_a), and d(beta) = beta'(t)/(2 t)
// d(t^2). The rows of the step contain f_s g g^T and the damping f_sdot g g^T of each measure. At
// |theta| = pi the rotation vector jumps: a bushing must stay below it.
// Dampers of rotations are laws of thetadot_i, or with `rotation_rate: angular_velocity` of the
// components u_i themselves, moments about the axes of a: with equal ones -c (w_b - w_a), a viscous
// ball joint, which turns without end. Then
//   moment     R_a tau^d, tau^d_i = damper_i(u_i), gradients (0, -e_i, 0, e_i)
// and the rows of the dampers are added to those of the springs.
// Mirrored: axis and axis_2 are polar, so e_2 = e_3 x e_1 and the axial theta reflect such that,
// for an odd number of planes, s_2, theta_1 and theta_3 change their signs: their laws become
// -f(-x).
#include <cmath>

#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/element_kind.hpp"

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

/// Rotation vector of R, |theta| <= pi.
Vec3 rotation_vector(const Mat3& R) noexcept { return quaternion_log(Eigen::Quaterniond(R)); }

/// B(theta) and its inverse relation dtheta = B dphi for dR = R skew(dphi).
Mat3 rotation_rate_matrix(const Vec3& theta) noexcept {
  const Mat3 T = skew(theta);
  Mat3 B = Mat3::Identity() - 0.5 * T;
  B.noalias() += AngleCoefficients(theta.squaredNorm()).beta * (T * T);
  return B;
}

Eigen::Matrix<Dual, 3, 1> rotation_vector(const Eigen::Matrix<Dual, 3, 3>& R) noexcept {
  const Mat3 R_0 = R.unaryExpr([](const Dual& x) { return x.v; });
  const Vec3 theta = rotation_vector(R_0);
  const Mat3 B = rotation_rate_matrix(theta);
  Eigen::Matrix<Dual, 3, 1> out = theta.cast<Dual>();
  for (int k = 0; k < 12; ++k) {
    const Mat3 dR = R.unaryExpr([k](const Dual& x) { return x.d[k]; });
    const Mat3 W = dR * R_0.transpose();  // skew(dphi), R_new = exp(skew(dphi)) R
    const Vec3 dtheta = B * Vec3(W(2, 1), W(0, 2), W(1, 0));
    for (int c = 0; c < 3; ++c) out[c].d[k] = dtheta[c];
  }
  return out;
}

double beta_of(double t2) noexcept { return AngleCoefficients(t2).beta; }
Dual beta_of(const Dual& t2) noexcept {
  const AngleCoefficients c(t2.v);
  return chained(c.beta, 0.5 * c.gamma, t2);
}

/// theta, u and B.
template <class S>
struct Turn {
  using V = Eigen::Matrix<S, 3, 1>;
  using M = Eigen::Matrix<S, 3, 3>;
  V theta, u, rate;
  M B;
  explicit Turn(const PortsOf<S>& in) noexcept {
    const auto &a = in.marker(0), &b = in.marker(1);
    theta = rotation_vector(M(a.R.transpose() * b.R));
    u = a.R.transpose() * (b.w - a.w);
    M T;
    const S zero = 0.0;
    T << zero, -theta.z(), theta.y(), theta.z(), zero, -theta.x(), -theta.y(), theta.x(), zero;
    B = M::Identity() - S(0.5) * T;
    B.noalias() += beta_of(S(theta.squaredNorm())) * (T * T);
    rate = B * u;
  }
};

/// The measure i with its gradient.
template <class S>
AxisMeasure<S> bushing_measure(const PortsOf<S>& in, const Turn<S>& turn, int i) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const auto& R = in.marker(0).R;
  if (i < 3) return axis_measure(V(R.col(i)), in.marker(0), in.marker(1));
  const V h = R * turn.B.row(i - 3).transpose();
  const V zero = V::Zero();
  return {turn.theta[i - 3], turn.rate[i - 3], {{zero, -h}, {zero, h}}};
}

template <class S>
void bushing_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const Turn<S> turn(in);
  const bool apart = in.template keys<Bushing>().rotation_rate == RotationRate::angular_velocity;
  V force = V::Zero(), s = V::Zero(), rate = V::Zero();
  for (int i = 0; i < 6; ++i) {
    const AxisMeasure<S> m = bushing_measure(in, turn, i);
    AxisMeasure<S> d = m;  // of the damper
    if (i >= 3 && apart) {
      const V e = in.marker(0).R.col(i - 3), zero = V::Zero();
      d = {0.0, turn.u[i - 3], {{zero, -e}, {zero, e}}};
    }
    const auto& laws = in.element.laws;  // springs, then dampers
    const LawValue<S> k = law_of(laws[static_cast<std::size_t>(i)], m.s);
    const LawValue<S> c = law_of(laws[static_cast<std::size_t>(6 + i)], d.rate);
    const S f = k.f + c.f;
    if (i < 3 || !apart) {
      out.add_pair(-f, m.g);
      out.add_pair_row(m.g, k.df, c.df);
    } else {
      out.add_pair(-k.f, m.g);
      out.add_pair(-c.f, d.g);
      out.add_pair_row(m.g, k.df, 0.0);
      out.add_pair_row(d.g, 0.0, c.df);
    }
    out.energy += energy_of(laws[static_cast<std::size_t>(i)], m.s);
    out.energy_rate += k.f * m.rate;
    out.damping += c.f * d.rate;
    if (i >= 3) continue;
    force[i] = f;
    s[i] = m.s;
    rate[i] = m.rate;
  }
  out.force = force.norm();
  out.length = s.norm();
  out.rate = out.length > 0.0 ? S(s.dot(rate) / out.length) : S(0.0);
}

}  // namespace

FLOATFRAME_LAW(bushing)

namespace {

constexpr const char* rates_of_rotations[] = {"rotation_vector", "angular_velocity"};
constexpr KeyKind spring_law = KeyKind::spring, damper_law = KeyKind::damper;
constexpr ElementAxis about_axis = ElementAxis::about;
constexpr ElementKey bushing_keys[] = {
    place_key("from", "on the body that carries the axes", described_by<&Bushing::from>),
    place_key("to", "on the other body", described_by<&Bushing::to>),
    {.name = "axis",
     .kind = KeyKind::direction,
     .about = "the third axis, e₃",
     .member = described_by<&Bushing::axis>},
    axis_2_key(described_by<&Bushing::axis_2>),
    law_key("spring_x", spring_law, "of the displacement along e₁",
            described_by<&Bushing::spring_x>),
    law_key("spring_y", spring_law, "along e₂", described_by<&Bushing::spring_y>),
    law_key("spring_z", spring_law, "along e₃", described_by<&Bushing::spring_z>),
    law_key("spring_rx", spring_law, "of the rotation about e₁", described_by<&Bushing::spring_rx>,
            about_axis),
    law_key("spring_ry", spring_law, "about e₂", described_by<&Bushing::spring_ry>, about_axis),
    law_key("spring_rz", spring_law, "about e₃", described_by<&Bushing::spring_rz>, about_axis),
    law_key("damper_x", damper_law, "of the rate of the displacement along e₁",
            described_by<&Bushing::damper_x>),
    law_key("damper_y", damper_law, "along e₂", described_by<&Bushing::damper_y>),
    law_key("damper_z", damper_law, "along e₃", described_by<&Bushing::damper_z>),
    law_key("damper_rx", damper_law, "of the rate of the rotation about e₁",
            described_by<&Bushing::damper_rx>, about_axis),
    law_key("damper_ry", damper_law, "about e₂", described_by<&Bushing::damper_ry>, about_axis),
    law_key("damper_rz", damper_law, "about e₃", described_by<&Bushing::damper_rz>, about_axis),
    {.name = "rotation_rate",
     .kind = KeyKind::word,
     .about = "what `damper_rx`, `damper_ry` and `damper_rz` are laws of: the rates of the "
              "components of the rotation vector, or the components of the angular velocity of "
              "`to` relative to `from`, which may then turn without end",
     .words = rates_of_rotations,
     .member = described_by<&Bushing::rotation_rate>}};
constexpr int first_law = 4;

/// Displacements count from the design configuration.
double design_displacement(const ElementView& values, const ElementKey& key) {
  const auto i = &key - &bushing_keys[first_law];
  if (i >= 3) return 0.0;
  return element_axes(values).col(i).dot(values.place("to").point - values.place("from").point);
}

bool bushing_build(ElementBuild& b) {
  const Mat3 R = element_axes(b);
  const bool from = b.connect("from", true, R), to = b.connect("to", true, R);
  return from && to;
}

bool bushing_ends(const Element& f) noexcept {
  const bool springs = std::get<Bushing>(*f.keys).rotation_rate == RotationRate::angular_velocity;
  for (std::size_t i = 3; i < (springs ? 6u : 12u); ++i) {
    if (i >= 6 && i < 9) continue;
    for (const PiecewisePolynomial::Piece& p : f.laws[i].pieces())
      for (const double c : p.coefficients)
        if (c != 0.0) return true;
  }
  return false;
}

Picture bushing_picture(const Element& element) {
  return {.symbol = Picture::Symbol::bushing,
          .a = element.markers[0],
          .b = element.markers[1],
          .axis = Vec3::UnitZ(),
          .axis_of = element.markers[0]};
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

void bushing_mirror(ElementDescription& force, const Placement& x) {
  if (x.det() > 0.0) return;
  const ElementView values(force);
  for (const char* name :
       {"spring_y", "spring_rx", "spring_rz", "damper_y", "damper_rx", "damper_rz"})
    if (values.has(name)) set_key_value(force, values.key(name), reflected(values.law(name)));
}

constexpr const char* turning_axes = "the turning of the axes with the body and of the moments";
constexpr ElementRegime bushing_regimes[] = {
    {.name = "anywhere", .rows_leave_out = turning_axes},
    {.name = "almost_aligned", .rows_leave_out = turning_axes},
    {.name = "far_turned", .rows_leave_out = turning_axes},
    {.name = "angular_velocity", .rows_leave_out = turning_axes},
};

ElementExample bushing_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  Bushing f;
  int i = 0;
  for (PiecewisePolynomial* law :
       {&f.spring_x, &f.spring_y, &f.spring_z, &f.spring_rx, &f.spring_ry, &f.spring_rz}) {
    const double k = i++ < 3 ? 10.0 : 1.0;
    *law = PiecewisePolynomial::polynomial(
        {k * numbers(-2.0, 2.0), k * numbers(5.0, 20.0), k * numbers(-1.0, 1.0), k * 0.5});
  }
  for (PiecewisePolynomial* law :
       {&f.damper_x, &f.damper_y, &f.damper_z, &f.damper_rx, &f.damper_ry, &f.damper_rz})
    *law = example_damper(numbers);
  if (regime == 3) f.rotation_rate = RotationRate::angular_velocity;
  x.keys(f);
  x.markers = {numbers.marker(), numbers.marker()};
  const double angles[] = {numbers(0.3, 2.0), numbers(0.0, 1e-3), numbers(2.5, 3.0),
                           numbers(0.3, 3.0)};
  x.markers[1].R = x.markers[0].R * rotation_exp(angles[regime] * numbers.direction());
  return x;
}

}  // namespace

constinit const ElementKind bushing_element = {
    .about =
        "elastic connection of two bodies with a law for each displacement along and each rotation "
        "about axes fixed in the body of `from`; the rotations are the components of the rotation "
        "vector of the other body in these axes, of less than half a turn, and the dampers of "
        "rotations are laws of its rates unless `rotation_rate` is given. Displacements of "
        "laws that are a number count from the design configuration; a preload goes into the law. "
        "Results: size of the force, distance of the points and its rate",
    .keys = bushing_keys,
    .blank = [] { return ElementKeys(Bushing()); },
    .free_value = design_displacement,
    .validate = validate_framed,
    .build = bushing_build,
    .mirror = bushing_mirror,
    .ends_at_half_turn = bushing_ends,
    .dual = bushing_law<Dual>,
    .picture = bushing_picture,
    .regimes = bushing_regimes};

constinit const ExampleMaker bushing_examples = bushing_example;

}  // namespace floatframe
