// Residual and constraints: accelerations root to leaves, body terms, wrenches leaves to root.
#include <cassert>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/small_products.hpp"

namespace floatframe {

void RelativeFormulation::positions(double t, const VecX& q) noexcept {
  time_ = t;
  assert(std::isfinite(t));
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::positions));
  tree_.positions(q);
  for (TreeAngle& a : tree_angles_) a.value = a.sign * q[a.iq];
}

void RelativeFormulation::velocities(const VecX& v) noexcept {
  assert(calls_.has(CallOrder::positions));
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::velocities));
  tree_.velocities(v);
  set_tree_angles();
  element_set_.count_held_turns();
  constraint_set_.evaluate(
      time_, [&](int marker) -> const MarkerState& { return tree_.marker(marker).s; });
}

void RelativeFormulation::dynamics() noexcept {
  assert(calls_.has(CallOrder::velocities));
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::dynamics));
  for (const int i : tree_.order()) {
    const TreeBody& b = tree_.body(i);
    BodyTerms& t = terms_[i];
    t.inertia.relative(b.p_OB, b.R_WB, b.w_WB, b.y.data(), b.yd.data(), t.M, t.Qv);
  }
  forces();
}

void RelativeFormulation::forces() noexcept {
  assert(calls_.has(CallOrder::velocities));
  set_tree_angles();
  element_set_.evaluate(tree_.origin(), time_);
}

Ports RelativeFormulation::ports(std::size_t element) const noexcept {
  assert(calls_.has(CallOrder::velocities) && element < model_.elements.size());
  return element_set_.ports(element, tree_.origin(), time_);
}

void RelativeFormulation::find_wrenches(const VecX& a, const VecX& w) noexcept {
  FLOATFRAME_DEBUG(calls_.accelerate());
  tree_.accelerations(a);
  for (const int i : tree_.order()) {  // (1)
    const TreeBody& b = tree_.body(i);
    const BodyTerms& t = terms_[i];
    VecX& h = wrenches_[i];
    assert(h.size() == 6 + b.nm && t.M.cols() == 6 + b.nm);
    const Vec6 zdot = b.Zdot + b.Zdot_0;
    const int n = 6 + b.nm;
    h = -t.Qv;
    add_product(t.M.data(), n, 6, zdot.data(), h.data());
    if (b.nm == 0) continue;
    add_product(t.M.data() + 6 * n, n, b.nm, b.ydd.data(), h.data());
    const FlexibleBody& data = *model_.bodies[i].data;
    add_product(data.K.data(), b.nm, b.nm, b.y.data(), h.data() + 6);
    if (t.damped) add_product(data.D.data(), b.nm, b.nm, b.yd.data(), h.data() + 6);
  }
  const auto add = [&](int marker, const Vec3& force, const Vec3& torque) {
    tree_.add_wrench(marker, force, torque, wrenches_);
  };
  element_set_.add_wrenches(add);
  constraint_set_.add_wrenches(w, add);
}

void RelativeFormulation::residual(const VecX& a, const VecX& lambda, double alpha,
                                   VecX& out) noexcept {
  assert(calls_.has(CallOrder::dynamics) && alpha >= 0.0 && lambda.size() == constraints());
  FLOATFRAME_DEBUG(calls_.reach(CallOrder::residual));
  constraint_set_.set_multipliers(lambda, alpha);
  find_wrenches(a, constraint_set_.weights());
  tree_.project(wrenches_, out);
}

/// Of joints that are cut by their multipliers, of others by what is further out in the tree.
void RelativeFormulation::find_loads(const VecX& a, const VecX& lambda, VecX& out) noexcept {
  assert(calls_.has(CallOrder::dynamics) && lambda.size() == constraints());
  assert(out.size() == load_count());
  find_wrenches(a, lambda);
  tree_.project(wrenches_, projected_);
  for (int i = 0; i < load_count(); ++i) {
    Wrench w = load_readers_.wrench(i, constraint_set_, lambda);
    const int joint = load_readers_.joint(i), body = tree_.body_of_joint(joint);
    if (body >= 0) {
      const Wrench of_tree = tree_wrench(joint, tree_.body(body));
      w.F += of_tree.F;
      w.T += of_tree.T;
    }
    out[i] = load_readers_.load(
        i, w, [&](int marker) -> const MarkerState& { return tree_.marker(marker).s; });
  }
}

Wrench RelativeFormulation::tree_wrench(int joint, const TreeBody& child) const noexcept {
  const Vec6 h = wrenches_[tree_.body_of_joint(joint)].head<6>();
  const double sign = child.reversed ? -1.0 : 1.0;
  const Vec3& r = tree_.marker(model_.joints[joint].frame_M).s.r;
  return {sign * h.head<3>(), sign * (h.tail<3>() - r.cross(h.head<3>()))};
}

void RelativeFormulation::constraint_forces(const VecX& w, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities) && w.size() == constraints());
  for (VecX& h : wrenches_) h.setZero();
  constraint_set_.add_wrenches(w, [&](int marker, const Vec3& force, const Vec3& torque) {
    tree_.add_wrench(marker, force, torque, wrenches_);
  });
  tree_.project(wrenches_, out);
}

void RelativeFormulation::add_wrenches(const std::vector<int>& markers,
                                       const std::vector<Wrench>& wrenches, VecX& out) noexcept {
  assert(calls_.has(CallOrder::positions) && markers.size() == wrenches.size());
  for (VecX& h : wrenches_) h.setZero();
  for (std::size_t i = 0; i < markers.size(); ++i)
    tree_.add_wrench(markers[i], wrenches[i].F, wrenches[i].T, wrenches_);
  tree_.project(wrenches_, projected_);
  out += projected_;
}

void RelativeFormulation::constraint_rates(VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities) && out.size() == constraints());
  FLOATFRAME_DEBUG(poison(out));
  constraint_set_.rates([&](int marker) -> const MarkerState& { return tree_.marker(marker).s; },
                        out);
}

void RelativeFormulation::constraint_increments(const VecX& delta, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities) && out.size() == constraints());
  FLOATFRAME_DEBUG(poison(out));
  tree_.spread(delta, increments_);
  constraint_set_.increments([&](int marker) { return tree_.increment_of(marker, increments_); },
                             out);
}

void RelativeFormulation::constraint_accelerations(const VecX& a, VecX& out) noexcept {
  assert(calls_.has(CallOrder::velocities) && out.size() == constraints());
  FLOATFRAME_DEBUG(calls_.accelerate());
  FLOATFRAME_DEBUG(poison(out));
  tree_.accelerations(a);
  constraint_set_.accelerations([&](int marker) { return tree_.acceleration_of(marker); }, out);
}

}  // namespace floatframe
