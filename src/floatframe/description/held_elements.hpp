#pragma once
// The structs of elements that hold points, directions and cams.
#include <optional>

#include "floatframe/description/attachment.hpp"
#include "floatframe/description/coupling_elements.hpp"
#include "floatframe/formulas/formula.hpp"

namespace floatframe {

/// Holds a point, a direction or both of the body of `b` along or about an axis that turns with the
/// body of `a`.
struct AxisConstraint {
  AttachmentDescription a, b;
  Vec3 axis = Vec3::UnitZ();
};
/// The point of b stays on the line through the point of a along the axis.
struct InLine : AxisConstraint {};
/// The point of b stays in the plane through the point of a that is normal to the axis.
struct InPlane : AxisConstraint {};
/// The axis, which both bodies carry as drawn, stays parallel in both.
struct Parallel : AxisConstraint {};
/// A direction of a, `axis`, and one of b, `axis_2`, keep a right angle.
struct Perpendicular : AxisConstraint {
  Vec3 axis_2 = Vec3::UnitX();
};
/// Two shafts, of a along `axis` and of b along `axis_2`, turn by the same angle, however they are
/// inclined. Their points coincide, unless the joint slides.
struct ConstantVelocity : AxisConstraint {
  Vec3 axis_2 = Vec3::UnitZ();
  bool slides = false;
};

/// The point of b stays on a curve that is fixed in the body of a: through points or by formulas of
/// `u`, from the point of a along the axes of the world as drawn.
struct PointOnCurve {
  AttachmentDescription a, b;
  MatX points = {};                                     ///< n x 3 [m], a cubic spline; or ...
  std::optional<SharedFormula> x = {}, y = {}, z = {};  ///< ... these [m]; absent: 0
  MatX range = {};                                      ///< 1 x 2: of u in the formulas
  bool closed = false;
};

/// A curve that is fixed in the body of a touches one that is fixed in the body of b, in planes
/// normal to the axis: each as that of a PointOnCurve, the second one from the point of b.
struct CurveOnCurve : AxisConstraint {
  MatX points = {};
  std::optional<SharedFormula> x = {}, y = {}, z = {};
  MatX range = {};
  bool closed = false;
  MatX points_2 = {};
  std::optional<SharedFormula> x_2 = {}, y_2 = {}, z_2 = {};
  MatX range_2 = {};
  bool closed_2 = false;
};

/// The point of b stays on the line through nodes of the body of a, which bends with it, or on a
/// spline that is fixed in a rigid one.
struct SlideAlong {
  AttachmentDescription a, b;
  MatX points = {};  ///< n x 3 [m], from the point of a along the axes of the world as drawn
  std::optional<TimeFunction> motion = {};  ///< the travel from the first point on [m]
};

/// How the rise of a cam goes from its beginning to its end (docs/model-file.md).
enum class CamLaw { harmonic, cycloidal, polynomial_345, polynomial_4567 };
inline constexpr const char* cam_laws[] = {"harmonic", "cycloidal", "polynomial_345",
                                           "polynomial_4567"};

/// The coordinate of a follower is the lift of a cam at x = its coordinate - phase: by one of
/// segments, points and a formula.
struct Cam {
  CoordinateTerm follower, cam;
  MatX segments = {};  ///< n x 2: the x [m] or [rad] that each ends at, from 0 on; its rise
  CamLaw law = CamLaw::cycloidal;             ///< of the segments
  MatX points = {};                           ///< n x 2: x, lift; a cubic spline
  std::optional<SharedFormula> formula = {};  ///< of `x`
  double phase = 0.0;                         ///< [m] or [rad]
};

}  // namespace floatframe
