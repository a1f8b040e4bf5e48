#pragma once
// What couplings share: a sum of coordinates of joints is a function of time,
//   sum_i c_i q_i = f(t),                                                                       (1)
// one row of a part `coordinate_displacement` or `coordinate_angle` for each term, between the
// markers of its joint, which owns the part: the wrench of a joint includes what couplings exert on
// its coordinates, c_i times the force of the coupling. The row is scaled to lengths: with L_i the
// length of the child of a joint that turns, 1 of one that slides,
//   l = 1 / max_i (|c_i| / L_i),                                                                (2)
// so that the largest part of its gradient is that of a joint's own rows, whatever the units of
// the factors. Couplings by name compute their factors from teeth, radii or a lead. Load time only.
#include <span>
#include <string>
#include <vector>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

/// The sum of a coupling by name, its `Element::data`: a factor for each coordinate of the element.
struct CoupledSum {
  std::vector<double> factors;
  TimeFunction value = {};
};

/// The number of a coordinate of a joint that couplings can hold: a displacement (`along`), an
/// angle (`about`) or either (`coordinate`). `given`: its number, -1: the only one. Returns -1 if
/// there is none, or if there are several.
int coupled_component(JointType type, int given, ElementAxis what);
/// "revolute, prismatic, cylindrical or planar": those with such a coordinate.
std::string coupled_joints(ElementAxis what);
/// "displacement or angle": all coordinates of a joint.
std::string coordinate_names(JointType type);

/// A required coordinate, the same that may be absent, and a list of numbers.
constexpr ElementKey coordinate_key(const char* name, const char* about, KeyMember member,
                                    ElementAxis what = ElementAxis::about, bool required = true) {
  return {.name = name,
          .kind = KeyKind::coordinate,
          .about = about,
          .required = required,
          .axis = what,
          .member = member};
}
constexpr ElementKey numbers_key(const char* name, const char* about, NumberRule rule,
                                 std::span<const char* const> words, KeyMember member,
                                 bool required = false) {
  return {.name = name,
          .kind = KeyKind::numbers,
          .about = about,
          .required = required,
          .rule = rule,
          .words = words,
          .member = member};
}
inline constexpr NumberRule number_of_teeth = {"a number of teeth >= 1", "", 1.0};

/// Each coordinate that a key names is one of its joint, and no other names it. False after an
/// error.
bool validate_coordinates(const ElementCheck& check);
/// Whole numbers, if they are given.
void validate_teeth(const ElementCheck& check);
/// Either `ratio` or `teeth`.
void validate_ratio(const ElementCheck& check);
/// Turns of the driver per turn of the driven wheel.
double ratio_of(const ElementView& values);

/// Connects the coordinate of a key, if it is given; false after an error.
bool connect_coupled(ElementBuild& build, const char* key);
/// The sense of a coordinate in a mirrored subsystem: 1 or -1.
double mirrored_sense(const ElementView& values, const char* key);
/// The senses of the axes of all coordinates against the first one, as drawn: 1 or -1. Nothing,
/// with an error, if an axis is further from parallel than the angle [rad].
std::vector<double> senses_of_axes(ElementBuild& build, double angle);
inline constexpr double parallel_wheels = 0.01, parallel_shafts = 1.0;

/// Appends (1) with these factors; nullptr: f = 0.
void append_sum(const Model& model, const Element& element, std::span<const double> factors,
                const TimeFunction* value, ConstraintPart part, std::vector<ConstraintPart>& parts);
/// `ElementKind::rows` of an element whose data is a CoupledSum.
void coupled_rows(const Model& model, const Element& element, ConstraintPart part,
                  std::vector<ConstraintPart>& parts);
/// A toothed wheel at the first joint of a coupling, about its axis.
Picture picture_of_coupling(const Element& element);
/// Of a coupling that only holds.
inline constexpr ElementRegime holding_regimes[] = {{.name = "anywhere", .acts = false}};
/// With the markers of these many coordinates.
ElementExample coupled_example(ElementKeys keys, std::size_t coordinates, ExampleNumbers& numbers);

}  // namespace floatframe
