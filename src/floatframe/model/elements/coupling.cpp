// Coupling: a sum of coordinates of joints with any factors is a function of time: one row
// (coupled_coordinates.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "floatframe/model/coupled_coordinates.hpp"
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
      error(ErrorCode::wrong_value,
            fmt::format("found {}, a {} joint, expected a {} joint", joint, joint_type_name(*type),
                        coupled_joints(ElementAxis::coordinate)));
    else if (term.coordinate >= count || (term.coordinate < 0 && count > 1))
      error(ErrorCode::incomplete,
            fmt::format("found no coordinate of {}, expected {}", joint, coordinate_names(*type)));
    else if (term.factor == 0.0)
      error(ErrorCode::out_of_range,
            fmt::format("found the factor 0 of {}, expected a number other than 0", joint));
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
  std::vector<double> factors;
  for (const CoordinateTerm& term : std::get<Coupling>(*element.keys).terms)
    factors.push_back(term.factor);
  append_sum(model, element, factors, &element.signals[0].function, part, parts);
}

ElementExample coupling_example(std::size_t, ExampleNumbers& numbers) {
  return coupled_example(Coupling{{{"a"}, {"b", -1, numbers(1.0, 2.0)}}, {}}, 2, numbers);
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
                                                .picture = picture_of_coupling,
                                                .regimes = holding_regimes};

constinit const ExampleMaker coupling_examples = coupling_example;

}  // namespace floatframe
