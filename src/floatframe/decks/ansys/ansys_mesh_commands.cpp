// Nodes, elements, components and coordinate systems, as CDWRITE writes them (blocked and
// unblocked) and as a user does.
#include <algorithm>
#include <limits>

#include "floatframe/decks/ansys/ansys_content.hpp"
#include "floatframe/decks/number_sizes.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

int add_node(AnsysFields& f, AnsysContent& c, int id, const Vec3& p, const FeSource& at) {
  if (id < 1)
    f.source().stop(ErrorCode::out_of_range, at, "a node has the number {}, expected is 1 or more",
                    id);
  const auto [it, fresh] = c.node_index.try_emplace(id, c.model.nodes());
  if (!fresh) {
    f.source().error(ErrorCode::duplicate, at, "node {} is in the file twice, first in line {}", id,
                     c.model.node_sources[it->second].line);
    return it->second;
  }
  if (const std::string huge = huge_place(p); !huge.empty())
    f.source().error(ErrorCode::not_finite, at, "node {}: {}", id, huge);
  c.model.positions.push_back(p);
  c.model.node_ids.push_back(id);
  c.model.node_sources.push_back(at);
  return it->second;
}

/// A block whose stated number of nodes or elements differs from its lines.
void note_count(AnsysFields& f, AnsysContent& c, double said, std::size_t found, const char* what) {
  if (said > 0.0 && said != static_cast<double>(found))
    f.source().note(
        c.model, f.at(),
        "{} announces {:.0f} {}, {} follow: if the file is not cut short, nothing is missing",
        f.command(), said, what, found);
}

void set_angles(AnsysContent& c, int index, const Vec3& angles) {
  if (!angles.isZero(0.0)) c.node_angles[index] = angles;
}

/// With the attributes that are set, its nodes to come.
AnsysElement next_element(const AnsysContent& c, const FeSource& at) {
  AnsysElement e = c.current;
  e.at = at;
  e.first = c.element_nodes.size();
  return e;
}

void add_element(AnsysFields& f, AnsysContent& c, AnsysElement e) {
  if (e.id < 1)
    f.source().stop(ErrorCode::out_of_range, e.at,
                    "an element has the number {}, expected is 1 or more", e.id);
  const auto [it, fresh] = c.element_index.try_emplace(e.id, c.elements.size());
  if (!fresh)
    f.source().error(ErrorCode::duplicate, e.at,
                     "element {} is in the file twice, first in line {}", e.id,
                     c.elements[it->second].at.line);
  c.highest_element = std::max(c.highest_element, e.id);
  c.elements.push_back(e);
}

/// Nodes of the fields from `first`; blank ones are 0.
void append_nodes(AnsysFields& f, AnsysContent& c, AnsysElement& e, std::size_t first) {
  for (std::size_t k = first; k < f.size(); ++k) {
    if (e.nodes == 20)
      f.stop(ErrorCode::too_large, "element {} has more than 20 nodes, which no element has", e.id);
    c.element_nodes.push_back(f.integer(k, "the node"));
    ++e.nodes;
  }
}

/// N,R5.3,LOC,node,solid,line,x,y,z and N,R5.3,ANG,...; N,node,x,y,z,thxy,thyz,thzx.
void read_ansys_node(AnsysFields& f, AnsysContent& c) {
  if (!ansys_written(f)) {
    if (c.nodal_system != 0)
      f.stop(ErrorCode::unsupported,
             "N: the node is in coordinate system {} (CSYS), only nodes in global rectangular "
             "coordinates are read",
             c.nodal_system);
    const int id = f.label(1, "the number of the node");
    const int index = add_node(f, c, id, f.three(2, "the coordinate"), f.at());
    return set_angles(c, index, f.three(5, "the angle"));
  }
  const int id = f.integer(3, "the number of the node");
  if (id == -1) return;  // the end of a block
  if (f.word(2) == "LOC") {
    add_node(f, c, id, f.three(6, "the coordinate"), f.at());
  } else if (f.word(2) == "ANG") {
    const auto it = c.node_index.find(id);
    if (it == c.node_index.end())
      return f.source().error(ErrorCode::not_found, f.at(),
                              "N: angles of node {}, which is not in the file before", id);
    set_angles(c, it->second, f.three(6, "the angle"));
  } else {
    f.stop(ErrorCode::wrong_value, "N: expected LOC or ANG, found {}", shown(f.text(2)));
  }
}

