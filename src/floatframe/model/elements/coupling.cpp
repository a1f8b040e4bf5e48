// Coupling: a sum of coordinates of joints is a function of time,
//   sum_i c_i q_i = f(t),
// one row of a part `coordinate_displacement` or `coordinate_angle` for each term, between the
// markers of its joint, which owns the part: the wrench of a joint includes what couplings exert on
// its coordinates, c_i times the force of the coupling. The row is scaled to lengths: with L_i the
// length of the child of a joint that turns, 1 of one that slides,
//   l = 1 / max_i (|c_i| / L_i),
// so that the largest part of its gradient is that of a joint's own rows, whatever the units of
// the factors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(coupling)

namespace {

constexpr ElementKey coupling_keys[] = {{.name = "terms",
                                         .kind = KeyKind::terms,
                                         .about = "the coordinates with their factors",
                                         .required = true,
                                         .member = described_by<&Coupling::terms>},
                                        {.name = "value",
                                         .kind = KeyKind::motion,
                                         .about = "of their sum",
                                         .axis = ElementAxis::coordinate,
                                         .member = described_by<&Coupling::value>}};

/// "revolute, prismatic, cylindrical or planar"
std::string coupled_joints() {
  std::vector<const char*> words;
  for (const JointType type : joint_types)
    if (joint_velocities(type) > 0 && coordinate_axis(type, Vec3::UnitX(), 0))
      words.push_back(joint_type_name(type));
  return alternatives(words);
}

/// "displacement or angle"
std::string coordinate_names(JointType type) {
  std::vector<const char*> words;
  for (int k = 0; k < joint_velocities(type); ++k) words.push_back(joint_coordinate_name(type, k));
  return alternatives(words);
}

void coupling_validate(const ElementCheck& check) {
  if (!check.good("terms")) return;
  const std::vector<CoordinateTerm> terms = check.coordinates();
  const auto error = [&](ErrorCode code, const std::string& sentence) {
    check.error(code, "terms", sentence);
  };
  if (terms.empty())
    error(ErrorCode::missing, "found an empty list, expected terms {joint, coordinate, factor}");
  std::set<std::pair<std::string, int>> taken;
  for (const CoordinateTerm& term : terms) {
    const auto type = check.joint_type(term.joint);
    if (!type) continue;
    const std::string joint = "joint '" + check.written(term.joint) + "'";
    const int count = joint_velocities(*type);
    if (count == 0 || !coordinate_axis(*type, Vec3::UnitX(), 0))
      error(ErrorCode::wrong_value, fmt::format("found {}, a {} joint, expected a {} joint", joint,
                                                joint_type_name(*type), coupled_joints()));
    else if (term.coordinate >= count || (term.coordinate < 0 && count > 1))
      error(ErrorCode::incomplete,
            fmt::format("found no coordinate of {}, expected {}", joint, coordinate_names(*type)));
    else if (term.factor == 0.0)
      error(ErrorCode::out_of_range,
            fmt::format("found the factor 0 of {}, expected another number", joint));
    else if (const int k = std::max(0, term.coordinate); !taken.insert({term.joint, k}).second)
      error(ErrorCode::duplicate, fmt::format("found the {} of {} twice, expected it once",
                                              joint_coordinate_name(*type, k), joint));
  }
}

bool coupling_build(ElementBuild& build) {
  bool good = true;
  for (const CoordinateTerm& term : build.coordinates())
    good = build.connect_coordinate(term.joint, std::max(0, term.coordinate)) && good;
  return good;
}

void coupling_rows(const Model& model, const Element& element, ConstraintPart part,
                   std::vector<ConstraintPart>& parts) {
  const std::vector<CoordinateTerm>& terms = std::get<Coupling>(*element.keys).terms;
  const std::size_t first = parts.size();
  double largest = 0.0;
  part.motion = &element.signals[0].function;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const CoordinatePort& port = element.coordinates[i];
    const Joint& joint = model.joints[port.joint];
    const auto axis = coordinate_axis(joint.type, joint.axis_2, port.component);
    assert(axis);
    part.type =
        axis->turns ? ConstraintType::coordinate_angle : ConstraintType::coordinate_displacement;
    part.owner.joint = port.joint;
    part.coordinate = i;
    part.a = element.markers[port.port];
    part.b = element.markers[port.port + 1];
    part.e_a = axis->direction;
    part.c = terms[i].factor;
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

constexpr ElementRegime coupling_regimes[] = {{.name = "anywhere", .acts = false}};

ElementExample coupling_example(std::size_t, ExampleNumbers& numbers) {
  ElementExample x;
  x.keys(Coupling{{{"a"}, {"b", -1, numbers(1.0, 2.0)}}, {}});
  for (int k = 0; k < 4; ++k) x.markers.push_back(numbers.marker());
  return x;
}

}  // namespace

constinit const ElementKind coupling_element = {.about = "holds a sum of coordinates of joints",
                                                .keys = coupling_keys,
                                                .list = ElementList::couplings,
                                                .axis = ElementAxis::coordinate,
                                                .blank = [] { return ElementKeys(Coupling()); },
                                                .validate = coupling_validate,
                                                .build = coupling_build,
                                                .rows = coupling_rows,
                                                .regimes = coupling_regimes,
                                                .example = coupling_example};

}  // namespace floatframe
