// Roads.
#include <limits>

#include "floatframe/description/road_spectrum.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/model_file/parsed_files.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/yaml/read_table.hpp"

namespace floatframe {
namespace {

/// Points [x, z] of a road; two with the same x are a step.
PiecewisePolynomial read_profile(const YamlValue& value) {
  const TableRows table = read_table_rows(value, any_number("m"), "a point [x, z] [m]");
  if (table.good && table.rows.empty())
    value.error(ErrorCode::missing,
                value.is_list() ? "found an empty list, expected points [x, z]"
                                : "found no rows in '" + table.file + "', expected points x, z");
  std::vector<TablePoint> points;
  for (const TableRow& row : table.rows) {
    const double x = row.point.x;
    const std::size_t n = points.size();
    if (n > 0 && x < points.back().x)
      table.error(ErrorCode::wrong_value, row,
                  "found x = " + number_text(x) + " after " + number_text(points.back().x) +
                      ", expected x that does not decrease [m]");
    else if (n > 1 && x == points[n - 1].x && x == points[n - 2].x)
      table.error(ErrorCode::duplicate, row,
                  "found x = " + number_text(x) + " a third time, expected two points at a jump");
    else
      points.push_back(row.point);
  }
  return points.empty() ? PiecewisePolynomial() : profile_function(points);
}

/// {class or roughness, start, length, seed}
std::optional<RoadSpectrum> read_spectrum(const YamlValue& value) {
  auto s = value.section("a map with class (or roughness), length and seed");
  if (!s) return std::nullopt;
  const std::size_t before = value.context().errors->size();
  const RoadSpectrum spectrum = read_spectrum_keys(*s);
  s->finish();
  if (value.context().errors->size() != before) return std::nullopt;
  return spectrum;
}

}  // namespace

RoadSpectrum read_spectrum_keys(YamlSection& s) {
  RoadSpectrum spectrum;
  const auto word = s.get("class");
  const auto number = s.get("roughness");
  if (word && number) {
    number->error(ErrorCode::exclusive, "excludes 'class'; remove one of them");
  } else if (number) {
    spectrum.roughness = number->number(non_negative_number("m3")).value_or(0.0);
  } else if (const auto found = s.require("class")) {
    const auto place = found->word(road_classes::names);
    if (place) spectrum.roughness = road_classes::roughness(static_cast<int>(*place));
  }
  spectrum.start = s.number("start", any_number("m"), 0.0);
  spectrum.length = s.required_number("length", rules::random_road_length, 100.0);
  if (const auto seed = s.get("seed"))
    spectrum.seed = seed->integer(0, std::numeric_limits<int>::max(), "a whole number").value_or(1);
  return spectrum;
}

void read_roads(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, s] : active_entities(self, EntityKind::road)) {
    RoadDescription r;
    r.name = self.prefix + name;
    r.origin = s.origin();
    if (const auto v = s.get("profile")) r.pieces = read_profile(*v);
    if (const auto v = s.get("spectrum"))
      if (const auto spectrum = read_spectrum(*v))
        r.pieces = r.pieces + (model.options.parsed ? model.options.parsed->road(*spectrum)
                                                    : random_road(*spectrum));
    if (const auto v = s.get("bumps"))
      for (const YamlValue& item : v->list("a list of bumps {start, length, height}")) {
        auto b = item.section("a bump {start, length, height}");
        if (!b) continue;
        CosineBump bump;
        bump.start = b->required_number("start", any_number("m"), 0.0);
        bump.length = b->required_number("length", rules::bump_length, 1.0);
        bump.height = b->required_number("height", any_number("m"), 0.0);
        b->finish();
        r.bumps.push_back(bump);
      }
    r.surface = read_surface(self, s);
    s.finish();
    model.description.roads.push_back(std::move(r));
  }
}

}  // namespace floatframe
