// Cards of bars, beams and rods, with the defaults from BAROR and BEAMOR.
//
// Ends of bars. An offset end is a separate node, tied rigidly: u' = u + theta x d, theta' =
// theta. A pinned end is a separate node too, tied only in the components that are not pinned, in
// the axes of the element. A direction released by both pins of a bar is released once, otherwise
// the end would be free.
//
// Bars with I1, I2 or J equal to 0. They have no such stiffness, so as beams they would leave
// rotations of nodes without any, which Nastran removes one by one (AUTOSPC). Here they are rods
// with springs for their remaining stiffness, since rotations held only by springs are condensed
// (fe/springs.hpp). In a plane with EI and L, phi = 12 EI/(G As L^2), the beam is
//   12 EI/(L^3 (1 + phi)) of v_2 - v_1 - L/2 (r_1 + r_2)  and  EI/L of r_2 - r_1,
// exactly; torsion comes with the rod (build_nastran_torsion).
#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/fe/beam_tangent.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// OFFT; of BAROR only the first letter counts. CBEAM may have a number (BIT) there.
void bar_axes(NastranFields& f, char* axes) {
  if (f.blank(7) || parse_real(f.text(7))) return;
  const std::string word = upper_case(f.text(7));
  const auto one_of = [&](std::size_t i, std::string_view letters) {
    return i >= word.size() || letters.find(word[i]) != std::string_view::npos;
  };
  if (word.size() > 3 || !one_of(0, "GB") || !one_of(1, "GO") || !one_of(2, "GO"))
    return f.error(ErrorCode::wrong_value,
                   "OFFT is {}, expected GGG, BGG, GGO, BGO, GOG, BOG, GOO or BOO",
                   shown(f.text(7)));
  for (std::size_t i = 0; i < word.size(); ++i) axes[i] = word[i];
}

NastranElement line_element(NastranFields& f, FeElementType type) {
  auto e = f.entity<NastranElement>("the number of the element");
  e.type = type;
  e.count = 2;
  return e;
}

void read_nastran_bar(NastranFields& f, NastranContent& c) {
  NastranElement e = line_element(f, FeElementType::beam2);
  e.default_property = f.blank(1);
  e.property = f.label(1, "the property", e.id);
  e.nodes[0] = f.label(2, "node GA");
  e.nodes[1] = f.label(3, "node GB");
  e.default_orientation = !read_nastran_direction(f, "node G0", e.orientation);
  NastranBarEnds ends;
  bar_axes(f, ends.axes);
  for (int k = 0; k < 2; ++k) {
    ends.pins[k] = f.components(8 + k, k == 0 ? "the pins PA" : "the pins PB");
    ends.offset[k] = f.vector(10 + 3 * k, k == 0 ? "the offset WA" : "the offset WB");
  }
  if (ends.axes[0] != 'G' || !ends.plain()) {
    e.ends = static_cast<int>(c.bar_ends.size());
    c.bar_ends.push_back(ends);
  }
  c.elements.push_back(std::move(e));
}

void read_nastran_bar_default(NastranFields& f, NastranContent& c) {
  NastranBarDefault d;
  d.at = f.at();
  d.property = f.label(1, "the property", 0);
  read_nastran_direction(f, "node G0", d.orientation);
  char axes[3] = {'G', 'G', 'G'};
  bar_axes(f, axes);
  d.axes = axes[0];
  const auto [it, fresh] = c.bar_defaults.try_emplace(f.name() == "BAROR" ? "CBAR" : "CBEAM", d);
  if (!fresh)
    f.error(ErrorCode::duplicate, "it is in the file twice, first in line {}", it->second.at.line);
}

/// A CONROD has a separate property, with a number that no card has.
void read_nastran_rod(NastranFields& f, NastranContent& c) {
  NastranElement e = line_element(f, FeElementType::rod2);
  const bool own = f.name() == "CONROD";
  const std::size_t first = own ? 1 : 2;
  if (!own) e.property = f.label(1, "the property", e.id);
  e.nodes[0] = f.label(first, "node G1");
  e.nodes[1] = f.label(first + 1, "node G2");
  if (own && e.id > 0) {
    e.property = -e.id;
    const auto [it, fresh] = c.properties.try_emplace(e.property);
    NastranProperty& p = it->second;
    if (fresh) {
      NastranEntity& entity = p;
      entity = e;
      read_nastran_rod_section(f, 3, p);
    } else {
      f.twice(p.at);
    }
  }
  c.elements.push_back(std::move(e));
}

/// One of two equal releases at both ends of a bar: 1, 4, and in each plane those in excess of
/// two of the deflections and slopes.
void without_double_releases(unsigned& a, unsigned& b) {
  for (const unsigned component : {1u, 8u})
    if ((a & b & component) != 0) b &= ~component;
  for (const auto& [deflection, slope] : {std::pair{2u, 32u}, std::pair{4u, 16u}}) {
    if ((a & b & deflection) != 0) b &= ~deflection;
    if ((a & b & slope) == 0) continue;
    a &= ~deflection;
    b &= ~deflection;
  }
}

