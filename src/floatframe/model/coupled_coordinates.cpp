#include "floatframe/model/coupled_coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "floatframe/model/element_data.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {

namespace {

bool is_coupled(JointType type, int component, ElementAxis what) {
  const auto axis = coordinate_axis(type, Vec3::UnitX(), component);
  if (!axis) return false;
  return what == ElementAxis::coordinate || axis->turns == (what == ElementAxis::about);
}

int coupled_count(JointType type, ElementAxis what) {
  int count = 0;
  for (int k = 0; k < joint_velocities(type); ++k) count += is_coupled(type, k, what);
  return count;
}

/// What is wrong with the coordinate that a key names.
std::string coordinate_complaint(const std::string& joint, JointType type, int given,
                                 ElementAxis what) {
  if (coupled_count(type, what) == 0)
    return fmt::format("found {}, a {} joint, expected a {} joint", joint, joint_type_name(type),
                       coupled_joints(what));
  if (given < 0 || given >= joint_velocities(type))
    return fmt::format("found no coordinate of {}, expected {}", joint, coordinate_names(type));
  return fmt::format("found the {} of {}, expected {}", joint_coordinate_name(type, given), joint,
                     what == ElementAxis::about ? "an angle" : "a displacement");
}

}  // namespace

int coupled_component(JointType type, int given, ElementAxis what) {
  int found = -1, count = 0;
  for (int k = 0; k < joint_velocities(type); ++k) {
    if (!is_coupled(type, k, what) || (given >= 0 && k != given)) continue;
    found = k;
    ++count;
  }
  return count == 1 ? found : -1;
}

std::string coupled_joints(ElementAxis what) {
  std::vector<const char*> words;
  for (const JointType type : joint_types)
    if (coupled_count(type, what) > 0) words.push_back(joint_type_name(type));
  return alternatives(words);
}

std::string coordinate_names(JointType type) {
  std::vector<const char*> words;
  for (int k = 0; k < joint_velocities(type); ++k) words.push_back(joint_coordinate_name(type, k));
  return alternatives(words);
}

bool validate_coordinates(const ElementCheck& check) {
  bool good = true;
  std::set<std::pair<std::string, int>> taken;
  for (const ElementKey& key : element_keys(check.description().type())) {
    if (key.kind != KeyKind::coordinate || !check.has(key.name)) continue;
    const CoordinateTerm term = check.coordinate(key.name);
    const auto type = check.wrong.contains(key.name) ? std::nullopt : check.joint_type(term.joint);
    good = good && type;
    if (!type) continue;
    const std::string joint = "joint '" + check.written(term.joint) + "'";
    const int k = coupled_component(*type, term.coordinate, key.axis);
    if (k < 0) {
      check.error(
          coupled_count(*type, key.axis) == 0 ? ErrorCode::wrong_value : ErrorCode::incomplete,
          key.name, coordinate_complaint(joint, *type, term.coordinate, key.axis));
    } else if (!taken.insert({term.joint, k}).second) {
      check.error(ErrorCode::duplicate, key.name,
                  fmt::format("found the {} of {} twice, expected another",
                              joint_coordinate_name(*type, k), joint));
    } else {
      continue;
    }
    good = false;
  }
  return good;
}

void validate_teeth(const ElementCheck& check) {
  const MatX teeth = check.matrix("teeth");
  if (check.wrong.contains("teeth")) return;
  for (Eigen::Index i = 0; i < teeth.size(); ++i)
    if (teeth(i) != std::floor(teeth(i)))
      check.error(ErrorCode::out_of_range, "teeth",
                  fmt::format("found {} teeth, expected a whole number", number_text(teeth(i))));
}