void read_ansys_node_block(AnsysFields& f, AnsysContent& c) {
  const FortranColumns format = f.columns();
  const std::size_t first = format.integers();
  if (first == 0 || format.columns.size() < first + 3)
    f.stop(ErrorCode::missing,
           "NBLOCK: its format has no column for the number of the node or not three for its "
           "coordinates");
  const double said = f.number(4).value_or(0.0);
  const std::size_t before = c.model.positions.size();
  while (f.row(format)) {
    const FeSource at = f.source().here();
    const int id = f.cell_integer(0, "the number of the node");
    Vec3 p, angles = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      p(k) = f.cell_real(first + k, "the coordinate");
      angles(k) = f.cell_real(first + 3 + k, "the angle");
    }
    set_angles(c, add_node(f, c, id, p, at), angles);
  }
  note_count(f, c, said, c.model.positions.size() - before, "nodes");
}

/// EN,R5.5,ATTR,... and EN,R5.5,NODE,...
void read_written_element(AnsysFields& f, AnsysContent& c) {
  if (f.word(2) == "NODE") {
    if (c.elements.empty()) f.stop(ErrorCode::missing, "EN: nodes, but no line ATTR before them");
    for (std::size_t k = 3; k < f.size(); ++k) {
      if (f.blank(k)) continue;
      c.element_nodes.push_back(f.integer(k, "the node"));
      ++c.elements.back().nodes;
    }
    return;
  }
  if (f.word(2) != "ATTR")
    f.stop(ErrorCode::wrong_value, "EN: expected ATTR or NODE, found {}", shown(f.text(2)));
  if (f.integer(3, "the number of nodes") == -1) return;  // the end of a block
  AnsysElement e = next_element(c, f.at());
  e.material = f.integer(4, "the material");
  e.type = f.integer(5, "the type");
  e.real = f.integer(6, "the real constants");
  e.section = f.integer(7, "the section");
  e.system = f.integer(8, "the coordinate system");
  e.id = f.integer(9, "the number of the element");
  add_element(f, c, e);
}

/// EN,number,nodes; E,nodes.
void read_ansys_element(AnsysFields& f, AnsysContent& c) {
  const bool numbered = f.command() == "EN";
  if (numbered && ansys_written(f)) return read_written_element(f, c);
  AnsysElement e = next_element(c, f.at());
  if (!numbered && c.highest_element == std::numeric_limits<int>::max())
    f.stop(ErrorCode::not_a_number, "E: there is no number above 2147483647 for the element");
  e.id = numbered ? f.label(1, "the number of the element") : c.highest_element + 1;
  append_nodes(f, c, e, numbered ? 2 : 1);
  add_element(f, c, e);
}

void read_ansys_element_more(AnsysFields& f, AnsysContent& c) {
  if (c.elements.empty()) f.stop(ErrorCode::missing, "EMORE: there is no element before");
  AnsysElement& e = c.elements.back();
  while (e.nodes < 8) {  // E has room for eight
    c.element_nodes.push_back(0);
    ++e.nodes;
  }
  append_nodes(f, c, e, 1);
}

/// EBLOCK,19,SOLID: material, type, real, section, system, three more, number of nodes, one more,
/// number of the element, nodes. Without SOLID: number, section, real, material, system, nodes, of
/// the type set by TYPE.
void read_ansys_element_block(AnsysFields& f, AnsysContent& c) {
  const bool solid = f.word(2) == "SOLID";
  const FortranColumns format = f.columns();
  const std::size_t lead = solid ? 11 : 5;
  if (format.integers() != format.columns.size() || format.columns.size() <= lead)
    f.stop(ErrorCode::wrong_count,
           "EBLOCK: its format has {} columns of whole numbers, expected more than {}",
           format.integers(), lead);
  const double said = f.number(4).value_or(0.0);
  const std::size_t before = c.elements.size();
  while (f.row(format)) {
    AnsysElement e = next_element(c, f.source().here());
    e.material = f.cell_integer(solid ? 0 : 3, "the material");
    e.real = f.cell_integer(2, "the real constants");
    e.section = f.cell_integer(solid ? 3 : 1, "the section");
    e.system = f.cell_integer(4, "the coordinate system");
    e.id = f.cell_integer(solid ? 10 : 0, "the number of the element");
    if (solid) e.type = f.cell_integer(1, "the type");
    e.nodes = solid ? f.cell_integer(8, "the number of nodes") : static_cast<int>(f.cells() - lead);
    if (f.cells() <= lead || e.nodes < 1 || e.nodes > 20)
      f.source().stop(ErrorCode::wrong_count, e.at, "element {} has {} nodes, expected 1 to 20",
                      e.id, f.cells() <= lead ? 0 : e.nodes);
    f.append_cells(lead, "the node", c.element_nodes);
    const std::size_t end = e.first + e.nodes;
    while (c.element_nodes.size() < end && f.row(format))
      f.append_cells(0, "the node", c.element_nodes);
    if (c.element_nodes.size() != end)
      f.source().stop(ErrorCode::wrong_count, e.at,
                      "element {} has {} nodes in its first line, but {} are listed", e.id, e.nodes,
                      c.element_nodes.size() - e.first);
    add_element(f, c, e);
  }
  note_count(f, c, said, c.elements.size() - before, "elements");
}

