#pragma once
// Stress at the points of a picture at an instant, from what the body knows of it (BodyStress):
//   stress = modes y + loads c,   c of the motion of the body (body_stress.hpp), as gauges see it.
// A point may have several places - top and bottom of a shell, two materials, outer points of a
// section: it shows the one with the largest von Mises stress at this instant.
#include "floatframe/body/body_stress.hpp"
#include "floatframe/export/body_picture.hpp"

namespace floatframe {

/// c, 12 + nm.
VecX stress_loads(const OutputView& view, int body);

/// xx yy zz xy yz zx in world axes. R: R_WB.
Vec6 turned_stress(const Mat3& R, const Vec6& stress) noexcept;

class StressField {
 public:
  /// Nothing is known if the body does not know its stress, or only section forces.
  StressField() = default;
  StressField(const BodyPicture& picture, const FlexibleBody& body);

  bool known() const noexcept { return stress_ != nullptr; }
  const BodyStress& stress() const noexcept { return *stress_; }
  /// All places, 6 after the other, body axes [Pa].
  const VecX& at(const VecX& y, const VecX& c);

  struct Shown {
    Vec6 stress;
    double von_mises = 0.0;
    const StressPlace* place = nullptr;
  };
  /// Of a point of the picture after `at`; false: not known there.
  bool shown(Eigen::Index point, Shown& out) const noexcept;

 private:
  void add_places(const BodyPicture& picture);

  const BodyStress* stress_ = nullptr;
  std::vector<int> first_, places_;  ///< of point k: places_[first_[k]] to places_[first_[k + 1]]
  VecX values_;
};

}  // namespace floatframe
