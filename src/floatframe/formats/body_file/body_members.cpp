#include "floatframe/formats/body_file/body_members.hpp"

namespace floatframe {
namespace {

constexpr double symmetric_to = 1e-6;  // numbers that were printed and read again

// The stacks of matrices nm x nm, for ArrayWriter, ArrayReader and SymmetryCheck.

template <class IO, class Integrals>
void integrals(IO& io, const std::string& name, Eigen::Index nm, Integrals& s) {
  io.stack(
      name + "_S", 3, nm, nm, [&](std::size_t k) -> auto& { return s.S2[k]; });
  io.stack(
      name + "_Si", 9, nm, nm, [&](std::size_t k) -> auto& { return s.S2i[k / 3][k % 3]; });
}

template <class IO, class Nodes>
void node_matrices(IO& io, Eigen::Index nm, Nodes& nodes) {
  const auto count = 3 * static_cast<Eigen::Index>(nodes.size());
  io.stack(
      "second_order_h", count, nm,
      nm, [&](std::size_t k) -> auto& { return nodes[k / 3].h[k % 3]; });
  io.stack(
      "second_order_theta", count, nm,
      nm, [&](std::size_t k) -> auto& { return nodes[k / 3].theta[k % 3]; });
}

/// NAME_S and NAME_Si alone.
std::shared_ptr<const SecondOrder> read_integrals(ArrayReader& arrays, const std::string& name,
                                                  Eigen::Index nm) {
  if (nm == 0 || !(arrays.has(name + "_S") || arrays.has(name + "_Si"))) return nullptr;
  auto out = std::make_shared<SecondOrder>();
  integrals(arrays, name, nm, *out);
  return out;
}

void add_projection(const ProjectionData& data, Eigen::Index nm, ArrayWriter& out) {
  if (data.h.size() > 0) out.grouped("projection_h", data.h, data.h.rows() / nm, nm, nm);
  if (data.twist) integrals(out, "projection_twist", nm, *data.twist);
  if (data.turning.empty()) return;
  std::vector<std::array<int, 2>> pairs;
  for (const ProjectionData::TurningPoint& t : data.turning) pairs.push_back({t.point, t.rotation});
  out.integers("projection_turning", pairs);
  out.rows(
      "projection_arms", static_cast<Eigen::Index>(pairs.size()), [&](std::size_t k) -> auto& {
        return data.turning[k].arm;
      });
  out.grouped("projection_rotations", data.rotations, data.rotations.rows() / 3, 3, nm);
}

/// An error for the first matrix of each stack that is not symmetric.
class SymmetryCheck {
 public:
  explicit SymmetryCheck(ArrayReader& arrays) : arrays_(arrays) {}

  template <class Of>
  void stack(const std::string& name, Eigen::Index count, Eigen::Index, Eigen::Index, Of of) {
    double size = 0.0;
    for (Eigen::Index k = 0; k < count; ++k) size = std::max(size, of(k).cwiseAbs().maxCoeff());
    for (Eigen::Index k = 0; k < count; ++k) {
      const double off = (of(k) - of(k).transpose()).cwiseAbs().maxCoeff();
      if (off <= symmetric_to * size) continue;
      arrays_.error(ErrorCode::contradiction, name,
                    "matrix {} is not symmetric: two of its entries differ by {:g}", k + 1, off);
      return;
    }
  }

 private:
  ArrayReader& arrays_;
};

constexpr std::int64_t any_integer = std::numeric_limits<std::int32_t>::max();
constexpr int layers = 4;

/// For solids, in files without further data.
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

void add_second_order(const FlexibleBody& body, ArrayWriter& out) {
  const Eigen::Index nm = body.modes();
  if (nm == 0) return;
  if (body.projection) add_projection(*body.projection, nm, out);
  if (body.turning) integrals(out, "turning", nm, *body.turning);
  if (!body.second_order) return;
  const SecondOrder& s = *body.second_order;
  integrals(out, "second_order", nm, s);
  std::vector<int> nodes;
  for (const SecondOrderNode& node : s.nodes) nodes.push_back(node.node);
  out.integers("second_order_nodes", nodes);
  node_matrices(out, nm, s.nodes);
}

std::shared_ptr<const SecondOrder> read_second_order(ArrayReader& arrays, Eigen::Index nm,
                                                     Eigen::Index markers) {
  if (nm == 0 || !arrays.has_any({"second_order_S", "second_order_Si", "second_order_nodes",
                                  "second_order_h", "second_order_theta"}))
    return nullptr;
  auto out = std::make_shared<SecondOrder>();
  integrals(arrays, "second_order", nm, *out);
  std::vector<int> nodes = arrays.integers("second_order_nodes", std::nullopt, markers);
  if (std::adjacent_find(nodes.begin(), nodes.end(), std::greater_equal<>()) != nodes.end())
    arrays.error(ErrorCode::duplicate, "second_order_nodes",
                 "expected markers in ascending order, each once");
  nodes.resize(
      static_cast<std::size_t>(arrays.length("second_order_nodes")));  // zeros after an error
  for (const int node : nodes) out->nodes.emplace_back().node = node;
  node_matrices(arrays, nm, out->nodes);
  return out;
}

std::shared_ptr<const SecondOrder> read_turning(ArrayReader& arrays, Eigen::Index nm) {
  return read_integrals(arrays, "turning", nm);
}

void read_projection_second_order(ArrayReader& arrays, Eigen::Index nm, ProjectionData& data) {
  if (nm == 0) return;
  const Eigen::Index nodes = data.p.cols();
  if (arrays.has("projection_h")) arrays.grouped("projection_h", data.h, 3 * nodes, nm, nm);
  data.twist = read_integrals(arrays, "projection_twist", nm);
  if (!arrays.has_any({"projection_turning", "projection_arms", "projection_rotations"})) return;
  const Eigen::Index count = arrays.length("projection_turning");
  const Eigen::Index rotations = arrays.length("projection_rotations");
  auto pairs = arrays.integers<2>("projection_turning", std::max<std::int64_t>(nodes, rotations));
  pairs.resize(static_cast<std::size_t>(count));  // zeros after an error
  const MatX arms = arrays.matrix("projection_arms", count, 3);
  arrays.grouped("projection_rotations", data.rotations, rotations, 3, nm);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto [point, rotation] = pairs[k];
    if (point >= nodes || rotation >= rotations || (k > 0 && point < data.turning.back().point))
      return arrays.error(
          ErrorCode::wrong_value, "projection_turning",
          "found point {} with rotation {} in row {}, expected points in ascending order "
          "below {} and rotations below {}",
          point, rotation, k + 1, nodes, rotations);
    data.turning.push_back({point, rotation, arms.row(k).transpose()});
  }
}

void check_second_order(const FlexibleBody& body, ArrayReader& arrays) {
  const Eigen::Index nm = body.modes();
  if (nm == 0) return;
  SymmetryCheck check(arrays);
  if (body.turning) integrals(check, "turning", nm, *body.turning);
  if (body.second_order) {
    integrals(check, "second_order", nm, *body.second_order);
    node_matrices(check, nm, body.second_order->nodes);
  }
  if (!body.projection) return;
  if (body.projection->twist) integrals(check, "projection_twist", nm, *body.projection->twist);
  const MatX& h = body.projection->h;
  check.stack("projection_h", h.rows() / nm, nm, nm,
              [&](Eigen::Index k) { return h.middleRows(k * nm, nm); });
}

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
