// Elastic constants of Abaqus decks that are not isotropic, and *ORIENTATION.
//   ENGINEERING CONSTANTS  E1 E2 E3 nu12 nu13 nu23 G12 G13 G23, nu_ij: strain along j by stress
//                          along i
//   ORTHOTROPIC            D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323
//   ANISOTROPIC            the upper triangle by columns, in the order 11 22 33 12 13 23
//   LAMINA                 E1 E2 nu12 G12 G13 G23 of plane stress
// Eight numbers a line, and after the last one the temperature.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/fe/elasticity.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

struct ElasticType {
  const char* name;  ///< without blanks
  std::size_t constants;
  enum class Form { engineering, orthotropic, anisotropic, lamina } form;
};
using Form = ElasticType::Form;

constexpr ElasticType elastic_types[] = {{"ENGINEERINGCONSTANTS", 9, Form::engineering},
                                         {"ENGINEERING", 9, Form::engineering},
                                         {"ORTHO", 9, Form::orthotropic},
                                         {"ORTHOTROPIC", 9, Form::orthotropic},
                                         {"ANISO", 21, Form::anisotropic},
                                         {"ANISOTROPIC", 21, Form::anisotropic},
                                         {"LAMINA", 6, Form::lamina}};

/// Place among xx yy zz xy yz zx of the program's 11 22 33 12 13 23, and their names.
constexpr int place_of[6] = {0, 1, 2, 3, 5, 4};
constexpr const char* index_names[6] = {"11", "22", "33", "12", "23", "13"};

std::string constant_name(int i, int j) {
  const bool ordered = std::find(place_of, place_of + 6, i) <= std::find(place_of, place_of + 6, j);
  return fmt::format("D{}{}", index_names[ordered ? i : j], index_names[ordered ? j : i]);
}

Mat6 constants_matrix(const std::vector<double>& c, Form form) {
  Mat6 D = Mat6::Zero();
  std::size_t k = 0;
  for (int column = 0; column < 6; ++column)
    for (int row = 0; row <= column; ++row) {
      const bool there = form == Form::anisotropic || column < 3 || row == column;
      if (there) D(place_of[row], place_of[column]) = D(place_of[column], place_of[row]) = c[k++];
    }
  return D;
}

const ElasticType* elastic_type(const AbaqusCard& card) {
  const std::string name = card.word("TYPE");
  const auto it = std::find_if(std::begin(elastic_types), std::end(elastic_types),
                               [&](const ElasticType& t) { return name == t.name; });
  return it == std::end(elastic_types) ? nullptr : it;
}

/// The constants of one temperature; false if there are no more lines.
bool next_constants(AbaqusCard& card, std::size_t count, TemperatureRow& row) {
  std::vector<double>& out = row.values;
  while (out.size() < count) {
    if (!card.next()) {
      if (!out.empty())
        card.error(ErrorCode::wrong_count, "has {} constants, expected {}", out.size(), count);
      return false;
    }
    const std::size_t here = std::min<std::size_t>(8, count - out.size());
    if (card.fields.size() < here) {
      card.error(ErrorCode::missing, "has no constant {} of {}: eight stand in a line",
                 out.size() + card.fields.size() + 1, count);
      return false;
    }
    for (std::size_t k = 0; k < here; ++k)
      out.push_back(card.real_or(k, 0.0, fmt::format("elastic constant {}", out.size() + 1)));
    if (out.size() == count) row.temperature = card.real_or(here, 0.0, "temperature");
  }
  return true;
}

void use_anisotropic(AbaqusCard& card, AbaqusMaterial& material, const std::vector<double>& c) {
  const ElasticType& type = *elastic_type(card);
  std::string error;
  if (type.form == Form::engineering || type.form == Form::lamina) {
    const bool lamina = type.form == Form::lamina;
    const EngineeringConstants e =
        lamina ? EngineeringConstants{c[0], c[1], 0.0, c[2], 0.0, 0.0, c[3], c[4], c[5]}
               : EngineeringConstants{c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]};
    error = engineering_error(e, lamina);
    if (error.empty()) material.elasticity = lamina ? lamina_elasticity(e) : elasticity_of(e);
    material.plane = lamina;
  } else {
    const Mat6 D = constants_matrix(c, type.form);
    error = elasticity_error(D, false, constant_name);
    if (error.empty()) material.elasticity = D;
  }
  if (!error.empty()) card.error(ErrorCode::wrong_value, "TYPE={}: {}", type.name, error);
  material.young = c[0];
}

