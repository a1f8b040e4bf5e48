// Wheels, tyres and spin joints of the section `vehicle`: each is of the kind that its role needs,
// acts on its wheel, and points the way that the vehicle does: x forward, y left.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/validate_model.hpp"

namespace floatframe::validation {
namespace {

/// Largest angle of the spin joint from the axis of the tyre: cos(10 deg).
constexpr double least_along = 0.985;

template <class T>
const T& by_name(const std::vector<T>& all, const std::string& name) {
  return *std::ranges::find(all, name, &T::name);
}

/// The bodies that are one with another by welds.
std::set<std::string> one_with(const ModelDescription& d, const std::string& body) {
  std::set<std::string> out{body};
  for (std::size_t before = 0; before != out.size();) {
    before = out.size();
    for (const JointDescription& j : d.joints) {
      if (std::string_view(joint_type_name(j.type)) != "weld") continue;
      if (out.contains(j.parent.body)) out.insert(j.child.body);
      if (out.contains(j.child.body)) out.insert(j.parent.body);
    }
  }
  return out;
}

/// What is known of an element as a tyre.
struct TyreRole {
  bool on_road = false;
  int places = 0;
  std::string body;
  Vec3 axis = Vec3::UnitY();
};

TyreRole tyre_role(const ElementDescription& e) {
  TyreRole out;
  for (const ElementKey& key : element_keys(e.type())) {
    out.on_road = out.on_road || key.kind == KeyKind::road;
    const std::optional<KeyValue> value = key_value(e, key);
    if (!value) continue;
    if (const auto* place = std::get_if<AttachmentDescription>(&*value)) {
      ++out.places;
      out.body = place->body;
    }
    if (key.kind == KeyKind::direction && std::string_view(key.name) == "axis")
      out.axis = std::get<Vec3>(*value).normalized();
  }
  return out;
}

/// Of the spin joint: its type, the body that it turns, and its axis.
void spin_role(const ModelDescription& d, const VehicleWheel& w, const TyreRole& tyre,
               const Entity& wheel) {
  const JointDescription& spin = by_name(d.joints, w.spin);
  const std::string type = joint_type_name(spin.type);
  if (type != "revolute")
    return wheel.error(ErrorCode::wrong_value, "spin",
                       fmt::format("found the {} joint '{}', expected a revolute one, about which "
                                   "the wheel turns",
                                   type, w.spin));
  const std::set<std::string> turned = one_with(d, tyre.body);
  if (turned.contains(spin.child.body) == turned.contains(spin.parent.body))
    return wheel.error(
        ErrorCode::wrong_value, "spin",
        fmt::format("found the joint '{}' between '{}' and '{}', expected the one about which '{}' "
                    "turns, on which the tyre acts",
                    w.spin, spin.parent.body, spin.child.body, tyre.body));
  const double along = std::abs(spin.axis.normalized().dot(tyre.axis));
  if (along < least_along)
    wheel.error(ErrorCode::geometry, "spin",
                fmt::format("found the joint '{}' with an axis {:.3g} deg off that of the tyre, "
                            "expected one along it",
                            w.spin, std::acos(std::min(1.0, along)) * 180.0 / std::numbers::pi));
}

void wheel_roles(const ModelDescription& d, const VehicleWheel& w, const Entity& wheel) {
  const ElementDescription& element = by_name(d.forces, w.tyre);
  const std::string type = element_type_name(element.type());
  const TyreRole tyre = tyre_role(element);
  if (!tyre.on_road && tyre.places != 1)
    return wheel.error(ErrorCode::wrong_value, "tyre",
                       fmt::format("found the {} '{}', expected a tyre on a road, or a force on "
                                   "the wheel that stands for one",
                                   type, w.tyre));
  std::set<std::string> own = one_with(d, w.wheel);
  if (!w.spin.empty()) {
    const JointDescription& spin = by_name(d.joints, w.spin);
    const bool child = own.contains(spin.child.body), parent = own.contains(spin.parent.body);
    if (child != parent) own.merge(one_with(d, child ? spin.parent.body : spin.child.body));
  }
  if (!own.contains(tyre.body))
    return wheel.error(ErrorCode::wrong_value, "tyre",
                       fmt::format("found the {} '{}' on the body '{}', expected one on the wheel "
                                   "'{}' or on what turns on it by the joint `spin`",
                                   type, w.tyre, tyre.body, w.wheel));
  if (element_kind(element.type()).rolls && tyre.axis.y() < 0.0)
    wheel.error(ErrorCode::geometry, "tyre",
                fmt::format("found the {} '{}' with an axis to the right, so that its forwards is "
                            "backwards, expected one to the left, as `axis: y`",
                            type, w.tyre));
  if (!w.spin.empty()) spin_role(d, w, tyre, wheel);
}

/// y of the centre in the design configuration [m].
double side_of_wheel(const ModelDescription& d, const std::string& name) {
  const BodyDescription& body = by_name(d.bodies, name);
  const auto* rigid = std::get_if<RigidDescription>(&body.kind);
  const Vec3 centre =
      rigid != nullptr ? Vec3(body.X_WB.p + body.X_WB.R * rigid->p_BC) : body.X_WB.p;
  return centre.y();
}

}  // namespace

void vehicle_roles(const ModelDescription& d, ErrorList& errors) {
  if (!d.vehicle) return;
  for (const VehicleAxle& a : d.vehicle->axles) {
    const std::string path = "vehicle.axles." + a.name;
    const Entity axle{errors, a.origin, path};
    const double left = side_of_wheel(d, a.left.wheel), right = side_of_wheel(d, a.right.wheel);
    if (left < right)
      axle.error(ErrorCode::geometry, "left",
                 fmt::format("found the wheel '{}' at y = {:.4g} m, to the right of '{}' at y = "
                             "{:.4g} m, expected the left one, with x forward and y to the left",
                             a.left.wheel, left, a.right.wheel, right));
    wheel_roles(d, a.left, {errors, a.left.origin, path + ".left"});
    wheel_roles(d, a.right, {errors, a.right.origin, path + ".right"});
  }
}

}  // namespace floatframe::validation
