// Residual and constraints of the absolute formulation.
#include "floatframe/formulation/absolute.hpp"

namespace floatframe {

void AbsoluteFormulation::positions(double t, const VecX& q) noexcept {
  time_ = t;
  kinematics_.positions(q);
}

void AbsoluteFormulation::velocities(const VecX& v) noexcept {
  kinematics_.velocities(v, constraint_set_.values());
  constraint_set_.evaluate(time_, [&](int marker) -> const MarkerState& {
    return kinematics_.constraint_state(marker);
  });
}

void AbsoluteFormulation::dynamics() noexcept {
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const AbsoluteBody& b = kinematics_.bodies()[i];
    BodyTerms& t = terms_[i];
    t.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), t.M, t.Qv);
  }
  forces();
}

void AbsoluteFormulation::forces() noexcept {
  force_set_.evaluate(Vec3::Zero(), time_, [&](int marker) -> const MarkerState& {
    return kinematics_.markers()[marker].s;
  });
}

ForceSide AbsoluteFormulation::force_side(std::size_t force) const noexcept {
  return force_set_.side(force, Vec3::Zero(), time_, [&](int marker) -> const MarkerState& {
    return kinematics_.markers()[marker].s;
  });
}

void AbsoluteFormulation::add_constraint_forces(const VecX& w, VecX& out) const noexcept {
  for (const AbsoluteBody& b : kinematics_.bodies()) kinematics_.add_own_forces(b, w, out);
  constraint_set_.add_wrenches(w, [&](int marker, const Vec3& force, const Vec3& torque) {
    kinematics_.add_wrench(marker, true, force, torque, out);
  });
}

void AbsoluteFormulation::constraint_forces(const VecX& w, VecX& out) noexcept {
  out.setZero();
  add_constraint_forces(w, out);
}

void AbsoluteFormulation::residual(const VecX& a, const VecX& lambda, double alpha,
                                   VecX& out) noexcept {
  kinematics_.accelerations(a);
  constraint_set_.set_multipliers(lambda, alpha);
  out.setZero();
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const AbsoluteBody& b = kinematics_.bodies()[i];
    auto lifted = work_.segment(b.offset, 12 + b.nm);
    lifted = a.segment(b.offset, 12 + b.nm);
    lifted.head<3>() -= model_.gravity;
    auto f = out.segment(b.offset, 12 + b.nm);
    f.noalias() += terms_[i].M * lifted;
    f -= terms_[i].Qv;
    if (b.nm > 0) {
      const FlexibleBody& data = *model_.bodies[i].data;
      out.segment(b.offset + 12, b.nm).noalias() += data.K * b.y;
      out.segment(b.offset + 12, b.nm).noalias() += data.D * b.yd;
    }
  }
  force_set_.add_wrenches([&](int marker, const Vec3& force, const Vec3& torque) {
    kinematics_.add_wrench(marker, false, force, torque, out);
  });
  add_constraint_forces(constraint_set_.weights(), out);
}

void AbsoluteFormulation::constraint_rates(VecX& out) noexcept {
  kinematics_.own_rates(out);
  constraint_set_.rates(
      [&](int marker) -> const MarkerState& { return kinematics_.constraint_state(marker); }, out);
}

void AbsoluteFormulation::constraint_increments(const VecX& delta, VecX& out) noexcept {
  kinematics_.own_increments(delta, out);
  constraint_set_.increments([&](int marker) { return kinematics_.increment_of(marker, delta); },
                             out);
}

void AbsoluteFormulation::constraint_accelerations(const VecX& a, VecX& out) noexcept {
  kinematics_.accelerations(a);
  kinematics_.own_accelerations(out);
  constraint_set_.accelerations([&](int marker) { return kinematics_.acceleration_of(marker); },
                                out);
}

}  // namespace floatframe