/// SYSTEM, DEFINITION and NAME of *ORIENTATION.
AbaqusOrientation begin_orientation(AbaqusCard& card) {
  AbaqusOrientation o;
  o.at = card.at;
  o.scope = card.content.scope;
  card.required("NAME");
  const std::string system = card.word("SYSTEM"), definition = card.word("DEFINITION");
  if (system == "CYLINDRICAL") {
    o.kind = AbaqusOrientation::Kind::cylindrical;
  } else if (system == "ZRECTANGULAR") {
    o.kind = AbaqusOrientation::Kind::z_rectangular;
    if (!card.content.clues.axes)
      card.content.clues.axes = {"*ORIENTATION, SYSTEM=Z RECTANGULAR", card.at};
  } else if (!system.empty() && system != "RECTANGULAR") {
    card.error(ErrorCode::wrong_value,
               "has the system {}, expected RECTANGULAR, Z RECTANGULAR or CYLINDRICAL",
               shown(card.value("SYSTEM")));
  }
  if (!definition.empty() && definition != "COORDINATES")
    card.error(ErrorCode::wrong_value, "has the definition {}, expected COORDINATES",
               shown(card.value("DEFINITION")));
  return o;
}

}  // namespace

bool read_abaqus_anisotropic(AbaqusCard& card) {
  const ElasticType* const type = elastic_type(card);
  if (type == nullptr) return false;
  has_abaqus_dependencies(card);
  std::vector<TemperatureRow> rows;
  for (TemperatureRow row; next_constants(card, type->constants, row); row = {})
    rows.push_back(row);
  take_abaqus_constants(card, std::move(rows), use_anisotropic);
  return true;
}

bool AbaqusOrientation::points_on_a_line() const {
  const bool cylinder = kind == Kind::cylindrical;
  const Vec3 first = cylinder ? Vec3(b - a) : Vec3(a - c), second = b - c;
  return first.norm() == 0.0 ||
         (!cylinder && first.cross(second).norm() <= 1e-12 * first.norm() * second.norm());
}

const char* AbaqusOrientation::wrong_points() const noexcept {
  return kind == Kind::cylindrical ? "has the same point for a and b"
                                   : "has its points a, b and the origin on a line";
}

void read_abaqus_orientation(AbaqusCard& card) {
  AbaqusOrientation o = begin_orientation(card);
  if (card.wrong() || !card.needs_line()) return;
  if (card.fields.size() < 6)
    card.error(ErrorCode::wrong_count, "has {} coordinates, expected those of the points a and b",
               card.fields.size());
  std::size_t k = 0;
  for (Vec3* const point : {&o.a, &o.b, &o.c})
    *point = card.vector(std::exchange(k, k + 3), "coordinate of the orientation");
  if (card.next()) {
    o.axis_given = !card.field(0).empty();
    const std::optional<int> axis = o.axis_given ? parse_integer(card.field(0)) : 1;
    if (!axis || *axis < 1 || *axis > 3)
      card.error(ErrorCode::out_of_range, "turns about axis {}, expected 1, 2 or 3",
                 axis ? std::to_string(*axis) : shown(card.field(0)));
    o.axis = axis.value_or(1);
    o.angle = card.real_or(1, 0.0, "additional rotation") * std::numbers::pi / 180.0;
  }
  // CalculiX has the origin in place of c: whose deck this is shows later.
  AbaqusOrientation without_c = o;
  without_c.c.setZero();
  if (!card.wrong() && o.points_on_a_line() && without_c.points_on_a_line())
    card.error(ErrorCode::wrong_value, o.wrong_points());
  const std::string name = card.word("NAME");
  const auto [it, added] = card.content.orientations.emplace(std::pair{o.scope, name}, o);
  if (!added && !card.wrong())
    card.error(ErrorCode::duplicate, "names the orientation {} a second time ({})", shown(name),
               card.place(it->second.at));
}

}  // namespace floatframe
