// Surfaces joined by *TIE, and contact pairs, which are joined or left free by the options
// (fe/surface_ties.hpp).
#include <unordered_set>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Data lines "slave, master".
void read_pairs(AbaqusCard& card, AbaqusTie tie) {
  bool any = false;
  for (; card.next(); any = true) {
    if (card.field(0).empty() || card.field(1).empty()) {
      card.error_in_line(ErrorCode::missing,
                         "{}: expected the names of two surfaces, slave and master", card.shown);
      continue;
    }
    tie.where = card.content.named(card.field(0), card.here());
    tie.master = card.content.named(card.field(1), card.here());
    card.content.ties.push_back(tie);
  }
  if (!any)
    card.error(ErrorCode::missing, "has no line with the names of two surfaces, slave and master");
}

/// Do the options ignore contact? With a note then.
bool is_ignored(AbaqusCard& card, const char* what) {
  if (card.content.options.contact != DeckContact::ignore) return false;
  card.note("{} is ignored, as the options say: {}", card.shown, what);
  return true;
}

std::vector<int> nodes_of_surface(AbaqusBuild& build, const AbaqusSurface& surface,
                                  const std::string& name) {
  if (surface.of_nodes) return abaqus_surface_nodes(build, surface);
  std::vector<int> nodes;
  std::unordered_set<int> known;
  for (const ElementFace& f : build.model.surfaces.at(name)) {
    const FeElement& element = build.model.elements[f.element];
    const FaceNodes& face = element_faces(element.type)[f.face];
    for (int k = 0; k < face.count; ++k)
      if (const int node = element.nodes[face.nodes[k]]; known.insert(node).second)
        nodes.push_back(node);
  }
  return nodes;
}

void build_tie(AbaqusBuild& build, const AbaqusTie& raw, std::vector<char>& taken) {
  std::string slave_name, master_name;
  const AbaqusSurface* slave = find_abaqus_surface(build, raw.where, slave_name);
  const AbaqusSurface* master = find_abaqus_surface(build, raw.master, master_name);
  if (slave == nullptr || master == nullptr) return;
  const char* const word = raw.contact ? "*CONTACT PAIR" : "*TIE";
  if (master->of_nodes) {
    build.source.error(ErrorCode::wrong_value, raw.where.at,
                       "{}: the master surface {} is made of nodes, expected faces of elements",
                       word, shown(master_name));
    return;
  }
  SurfaceTie tie = raw.in_model;
  tie.nodes = nodes_of_surface(build, *slave, slave_name);
  tie.faces = build.model.surfaces.at(master_name);
  tie.source = raw.where.at;
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
  build.note(raw.where.at, "{}", text);
}

}  // namespace

void read_abaqus_tie(AbaqusCard& card) {
  if (card.has("CYCLICSYMMETRY"))
    return card.note(
        "{}, CYCLIC SYMMETRY is ignored: the part is one sector, whose cut faces are free",
        card.shown);
  AbaqusTie tie;
  const std::string_view tolerance = card.value("POSITIONTOLERANCE");
  tie.in_model.distance = parse_real(tolerance).value_or(0.0);
  if (card.has("POSITIONTOLERANCE") && !(tie.in_model.distance > 0.0))
    card.error(ErrorCode::out_of_range, "has the position tolerance {}, expected a positive number",
               shown(tolerance));
  tie.in_model.adjust = !same_word(card.value("ADJUST"), "NO");
  tie.in_model.rotations = !card.has("NOROTATION");
  read_pairs(card, tie);
}

/// General contact names no pairs to tie.
void read_abaqus_contact(AbaqusCard& card) {
  if (card.content.only_nodes || is_ignored(card, "its surfaces are free")) return;
  card.error(ErrorCode::unsupported,
             card.content.options.contact == DeckContact::tied
                 ? "is general contact, which names no surfaces to tie: use *TIE, or --contact "
                   "ignore (key `contact`), which leaves all surfaces free"
                 : "is not linear: --contact ignore (key `contact`) leaves all surfaces free");
}

void read_abaqus_contact_pair(AbaqusCard& card) {
  if (card.content.only_nodes || is_ignored(card, "its surfaces are free")) return;
  if (card.content.options.contact == DeckContact::refuse)
    return card.error(ErrorCode::unsupported,
                      "is not linear: --contact ignore (key `contact`) leaves the surfaces free, "
                      "--contact tied joins them where they touch");
  AbaqusTie tie;
  tie.contact = true;
  tie.in_model.adjust = false;
  tie.in_model.distance = card.content.options.contact_distance;
  read_pairs(card, tie);
}

void read_abaqus_gap(AbaqusCard& card) {
  if (card.content.only_nodes)
    return card.note("{} is ignored, as the options say: its nodes are free", card.shown);
  if (is_ignored(card, "its nodes are free")) return;
  card.error(ErrorCode::unsupported,
             "has no linear stiffness: --contact ignore (key `contact`) leaves its nodes free; a "
             "gap that is closed may be a SPRINGA");
}

/// The mesh is connected there; its preload belongs to a step.
void read_abaqus_pre_tension(AbaqusCard& card) {
  card.note("{} is ignored: the bolt is whole and without its preload", card.shown);
  if (card.has("SURFACE") && !card.content.only_nodes)
    card.content.pre_tensions.push_back({card.named("SURFACE")});
}

void build_abaqus_ties(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  if (c.ties.empty()) return;
  // Nodes that already follow a spider or an equation keep it.
  std::vector<char> taken(build.model.positions.size(), 0);
  for (const Spider& s : build.model.spiders)
    if (s.kind == Spider::Kind::rigid)
      for (const int node : s.nodes) taken[node] = 1;
  for (const AbaqusTie& tie : c.ties) build_tie(build, tie, taken);
}

}  // namespace floatframe
