// Outputs access one of the two formulations: a branch and a direct call.
#include "floatframe/model/output_view.hpp"

#include "floatframe/formulation/absolute.hpp"

namespace floatframe {

OutputView::OutputView(const RelativeFormulation& formulation, double t, const VecX& q,
                       const Reactions* reactions) noexcept
    : relative_(&formulation),
      model_(formulation.model()),
      q_(q),
      reactions_(reactions),
      t_(t),
      origin_(formulation.origin()) {}

OutputView::OutputView(const AbsoluteFormulation& formulation, double t, const VecX& q,
                       const Reactions* reactions) noexcept
    : absolute_(&formulation),
      model_(formulation.model()),
      q_(q),
      reactions_(reactions),
      t_(t),
      origin_(formulation.origin()) {}

template <class Get>
decltype(auto) OutputView::from(Get get) const noexcept {
  return relative_ ? get(*relative_) : get(*absolute_);
}

const MarkerState& OutputView::marker(int marker) const noexcept {
  return from([&](const auto& f) -> const MarkerState& { return f.marker(marker); });
}

Vec3 OutputView::acceleration(int marker) const noexcept {
  return from([&](const auto& f) -> Vec3 { return f.marker_acceleration(marker); });
}

Vec3 OutputView::body_position(int body) const noexcept {
  return from([&](const auto& f) -> Vec3 { return f.body_position(body); });
}

Vec3 OutputView::body_velocity(int body) const noexcept {
  return from([&](const auto& f) -> Vec3 { return f.body_velocity(body); });
}

Vec3 OutputView::body_acceleration(int body) const noexcept {
  return from([&](const auto& f) -> Vec3 { return f.body_acceleration(body).linear; });
}

const Mat3& OutputView::body_rotation(int body) const noexcept {
  return from([&](const auto& f) -> const Mat3& { return f.body_rotation(body); });
}

Vec3 OutputView::body_angular_velocity(int body) const noexcept {
  return from([&](const auto& f) -> Vec3 { return f.body_angular_velocity(body); });
}

Vec3 OutputView::body_angular_acceleration(int body) const noexcept {
  return from([&](const auto& f) -> Vec3 { return f.body_acceleration(body).angular; });
}

double OutputView::amplitude_rate(int body, int mode) const noexcept {
  return from([&](const auto& f) -> double { return f.amplitude_rate(body, mode); });
}

double OutputView::amplitude_acceleration(int body, int mode) const noexcept {
  return from([&](const auto& f) -> double { return f.amplitude_acceleration(body, mode); });
}

double OutputView::kinetic_energy(int body) const noexcept {
  return from([&](const auto& f) -> double { return f.body_kinetic_energy(body); });
}

double OutputView::gravity_energy(int body) const noexcept {
  return from([&](const auto& f) -> double { return f.body_gravity_energy(body); });
}

double OutputView::elastic_energy(int body) const noexcept {
  return from([&](const auto& f) -> double { return f.body_elastic_energy(body); });
}

double OutputView::amplitude(int body, int mode) const noexcept {
  return from([&](const auto& f) -> double { return f.amplitude(q_, body, mode); });
}

const ForceState& OutputView::force(int force) const noexcept {
  return from([&](const auto& f) -> const ForceState& { return f.force(force); });
}

}  // namespace floatframe
