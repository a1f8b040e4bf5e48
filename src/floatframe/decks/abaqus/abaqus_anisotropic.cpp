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

/// The constants of one temperature; false if there are no more lines.
bool next_constants(AbaqusLines& lines, const AbaqusKeyword& keyword, std::size_t count,
                    TemperatureRow& row) {
  std::vector<double>& out = row.values;
  std::vector<std::string_view> fields;
  while (out.size() < count) {
    if (!lines.next_fields(fields)) {
      if (!out.empty())
        lines.error(ErrorCode::wrong_count, keyword, "has {} constants, expected {}", out.size(),
                    count);
      return false;
    }
    const std::size_t here = std::min<std::size_t>(8, count - out.size());
    if (fields.size() < here) {
      lines.error(ErrorCode::missing, keyword, "has no constant {} of {}: eight stand in a line",
                  out.size() + fields.size() + 1, count);
      return false;
    }
    for (std::size_t k = 0; k < here; ++k) {
      const std::size_t number = out.size() + 1;
      out.push_back(lines.real_or(fields, k, 0.0, fmt::format("elastic constant {}", number)));
    }
    if (out.size() == count) row.temperature = lines.real_or(fields, here, 0.0, "temperature");
  }
  return true;
}

const ElasticType& elastic_type(const AbaqusKeyword& keyword) {
  const std::string name = abaqus_name(keyword.value("TYPE"));
  return *std::find_if(std::begin(elastic_types), std::end(elastic_types),
                       [&](const ElasticType& t) { return name == t.name; });
}

void use_anisotropic(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusMaterial& material,
                     const std::vector<double>& c) {
  const ElasticType& type = elastic_type(keyword);
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
  if (!error.empty()) lines.error(ErrorCode::wrong_value, keyword, "TYPE={}: {}", type.name, error);
  material.young = c[0];
}

}  // namespace

bool is_abaqus_anisotropic(std::string_view type) {
  return std::any_of(std::begin(elastic_types), std::end(elastic_types),
                     [&](const ElasticType& t) { return abaqus_name(type) == t.name; });
}

void read_abaqus_anisotropic(AbaqusLines& lines, const AbaqusKeyword& keyword,
                             AbaqusContent& content, AbaqusMaterial* material) {
  const ElasticType& type = elastic_type(keyword);
  const std::size_t before = lines.source().errors();
  if (keyword.has("DEPENDENCIES") && !same_word(keyword.value("DEPENDENCIES"), "0"))
    lines.error(ErrorCode::unsupported, keyword,
                "depends on field variables (DEPENDENCIES), which is not supported");
  std::vector<TemperatureRow> rows;
  for (TemperatureRow row; next_constants(lines, keyword, type.constants, row); row = {})
    rows.push_back(row);
  if (rows.empty() && lines.source().errors() == before)
    lines.error(ErrorCode::missing, keyword, "has no data line");
  lines.skip_data();
  if (material == nullptr || lines.source().errors() != before) return;
  if (material->young)
    return lines.error(ErrorCode::duplicate, keyword, "is given a second time for its material");
  take_abaqus_constants(lines, keyword, content, *material, rows, use_anisotropic);
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

void read_abaqus_orientation(AbaqusLines& lines, const AbaqusKeyword& keyword,
                             AbaqusContent& content) {
  lines.allow_only(keyword, {"NAME", "SYSTEM", "DEFINITION"});
  AbaqusOrientation o;
  o.at = keyword.at;
  o.scope = content.scope;
  const std::size_t before = lines.source().errors();
  const std::string name = abaqus_name(lines.required(keyword, "NAME"));
  const std::string system = abaqus_name(keyword.value("SYSTEM"));
  const std::string definition = abaqus_name(keyword.value("DEFINITION"));
  if (system == "CYLINDRICAL") {
    o.kind = AbaqusOrientation::Kind::cylindrical;
  } else if (system == "ZRECTANGULAR") {
    o.kind = AbaqusOrientation::Kind::z_rectangular;
    if (!content.clues.axes)
      content.clues.axes = {"*ORIENTATION, SYSTEM=Z RECTANGULAR", keyword.at};
  } else if (!system.empty() && system != "RECTANGULAR") {
    lines.error(ErrorCode::wrong_value, keyword,
                "has the system {}, expected RECTANGULAR, Z RECTANGULAR or CYLINDRICAL",
                shown(keyword.value("SYSTEM")));
  }
  if (!definition.empty() && definition != "COORDINATES")
    lines.error(ErrorCode::wrong_value, keyword, "has the definition {}, expected COORDINATES",
                shown(keyword.value("DEFINITION")));
  std::vector<std::string_view> fields;
  if (lines.source().errors() != before) return lines.skip_data();
  if (!lines.next_fields(fields))
    return lines.error(ErrorCode::missing, keyword, "has no data line");
  if (fields.size() < 6)
    lines.error(ErrorCode::wrong_count, keyword,
                "has {} coordinates, expected those of the points a and b", fields.size());
  Vec3* const points[] = {&o.a, &o.b, &o.c};
  for (std::size_t k = 0; k < 9; ++k)
    (*points[k / 3])(static_cast<Eigen::Index>(k % 3)) =
        lines.real_or(fields, k, 0.0, "coordinate of the orientation");
  if (lines.next_fields(fields)) {
    const std::optional<int> axis = fields[0].empty() ? 1 : parse_integer(fields[0]);
    if (!axis || *axis < 1 || *axis > 3)
      lines.error(ErrorCode::out_of_range, keyword, "turns about axis {}, expected 1, 2 or 3",
                  axis ? std::to_string(*axis) : shown(fields[0]));
    o.axis = axis.value_or(1);
    o.axis_given = !fields[0].empty();
    o.angle = lines.real_or(fields, 1, 0.0, "additional rotation") * std::numbers::pi / 180.0;
  }
  lines.skip_data();
  // CalculiX has the origin in place of c: whose deck this is shows later.
  AbaqusOrientation without_c = o;
  without_c.c.setZero();
  if (lines.source().errors() == before && o.points_on_a_line() && without_c.points_on_a_line())
    lines.error(ErrorCode::wrong_value, keyword, o.wrong_points());
  const auto [it, added] = content.orientations.emplace(std::pair{o.scope, name}, o);
  if (added || lines.source().errors() != before) return;
  const SourceMark mark = lines.source().mark(it->second.at);
  lines.error(ErrorCode::duplicate, keyword, "names the orientation {} a second time ({}:{})",
              shown(name), mark.file, mark.line);
}

}  // namespace floatframe
