// Cards of nodes, coordinate systems, solids and shells.
#include <numbers>

#include "floatframe/decks/nastran/nastran_content.hpp"

namespace floatframe {
namespace {

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
  auto s = f.entity<NastranSystem>("the number of the coordinate system");
  s.rid = f.integer(1, "the reference system RID", 0);
  s.points = {f.vector(2, "a coordinate of A"), f.vector(5, "a coordinate of B"),
              f.vector(8, "a coordinate of C")};
  f.keep(c.systems, std::move(s));
}

/// One or two systems on a card.
void read_nastran_node_system(NastranFields& f, NastranContent& c) {
  for (std::size_t i = 0; i == 0 || (i == 4 && !f.blank(4)); i += 4) {
    auto s = f.entity<NastranSystem>("the number of the coordinate system", i);
    s.nodes = {f.label(i + 1, "node G1"), f.label(i + 2, "node G2"), f.label(i + 3, "node G3")};
    f.keep(c.node_systems, std::move(s));
  }
}

NastranElement mesh_element(NastranFields& f) {
  auto e = f.entity<NastranElement>("the number of the element");
  e.property = f.label(1, "the property", e.id);
  return e;
}

struct SolidCard {
  std::string_view name;
  std::size_t corners, all;
  FeElementType linear, quadratic;
  std::size_t uprights;  ///< vertical edges between the corners of two faces
};

constexpr SolidCard solid_cards[] = {
    {"CTETRA", 4, 10, FeElementType::tet4, FeElementType::tet10, 0},
    {"CHEXA", 8, 20, FeElementType::hex8, FeElementType::hex20, 4},
    {"CPYRAM", 5, 13, FeElementType::pyramid5, FeElementType::pyramid13, 0},  // CPYRA of OptiStruct
    {"CPENTA", 6, 15, FeElementType::wedge6, FeElementType::wedge15, 3}};

void read_nastran_solid(NastranFields& f, NastranContent& c) {
  const SolidCard& card =
      *std::find_if(std::begin(solid_cards), std::end(solid_cards),
                    [&f](const SolidCard& known) { return known.name.starts_with(f.name()); });
  NastranElement e = mesh_element(f);
  e.card = card.name;
  const std::size_t midsides = card.all - card.corners;
  std::size_t given = 0;
  for (std::size_t k = card.corners; k < card.all; ++k) given += f.blank(2 + k) ? 0 : 1;
  if (given > 0 && given < midsides)
    return f.error(ErrorCode::incomplete,
                   "{} of its {} mid-side nodes are given; all or none must be", given, midsides);
  if (f.size() > 2 + card.all)
    return f.error(ErrorCode::too_large, "it has more than {} nodes", card.all);
  const std::size_t count = given > 0 ? card.all : card.corners;
  for (std::size_t k = 0; k < count; ++k) {
    // Nastran: bottom edges, vertical edges, top edges; here the vertical edges are last.
    const std::size_t first = card.corners + card.uprights, n = card.uprights;
    const std::size_t to = n == 0 || k < first ? k : k < first + n ? k + n : k - n;
    e.nodes[to] = f.label(2 + k, "a node");
  }
  e.count = static_cast<int>(count);
  e.type = given > 0 ? card.quadratic : card.linear;
  c.elements.push_back(std::move(e));
}

struct SurfaceCard {
  std::string_view name;
  std::size_t corners;
  bool midside;
  std::size_t axes, flag;  ///< fields of THETA and TFLAG
  FeElementType linear, quadratic;
};

constexpr SurfaceCard surface_cards[] = {
    {"CTRIA3", 3, false, 5, 9, FeElementType::tri3, FeElementType::tri3},
    {"CQUAD4", 4, false, 6, 9, FeElementType::quad4, FeElementType::quad4},
    {"CTRIA6", 3, true, 8, 13, FeElementType::tri3, FeElementType::tri6},
    {"CQUAD8", 4, true, 14, 16, FeElementType::quad4, FeElementType::quad8},
    {"CTRIAR", 3, false, 5, 9, FeElementType::tri3, FeElementType::tri3},
    {"CQUADR", 4, false, 6, 9, FeElementType::quad4, FeElementType::quad4}};

/// THETA or MCID, ZOFFS, then T1 to T4, which with TFLAG 1 are factors of that of the property.
void read_shell_fields(NastranFields& f, const SurfaceCard& card, NastranElement& e) {
  const std::string_view text = f.text(card.axes);
  if (!text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos)
    e.material_system = f.integer(card.axes, "the material system MCID", -1);
  else
    e.theta = f.real(card.axes, "the material angle THETA", 0.0) * std::numbers::pi / 180.0;
  e.offset = f.real(card.axes + 1, "the offset ZOFFS", 0.0);
  for (std::size_t k = 0; k < card.corners; ++k) {
    e.corner_thickness[k] = -1.0;
    if (f.blank(10 + k)) continue;
    e.corner_thickness[k] =
        f.real(10 + k, "the thickness of a corner", -1.0, NastranRange::positive);
    e.own_thickness = true;
  }
  const int relative = f.integer(card.flag, "TFLAG", 0);
  if (relative != 0 && relative != 1)
    f.error(ErrorCode::out_of_range, "TFLAG is {}, expected 0 or 1", relative);
  e.relative_thickness = relative == 1;
}

void read_nastran_surface(NastranFields& f, NastranContent& c) {
  const SurfaceCard& card =
      *std::find_if(std::begin(surface_cards), std::end(surface_cards),
                    [&f](const SurfaceCard& known) { return f.name() == known.name; });
  NastranElement e = mesh_element(f);
  e.surface = true;
  const std::size_t all = card.midside ? 2 * card.corners : card.corners;
  for (std::size_t k = 0; k < all; ++k)
    if (k < card.corners || !f.blank(2 + k)) e.nodes[e.count++] = f.label(2 + k, "a node");
  const std::size_t given = e.count - card.corners;
  e.other = given > 0 && given < card.corners;
  e.type = given == card.corners ? card.quadratic : card.linear;
  if (!e.other) read_shell_fields(f, card, e);
  c.elements.push_back(std::move(e));
}

void read_nastran_panel(NastranFields& f, NastranContent& c) {
  NastranElement e = mesh_element(f);
  e.surface = true;
  e.type = FeElementType::shear4;
  for (std::size_t k = 0; k < 4; ++k) e.nodes[e.count++] = f.label(2 + k, "a node");
  c.elements.push_back(std::move(e));
}

}  // namespace

std::span<const NastranCardReader> nastran_mesh_cards() {
  static constexpr NastranCardReader cards[] = {
      {"GRID", read_nastran_grid},
      {"GRDSET", read_nastran_grid_default},
      {"CORD2R CORD2C CORD2S", read_nastran_system},
      {"CORD1R CORD1C CORD1S", read_nastran_node_system},
      {"CTETRA CHEXA CPYRAM CPYRA CPENTA", read_nastran_solid},
      {"CTRIA3 CQUAD4 CTRIA6 CQUAD8 CTRIAR CQUADR", read_nastran_surface},
      {"CSHEAR", read_nastran_panel}};
  return cards;
}

}  // namespace floatframe
