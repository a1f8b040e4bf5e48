// Cards of nodes, coordinate systems, elements, materials and point masses.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

NastranElement element(NastranFields& f, const char* card) {
  NastranElement e;
  e.card = card;
  e.at = f.at();
  e.id = f.label(0, "the number of the element");
  e.property = f.blank(1) ? e.id : f.label(1, "the property");
  return e;
}

/// THETA or MCID, then ZOFFS.
void shell_axes(NastranFields& f, std::size_t i, NastranElement& e) {
  const std::string_view text = f.text(i);
  if (!text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos) {
    e.material_system = f.integer(i, "the material system MCID", -1);
  } else {
    e.theta = f.real(i, "the material angle THETA", 0.0) * std::numbers::pi / 180.0;
  }
  e.offset = f.real(i + 1, "the offset ZOFFS", 0.0);
}

/// T1 to T4, which with TFLAG 1 are factors of that of the property; negative: none.
void corner_thicknesses(NastranFields& f, std::size_t corners, std::size_t flag,
                        NastranElement& e) {
  for (std::size_t k = 0; k < corners; ++k) {
    e.corner_thickness[k] = f.real(10 + k, "the thickness of a corner", -1.0);
    if (f.blank(10 + k)) continue;
    if (!(e.corner_thickness[k] > 0.0))
      f.error(ErrorCode::out_of_range, "the thickness of a corner is {:g}, expected more than 0",
              e.corner_thickness[k]);
    e.own_thickness = true;
  }
  const int relative = f.integer(flag, "TFLAG", 0);
  if (relative != 0 && relative != 1)
    f.error(ErrorCode::out_of_range, "TFLAG is {}, expected 0 or 1", relative);
  e.relative_thickness = relative == 1;
}

}  // namespace

void read_nastran_grid(NastranFields& f, NastranContent& c) {
  NastranGrid g;
  g.at = f.at();
  g.id = f.label(0, "the number of the node");
  g.cp = f.integer(1, "the coordinate system CP", -1);
  g.x = f.vector(2, "a coordinate");
  g.cd = f.integer(5, "the coordinate system CD", -1);
  if (!f.blank(6)) g.held = f.components(6, "the held components PS");
  c.grids.push_back(g);
}

void read_nastran_grid_default(NastranFields& f, NastranContent& c) {
  c.grid_default.cp = f.integer(1, "the coordinate system CP", 0);
  c.grid_default.cd = f.integer(5, "the coordinate system CD", 0);
  if (!f.blank(6)) c.grid_default.held = f.components(6, "the held components PS");
}

void read_nastran_system(NastranFields& f, NastranContent& c) {
  NastranSystem s;
  s.kind = f.name().back();
  s.at = f.at();
  const int id = f.label(0, "the number of the coordinate system");
  s.rid = f.integer(1, "the reference system RID", 0);
  s.a = f.vector(2, "a coordinate of A");
  s.b = f.vector(5, "a coordinate of B");
  s.c = f.vector(8, "a coordinate of C");
  const auto [it, fresh] = c.systems.try_emplace(id, s);
  if (!fresh && id > 0) nastran_twice(f, it->second.at);
}

/// One or two systems on a card.
void read_nastran_node_system(NastranFields& f, NastranContent& c) {
  for (std::size_t i = 0; i == 0 || (i == 4 && !f.blank(4)); i += 4) {
    NastranNodeSystem s;
    s.kind = f.name().back();
    s.at = f.at();
    const int id = f.label(i, "the number of the coordinate system");
    s.a = f.label(i + 1, "node G1");
    s.b = f.label(i + 2, "node G2");
    s.c = f.label(i + 3, "node G3");
    const auto [it, fresh] = c.node_systems.try_emplace(id, s);
    if (!fresh && id > 0) nastran_twice(f, it->second.at);
  }
}

