#pragma once
// Stress at the points of a picture at an instant, from the stress data of the body (BodyStress):
//  stress = modes y + loads c,   c from the motion of the body (body_stress.hpp), as for gauges.
// A point may have several places - top and bottom of a shell, two materials, outer points of a
// section: it shows the one with the largest von Mises stress at this instant.
#include "floatframe/body/body_stress.hpp"
#include "floatframe/export/body_picture.hpp"

namespace floatframe {

/// c, 12 + nm.
VecX stress_loads(const SystemMotion& motion, int body);

/// xx yy zz xy yz zx in world axes. R: R_WB.
Vec6 turned_stress(const Mat3& R, const Vec6& stress) noexcept;

class StressField {
 public:
  /// Without values if the body has no stress data, or only section forces.
  StressField() = default;
  StressField(const BodyPicture& picture, const FlexibleBody& body);

  bool known() const noexcept { return stress_ != nullptr; }
  const BodyStress& stress() const noexcept { return *stress_; }
  /// All places, 6 values each, body axes [Pa].
  const VecX& at(const VecX& y, const VecX& c);

  struct Shown {
    Vec6 stress;
    double von_mises = 0.0;
    const StressPlace* place = nullptr;
  };
  /// Stress at a point of the picture after `at`; false: unknown there.
  bool shown(Eigen::Index point, Shown& out) const noexcept;

 private:
  void add_places(const BodyPicture& picture);

  const BodyStress* stress_ = nullptr;
  std::vector<int> first_, places_;  ///< of point k: places_[first_[k]] to places_[first_[k + 1]]
  VecX values_;
};

}  // namespace floatframe
