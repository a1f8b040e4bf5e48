#include "floatframe/formulation/formulation.hpp"

#include <algorithm>
#include <cassert>
#include <new>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/math/contracts.hpp"

namespace floatframe {

Formulation::Formulation(const Model& model, const std::vector<int>& constrained_joints)
    : model_(model),
      constraint_set_(model, constrained_joints),
      element_set_(model),
      load_readers_(model, constraint_set_),
      signal_tangent_(model),
      motion_(model) {
  constraint_set_.count_turns_with(element_set_);
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    for (std::size_t i = 0; i < model.elements[k].coordinates.size(); ++i)
      if (const CoordinatePort& c = model.elements[k].coordinates[i]; c.counted)
        motion_.counted.push_back(
            {c.joint, c.component, element_set_.angle(element_set_.slot(k, i))});
  motion_.efforts = element_set_.states().data();
  motion_.inputs = element_set_.inputs();
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    motion_.states.push_back(element_set_.element_states().of(k));
  motion_.bodies.reserve(model.bodies.size());
}

void Formulation::show_body(const Mat3& R_WB, const Vec3& w_WB, const VecX& y, const VecX& yd,
                            const double* ydd) {
  const auto view = [&](const double* data) { return VecX::ConstMapType(data, y.size()); };
  motion_.bodies.push_back({R_WB, w_WB, view(y.data()), view(yd.data()), view(ydd)});
#ifndef NDEBUG
  modal_accelerations_.push_back(ydd);
  not_asked_.resize(std::max(not_asked_.size(), y.size()));
  FLOATFRAME_DEBUG(poison(not_asked_));
#endif
}

#ifndef NDEBUG
void Formulation::view_modal_accelerations(bool asked) const noexcept {
  for (std::size_t i = 0; i < motion_.bodies.size(); ++i) {
    auto& ydd = motion_.bodies[i].ydd;
    new (&ydd) VecX::ConstMapType(asked ? modal_accelerations_[i] : not_asked_.data(), ydd.size());
  }
}
#endif

void Formulation::show_marker(const MarkerState& state, const LocalMarker& local) {
  motion_.markers.push_back(&state);
  local_markers_.push_back(&local);
}

const SystemMotion& Formulation::motion(MotionNeeds needs,
                                        const Reactions* reactions) const noexcept {
  assert(calls_.has(CallOrder::velocities));
  assert(!needs.accelerations || calls_.has_accelerations());
  assert(!needs.energies || calls_.has(CallOrder::dynamics));
  assert(!needs.reactions || reactions);
  FLOATFRAME_DEBUG(motion_.poison_filled());
#ifndef NDEBUG
  view_modal_accelerations(needs.accelerations);
#endif
  motion_.t = time_;
  motion_.reactions = reactions;
  fill_poses(motion_);
  if (needs.accelerations) fill_accelerations(motion_);
  if (!needs.energies) return motion_;
  for (std::size_t i = 0; i < motion_.bodies.size(); ++i) {
    BodyKinematics& b = motion_.bodies[i];
    const int body = static_cast<int>(i);
    b.kinetic_energy = body_kinetic_energy(body);
    b.first_moment = first_moment(body, b);
    b.gravity_energy = -model_.gravity.dot(b.first_moment);
    fill_momenta(body, b);
    b.elastic_energy = elastic_energy(model_.bodies[i], b);
  }
  return motion_;
}

Vec3 Formulation::first_moment(int body, const BodyKinematics& b) const noexcept {
  assert(is_index(body, model_.bodies) && b.y.size() == model_.bodies[body].modes());
  const BodyInertia& terms = inertia(body);
  const Vec3 m_bar = terms.static_moment(b.y.data());
  return terms.data().m * b.p_WB + b.R_WB * m_bar;
}

double Formulation::gravity_energy() const noexcept {
  assert(calls_.has(CallOrder::velocities));
  fill_poses(motion_);
  double sum = 0.0;
  for (std::size_t i = 0; i < motion_.bodies.size(); ++i)
    sum -= model_.gravity.dot(first_moment(static_cast<int>(i), motion_.bodies[i]));
  return sum;
}

CoordinateCounts Formulation::counts() const {
  int elastic = 0;
  for (const Body& b : model_.bodies) elastic += b.modes();
  return {velocities() - elastic, elastic, velocities(), constraints()};
}

std::unique_ptr<Formulation> make_formulation(Coordinates coordinates, const Model& model,
                                              InertiaMethod method) {
  if (coordinates == Coordinates::relative)
    return std::make_unique<RelativeFormulation>(model, method);
  return std::make_unique<AbsoluteFormulation>(model, method);
}

}  // namespace floatframe
