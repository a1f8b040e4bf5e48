#include "floatframe/formats/body_file/stress_arrays.hpp"

#include <fmt/format.h>

#include <limits>

#include "floatframe/core/enum_index.hpp"

namespace floatframe {
namespace {

constexpr std::int64_t any_integer = std::numeric_limits<std::int32_t>::max();
constexpr int layers = 4;

/// Of solids, in files that know no more.
std::shared_ptr<const BodyStress> surface_stress(ArrayReader& arrays, Eigen::Index nm,
                                                 const std::vector<int>& nodes,
                                                 const Mat3X& positions) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  auto out = std::make_shared<BodyStress>();
  out->modes = arrays.grouped("surface_stress", n, 6, nm);
  out->groups.emplace_back();
  for (Eigen::Index k = 0; k < n; ++k)
    out->places.push_back({.point = static_cast<int>(k),
                           .node = nodes[k],
                           .number = nodes[k] + 1,
                           .p = positions.col(k)});
  return out;
}

void read_places(ArrayReader& arrays, Eigen::Index points, BodyStress& out) {
  const std::vector<int> flat = arrays.integers("stress_places", 6, any_integer);
  const auto n = static_cast<Eigen::Index>(flat.size() / 6);
  const MatX p = arrays.matrix("stress_p", n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const int* row = flat.data() + 6 * k;
    if (row[0] > points || row[3] >= layers || row[4] >= static_cast<int>(out.groups.size()) ||
        row[5] > 1) {
      arrays.error(ErrorCode::wrong_value, "stress_places",
                   "place {} is not one: expected a point up to {}, a layer below {}, a group "
                   "below {} and 0 or 1",
                   k + 1, points, layers, out.groups.size());
      return;
    }
    out.places.push_back({.layer = static_cast<StressPlace::Layer>(row[3]),
                          .point = row[0] - 1,
                          .node = row[1],
                          .number = row[2],
                          .group = row[4],
                          .doubtful = row[5] != 0,
                          .p = p.row(k).transpose()});
  }
}

void read_sections(ArrayReader& arrays, const StressNames& names, BodyStress& out) {
  const std::vector<int> flat = arrays.integers("stress_sections", 5, any_integer);
  const MatX p = arrays.matrix("section_p", static_cast<Eigen::Index>(flat.size() / 5), 3);
  const auto places = static_cast<int>(out.places.size());
  int before = 0;
  for (std::size_t k = 0; k < flat.size() / 5; ++k) {
    const int* row = flat.data() + 5 * k;
    if (row[3] != static_cast<int>(k % 2) || row[4] < before || row[4] > places) {
      arrays.error(ErrorCode::wrong_value, "stress_sections",
                   "section {} is not one: expected the ends 0 and 1 in turn and first places that "
                   "ascend up to {}",
                   k + 1, places);
      return;
    }
    before = row[4];
    out.sections.push_back({row[0], row[1], row[2], row[3],
                            p.row(static_cast<Eigen::Index>(k)).transpose(),
                            k < names.beams.size() ? names.beams[k] : ""});
    out.first_place.push_back(row[4]);
  }
  if (!out.sections.empty()) out.first_place.push_back(places);
}

}  // namespace

void add_stress(const FlexibleBody& body, NamedBytes& arrays) {
  if (!body.stress || body.modes() == 0) return;
  const BodyStress& s = *body.stress;
  const auto add = [&](const char* name, const NpyArray& array) {
    arrays.emplace_back(name, npy_bytes(array));
  };
  std::vector<std::array<int, 6>> places;
  std::vector<std::array<int, 5>> sections;
  MatX p(static_cast<Eigen::Index>(s.places.size()), 3);
  for (const StressPlace& place : s.places) {
    p.row(static_cast<Eigen::Index>(places.size())) = place.p.transpose();
    places.push_back({place.point + 1, place.node, place.number,
                      static_cast<int>(index_of(place.layer)), place.group,
                      place.doubtful ? 1 : 0});
  }
  MatX section_p(static_cast<Eigen::Index>(s.sections.size()), 3);
  for (std::size_t k = 0; k < s.sections.size(); ++k) {
    const BeamSectionPlace& section = s.sections[k];
    section_p.row(static_cast<Eigen::Index>(k)) = section.p.transpose();
    sections.push_back(
        {section.element, section.node, section.number, section.end, s.first_place[k]});
  }
  MatX groups(static_cast<Eigen::Index>(s.groups.size()), 2);
  for (Eigen::Index k = 0; k < groups.rows(); ++k)
    groups.row(k) << s.groups[k].young, s.groups[k].poisson;
  add("stress_places", array_of(places));
  add("stress_p", array_of(p));
  add("stress_groups", array_of(groups));
  add("stress_modes", grouped_array(s.modes, 6));
  if (s.loads.size() > 0) add("stress_loads", grouped_array(s.loads, 6));
  if (s.sections.empty()) return;
  add("stress_sections", array_of(sections));
  add("section_p", array_of(section_p));
  add("section_modes", grouped_array(s.section_modes, 6));
  if (s.section_loads.size() > 0) add("section_loads", grouped_array(s.section_loads, 6));
}

std::shared_ptr<const BodyStress> read_stress(ArrayReader& arrays, Eigen::Index nm,
                                              const std::vector<int>& nodes, const Mat3X& positions,
                                              const StressNames& names) {
  if (nm == 0) return nullptr;
  if (!arrays.has("stress_modes"))
    return arrays.has("surface_stress") ? surface_stress(arrays, nm, nodes, positions) : nullptr;
  auto out = std::make_shared<BodyStress>();
  const Eigen::Index groups = arrays.length("stress_groups");
  const MatX constants = arrays.matrix("stress_groups", groups, 2);
  for (Eigen::Index k = 0; k < groups; ++k)
    out->groups.push_back(
        {k < static_cast<Eigen::Index>(names.groups.size()) ? names.groups[k] : "", constants(k, 0),
         constants(k, 1)});
  read_places(arrays, static_cast<Eigen::Index>(nodes.size()), *out);
  if (arrays.has("stress_sections")) read_sections(arrays, names, *out);
  const auto places = static_cast<Eigen::Index>(out->places.size());
  const auto sections = static_cast<Eigen::Index>(out->sections.size());
  const Eigen::Index loads = body_load_cases + nm;
  out->modes = arrays.grouped("stress_modes", places, 6, nm);
  if (arrays.has("stress_loads")) out->loads = arrays.grouped("stress_loads", places, 6, loads);
  if (sections == 0) return out;
  out->section_modes = arrays.grouped("section_modes", sections, 6, nm);
  if (arrays.has("section_loads"))
    out->section_loads = arrays.grouped("section_loads", sections, 6, loads);
  return out;
}

}  // namespace floatframe
