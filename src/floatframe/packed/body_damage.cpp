// Sizes and numbers of bodies that come from bytes. Those of the integrals, of stiffness, damping
// and nodes are checked by `validate`, as for any program that describes a body.
#include <algorithm>

#include "floatframe/packed/pass_body.hpp"

namespace floatframe {
namespace {

bool has_size(const MatX& m, Eigen::Index rows, Eigen::Index columns) {
  return m.rows() == rows && m.cols() == columns;
}

bool is_index(int k, std::size_t count) { return k >= 0 && std::size_t(k) < count; }

bool fits(const SecondOrder& x, Eigen::Index modes, std::size_t nodes) {
  bool good = true;
  const auto square = [&](const MatX& m) { good = good && has_size(m, modes, modes); };
  std::ranges::for_each(x.S2, square);
  for (const auto& row : x.S2i) std::ranges::for_each(row, square);
  int last = -1;
  for (const SecondOrderNode& n : x.nodes) {
    good = good && n.node > last && is_index(n.node, nodes);
    last = n.node;
    std::ranges::for_each(n.h, square);
    std::ranges::for_each(n.theta, square);
  }
  return good;
}

bool fits(const ProjectionData& d, Eigen::Index modes) {
  const Eigen::Index n = d.p.cols();
  const auto square = [](const auto& m, Eigen::Index size) {
    return m.rows() == size && m.cols() == size;
  };
  bool good = has_size(d.X, 3 * n, modes);
  good = good && (d.six_dof() ? square(d.M_6, 6 * n) && has_size(d.X_theta, 3 * n, modes)
                              : square(d.M_s, n));
  good = good && (d.h.size() == 0 || has_size(d.h, 3 * modes * n, modes));
  good = good && d.rotations.rows() % 3 == 0 &&
         (d.rotations.size() == 0 || d.rotations.cols() == modes);
  int last = -1;
  for (const auto& t : d.turning) {
    good = good && t.point > last && is_index(t.point, n) &&
           is_index(t.rotation, d.rotations.rows() / 3) && !d.six_dof();
    last = t.point;
  }
  return good && (!d.twist || fits(*d.twist, modes, 0));
}

bool fits(const BodyStress& x, Eigen::Index modes, std::size_t nodes, std::size_t points) {
  const auto rows = [&](const MatX& m, const MatX& loads, std::size_t count) {
    const Eigen::Index n = 6 * Eigen::Index(count);
    return (has_size(m, n, modes) || (m.size() == 0 && n * modes == 0)) &&
           (loads.size() == 0 || has_size(loads, n, body_load_cases + modes));
  };
  bool good = rows(x.modes, x.loads, x.places.size()) &&
              rows(x.section_modes, x.section_loads, x.sections.size());
  for (const StressPlace& p : x.places)
    good = good && is_index(p.group, x.groups.size()) && p.point >= -1 &&
           (p.point < 0 || points == 0 || is_index(p.point, points)) &&
           (p.point >= 0 || is_index(p.node, nodes));
  for (const BeamSectionPlace& p : x.sections) good = good && (p.end == 0 || p.end == 1);
  good = good && (x.first_place.empty() || x.first_place.size() == x.sections.size() + 1);
  for (const int k : x.first_place) good = good && k >= 0 && std::size_t(k) <= x.places.size();
  return good && std::ranges::is_sorted(x.first_place);
}

}  // namespace

const char* shape_damage(const BodyShape& x, Eigen::Index modes, std::size_t nodes) {
  const std::size_t n = x.positions.cols();
  bool good = x.modes.size() == 0 || has_size(x.modes, 3 * x.positions.cols(), modes);
  for (const auto& triangle : x.triangles)
    for (const int k : triangle) good = good && is_index(k, n);
  for (const auto& line : x.lines)
    for (const int k : line) good = good && is_index(k, n);
  good = good && (x.nodes.empty() || x.nodes.size() == n);
  for (const auto& bar : x.bars)
    good = good && is_index(bar.from, nodes) && is_index(bar.to, nodes);
  int before = -1;  // paints begin with the first triangle and ascend
  for (const auto& paint : x.paints) {
    good = good && is_index(paint.first, x.triangles.size()) && paint.first > before &&
           (before >= 0 || paint.first == 0);
    before = paint.first;
  }
  return good ? nullptr : "a shape whose points do not exist";
}

const char* body_damage(const FlexibleBody& b) {
  const Eigen::Index modes = b.modes();
  const std::size_t nodes = b.nodes.size();
  for (const auto* x : {&b.turning, &b.second_order})
    if (*x && !fits(**x, modes, nodes)) return "displacements of second order of other sizes";
  if (b.turning && !b.turning->nodes.empty()) return "turning masses with nodes";
  if (b.projection && !fits(*b.projection, modes)) return "data of projection of other sizes";
  if (b.shape)
    if (const char* what = shape_damage(*b.shape, modes, nodes)) return what;
  if (b.stress && !fits(*b.stress, modes, nodes, b.shape ? b.shape->positions.cols() : 0))
    return "stress of other sizes";
  for (const InterfaceDofs& i : b.interfaces)
    if (!is_index(i.node, nodes) || i.mask > 63u) return "a support at no node";
  return nullptr;
}

}  // namespace floatframe