void read_nastran_solid(NastranFields& f, NastranContent& c) {
  const bool tetra = f.name() == "CTETRA", hexa = f.name() == "CHEXA",
             pyramid = f.name().starts_with("CPYRA");
  NastranElement e = element(f, tetra ? "CTETRA" : hexa ? "CHEXA" : pyramid ? "CPYRAM" : "CPENTA");
  const std::size_t corners = tetra     ? 4
                              : hexa    ? 8
                              : pyramid ? 5
                                        : 6,
                    all = tetra     ? 10
                          : hexa    ? 20
                          : pyramid ? 13
                                    : 15;
  std::size_t given = 0;
  for (std::size_t k = corners; k < all; ++k) given += f.blank(2 + k) ? 0 : 1;
  if (given > 0 && given < all - corners) {
    f.error(ErrorCode::incomplete, "{} of its {} mid-side nodes are given; all or none must be",
            given, all - corners);
    return;
  }
  if (f.size() > 2 + all) {
    f.error(ErrorCode::too_large, "it has more than {} nodes", all);
    return;
  }
  e.count = static_cast<int>(given > 0 ? all : corners);
  for (int k = 0; k < e.count; ++k) {
    // Nastran: bottom edges, vertical edges, top edges; here the vertical ones come last.
    std::size_t to = k;
    if (hexa && k >= 12) to = k < 16 ? k + 4 : k - 4;
    if (!tetra && !hexa && !pyramid && k >= 9) to = k < 12 ? k + 3 : k - 3;
    e.nodes[to] = f.label(2 + k, "a node");
  }
  e.type = tetra     ? (given > 0 ? ElementType::tet10 : ElementType::tet4)
           : hexa    ? (given > 0 ? ElementType::hex20 : ElementType::hex8)
           : pyramid ? (given > 0 ? ElementType::pyramid13 : ElementType::pyramid5)
                     : (given > 0 ? ElementType::wedge15 : ElementType::wedge6);
  c.elements.push_back(e);
}

void read_nastran_surface(NastranFields& f, NastranContent& c) {
  static const char* const cards[] = {"CTRIA3", "CQUAD4", "CTRIA6", "CQUAD8", "CTRIAR", "CQUADR"};
  NastranElement e = element(f, *std::find_if(std::begin(cards), std::end(cards),
                                              [&f](const char* card) { return f.name() == card; }));
  const bool triangle = f.name().starts_with("CTRIA");
  const std::size_t corners = triangle ? 3 : 4;
  e.surface = true;
  const bool midside = f.name() == "CTRIA6" || f.name() == "CQUAD8";
  const std::size_t all = midside ? 2 * corners : corners;
  for (std::size_t k = 0; k < all; ++k) {
    if (k >= corners && f.blank(2 + k)) continue;
    e.nodes[e.count++] = f.label(2 + k, "a node");
  }
  const std::size_t given = e.count - corners;
  e.other = midside && given > 0 && given < corners;
  if (midside && given == corners) {
    e.type = triangle ? ElementType::tri6 : ElementType::quad8;
  } else {
    e.type = triangle ? ElementType::tri3 : ElementType::quad4;
  }
  if (!e.other) {
    shell_axes(f, !midside ? 2 + corners : triangle ? 8 : 14, e);
    corner_thicknesses(f, corners, midside ? (triangle ? 13u : 16u) : 9u, e);
  }
  c.elements.push_back(e);
}

void read_nastran_panel(NastranFields& f, NastranContent& c) {
  NastranElement e = element(f, "CSHEAR");
  e.surface = true;
  e.type = ElementType::shear4;
  for (std::size_t k = 0; k < 4; ++k) e.nodes[e.count++] = f.label(2 + k, "a node");
  c.elements.push_back(e);
}

void read_nastran_material(NastranFields& f, NastranContent& c) {
  NastranMaterial m;
  m.at = f.at();
  const int id = f.label(0, "the number of the material");
  if (!f.blank(1)) m.young = f.real(1, "E");
  if (!f.blank(2)) m.shear = f.real(2, "G");
  if (!f.blank(3)) m.poisson = f.real(3, "NU");
  if (!f.blank(4)) m.density = f.real(4, "RHO");
  const auto [it, fresh] = c.materials.try_emplace(id, m);
  if (!fresh && id > 0) nastran_twice(f, it->second.at);
}

void read_nastran_mass(NastranFields& f, NastranContent& c) {
  NastranMass m;
  m.at = f.at();
  m.id = f.label(0, "the number of the element");
  m.node = f.label(1, "the node");
  m.system = f.integer(2, "the coordinate system CID", 0);
  m.mass = f.real(3, "the mass");
  if (m.mass < 0.0)
    f.error(ErrorCode::out_of_range, "the mass is {:g}, expected no negative number", m.mass);
  m.offset = f.vector(4, "the offset");
  const double I11 = f.real(8, "I11", 0.0), I21 = f.real(9, "I21", 0.0);
  const double I22 = f.real(10, "I22", 0.0), I31 = f.real(11, "I31", 0.0);
  const double I32 = f.real(12, "I32", 0.0), I33 = f.real(13, "I33", 0.0);
  m.J << I11, -I21, -I31, -I21, I22, -I32, -I31, -I32, I33;
  c.masses.push_back(m);
}

}  // namespace floatframe
