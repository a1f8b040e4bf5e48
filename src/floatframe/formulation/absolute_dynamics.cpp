// Residual and constraints of the absolute formulation.
#include <cassert>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {

namespace {

const Vec3 world_origin = Vec3::Zero();

}  // namespace

void AbsoluteFormulation::positions(double t, const VecX& q) noexcept {
  assert(std::isfinite(t));
  time_ = t;
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::positions));
  kinematics_.positions(q);
}

void AbsoluteFormulation::velocities(const VecX& v) noexcept {
  assert(calls_.has(CallOrder::positions));
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::velocities));
  FLOATFRAME_DEBUG(poison(constraint_set_.values()));
  kinematics_.velocities(v, constraint_set_.values());
  element_set_.count_held_turns();
  constraint_set_.evaluate(time_, [&](int marker) -> const MarkerState& {
    return kinematics_.constraint_state(marker);
  });
}

void AbsoluteFormulation::dynamics() noexcept {
  assert(calls_.has(CallOrder::velocities));
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::dynamics));
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const AbsoluteBody& b = kinematics_.bodies()[i];
    BodyTerms& t = terms_[i];
    t.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), t.M, t.Qv);
  }
  forces();
}

void AbsoluteFormulation::forces() noexcept {
  assert(calls_.has(CallOrder::velocities));
  element_set_.evaluate(world_origin, time_);
}

Ports AbsoluteFormulation::ports(std::size_t element) const noexcept {
  assert(calls_.has(CallOrder::velocities) && element < model_.elements.size());
  return element_set_.ports(element, world_origin, time_);
}

void AbsoluteFormulation::add_constraint_forces(const VecX& w, VecX& out) const noexcept {
  for (const AbsoluteBody& b : kinematics_.bodies()) kinematics_.add_own_forces(b, w, out);
  constraint_set_.add_wrenches(w, [&](int marker, const Vec3& force, const Vec3& torque) {
    kinematics_.add_wrench(marker, true, force, torque, out);
  });
}

void AbsoluteFormulation::constraint_forces(const VecX& w, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities));
  assert(w.size() == constraints() && out.size() == velocities());
  out.setZero();
  add_constraint_forces(w, out);
}

void AbsoluteFormulation::add_wrenches(const std::vector<int>& markers,
                                       const std::vector<Wrench>& wrenches, VecX& out) noexcept {
  assert(calls_.has(CallOrder::positions) && markers.size() == wrenches.size());
  for (std::size_t i = 0; i < markers.size(); ++i)
    kinematics_.add_wrench(markers[i], false, wrenches[i].F, wrenches[i].T, out);
}

void AbsoluteFormulation::residual(const VecX& a, const VecX& lambda, double alpha,
                                   VecX& out) noexcept {
  assert(calls_.has(CallOrder::dynamics) && alpha >= 0.0);
  assert(lambda.size() == constraints() && out.size() == velocities());
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::residual));
  FLOATFRAME_DEBUG(calls_.accelerate());
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
  element_set_.add_wrenches([&](int marker, const Vec3& force, const Vec3& torque) {
    kinematics_.add_wrench(marker, false, force, torque, out);
  });
  add_constraint_forces(constraint_set_.weights(), out);
}

void AbsoluteFormulation::find_loads(const VecX&, const VecX& lambda, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities));
  assert(lambda.size() == constraints() && out.size() == load_count());
  for (int i = 0; i < load_count(); ++i)
    out[i] = load_readers_.load(i, load_readers_.wrench(i, constraint_set_, lambda),
                                [&](int k) -> const MarkerState& { return marker(k); });
}

void AbsoluteFormulation::constraint_rates(VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities) && out.size() == constraints());
  FLOATFRAME_DEBUG(poison(out));
  kinematics_.own_rates(out);
  constraint_set_.rates(
      [&](int marker) -> const MarkerState& { return kinematics_.constraint_state(marker); }, out);
}

void AbsoluteFormulation::constraint_increments(const VecX& delta, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities));
  assert(delta.size() == velocities() && out.size() == constraints());
  FLOATFRAME_DEBUG(poison(out));
  kinematics_.own_increments(delta, out);
  constraint_set_.increments([&](int marker) { return kinematics_.increment_of(marker, delta); },
                             out);
}

void AbsoluteFormulation::constraint_accelerations(const VecX& a, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities) && out.size() == constraints());
  FLOATFRAME_DEBUG(calls_.accelerate());
  FLOATFRAME_DEBUG(poison(out));
  kinematics_.accelerations(a);
  kinematics_.own_accelerations(out);
  constraint_set_.accelerations([&](int marker) { return kinematics_.acceleration_of(marker); },
                                out);
}

}  // namespace floatframe
