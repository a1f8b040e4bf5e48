// Surfaces joined by *TIE, and contact pairs, which are joined or left free as the options say
// (fe/surface_ties.hpp).
#include <fmt/format.h>

#include <unordered_set>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/surface_ties.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Data lines "slave, master".
void read_pairs(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
                const AbaqusTie& pattern) {
  std::vector<std::string_view> fields;
  bool any = false;
  while (lines.next_fields(fields)) {
    any = true;
    if (fields.size() < 2 || fields[0].empty() || fields[1].empty()) {
      lines.source().error(ErrorCode::missing,
                           "{}: expected the names of two surfaces, slave and master",
                           keyword.shown);
      continue;
    }
    AbaqusTie tie = pattern;
    tie.at = lines.source().here();
    tie.slave = content.named(fields[0], tie.at);
    tie.master = content.named(fields[1], tie.at);
    content.ties.push_back(tie);
  }
  if (!any)
    lines.error(ErrorCode::missing, keyword,
                "has no line with the names of two surfaces, slave and master");
}

std::vector<int> nodes_of_surface(AbaqusBuild& build, const AbaqusSurface& surface,
                                  const std::string& name) {
  std::vector<int> nodes;
  if (surface.of_nodes) {
    for (const AbaqusSurface::Item& item : surface.items) {
      const std::vector<int> found = build.nodes.resolve(item.where);
      nodes.insert(nodes.end(), found.begin(), found.end());
    }
    return nodes;
  }
  std::unordered_set<int> known;
  for (const ElementFace& f : build.model.surfaces.at(name)) {
    const Element& element = build.model.elements[f.element];
    const FaceNodes& face = element_faces(element.type)[f.face];
    for (int k = 0; k < face.count; ++k)
      if (const int node = element.nodes[face.nodes[k]]; known.insert(node).second)
        nodes.push_back(node);
  }
  return nodes;
}

void build_tie(AbaqusBuild& build, const AbaqusTie& raw, std::vector<char>& taken) {
  std::string slave_name, master_name;
  const AbaqusSurface* slave = find_abaqus_surface(build, raw.slave, slave_name);
  const AbaqusSurface* master = find_abaqus_surface(build, raw.master, master_name);
  if (slave == nullptr || master == nullptr) return;
  const char* const word = raw.contact ? "*CONTACT PAIR" : "*TIE";
  if (master->of_nodes) {
    build.source.error(ErrorCode::wrong_value, raw.at,
                       "{}: the master surface {} is made of nodes, expected faces of elements",
                       word, shown(master_name));
    return;
  }
  SurfaceTie tie;
  tie.nodes = nodes_of_surface(build, *slave, slave_name);
  tie.faces = build.model.surfaces.at(master_name);
  tie.distance = raw.distance;
  tie.adjust = raw.adjust;
  tie.rotations = raw.rotations;
  tie.source = raw.at;
  if (build.clues.abaqus && !build.clues.calculix) tie.part_of_size = 0.05;
  const TiedNodes done = add_surface_tie(build.model, tie, taken);
  std::string text = fmt::format("{}: {} of {} nodes of {} are tied to {} (within {:.3g})", word,
                                 done.tied, done.tied + static_cast<int>(done.free.size()),
                                 shown(slave_name), shown(master_name), done.distance);
  if (done.moved > 1e-9 * done.distance)
    text += fmt::format("; they were moved by up to {:.3g}", done.moved);
  if (!done.free.empty())
    text += fmt::format("; not tied: {}{}", build.model.node_label(done.free.front()),
                        done.free.size() > 1 ? ", ..." : "");
  build.note(raw.at, text);
}

}  // namespace

void read_abaqus_tie(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  lines.allow_only(keyword, {"NAME", "ADJUST", "POSITIONTOLERANCE", "CYCLICSYMMETRY", "TYPE",
                             "NOROTATION", "CONSTRAINTRATIO", "NOTHICKNESS"});
  if (keyword.has("CYCLICSYMMETRY")) {
    const SourceMark mark = lines.source().mark(keyword.at);
    content.notes.push_back(fmt::format(
        "{}:{}: {}, CYCLIC SYMMETRY is ignored: the part is one sector, whose cut faces are free",
        mark.file, mark.line, keyword.shown));
    return lines.skip_data();
  }
  AbaqusTie tie;
  if (keyword.has("POSITIONTOLERANCE")) {
    const std::string_view text = keyword.value("POSITIONTOLERANCE");
    tie.distance = parse_real(text).value_or(0.0);
    if (!(tie.distance > 0.0)) {
      lines.error(ErrorCode::out_of_range, keyword,
                  "has the position tolerance {}, expected a positive number", shown(text));
    }
  }
  tie.adjust = !same_word(keyword.value("ADJUST"), "NO");
  tie.rotations = !keyword.has("NOROTATION");
  read_pairs(lines, keyword, content, tie);
}

/// General contact names no pairs to tie.
void read_abaqus_general_contact(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                 AbaqusContent& content) {
  lines.skip_data();
  if (content.only_nodes) return;
  if (content.contact != DeckContact::ignore) {
    lines.error(ErrorCode::unsupported, keyword,
                content.contact == DeckContact::tied
                    ? "is general contact, which names no surfaces to tie: use *TIE, or --contact "
                      "ignore (key `contact`), which leaves all surfaces free"
                    : "is not linear: --contact ignore (key `contact`) leaves all surfaces free");
    return;
  }
  const SourceMark mark = lines.source().mark(keyword.at);
  content.notes.push_back(
      fmt::format("{}:{}: {} is ignored, as the options say: its surfaces are free", mark.file,
                  mark.line, keyword.shown));
}

void read_abaqus_contact_pair(AbaqusLines& lines, const AbaqusKeyword& keyword,
                              AbaqusContent& content) {
  using Contact = DeckContact;
  if (content.only_nodes) return lines.skip_data();
  if (content.contact == Contact::refuse) {
    lines.error(ErrorCode::unsupported, keyword,
                "is not linear: --contact ignore (key `contact`) leaves the surfaces free, "
                "--contact tied joins them where they touch");
    return lines.skip_data();
  }
  if (content.contact == Contact::ignore) {
    const SourceMark mark = lines.source().mark(keyword.at);
    content.notes.push_back(
        fmt::format("{}:{}: {} is ignored, as the options say: its surfaces are free", mark.file,
                    mark.line, keyword.shown));
    return lines.skip_data();
  }
  AbaqusTie tie;
  tie.contact = true;
  tie.adjust = false;
  tie.distance = content.contact_distance;
  read_pairs(lines, keyword, content, tie);
}

void build_abaqus_ties(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  if (c.ties.empty()) return;
  // Who follows a spider or an equation already stays with it.
  std::vector<char> taken(build.model.positions.size(), 0);
  for (const Spider& s : build.model.spiders)
    if (s.kind == Spider::Kind::rigid)
      for (const int node : s.nodes) taken[node] = 1;
  for (const AbaqusTie& tie : c.ties) build_tie(build, tie, taken);
}

}  // namespace floatframe
