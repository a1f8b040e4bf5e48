#include "floatframe/model/rolling_tyre.hpp"

#include <fmt/format.h>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/rolling_tyre_kind.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {

namespace {

using Mat2 = Eigen::Matrix2d;

/// -d(F_x, F_y)/d(V_sx, V_sy) with the states following.
Mat2 damping_in_road(const Ports& in, const RollingForces<DualNumber<4>, double>& f) noexcept {
  Mat2 F_V, F_z, z_V, z_z;
  for (int j = 0; j < 2; ++j) {
    F_z.col(j) << f.of.F_x.d[j], f.of.F_y.d[j];
    F_V.col(j) << f.of.F_x.d[2 + j], f.of.F_y.d[2 + j];
    z_z.col(j) << f.u_rate.d[j], f.v_rate.d[j];
    z_V.col(j) << f.u_rate.d[2 + j], f.v_rate.d[2 + j];
  }
  const double w = in.state_weight;
  if (in.element.states == 0 || in.rest_slopes || !std::isfinite(w)) return -F_V;
  const Mat2 A = w * Mat2::Identity() - z_z;
  if (!(std::abs(A.determinant()) > 0.0)) return -F_V;
  return -F_V - F_z * A.inverse() * z_V;
}

}  // namespace

void add_rolling_rows(const Ports& in, const RollingContact<double>& c, double stiffness,
                      double damping, bool spinning,
                      const RollingForces<DualNumber<4>, double>& slopes, Efforts& out) noexcept {
  const double upright = c.e_z.dot(c.n);
  const auto row = [&](const Vec3& along, double k, double d) noexcept {
    *out.add_row(k, d) = {along, c.arm.cross(along)};
  };
  row(c.n, stiffness / upright, damping / upright);
  const Mat2 D = damping_in_road(in, slopes);
  const double *rest = in.element.states > 0 ? in.rest_slopes : nullptr,
               k_x = rest ? rest[0] * slopes.of.F_x.d[0] : 0.0,
               k_y = rest ? rest[1] * slopes.of.F_y.d[1] : 0.0;
  if (spinning) row(c.e_x, std::max(0.0, k_x), std::max(0.0, D(0, 0)));
  row(c.e_y, std::max(0.0, k_y), std::max(0.0, D(1, 1)));
}

std::string complaint_of_rolling_tyre(const Ports& in) {
  const Vec3 centre = in.marker(0).r + in.origin;
  const Road& road = in.model.roads[in.element.road];
  if (!std::isnan(surface_at(road, centre.x(), centre.y()).z)) return {};
  return fmt::format(
      "its wheel is at x = {:.4g} m, y = {:.4g} m, where the road '{}' does not lead", centre.x(),
      centre.y(), road.name);
}

void validate_rolling_tyre(const ElementCheck& check) {
  if (check.wrong.contains("contact") ||
      check.word("contact") == static_cast<int>(TyreContact::patch))
    return;
  for (const char* key : {"patch_length", "patch_width"})
    if (check.good(key))
      check.error(ErrorCode::incomplete, key, sentences::is_for("tyres with 'contact: patch'"));
}

bool build_rolling_tyre(ElementBuild& build, RollingTyre& keys) {
  keys.axis = keys.axis.stableNormalized();
  build.element.road = build.road("road");
  return build.connect("body", true);
}

void mirror_rolling_tyre(RollingTyre& keys, const Placement& x) {
  if (x.det() > 0.0) return;
  keys.side = keys.side == TyreSide::left ? TyreSide::right : TyreSide::left;
}

/// The model does not give the width; this one is typical of a car's wheel.
Picture picture_of_rolling_tyre(const Element& element, const RollingTyre& keys, double radius) {
  return {.symbol = Picture::Symbol::wheel,
          .a = element.markers[0],
          .axis = keys.axis,
          .axis_of = element.markers[0],
          .radius = radius,
          .width = 0.4 * radius};
}

double angle_of_wheel(const Ports& in, const RollingTyre& keys,
                      const RollingContact<double>& c) noexcept {
  Vec3 first, second;
  orthonormal_complement(keys.axis, first, second);
  const Vec3 spoke = in.marker(0).R * first;
  return std::atan2(spoke.dot(c.e_x), spoke.dot(c.e_z));
}

double on_either_side(ExampleNumbers& numbers, double least, double most) {
  const double x = numbers(-1.0, 1.0);
  return std::copysign(least + std::abs(x) * (most - least), x);
}

MarkerState rolling_example_wheel(RollingRegime regime, double radius, double depth,
                                  ExampleNumbers& numbers, ElementExample& x, RollingTyre& keys) {
  using R = RollingRegime;
  const bool sloping = regime == R::on_slope || regime == R::on_bump || regime == R::cambered;
  Road road;
  if (sloping)
    road.pieces = PiecewisePolynomial::polynomial({numbers(-1.0, 1.0), numbers(-0.3, 0.3)});
  if (regime == R::on_bump || regime == R::patch)
    road.bumps.push_back({-3.0, 6.0, numbers(0.2, 0.6)});
  x.model.roads.push_back(road);
  keys.contact = regime == R::patch ? TyreContact::patch : TyreContact::point;
  keys.spinning = regime != R::carried;
  keys.side = regime == R::other_side ? TyreSide::right : TyreSide::left;
  keys.relaxation = regime != R::direct;
  keys.axis = Vec3::UnitY();
  x.origin = numbers.vector(1.0);
  MarkerState b = numbers.marker();
  const Vec3 place = b.r + x.origin;
  const SurfacePoint below = surface_at(road, place.x(), place.y());
  const Vec3 normal = Vec3(-below.zx, -below.zy, 1.0).normalized();
  const double camber =
      regime == R::cambered ? numbers(0.1, 0.4) : on_either_side(numbers, 0.01, 0.03);
  Mat3 frame = rotation_exp(std::atan2(normal.x(), normal.z()) * Vec3::UnitY()) *
               rotation_exp(numbers(-0.7, 0.7) * Vec3::UnitZ()) *
               rotation_exp(camber * Vec3::UnitX());
  if (regime == R::lying) frame = rotation_exp(0.5 * std::numbers::pi * Vec3::UnitX());
  b.R = frame * rotation_exp(numbers(-3.0, 3.0) * Vec3::UnitY());
  const double gap = regime == R::airborne ? 0.1 * radius : -depth;
  b.r.z() = below.z + (radius + gap) * std::cos(camber) / normal.z() - x.origin.z();
  const double speed = regime == R::rests
                           ? numbers(0.1, 0.4)
                           : (regime == R::backwards ? -1.0 : 1.0) * numbers(1.0, 3.0);
  const double slip =
      regime == R::slides ? numbers(0.5, 0.8) : on_either_side(numbers, 0.005, 0.05);
  const double drift =
      regime == R::slides ? numbers(0.5, 0.8) : on_either_side(numbers, 0.005, 0.05);
  b.v = speed * (frame.col(0) + drift * frame.col(1)) + numbers(-0.05, 0.05) * normal;
  b.w = (speed / radius) * (1.0 - slip) * frame.col(1) + numbers.vector(0.05);
  return b;
}

}  // namespace floatframe
