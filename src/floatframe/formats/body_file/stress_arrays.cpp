#include "floatframe/formats/body_file/body_members.hpp"

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

/// The matrices of places, or of sections (`of` "section"): for ArrayWriter and ArrayReader.
template <class IO, class Matrix>
void stress_matrices(IO& io, const std::string& of, Eigen::Index count, Eigen::Index nm,
                     Matrix& modes, Matrix& loads) {
  io.grouped(of + "_modes", modes, count, 6, nm);
  if (io.wants(of + "_loads", loads.size() > 0))
    io.grouped(of + "_loads", loads, count, 6, body_load_cases + nm);
}

void read_places(ArrayReader& arrays, Eigen::Index points, BodyStress& out) {
  const auto rows = arrays.integers<6>("stress_places", any_integer);
  const auto n = static_cast<Eigen::Index>(rows.size());
  const MatX p = arrays.matrix("stress_p", n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& [point, node, number, layer, group, doubtful] = rows[k];
    if (point > points || layer >= layers || group >= static_cast<int>(out.groups.size()) ||
        doubtful > 1)
      return arrays.error(
          ErrorCode::wrong_value, "stress_places",
          "place {} is not one: expected a point up to {}, a layer below {}, a group "
          "below {} and 0 or 1",
          k + 1, points, layers, out.groups.size());
    out.places.push_back({.layer = static_cast<StressPlace::Layer>(layer),
                          .point = point - 1,
                          .node = node,
                          .number = number,
                          .group = group,
                          .doubtful = doubtful != 0,
                          .p = p.row(k).transpose()});
  }
}

void read_sections(ArrayReader& arrays, const StressNames& names, BodyStress& out) {
  const auto rows = arrays.integers<5>("stress_sections", any_integer);
  const auto n = static_cast<Eigen::Index>(rows.size());
  const MatX p = arrays.matrix("section_p", n, 3);
  const auto places = static_cast<int>(out.places.size());
  int before = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& [element, node, number, end, first] = rows[k];
    if (end != k % 2 || first < before || first > places)
      return arrays.error(
          ErrorCode::wrong_value, "stress_sections",
          "section {} is not one: expected the ends 0 and 1 in turn and first places that "
          "ascend up to {}",
          k + 1, places);
    before = first;
    const std::size_t at = k;
    out.sections.push_back({element, node, number, end, p.row(k).transpose(),
                            at < names.beams.size() ? names.beams[at] : ""});
    out.first_place.push_back(first);
  }
  if (!out.sections.empty()) out.first_place.push_back(places);
}

}  // namespace

void add_stress(const FlexibleBody& body, ArrayWriter& out) {
  const Eigen::Index nm = body.modes();
  if (!body.stress || nm == 0) return;
  const BodyStress& s = *body.stress;
  std::vector<std::array<int, 6>> places;
  std::vector<std::array<int, 5>> sections;
  for (const StressPlace& place : s.places)
    places.push_back({place.point + 1, place.node, place.number,
                      static_cast<int>(index_of(place.layer)), place.group,
                      place.doubtful ? 1 : 0});
  for (const BeamSectionPlace& at : s.sections)
    sections.push_back({at.element, at.node, at.number, at.end, s.first_place[sections.size()]});
  MatX groups(static_cast<Eigen::Index>(s.groups.size()), 2);
  for (Eigen::Index k = 0; k < groups.rows(); ++k)
    groups.row(k) << s.groups[k].young, s.groups[k].poisson;
  const auto count = static_cast<Eigen::Index>(places.size());
  out.integers("stress_places", places);
  out.rows(
      "stress_p", count, [&](std::size_t k) -> auto& { return s.places[k].p; });
  out.matrix("stress_groups", groups, groups.rows(), 2);
  stress_matrices(out, "stress", count, nm, s.modes, s.loads);
  if (s.sections.empty()) return;
  const auto section_count = static_cast<Eigen::Index>(sections.size());
  out.integers("stress_sections", sections);
  out.rows(
      "section_p", section_count, [&](std::size_t k) -> auto& { return s.sections[k].p; });
  stress_matrices(out, "section", section_count, nm, s.section_modes, s.section_loads);
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
  stress_matrices(arrays, "stress", places, nm, out->modes, out->loads);
  if (sections > 0)
    stress_matrices(arrays, "section", sections, nm, out->section_modes, out->section_loads);
  return out;
}

}  // namespace floatframe
