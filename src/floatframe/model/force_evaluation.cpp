#include "floatframe/model/force_evaluation.hpp"

#include <cmath>
#include <numbers>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

namespace {

/// Integral of one polynomial piece from x0 to x1.
double piece_integral(const PiecewisePolynomial::Piece& p, double x0, double x1) noexcept {
  const double t0 = x0 - p.centre, t1 = x1 - p.centre;
  double i0 = 0.0, i1 = 0.0;
  for (std::size_t j = p.coefficients.size(); j-- > 0;) {
    const double c = p.coefficients[j] / static_cast<double>(j + 1);
    i0 = i0 * t0 + c;
    i1 = i1 * t1 + c;
  }
  return i1 * t1 - i0 * t0;
}

double input_value(std::span<const double> inputs, int index) noexcept {
  return index < 0 ? 0.0 : inputs[static_cast<std::size_t>(index)];
}

/// Magnitude of a load, force of an actuator.
double drive(const Force& f, double t, std::span<const double> inputs) noexcept {
  return evaluate(f.magnitude, t).f + input_value(inputs, f.input);
}

void spring_damper(const Force& f, const MarkerState& a, const MarkerState& b, double actuator,
                   ForceState& out) noexcept {
  const Vec3 d = b.r - a.r;
  const double length = d.norm();
  const Vec3 n = length > 0.0 ? Vec3(d / length) : Vec3::UnitX();
  out.length = length;
  out.rate = n.dot(b.v - a.v);
  const PiecewisePolynomial::Value s = f.spring(length), c = f.damper(out.rate);
  out.force = s.f + c.f + actuator;
  const Vec3 pull = out.force * n;
  out.wrench = {pull, Vec3::Zero(), -pull, Vec3::Zero()};
  out.rows[0] = {{-n, Vec3::Zero(), n, Vec3::Zero()}, s.df, c.df};
  out.row_count = 1;
  if (length > 0.0) {
    Vec3 t1, t2;
    orthonormal_complement(n, t1, t2);
    const double k = out.force / length;
    out.rows[1] = {{-t1, Vec3::Zero(), t1, Vec3::Zero()}, k, 0.0};
    out.rows[2] = {{-t2, Vec3::Zero(), t2, Vec3::Zero()}, k, 0.0};
    out.row_count = 3;
  }
  out.energy = law_energy(f.spring, length);
}

void guided_spring(const Force& f, const MarkerState& a, const MarkerState& b, double actuator,
                   ForceState& out) noexcept {
  const Vec3 e = a.R * f.axis;
  const Vec3 d = b.r - a.r;
  out.length = -e.dot(d);
  out.rate = -e.dot(b.v - a.v) - a.w.cross(e).dot(d);
  const PiecewisePolynomial::Value s = f.spring(out.length), c = f.damper(out.rate);
  out.force = s.f + c.f + actuator;
  // ds = -e.(dr_b - dr_a) - (dpi_a x e).d
  const WrenchRow g{e, -e.cross(d), -e, Vec3::Zero()};
  out.wrench = {-out.force * g.Fa, -out.force * g.Ta, -out.force * g.Fb, Vec3::Zero()};
  out.rows[0] = {g, s.df, c.df};
  out.row_count = 1;
  out.energy = law_energy(f.spring, out.length);
}

/// `target`: where the spring and the damper pull to, with its rate.
struct Target {
  double position = 0.0, rate = 0.0;
};

void joint_spring(const Force& f, const MarkerState& a, const MarkerState& b,
                  double reference_angle, double actuator, const Target& target,
                  ForceState& out) noexcept {
  const Vec3 z = a.R.col(2);
  WrenchRow g;
  if (f.rotational) {
    const Vec3 x = b.R.col(0);
    const double angle = std::atan2(x.dot(a.R.col(1)), x.dot(a.R.col(0)));
    out.length = reference_angle + std::remainder(angle - reference_angle, 2.0 * std::numbers::pi);
    out.rate = z.dot(b.w - a.w);
    g = {Vec3::Zero(), -z, Vec3::Zero(), z};
  } else {
    const Vec3 d = b.r - a.r;
    out.length = z.dot(d);
    out.rate = z.dot(b.v - a.v) + a.w.cross(z).dot(d);
    g = {-z, z.cross(d), z, Vec3::Zero()};
  }
  const PiecewisePolynomial::Value s = f.spring(out.length - target.position),
                                   c = f.damper(out.rate - target.rate);
  out.force = s.f + c.f - actuator;
  out.wrench = {-out.force * g.Fa, -out.force * g.Ta, -out.force * g.Fb, -out.force * g.Tb};
  out.rows[0] = {g, s.df, c.df};
  out.row_count = 1;
  out.energy = law_energy(f.spring, out.length - target.position);
}

void tyre(const Model& model, const Force& f, const MarkerState& b, const Vec3& origin,
          ForceState& out) noexcept {
  const Vec3 centre = b.r + origin;
  const RoadPoint road = road_at(model.roads[static_cast<std::size_t>(f.road)], centre.x());
  const double height = centre.z() - road.z;
  const double rate = b.v.z() - road.slope * b.v.x();
  out.length = height;
  out.rate = rate;
  const Vec3 zero = Vec3::Zero();
  if (f.law == TyreLaw::vertical) {
    const double spring = f.radius - height;
    const double force = f.stiffness * spring - f.damping * rate;
    if (spring <= 0.0 || force <= 0.0) return;
    out.force = force;
    out.wrench = {zero, zero, force * Vec3::UnitZ(), zero};
    out.rows[0] = {{zero, zero, Vec3::UnitZ(), zero}, f.stiffness, f.damping};
    out.row_count = 1;
    out.energy = 0.5 * f.stiffness * spring * spring;
    return;
  }
  // Radial: the tyre sees the straight line through the road below its centre.
  const double q = 1.0 / std::sqrt(1.0 + road.slope * road.slope);
  const double spring = f.radius - height;
  const double force = (f.stiffness * spring - f.damping * rate) * q;
  if (spring <= 0.0 || force <= 0.0) return;
  const Vec3 n(-road.slope * q, 0.0, q);
  const Vec3 axis = b.R * f.axis;
  const Vec3 e_x = axis.cross(n).normalized();
  const Vec3 e_z = e_x.cross(axis);
  const double z_P = road.z + road.slope * road.slope * height * q * q;
  const double r_w = (centre.z() - z_P) / e_z.z();
  const Vec3 arm = -r_w * e_z;  // from the wheel centre to the contact point
  const Vec3 push = force * n;
  out.force = force;
  out.wrench = {zero, zero, push, arm.cross(push)};
  out.rows[0] = {{zero, zero, n, zero}, f.stiffness, f.damping};
  out.row_count = 1;
  out.energy = 0.5 * f.stiffness * spring * spring * q;
}

}  // namespace

