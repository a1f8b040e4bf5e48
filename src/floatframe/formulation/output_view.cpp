// Outputs see one of the two formulations: a branch and a direct call.
#include "floatframe/model/output_view.hpp"

#include "floatframe/formulation/absolute.hpp"

namespace floatframe {

OutputView::OutputView(const RelativeFormulation& formulation, double t, const VecX& q) noexcept
    : relative_(&formulation),
      model_(formulation.model()),
      q_(q),
      t_(t),
      origin_(formulation.origin()) {}

OutputView::OutputView(const AbsoluteFormulation& formulation, double t, const VecX& q) noexcept
    : absolute_(&formulation),
      model_(formulation.model()),
      q_(q),
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

const Mat3& OutputView::body_rotation(int body) const noexcept {
  return from([&](const auto& f) -> const Mat3& { return f.body_rotation(body); });
}

Vec3 OutputView::body_angular_velocity(int body) const noexcept {
  return from([&](const auto& f) -> Vec3 { return f.body_angular_velocity(body); });
}

double OutputView::amplitude(int body, int mode) const noexcept {
  return from([&](const auto& f) -> double { return f.amplitude(q_, body, mode); });
}

const ForceState& OutputView::force(int force) const noexcept {
  return from([&](const auto& f) -> const ForceState& { return f.force(force); });
}

}  // namespace floatframe
