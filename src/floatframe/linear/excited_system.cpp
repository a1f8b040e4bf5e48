#include "floatframe/linear/excited_system.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/model/element_outputs.hpp"

namespace floatframe {
namespace {

/// A law that has this value, rate and second derivative at t.
TimeFunction parabola(double t, const Vec3& at) {
  TimeFunction f;
  f.pieces = PiecewisePolynomial({}, {{t, {at[0], at[1], 0.5 * at[2]}}});
  return f;
}

/// With these outputs, and roads that can be lifted under each wheel.
Model with_lifts(const Model& model, std::vector<Output> outputs) {
  Model copy = model;
  copy.outputs = std::move(outputs);
  for (Element& e : copy.elements)
    if (*lifted_by(e.type)) lift(e, TimeFunction());
  return copy;
}

}  // namespace

ExcitedSystem::ExcitedSystem(InitialisedModel& started, std::vector<Output> outputs, double step)
    : parts_(std::move(outputs)),
      model_(with_lifts(started.model(), parts_.parts())),
      own_(make_formulation(started.formulation().coordinates(), model_, started.inertia())),
      f_(*own_),
      state_(started.state()),
      original_(started.model()),
      followed_(followed_outputs(model_.outputs)) {
  f_.set_spring_angles(started.formulation().spring_angles());
  const std::span<const double> values = started.formulation().inputs();
  inputs_.assign(values.begin(), values.end());
  f_.set_inputs(inputs_);
  if (needs_of_outputs(model_).reactions)
    reactions_.emplace(f_.coordinates(), model_, started.inertia(), state_,
                       ReactionOptions{started.step_options().penalty_mass, step,
                                       !started.report().redundant.empty()});
  const VecX still = VecX::Zero(unknowns());
  if (state_.a.size() != f_.velocities()) state_.a = VecX::Zero(f_.velocities());
  this->outputs(still, still, still);  // angles over several turns are continued from here
}

const std::vector<std::string>& ExcitedSystem::open_outputs() const noexcept {
  static const std::vector<std::string> none;
  return reactions_ ? reactions_->open_outputs() : none;
}

double ExcitedSystem::value(const LinearInput& input) const {
  const auto k = static_cast<std::size_t>(input.index);
  switch (input.kind) {
    case LinearInput::Kind::signal:
      return inputs_[k];
    case LinearInput::Kind::motion:
      return evaluate(original_.elements[k].signals[0].function, state_.t).f;
    default:
      return 0.0;
  }
}

void ExcitedSystem::move(const LinearInput& input, const Vec3& by) {
  const auto k = static_cast<std::size_t>(input.index);
  if (input.kind == LinearInput::Kind::signal) {
    change_inputs(by[0] * VecX::Unit(std::ssize(inputs_), k));
  } else if (input.kind == LinearInput::Kind::motion) {
    const PiecewisePolynomial::Value v =
        evaluate(original_.elements[k].signals[0].function, state_.t);
    // In place: constraints have pointers to the law.
    model_.elements[k].signals[0].function = parabola(state_.t, Vec3(v.f, v.df, v.ddf) + by);
  } else {
    for (const int wheel : input.wheels)
      lift(model_.elements[static_cast<std::size_t>(wheel)], parabola(state_.t, by));
  }
}

void ExcitedSystem::change_inputs(const VecX& by) {
  f_.change_inputs(by);
  if (reactions_) reactions_->formulation().change_inputs(by);
}

VecX ExcitedSystem::balance() {
  const Eigen::Index nc = f_.constraints(), n = unknowns();
  VecX all(n + 3 * nc), r(f_.velocities()), rows(nc);
  dynamics_at(f_, state_);
  f_.residual(state_.a, state_.lambda, 0.0, r);
  all.head(n) << r, state_residuals(f_);
  all.segment(n, nc) = f_.constraint_values();
  f_.constraint_rates(rows);
  all.segment(n + nc, nc) = rows;
  f_.constraint_accelerations(state_.a, rows);
  all.tail(nc) = rows;
  return all;
}

double ExcitedSystem::step_of(const LinearInput& input) {
  if (input.kind == LinearInput::Kind::road) return 1e-4;
  if (input.kind == LinearInput::Kind::motion) return 1e-3;  // constraints are linear in it
  const double first = 1e-3 * std::max(1.0, std::abs(value(input)));
  const VecX before = balance();
  move(input, {first, 0.0, 0.0});
  const double change = (balance() - before).head(f_.velocities()).cwiseAbs().maxCoeff();
  move(input, Vec3::Zero());
  double largest = model_.mean_mass;
  for (int k = 0; k < std::ssize(model_.elements); ++k)
    largest = std::max(largest, std::abs(f_.effort(k).force));
  const double wanted = 1e-3 * largest;
  return change > 0.0 ? first * std::clamp(wanted / change, 1e-6, 1e6) : first;
}

void ExcitedSystem::derivatives(const LinearInput& input, double step, Eigen::Index column,
                                InputMotions& out) {
  const Eigen::Index n = unknowns(), nc = f_.constraints();
  for (int k = 0; k <= input.order(); ++k) {
    const VecX size = VecX::Constant(1, step * std::pow(10.0, k));
    const VecX d = precise_differences(size, 0, [&](const VecX& h) {
                     move(input, h[0] * Vec3::Unit(k));
                     return balance();
                   }).columns;
    out.residual[k].col(column) = d.head(n);
    if (k == 0) out.value.col(column) = d.segment(n, nc);
    out.rate[k].col(column) = d.segment(n + nc, nc);
    out.acceleration[k].col(column) = d.tail(nc);
  }
  move(input, Vec3::Zero());
}

VecX ExcitedSystem::outputs(const VecX& x, const VecX& dv, const VecX& da) {
  State s = state_;
  const Eigen::Index nv = f_.velocities();
  f_.retract(state_.q, x.head(nv), s.q);
  s.v = state_.v + dv.head(nv);
  s.a = state_.a + da.head(nv);
  move_states(model_, x.tail(x.size() - nv), s);
  dynamics_at(f_, s);
  if (reactions_) reactions_->solve(s, f_.inputs(), f_.spring_angles());
  f_.set_accelerations(s.a);
  const SystemMotion& motion =
      f_.motion(needs_of_outputs(model_), reactions_ ? &reactions_->reactions() : nullptr);
  VecX y(static_cast<Eigen::Index>(model_.outputs.size()));
  for (std::size_t k = 0; k < model_.outputs.size(); ++k) {
    FollowedOutput& memory = followed_[k];
    if (!memory.started) output_value(motion, model_.outputs[k], memory);
    FollowedOutput last = memory;
    y[static_cast<Eigen::Index>(k)] = output_value(motion, model_.outputs[k], last);
  }
  return y;
}

VecX ExcitedSystem::output_values(const VecX& parts) const {
  return parts_.values(parts, inputs_, state_.t);
}

VecX ExcitedSystem::output_derivatives(const VecX& parts, const VecX& dparts,
                                       const LinearInput* input) const {
  VecX dinputs = VecX::Zero(std::ssize(inputs_));
  if (input && input->kind == LinearInput::Kind::signal) dinputs[input->index] = 1.0;
  return parts_.derivatives(parts, inputs_, state_.t, dparts, dinputs);
}

}  // namespace floatframe