void read_ansys_component(AnsysFields& f, AnsysContent& c) {
  AnsysComponent component;
  component.at = f.at();
  component.name = f.word(1);
  if (component.name.empty())
    f.stop(ErrorCode::missing, "CMBLOCK: the name of the component is missing");
  const std::string kind = f.word(2);
  const int count = f.integer(3, "the number of members");
  const FortranColumns format = f.columns();
  component.elements = begins_with(kind, "ELEM");
  const bool known = component.elements || begins_with(kind, "NODE");
  int found = 0;
  while (found < count && f.row(format)) {
    f.append_cells(0, "the member", component.members);
    found += static_cast<int>(f.cells());
  }
  if (found != count)
    f.stop(ErrorCode::wrong_count,
           "CMBLOCK: component {} has {} members in its first line, but {} are listed",
           component.name, count, found);
  if (known)
    c.components.push_back(std::move(component));
  else
    c.ignored.try_emplace(fmt::format("CMBLOCK of {}", shown(f.text(2))), f.at());
}

/// LOCAL,R5.0,LOC,number,kind,x,y,z, ...,ANG,..., ...,PRM,...;
/// LOCAL,number,kind,x,y,z,angles,p1,p2.
void read_ansys_system(AnsysFields& f, AnsysContent& c) {
  const bool written = ansys_written(f);
  const std::size_t at = written ? 3 : 1;
  const int id = f.label(at, "the number of the coordinate system");
  if (id < 11)
    f.stop(ErrorCode::out_of_range, "LOCAL: coordinate system {}, expected a number of 11 or more",
           id);
  AnsysSystem& s = c.systems[id];
  s.at = f.at();
  s.kind = f.integer(at + 1, "the kind of the coordinate system");
  if (s.kind < 0 || s.kind > 3)
    f.stop(ErrorCode::out_of_range, "LOCAL: coordinate system {} is of kind {}, expected 0 to 3",
           id, s.kind);
  const std::string part = written ? f.word(2) : std::string("LOC");
  const auto round = [&](std::size_t k) {
    return f.real(k, "the parameter", 1.0) == 1.0 && f.real(k + 1, "the parameter", 1.0) == 1.0;
  };
  if (part == "LOC") {
    s.origin = f.three(at + 2, "the origin");
    if (!written) {
      s.angles = f.three(at + 5, "the angle");
      s.round = round(at + 8);
      c.nodal_system = id;
    }
  } else if (part == "ANG") {
    s.angles = f.three(at + 2, "the angle");
  } else if (part == "PRM") {
    s.round = s.kind == 0 || round(at + 2);
  } else {
    f.stop(ErrorCode::wrong_value, "LOCAL: expected LOC, ANG or PRM, found {}", shown(f.text(2)));
  }
}

constexpr AnsysCommand mesh_commands[] = {
    {"N", read_ansys_node},
    {"NBLOCK", read_ansys_node_block},
    {"E", read_ansys_element},
    {"EN", read_ansys_element},
    {"EMORE", read_ansys_element_more},
    {"EBLOCK", read_ansys_element_block},
    {"CMBLOCK", read_ansys_component},
    {"LOCAL", read_ansys_system},
};

}  // namespace

bool ansys_written(const AnsysFields& f) {
  const std::string mark = f.word(1);
  return mark == "UNBL" || (mark.size() > 2 && mark[0] == 'R' && mark[2] == '.');
}

std::span<const AnsysCommand> ansys_mesh_commands() { return mesh_commands; }

}  // namespace floatframe
