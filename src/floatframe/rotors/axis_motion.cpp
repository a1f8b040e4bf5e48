#include "floatframe/body/modal_mass.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/rotors/steady_turning.hpp"
#include "floatframe/rotors/whirl.hpp"

namespace floatframe {
namespace {

/// int |v + w x r + X y|^2 dm = (v, length w, y)^T form (v, length w, y), v of the point p_BP, v
/// and w in world axes, r from that point.
MatX motion_form(const FlexibleBody& body, const Mat3& R, const Vec3& p_BP, double length) {
  const int nm = body.modes();
  MatX to_origin = MatX::Identity(6 + nm, 6 + nm);  // (v of the origin, w, y), body axes
  to_origin.topLeftCorner<3, 3>() = R.transpose();
  to_origin.block<3, 3>(3, 3) = R.transpose() / length;
  to_origin.block<3, 3>(0, 3) = skew(p_BP) * to_origin.block<3, 3>(3, 3);
  return to_origin.transpose() * mass_matrix_at_rest(body.invariants) * to_origin;
}

/// Moment of inertia about the axis through p_BP.
double axial_inertia(const InertiaInvariants& I, const RotorBody& r) {
  const Vec3 c = I.centre_of_mass() - r.p_BP;
  const Vec3 off = c - r.axis * r.axis.dot(c);
  return r.axis.dot(I.inertia_about_centre() * r.axis) + I.m * off.squaredNorm();
}

}  // namespace

AxisMotion axis_motion(RelativeFormulation& f, const Rotor& rotor, const SteadyTurning& s) {
  kinematics_at(f, 0.0, s.state.q, VecX::Zero(f.velocities()));
  const std::vector<Body>& bodies = f.model().bodies;
  Eigen::Index rows = 0, count = 0;
  std::vector<Eigen::Index> begin;
  for (const Body& b : bodies) {
    begin.push_back(rows);
    rows += 6 + b.modes();
  }
  for (const RotorBody& r : rotor.bodies) count += 2 + static_cast<Eigen::Index>(r.on_axis.size());
  AxisMotion axis;
  axis.across_1 = axis.across_2 = axis.along = axis.twist = MatX::Zero(count, 2 * rows);
  axis.rotor = axis.others = MatX::Zero(rows, rows);
  const SystemMotion& motion = f.motion();
  const auto form_of = [&](std::size_t i) { return Eigen::seqN(begin[i], 6 + bodies[i].modes()); };
  for (std::size_t i = 0; i < bodies.size(); ++i)
    axis.others(form_of(i), form_of(i)) =
        motion_form(*bodies[i].data, motion.bodies[i].R_WB, Vec3::Zero(), rotor.length);
  Eigen::Index at = 0;
  for (const RotorBody& r : rotor.bodies) {
    const std::size_t i = static_cast<std::size_t>(r.body);
    const FlexibleBody& body = *bodies[i].data;
    const Mat3 R = motion.bodies[i].R_WB * rotation_exp(-s.angle * r.axis);
    axis.others(form_of(i), form_of(i)).setZero();
    axis.rotor(form_of(i), form_of(i)) = motion_form(body, R, r.p_BP, rotor.length);
    axis.mass += body.invariants.m;
    axis.spin += axial_inertia(body.invariants, r) / (rotor.length * rotor.length);
    const Vec3 e = (R * r.axis).normalized() * (s.speed < 0.0 ? -1.0 : 1.0);
    const Vec3 e1 = e.unitOrthogonal(), e2 = e.cross(e1);
    const int nm = body.modes();
    MatX u = MatX::Zero(3, 6 + nm), turn = u;  // of a point; its rotation times the length
    turn.middleCols(3, 3).setIdentity();
    const auto add = [&] {
      const auto columns = Eigen::seqN(begin[i], u.cols());
      axis.across_1(at, columns) = e1.transpose() * u;
      axis.across_2(at, columns) = e2.transpose() * u;
      axis.along(at, columns) = e.transpose() * u;
      axis.twist(at, columns) = e.transpose() * turn;
      ++at;
    };
    u.leftCols(3).setIdentity();
    add();
    u.setZero();
    u.middleCols(3, 3) = -skew(e);  // of the tip of the axis, a length away
    add();
    for (const int k : r.on_axis) {
      const ModalNode& n = body.nodes[static_cast<std::size_t>(k)];
      u.leftCols(3).setIdentity();
      u.middleCols(3, 3) = -skew(R * (n.p - r.p_BP)) / rotor.length;
      u.rightCols(nm) = R * n.X;
      turn.rightCols(nm) = rotor.length * (R * n.X_theta);
      add();
    }
  }
  return axis;
}

}  // namespace floatframe