void validate_ratio(const ElementCheck& check) {
  if (check.wrong.contains("ratio") || check.wrong.contains("teeth")) return;
  const bool ratio = check.has("ratio"), teeth = check.matrix("teeth").size() > 0;
  if (ratio && teeth)
    check.error(ErrorCode::exclusive, "ratio", "excludes 'teeth'; remove one of them");
  else if (!ratio && !teeth)
    check.error(ErrorCode::missing, "", "missing key 'ratio' or 'teeth'");
  validate_teeth(check);
}

double ratio_of(const ElementView& values) {
  const MatX teeth = values.matrix("teeth");
  return teeth.size() == 2 ? teeth(1) / teeth(0) : values.number("ratio");
}

bool connect_coupled(ElementBuild& build, const char* key) {
  if (!build.has(key)) return true;
  const CoordinateTerm term = build.coordinate(key);
  const Joint* joint = build.joint(term.joint);
  if (!joint) return false;
  const int component = coupled_component(joint->type, term.coordinate, build.key(key).axis);
  return component >= 0 && build.connect_coordinate(term.joint, component);
}

double mirrored_sense(const ElementView& values, const char* key) {
  return values.coordinate(key).factor < 0.0 ? -1.0 : 1.0;
}

std::vector<double> senses_of_axes(ElementBuild& build, double angle) {
  std::vector<double> senses;
  Vec3 first = Vec3::Zero();
  for (const CoordinatePort& c : build.element.coordinates) {
    const Vec3 axis = build.design_axis(c.port);
    if (senses.empty()) first = axis;
    const double along = first.dot(axis),
                 between = std::atan2(first.cross(axis).norm(), std::abs(along));
    if (between > angle) {
      build.error(ErrorCode::geometry,
                  fmt::format("found axes at {:.3g} degrees to each other, expected parallel axes",
                              between * 180.0 / std::numbers::pi));
      return {};
    }
    senses.push_back(along < 0.0 ? -1.0 : 1.0);
  }
  return senses;
}

void append_sum(const Model& model, const Element& element, std::span<const double> factors,
                const TimeFunction* value, ConstraintPart part,
                std::vector<ConstraintPart>& parts) {
  assert(factors.size() == element.coordinates.size());
  const std::size_t first = parts.size();
  double largest = 0.0;
  part.motion = value;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const CoordinatePort& port = element.coordinates[i];
    const Joint& joint = model.joints[port.joint];
    const auto axis = coordinate_axis(joint.type, joint.axis_2, port.component);
    assert(axis);
    part.type =
        axis->turns ? ConstraintType::coordinate_angle : ConstraintType::coordinate_displacement;
    part.owner.joint = port.joint;
    part.coordinate = static_cast<int>(i);
    part.a = element.markers[port.port];
    part.b = element.markers[port.port + 1];
    part.e_a = axis->direction;
    part.c = factors[i];
    parts.push_back(part);
    part.continues = true;
    part.motion = nullptr;
    const double length = axis->turns ? model.bodies[joint.child].length : 1.0;
    largest = std::max(largest, std::abs(part.c) / length);
  }
  for (std::size_t k = first; k < parts.size(); ++k) {
    parts[k].scale = 1.0 / largest;
    parts[k].force = -parts[k].scale;
  }
}

Picture picture_of_coupling(const Element& element) {
  return {.symbol = Picture::Symbol::coupling,
          .a = element.markers[0],
          .b = element.markers[1],
          .axis = Vec3::UnitZ(),
          .axis_of = element.markers[0]};
}

void coupled_rows(const Model& model, const Element& element, ConstraintPart part,
                  std::vector<ConstraintPart>& parts) {
  const CoupledSum& sum = data_of<CoupledSum>(element);
  append_sum(model, element, sum.factors, &sum.value, part, parts);
}

ElementExample coupled_example(ElementKeys keys, std::size_t coordinates, ExampleNumbers& numbers) {
  ElementExample x;
  std::visit([&](auto& own) { x.keys(std::move(own)); }, keys);
  for (std::size_t k = 0; k < 2 * coordinates; ++k) x.markers.push_back(numbers.marker());
  return x;
}

}  // namespace floatframe