bool bar_without_axes(NastranBuild& build, const NastranEntity& bar) {
  return build.fail(ErrorCode::geometry, bar,
                    "it has no length, or its orientation vector is along its axis");
}

}  // namespace

bool read_nastran_direction(NastranFields& f, const char* node, NastranDirection& direction) {
  if (f.blank(4) && f.blank(5) && f.blank(6)) return false;
  if (f.blank(5) && f.blank(6) && parse_label(f.text(4)))
    direction.node = f.label(4, node);
  else
    direction.vector = f.vector(4, "the orientation vector");
  return true;
}

void complete_nastran_bars(NastranContent& c, TextSource& source) {
  for (NastranElement& e : c.elements) {
    if (!e.default_property && !e.default_orientation) continue;
    const auto it = c.bar_defaults.find(e.card);
    const NastranBarDefault* d = it == c.bar_defaults.end() ? nullptr : &it->second;
    if (e.default_property && d != nullptr && d->property > 0) e.property = d->property;
    if (!e.default_orientation) continue;
    if (d == nullptr || (d->orientation.node == 0 && d->orientation.vector == Vec3::Zero())) {
      source.error(ErrorCode::missing, e.at, "{}: the orientation vector is missing", e.label());
      continue;
    }
    e.orientation = d->orientation;
    if (d->axes == 'G') continue;
    if (e.ends < 0) {
      e.ends = static_cast<int>(c.bar_ends.size());
      c.bar_ends.emplace_back();
    }
    c.bar_ends[e.ends].axes[0] = d->axes;
  }
}

std::span<const NastranCardReader> nastran_bar_cards() {
  static constexpr NastranCardReader cards[] = {{"CBAR CBEAM", read_nastran_bar},
                                                {"BAROR BEAMOR", read_nastran_bar_default},
                                                {"CROD CTUBE CONROD", read_nastran_rod}};
  return cards;
}

Mat3 nastran_bar_axes(const Vec3& along, const Vec3& v) {
  Mat3 T;
  T.col(0) = along.normalized();
  T.col(2) = along.cross(v).normalized();
  T.col(1) = T.col(2).cross(T.col(0));
  return T;
}

bool find_nastran_bar_axes(NastranBuild& build, const NastranEntity& bar, const Vec3& along,
                           const Vec3& v, Mat3& T) {
  T = nastran_bar_axes(along, v);
  return T.squaredNorm() > 2.5 || bar_without_axes(build, bar);  // a column without length is zero
}

bool NastranBars::place(const NastranElement& e, double turn, bool bends, FeElement& element) {
  static const NastranBarEnds plain;
  const NastranBarEnds& ends = e.ends < 0 ? plain : b_.content.bar_ends[e.ends];
  const int node[2] = {element.nodes[0], element.nodes[1]};
  const Vec3 p[2] = {b_.model.positions[node[0]], b_.model.positions[node[1]]};
  if (element.type != FeElementType::rod2) {
    const bool pinned = (ends.pins[0] | ends.pins[1]) != 0;
    const bool offset = !ends.offset[0].isZero(0.0) || !ends.offset[1].isZero(0.0);
    bars_.push_back({{node[0], node[1], -1}, offset, bends && !pinned});
  }
  if (!b_.direction(e.orientation, node[0], ends.axes[0] == 'G', e, element.reference))
    return false;
  if (e.ends < 0 && turn == 0.0)
    return !is_along_axis(p[1] - p[0], element.reference) || bar_without_axes(b_, e);
  Vec3 arm[2], end[2];
  for (int k = 0; k < 2; ++k) {
    const Mat3 T = ends.axes[1 + k] == 'G' ? b_.axes(node[k])
                                           : nastran_bar_axes(p[1] - p[0], element.reference);
    arm[k] = ends.offset[k] == Vec3::Zero() ? Vec3::Zero() : Vec3(T * ends.offset[k]);
    end[k] = p[k] + arm[k];
  }
  Mat3 T;
  if (!find_nastran_bar_axes(b_, e, end[1] - end[0], element.reference, T)) return false;
  element.reference = std::cos(turn) * T.col(1) + std::sin(turn) * T.col(2);
  unsigned pins[2] = {ends.pins[0], ends.pins[1]};
  without_double_releases(pins[0], pins[1]);
  const bool rod = element.type == FeElementType::rod2;
  if (rod) pins[0] &= 7u, pins[1] &= 7u;
  for (int k = 0; k < 2; ++k) {
    if (pins[k] == 0 && arm[k].isZero(0.0)) continue;
    int* shared = nullptr;
    if (pins[k] == 0) {
      shared = &offset_nodes_[{double(node[k]), arm[k](0), arm[k](1), arm[k](2)}];
      if (*shared > 0) {
        element.nodes[k] = *shared;
        continue;
      }
    }
    const int fresh = element.nodes[k] = b_.add_node(end[k], e.at, e.label());
    if (shared != nullptr) *shared = fresh;
    ties_.push_back({fresh, node[k], arm[k], pins[k] != 0 ? T : Mat3(Mat3::Identity()),
                     (rod ? 7u : 63u) & ~pins[k], e.at});
  }
  return true;
}

