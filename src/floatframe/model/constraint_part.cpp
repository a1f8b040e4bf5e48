#include "floatframe/model/constraint_part.hpp"

#include <cmath>
#include <numbers>

namespace floatframe {

PiecewisePolynomial::Value evaluate(const TimeFunction& f, double t) noexcept {
  PiecewisePolynomial::Value v = f.pieces(t);
  if (f.amplitude != 0.0) {
    const double w = 2.0 * std::numbers::pi * f.frequency;
    const double s = std::sin(w * t + f.phase), c = std::cos(w * t + f.phase);
    v.f += f.amplitude * s;
    v.df += f.amplitude * w * c;
    v.ddf -= f.amplitude * w * w * s;
  }
  return v;
}

namespace {

using Kind = ConstraintPart::Kind;

/// phi = n.d with n fixed in a.
void in_line_row(const Vec3& n, const MarkerState& a, const MarkerState& b,
                 ConstraintRow& row) noexcept {
  const Vec3 d = b.r - a.r;
  const Vec3 d_dot = b.v - a.v;
  row.phi = n.dot(d);
  row.gradient = {-n, n.cross(d), n, Vec3::Zero()};
  row.quad = a.w.cross(a.w.cross(n)).dot(d) + 2.0 * a.w.cross(n).dot(d_dot);
  row.phi_t = row.phi_tt = 0.0;
}

}  // namespace

void evaluate_constraint(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                         double t, ConstraintRow* rows) noexcept {
  switch (part.kind) {
    case Kind::coincident:
      for (int k = 0; k < 3; ++k) {
        rows[k].phi = b.r[k] - a.r[k];
        rows[k].gradient = {-Vec3::Unit(k), Vec3::Zero(), Vec3::Unit(k), Vec3::Zero()};
        rows[k].quad = rows[k].phi_t = rows[k].phi_tt = 0.0;
      }
      break;
    case Kind::in_line:
      in_line_row(a.R.col(0), a, b, rows[0]);
      in_line_row(a.R.col(1), a, b, rows[1]);
      break;
    case Kind::perpendicular: {
      const Vec3 e = a.R * part.e_a;
      const Vec3 n = b.R * part.n_b;
      const Vec3 torque = part.scale * e.cross(n);
      rows->phi = part.scale * (e.dot(n) - part.c);
      rows->gradient = {Vec3::Zero(), torque, Vec3::Zero(), -torque};
      const Vec3 e_dot = a.w.cross(e);
      const Vec3 n_dot = b.w.cross(n);
      rows->quad =
          part.scale * (a.w.cross(e_dot).dot(n) + 2.0 * e_dot.dot(n_dot) + e.dot(b.w.cross(n_dot)));
      rows->phi_t = rows->phi_tt = 0.0;
      break;
    }
    case Kind::distance: {
      const Vec3 d = b.r - a.r;
      const Vec3 d_dot = b.v - a.v;
      const Vec3 n = d / part.scale;
      rows->phi = (d.squaredNorm() - part.scale * part.scale) / (2.0 * part.scale);
      rows->gradient = {-n, Vec3::Zero(), n, Vec3::Zero()};
      rows->quad = d_dot.squaredNorm() / part.scale;
      rows->phi_t = rows->phi_tt = 0.0;
      break;
    }
    case Kind::drive_position: {
      in_line_row(a.R.col(2), a, b, *rows);
      const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
      rows->phi -= f.f;
      rows->phi_t = -f.df;
      rows->phi_tt = -f.ddf;
      break;
    }
    case Kind::drive_angle: {
      const PiecewisePolynomial::Value f = evaluate(*part.motion, t);
      const Vec3 x = b.R.col(0);
      const Vec3 z = a.R.col(2);
      const double angle = std::atan2(x.dot(a.R.col(1)), x.dot(a.R.col(0)));
      rows->phi = part.scale * std::remainder(angle - f.f, 2.0 * std::numbers::pi);
      rows->gradient = {Vec3::Zero(), -part.scale * z, Vec3::Zero(), part.scale * z};
      rows->quad = part.scale * a.w.cross(z).dot(b.w - a.w);
      rows->phi_t = -part.scale * f.df;
      rows->phi_tt = -part.scale * f.ddf;
      break;
    }
  }
}

void append_joint_parts(const Model& model, int index, std::vector<ConstraintPart>& parts) {
  const Joint& joint = model.joints[static_cast<std::size_t>(index)];
  const double length = model.bodies[static_cast<std::size_t>(joint.child)].length;
  ConstraintPart base;
  base.a = joint.frame_F;
  base.b = joint.frame_M;
  base.owner = {ConstraintOwner::Kind::joint, index};
  const auto add = [&](Kind kind) {
    ConstraintPart p = base;
    p.kind = kind;
    parts.push_back(p);
  };
  const auto add_perpendicular = [&](const Vec3& e_a, const Vec3& n_b, double c) {
    ConstraintPart p = base;
    p.kind = Kind::perpendicular;
    p.e_a = e_a;
    p.n_b = n_b;
    p.c = c;
    p.scale = length;
    parts.push_back(p);
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  switch (joint.type) {
    case JointType::weld:
      add(Kind::coincident);
      add_perpendicular(z, x, 0.0);
      add_perpendicular(z, y, 0.0);
      add_perpendicular(x, y, 0.0);
      break;
    case JointType::revolute:
      add(Kind::coincident);
      add_perpendicular(z, x, 0.0);
      add_perpendicular(z, y, 0.0);
      break;
    case JointType::prismatic:
      add(Kind::in_line);
      add_perpendicular(z, x, 0.0);
      add_perpendicular(z, y, 0.0);
      add_perpendicular(x, y, 0.0);
      break;
    case JointType::cylindrical:
      add(Kind::in_line);
      add_perpendicular(z, x, 0.0);
      add_perpendicular(z, y, 0.0);
      break;
    case JointType::universal:
      add(Kind::coincident);
      add_perpendicular(z, joint.axis_2, joint.axis_2.z());
      break;
    case JointType::spherical:
      add(Kind::coincident);
      break;
    case JointType::free:
      break;
  }
}

void append_motion_parts(const Model& model, int index, std::vector<ConstraintPart>& parts) {
  const Joint& joint = model.joints[static_cast<std::size_t>(index)];
  if (!joint.motion) return;
  ConstraintPart p;
  p.kind = joint.type == JointType::prismatic ? Kind::drive_position : Kind::drive_angle;
  p.a = joint.frame_F;
  p.b = joint.frame_M;
  p.scale = p.kind == Kind::drive_angle ? model.bodies[static_cast<std::size_t>(joint.child)].length
                                        : 1.0;
  p.motion = &*joint.motion;
  p.owner = {ConstraintOwner::Kind::joint, index};
  parts.push_back(p);
}

void append_rod_parts(const Model& model, int index, std::vector<ConstraintPart>& parts) {
  const Rod& rod = model.rods[static_cast<std::size_t>(index)];
  ConstraintPart p;
  p.kind = Kind::distance;
  p.a = rod.a;
  p.b = rod.b;
  p.scale = rod.length;
  p.owner = {ConstraintOwner::Kind::rod, index};
  parts.push_back(p);
}

std::string owner_name(const Model& model, const ConstraintOwner& owner) {
  const auto i = static_cast<std::size_t>(owner.index);
  if (owner.kind == ConstraintOwner::Kind::rod) return "rod '" + model.rods[i].name + "'";
  return "joint '" + model.joints[i].name + "'";
}

}  // namespace floatframe