double law_energy(const PiecewisePolynomial& law, double s) noexcept {
  const std::vector<double>& breaks = law.breaks();
  double sum = 0.0;
  double from = std::min(0.0, s), to = std::max(0.0, s);
  std::size_t k = law.piece_index(from);
  while (true) {
    const double end = k < breaks.size() ? std::min(breaks[k], to) : to;
    sum += piece_integral(law.pieces()[k], from, end);
    if (end >= to) break;
    from = end;
    ++k;
  }
  return s >= 0.0 ? sum : -sum;
}

RoadPoint road_at(const Road& road, double x) noexcept {
  const PiecewisePolynomial::Value v = road.pieces(x);
  RoadPoint p{v.f, v.df};
  for (const CosineBump& bump : road.bumps) {
    const double s = (x - bump.start) / bump.length;
    if (s <= 0.0 || s >= 1.0) continue;
    const double w = 2.0 * std::numbers::pi;
    p.z += 0.5 * bump.height * (1.0 - std::cos(w * s));
    p.slope += 0.5 * bump.height * w / bump.length * std::sin(w * s);
  }
  return p;
}

void evaluate_force(const Model& model, const Force& force, const MarkerState& a,
                    const MarkerState& b, const Vec3& origin, double t, double reference_angle,
                    ForceState& out, std::span<const double> inputs) noexcept {
  const Vec3 zero = Vec3::Zero();
  const double actuator = force.driven ? drive(force, t, inputs) : 0.0;
  out.wrench = {zero, zero, zero, zero};
  out.row_count = 0;
  out.force = out.length = out.rate = out.energy = 0.0;
  switch (force.type) {
    case ForceType::spring_damper:
      spring_damper(force, a, b, actuator, out);
      break;
    case ForceType::guided_spring:
      guided_spring(force, a, b, actuator, out);
      break;
    case ForceType::joint_spring: {
      Target target;
      if (force.targeted) {
        const PiecewisePolynomial::Value position = evaluate(force.target.function, t);
        target.position = position.f + input_value(inputs, force.target.input);
        target.rate = force.derived_rate ? position.df
                                         : evaluate(force.target_rate.function, t).f +
                                               input_value(inputs, force.target_rate.input);
      }
      joint_spring(force, a, b, reference_angle, actuator, target, out);
      break;
    }
    case ForceType::tyre:
      tyre(model, force, b, origin, out);
      break;
    case ForceType::force:
    case ForceType::torque: {
      const double magnitude = drive(force, t, inputs);
      const Vec3 load = magnitude * (force.follows ? Vec3(b.R * force.axis) : force.axis);
      out.force = magnitude;
      (force.type == ForceType::force ? out.wrench.Fb : out.wrench.Tb) = load;
      break;
    }
  }
}

}  // namespace floatframe