void NastranBars::finish() {
  free_drilling_at_stiffeners(b_.model, bars_);
  std::vector<char> dofs(b_.model.positions.size(), 0);
  for (const FeElement& e : b_.model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    for (int k = 0; k < kernel.nodes; ++k) {
      char& d = dofs[e.nodes[k]];
      d = std::max(d, static_cast<char>(kernel.dofs_per_node));
    }
  }
  for (const Tie& t : ties_) {
    const bool held = dofs[t.node] == 6;
    tie(t, held);
    if (dofs[t.node] > 0 || spiders_.contains(t.node)) continue;
    b_.model.masses.push_back({t.node, 0.0, Mat3::Zero()});  // it has displacements
    dofs[t.node] = 3;
  }
}

void NastranBars::tie(const Tie& t, bool rotates) {
  FeModel& model = b_.model;
  // Rotations of a node that has only pinned or offset bars come with a spider.
  const bool needs_rotations = (t.mask >> 3) != 0 || !t.arm.isZero(0.0);
  if (!rotates && needs_rotations) {
    const auto [it, fresh] = spiders_.try_emplace(t.node, static_cast<int>(model.spiders.size()));
    if (fresh)
      add_rigid_spider(model, t.node, fmt::format("bars of node {}", model.node_ids[t.node]), t.at);
    if (t.mask == 63u) {
      model.spiders[it->second].nodes.push_back(t.fresh);
      return;
    }
    if (fresh) {  // a node that only gives the reference its rotations
      const int extra = b_.add_node(model.positions[t.node], t.at, "a pinned bar");
      model.spiders[it->second].nodes.push_back(extra);
    }
  }
  for (int c = 0; c < 6; ++c)
    if (((t.mask >> c) & 1u) != 0) b_.equations.follow(t.fresh, c, t.axes, t.node, t.arm, t.at);
}

bool is_weak_nastran_bar(const NastranProperty& p, const NastranBarEnds* ends) {
  const BeamSection& s = p.section;
  if (!(s.A > 0.0) || s.Iy < 0.0 || s.Iz < 0.0 || s.J < 0.0) return false;  // an error
  if (s.Iy == 0.0 && s.Iz == 0.0) return true;
  return (ends == nullptr || ends->plain()) && (s.Iy == 0.0 || s.Iz == 0.0 || s.J == 0.0);
}

std::string weak_nastran_bar_note(const NastranProperty& p) {
  const BeamSection& s = p.section;
  std::string zero;
  const std::pair<const char*, double> values[] = {{"I1", s.Iz}, {"I2", s.Iy}, {"J", s.J}};
  for (const auto& [name, value] : values)
    if (value == 0.0) zero += fmt::format("{}{}", zero.empty() ? "" : ", ", name);
  const bool bends = s.Iy > 0.0 || s.Iz > 0.0;
  return fmt::format("without {} its elements are rods{}{}", zero, s.J > 0.0 ? " with torsion" : "",
                     bends ? " and springs that bend as the beam does (without rotary inertia, "
                             "stress and stress stiffness of bending)"
                           : "");
}

void add_nastran_bending(NastranBuild& build, const FeElement& rod, const BeamSection& s,
                         double shear_modulus, const NastranEntity& bar) {
  FeModel& model = build.model;
  const Vec3 d = model.positions[rod.nodes[1]] - model.positions[rod.nodes[0]];
  Mat3 T;
  if (!find_nastran_bar_axes(build, bar, d, rod.reference, T)) return;
  const double L = d.norm(), E = model.materials[rod.material].young;
  for (const bool xz : {false, true}) {
    const double EI = E * (xz ? s.Iy : s.Iz), area = xz ? s.shear_z : s.shear_y;
    if (EI == 0.0) continue;
    const double phi = area > 0.0 ? 12.0 * EI / (shear_modulus * area * L * L) : 0.0;
    // The slope of the deflection is r about z, and -r about y.
    const Vec3 across = T.col(xz ? 2 : 1), about = xz ? Vec3(-T.col(1)) : Vec3(T.col(2));
    Vec6 left, right, turn = Vec6::Zero();
    left << -across, -0.5 * L * about;
    right << across, -0.5 * L * about;
    turn.tail<3>() = about;
    const std::array<int, 2> nodes = {rod.nodes[0], rod.nodes[1]};
    const std::string name = fmt::format("the bending of {}", bar.label());
    model.springs.push_back(
        {nodes, {left, right}, 12.0 * EI / (L * L * L * (1.0 + phi)), name, rod.source});
    model.springs.push_back({nodes, {Vec6(-turn), turn}, EI / L, name, rod.source});
  }
}

}  // namespace floatframe
