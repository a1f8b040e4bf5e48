// Spring on the coordinate of a prismatic or revolute joint, z the axis of marker a:
// f = spring(s - target) + damper(sdot - rate of the target) - actuator, and -f acts on the
// coordinate; with a target it is a motor.
//   along   s = z.d (axis_measure.hpp), Q = -f g
//   about   s = angle of x_b about z, followed over several turns; g = (0, -z, 0, z),
//           sdot = z.(w_b - w_a)
// The markers of a hinge share the axis. Where they do not (cut joints before they close) the angle
// changes by m.(dpi_b - dpi_a), m = (p x_b x y_a - q x_b x x_a)/(p^2 + q^2), p = x_b.x_a,
// q = x_b.y_a; m = z on the axis. The torque stays along z.
//   stiffness    f_s g (ds/d(motion))^T + f_sdot g (dsdot/d(motion))^T + f dg/d(motion)
//   damping      f_sdot g g^T
// The row of the step contains f_s g g^T and the damping.
#include <cmath>
#include <numbers>

#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/force_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/sentences.hpp"

namespace floatframe {

namespace {

struct Coordinate {
  double s, rate;
  WrenchRow g;
};

Coordinate coordinate(const ForceInput& in) noexcept {
  const Vec3 z = in.a.R.col(2);
  if (!in.force.rotational) {
    const AxisMeasure m = axis_measure(z, in.a, in.b);
    return {m.s, m.rate, m.g};
  }
  const Vec3 x = in.b.R.col(0);
  const double angle = std::atan2(x.dot(in.a.R.col(1)), x.dot(in.a.R.col(0)));
  const double turns = std::remainder(angle - in.reference_angle, 2.0 * std::numbers::pi);
  return {in.reference_angle + turns, z.dot(in.b.w - in.a.w), {Vec3::Zero(), -z, Vec3::Zero(), z}};
}

/// f and its slopes; spring and damper act towards the target.
struct Law {
  double f, f_s, f_rate;
  double stretch;               ///< s - target
  double energy_rate, damping;  ///< of the spring and of the damper
  double rate;                  ///< sdot - rate of the target
};

Law law_at(const ForceInput& in, const Coordinate& m) noexcept {
  double target = 0.0, target_rate = 0.0, moves = 0.0;
  if (in.force.targeted) {
    const PiecewisePolynomial::Value position = evaluate(in.force.target.function, in.t);
    target = position.f + in.input(in.force.target.input);
    moves = position.df;  // an input is constant during a step
    target_rate = in.force.derived_rate ? position.df
                                        : evaluate(in.force.target_rate.function, in.t).f +
                                              in.input(in.force.target_rate.input);
  }
  const PiecewisePolynomial::Value s = spring_of(in, m.s - target);
  const PiecewisePolynomial::Value c = damper_of(in, m.rate - target_rate);
  return {s.f + c.f - in.actuator(),
          s.df,
          c.df,
          m.s - target,
          s.f * (m.rate - moves),
          c.f * (m.rate - target_rate),
          m.rate - target_rate};
}

ForceSide joint_spring_side(const ForceInput& in) noexcept {
  const Law law = law_at(in, coordinate(in));
  return spring_side(in, law.stretch, law.rate);
}

}  // namespace

template <>
void force_of<ForceType::joint_spring>(const ForceInput& in, ForceState& out) noexcept {
  const Coordinate m = coordinate(in);
  out.length = m.s;
  out.rate = m.rate;
  const Law law = law_at(in, m);
  const double f = law.f;
  out.force = f;
  out.wrench = {-f * m.g.Fa, -f * m.g.Ta, -f * m.g.Fb, -f * m.g.Tb};
  out.rows[0] = {m.g, law.f_s, law.f_rate};
  out.row_count = 1;
  out.energy = law_energy(in.force.spring, law.stretch);
  out.energy_rate = law.energy_rate;
  out.damping = law.damping;
}

template <>
void force_tangent_of<ForceType::joint_spring>(const ForceInput& in, ForceTangent& out) noexcept {
  const Coordinate m = coordinate(in);
  const Law law = law_at(in, m);
  const Vec3 z = in.a.R.col(2);
  const Vec12 g = stacked(m.g);
  out.C.noalias() = law.f_rate * g * g.transpose();
  if (!in.force.rotational) {
    out.K.noalias() = law.f_s * g * g.transpose();
    out.K.noalias() += law.f_rate * g * axis_rate_gradient(z, in.a, in.b).transpose();
    add_axis_curvature(z, in.a, in.b, law.f, out.K);
    return;
  }
  using namespace part_of;
  const Vec3 x = in.b.R.col(0), x_a = in.a.R.col(0), y_a = in.a.R.col(1);
  const double p = x.dot(x_a), q = x.dot(y_a);
  const double r2 = p * p + q * q;
  const Vec3 turn = r2 > 0.0 ? Vec3((p * x.cross(y_a) - q * x.cross(x_a)) / r2) : z;
  Vec12 h = Vec12::Zero();
  h.segment<3>(pi_a) = law.f_rate * z.cross(in.b.w - in.a.w) - law.f_s * turn;
  h.segment<3>(pi_b) = law.f_s * turn;
  out.K.noalias() = g * h.transpose();
  const Mat3 Z = law.f * skew(z);  // f d(z) = -Z dpi_a
  out.K.block<3, 3>(pi_a, pi_a) += Z;
  out.K.block<3, 3>(pi_b, pi_a) -= Z;
}

namespace {

constexpr const char* turning_joint_axis = "the turning of the axis with its body";
constexpr ForceRegime joint_spring_regimes[] = {
    {.name = "along", .rows_leave_out = turning_joint_axis},
    {.name = "about", .rows_leave_out = turning_joint_axis},
    {.name = "about_after_turns", .rows_leave_out = turning_joint_axis},
    {.name = "motor_along", .rows_leave_out = turning_joint_axis, .conservative = false},
    {.name = "motor_about", .rows_leave_out = turning_joint_axis, .conservative = false}};

ForceExample joint_spring_example(std::size_t regime, ExampleNumbers& numbers) {
  ForceExample x;
  x.force.type = ForceType::joint_spring;
  x.force.rotational = regime == 1 || regime == 2 || regime == 4;
  x.force.spring = example_spring(numbers);
  x.force.damper = example_damper(numbers);
  x.a = numbers.marker();
  x.b = x.force.rotational ? numbers.marker_on_axis(x.a) : numbers.marker();
  if (regime >= 3) {
    add_example_drive(x, numbers);
    x.force.targeted = true;
    x.force.target.function.pieces = PiecewisePolynomial::polynomial({0.1, numbers(-1.0, 1.0)});
    x.force.target.input = static_cast<int>(x.inputs.size());
    x.inputs.push_back(numbers(-0.5, 0.5));
    x.force.target_rate.input = static_cast<int>(x.inputs.size());
    x.inputs.push_back(numbers(-0.5, 0.5));
  }
  if (regime == 2) x.reference_angle = 6.0 * std::numbers::pi;
  return x;
}

using J = JointSpringDescription;

constexpr ForceAxis on_q = ForceAxis::coordinate;
constexpr ForceKey joint_spring_keys[] = {
    {.name = "joint",
     .kind = ForceKeyKind::joint,
     .about = "one with one coordinate q",
     .required = true,
     .member = described_by<&J::joint>},
    law_key("spring", ForceKeyKind::spring, "of q - target", described_by<&J::spring>, on_q),
    law_key("damper", ForceKeyKind::damper, "of q̇ - rate of the target", described_by<&J::damper>,
            on_q),
    law_key("actuator", ForceKeyKind::load, "added to the force on q, which it raises",
            described_by<&J::actuator>, on_q),
    law_key("target", ForceKeyKind::target, "the place that `spring` pulls to",
            described_by<&J::target>, on_q),
    law_key("target_rate", ForceKeyKind::target_rate, "the rate that `damper` pulls to",
            described_by<&J::target_rate>, on_q)};

void joint_spring_validate(const ForceCheck& check) {
  if (check.good("joint")) {
    const std::string joint = check.text("joint");
    const auto type = check.joint_type(joint);
    if (type && !joint_has_one_coordinate(*type))
      check.error(ErrorCode::wrong_value, "joint",
                  "found '" + check.written(joint) + "', expected a " + joints_of_one_coordinate() +
                      " joint");
  }
  if (!check.given("target") && !check.given("target_rate")) check.some_law();
  if (check.given("spring") || check.given("damper")) return;
  for (const char* key : {"target", "target_rate"})
    if (check.given(key)) check.error(ErrorCode::incomplete, key, sentences::target_without_law());
}

bool joint_spring_build(ForceBuild& b) {
  Force& f = b.force;
  b.spring_damper_actuator();
  if (b.has("target")) f.target = b.built_signal("target");
  if (b.has("target_rate")) f.target_rate = b.built_signal("target_rate");
  f.targeted = b.has("target") || b.has("target_rate");
  f.derived_rate = !b.has("target_rate");
  const Joint* joint = b.joint("joint");
  if (!joint) return false;
  f.a = joint->frame_F;
  f.b = joint->frame_M;
  f.rotational = joint_unit(joint->type, 0) == JointUnit::rad;
  return true;
}

}  // namespace

constinit const ForceKind joint_spring_element = {
    .about =
        "spring, damper and motor on the coordinate of a joint: the force on it is actuator - "
        "spring(q - target) - damper(q̇ - rate)",
    .keys = joint_spring_keys,
    .markers = ForceMarkers::of_joint,
    .axis = ForceAxis::coordinate,
    .blank = [] { return ForceDescription::Values(J()); },
    .validate = joint_spring_validate,
    .build = joint_spring_build,
    .side = joint_spring_side,
    .regimes = joint_spring_regimes,
    .example = joint_spring_example};

}  // namespace floatframe
