// Nodes, elements, sets and surfaces of Abaqus decks.
#include <cmath>
#include <numbers>

#include "floatframe/core/plural.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

int AbaqusContent::intern(std::string name) {
  const auto [it, added] = name_of_text.emplace(std::move(name), static_cast<int>(names.size()));
  if (added) names.push_back(it->first);
  return it->second;
}

void AbaqusContent::note(const SourceMark& mark, const std::string& text) {
  notes.push_back(fmt::format("{}:{}: {}", mark.file, mark.line, text));
}

std::string abaqus_place(const TextSource& source, const FeSource& at) {
  const SourceMark mark = source.mark(at);
  return fmt::format("{}:{}", mark.file, mark.line);
}

AbaqusReference AbaqusContent::reference(std::string_view field, const FeSource& at) {
  AbaqusReference r;
  r.at = at;
  r.scope = scope;
  if (const std::optional<int> id = parse_label(field)) {
    r.first = r.last = *id;
    return r;
  }
  const std::string name = abaqus_name(field);
  for (std::size_t dot = name.find('.'); dot != std::string::npos && !scope_of_instance.empty();
       dot = name.find('.', dot + 1)) {
    const auto it = scope_of_instance.find(name.substr(0, dot));
    if (it == scope_of_instance.end() || dot + 1 == name.size()) continue;
    r.scope = it->second;
    const std::string rest = name.substr(dot + 1);
    if (const std::optional<int> id = parse_label(rest))
      r.first = r.last = *id;
    else
      r.name = intern(rest);
    return r;
  }
  r.name = intern(name);
  return r;
}

AbaqusReference AbaqusContent::named(std::string_view field, const FeSource& at) {
  AbaqusReference r = reference(field, at);
  if (r.name >= 0) return r;
  std::string name = abaqus_name(field);  // a name of digits, perhaps behind that of an instance
  if (r.scope != scope) name = name.substr(name.rfind('.') + 1);
  return {0, 0, 1, intern(std::move(name)), r.scope, at};
}

std::string AbaqusContent::text(const AbaqusReference& r, std::string_view what) const {
  const std::string where = prefix(r.scope);
  if (r.name < 0) return fmt::format("{} {}{}", what, where, r.first);
  return fmt::format("{} set {}", what, shown(where + names[r.name]));
}

const AbaqusPlacement& AbaqusContent::placement(AbaqusScope of) const {
  static const AbaqusPlacement as_it_stands;
  const auto it = instances.find(of);
  return it == instances.end() ? as_it_stands : it->second.place;
}

std::string AbaqusContent::prefix(AbaqusScope of) const {
  const auto it = instances.find(of);
  return instances.size() < 2 || it == instances.end() ? std::string() : it->second.name + ".";
}

const AbaqusOrientation* AbaqusContent::orientation(AbaqusScope seen_from,
                                                    const std::string& name) const {
  for (const AbaqusScope s : {seen_from, AbaqusScope::assembly, AbaqusScope::part}) {
    const auto it = orientations.find({s, name});
    if (it != orientations.end()) return &it->second;
  }
  return nullptr;
}

namespace {

/// Number of lines with more fields than are read, and location of the first.
struct FurtherFields {
  long count = 0;
  FeSource first;
  void cut(std::vector<std::string_view>& fields, std::size_t most, const FeSource& at) {
    if (count++ == 0) first = at;
    fields.resize(most);
  }
};

/// Fields of an element: id, nodes. A line that ends with a comma, or that has at least fifteen
/// nodes, is continued on the next one. False at the end of the data.
bool read_abaqus_element(AbaqusCard& card, std::size_t count, FeSource& at) {
  std::vector<std::string_view>& fields = card.fields;
  std::string_view line;
  if (!card.lines.next_data(line)) return false;
  at = card.here();
  split_commas(line, fields);
  std::vector<std::string_view> more;
  for (;;) {
    const bool comma = fields.size() > 1 && fields.back().empty();
    if (comma) fields.pop_back();
    if (fields.size() >= count || (!comma && fields.size() < 16) || !card.lines.next_data(line))
      return true;
    split_commas(line, more);
    fields.insert(fields.end(), more.begin(), more.end());
  }
}

/// The range of a line of GENERATE; null and an error if it is none.
std::optional<AbaqusReference> generated_range(AbaqusCard& card, AbaqusScope scope) {
  if (card.fields.size() < 2 || card.fields.size() > 3) {
    card.error_in_line(ErrorCode::wrong_count,
                       "a line of GENERATE has {} numbers, expected first, last and increment",
                       card.fields.size());
    return std::nullopt;
  }
  const int first = card.integer(card.field(0), "first number"),
            last = card.integer(card.field(1), "last number"),
            step = card.fields.size() == 3 ? card.integer(card.field(2), "increment") : 1;
  if (card.misread()) return std::nullopt;
  if (first >= 1 && last >= first && step >= 1)
    return AbaqusReference{first, last, step, -1, scope, card.here()};
  card.error_in_line(ErrorCode::out_of_range, "GENERATE from {} to {} by {} gives no numbers",
                     first, last, step);
  return std::nullopt;
}

/// Can a field be a name? "1.5", "-3" and "0" cannot.
bool may_be_name(std::string_view field) {
  const char first = upper_case(field.substr(0, 1)).front();
  return first == '"' || first == '_' || (first >= 'A' && first <= 'Z') ||
         !parse_real(field).has_value();
}

/// Scope of the parameter INSTANCE; an error if it does not exist.
AbaqusScope scope_of_set(AbaqusCard& card) {
  const AbaqusContent& content = card.content;
  if (card.value("INSTANCE").empty()) return content.scope;
  const auto it = content.scope_of_instance.find(card.word("INSTANCE"));
  if (it != content.scope_of_instance.end()) return it->second;
  card.error(ErrorCode::not_found, "names the instance {}, which does not exist",
             shown(card.value("INSTANCE")));
  return content.scope;
}

/// The coordinates of a line of *NODE, in body axes.
Vec3 coordinates_of(AbaqusCard& card, int id, bool cylindrical) {
  Vec3 p = Vec3::Zero();
  for (std::size_t k = 1; k < card.fields.size(); ++k) {
    if (card.field(k).empty()) continue;
    const std::optional<double> value = parse_real(card.field(k));
    if (value)
      p(static_cast<Eigen::Index>(k) - 1) = *value;
    else
      card.error_in_line(ErrorCode::not_a_number, "coordinate {} of node {}: {}", k, id,
                         not_a_real(card.field(k)));
  }
  if (cylindrical) {
    const double angle = p.y() * std::numbers::pi / 180.0, r = p.x();
    p.head<2>() << r * std::cos(angle), r * std::sin(angle);
  }
  const std::optional<Orientation>& system = card.content.system;
  return system ? Vec3(system->axes * p + system->origin) : p;
}

/// The element of the fields, with its nodes; null and an error if they do not define one.
std::optional<AbaqusElement> element_of_fields(AbaqusCard& card, const AbaqusType& type,
                                               const FeSource& at, FurtherFields& further) {
  AbaqusContent& content = card.content;
  const std::size_t count = static_cast<std::size_t>(type.nodes) + 1;
  const std::optional<int> id = parse_label(card.field(0));
  const auto wrong = [&](ErrorCode code, const std::string& text) {
    card.source.error(code, at, text);
    return std::nullopt;
  };
  if (!id)
    return wrong(ErrorCode::not_a_number, "element number: " + not_an_integer(card.field(0)));
  const bool directed = type.family == AbaqusType::Family::beam && card.fields.size() == count + 1;
  if (directed && content.options.dialect == DeckDialect::calculix)
    return wrong(ErrorCode::unsupported,
                 fmt::format("element {} ({}) has a node for its orientation, which CalculiX does "
                             "not know: give the direction in *BEAM SECTION",
                             *id, type.name));
  if (directed)
    content.clues.add(DeckDialect::abaqus,
                      fmt::format("a node for the orientation of element {}", *id), at);
  if (card.fields.size() > count && type.family == AbaqusType::Family::solid)
    further.cut(card.fields, count, at);
  if (card.fields.size() != count + directed)
    return wrong(ErrorCode::wrong_count,
                 fmt::format("element {} ({}) has {} nodes, expected {}", *id, type.name,
                             card.fields.size() - 1, type.nodes));
  const AbaqusElement element{*id, content.scope, &type, content.element_nodes.size(), directed,
                              at};
  for (std::size_t k = 1; k < card.fields.size(); ++k) {
    const std::optional<int> node = parse_label(card.field(k));
    content.element_nodes.push_back(node.value_or(0));
    if (node) continue;
    wrong(ErrorCode::not_a_number,
          fmt::format("node {} of element {}: {}", k, *id, not_an_integer(card.field(k))));
    break;
  }
  return element;
}

/// From 0; -1 if invalid.
int face_of(std::string_view word) {
  if (same_word(word, "SPOS")) return 0;
  if (same_word(word, "SNEG")) return 1;
  const bool numbered =
      word.size() == 2 && (word[0] == 'S' || word[0] == 's') && word[1] >= '1' && word[1] <= '6';
  return numbered ? word[1] - '1' : -1;
}

/// The surface, empty if it is new; null if what follows does not count.
AbaqusSurface* begin_surface(AbaqusCard& card, bool of_nodes) {
  const std::string_view name = card.value("NAME");
  AbaqusContent& content = card.content;
  AbaqusSurface& surface = content.surfaces[{content.scope, content.intern(abaqus_name(name))}];
  const bool again = surface.at.line != 0;
  if (again && content.options.dialect == DeckDialect::abaqus) {
    card.error(ErrorCode::duplicate, "names the surface {} a second time", shown(name));
    return nullptr;
  }
  if (again) {
    // CalculiX adds to the first one, or keeps nodes and faces with the same name separately.
    const bool both = surface.of_nodes != of_nodes;
    card.note("*SURFACE has {} again ({}): {}", shown(name), card.place(surface.at),
              both ? "of nodes and of faces those of faces count"
                   : "what it names is added, as in CalculiX");
    if (both && of_nodes) return nullptr;
    if (both) surface = {};
  }
  if (surface.at.line == 0) surface.at = card.at;
  surface.of_nodes = of_nodes;
  surface.internal = card.has("INTERNAL");
  return &surface;
}

}  // namespace

void read_abaqus_nodes(AbaqusCard& card) {
  const bool cylindrical = same_word(card.value("SYSTEM"), "C");
  if (card.has("SYSTEM") && !cylindrical && !same_word(card.value("SYSTEM"), "R"))
    card.error(ErrorCode::wrong_value, "has SYSTEM={}, expected R (rectangular) or C (cylindrical)",
               shown(card.value("SYSTEM")));
  AbaqusContent& content = card.content;
  AbaqusSet* const set = card.set(content.node_sets, "NSET");
  card.take_input();
  FurtherFields further;
  while (card.next()) {
    const FeSource at = card.here();
    const std::optional<int> id = parse_label(card.field(0));
    if (!id) {
      card.error_in_line(ErrorCode::not_a_number, "node number: {}", not_an_integer(card.field(0)));
      continue;
    }
    // Direction cosines of shells and beams in Abaqus; ignored by CalculiX.
    if (card.fields.size() > 4) further.cut(card.fields, 4, at);
    const AbaqusNode node{*id, content.scope, coordinates_of(card, *id, cylindrical), at};
    if (add_to_abaqus(card, content.nodes, node, "node") && set != nullptr)
      set->items.push_back({*id, *id, 1, -1, content.scope, at});
  }
  if (further.count > 0)
    content.note(card.source.mark(further.first),
                 fmt::format("fields after the coordinates of {} are ignored",
                             plural(further.count, "node")));
}

void read_abaqus_elements(AbaqusCard& card) {
  AbaqusContent& content = card.content;
  const std::string_view type_name = card.required("TYPE");
  if (type_name.empty()) return;
  const AbaqusType* const type = find_abaqus_type(type_name);
  if (type == nullptr)
    return card.error(ErrorCode::unsupported, "has the type {}, which is not supported{}",
                      shown(type_name),
                      abaqus_name(type_name).starts_with("CONN")
                          ? ": cut the deck there, each body is a part of its own, and the joint "
                            "is one of the model"
                          : did_you_mean(type_name, abaqus_type_names()));
  content.clues.look_at_type(type->name, card.at);
  AbaqusSet* const set = card.set(content.element_sets, "ELSET");
  card.take_input();
  FurtherFields further;
  FeSource at;
  while (read_abaqus_element(card, static_cast<std::size_t>(type->nodes) + 1, at)) {
    const auto element = element_of_fields(card, *type, at, further);
    if (element && add_to_abaqus(card, content.elements, *element, "element") && set != nullptr)
      set->items.push_back({element->id, element->id, 1, -1, content.scope, at});
  }
  if (further.count > 0)
    content.note(
        card.source.mark(further.first),
        fmt::format(
            "{} of type {} with more than {} nodes: the others are ignored, as CalculiX does",
            plural(further.count, "element"), type->name, type->nodes));
}

/// *NSET, *ELSET
void read_abaqus_set(AbaqusCard& card) {
  AbaqusContent& content = card.content;
  const bool of_nodes = card.name == "NSET";
  if (card.required(card.name).empty()) return;
  AbaqusSet& set = *card.set(of_nodes ? content.node_sets : content.element_sets, card.name);
  set.internal = card.has("INTERNAL");
  if (of_nodes && card.has("ELSET"))
    card.error(ErrorCode::unsupported,
               "has the parameter 'ELSET', which is not supported; an element set can be used "
               "wherever its nodes are wanted");
  const AbaqusScope scope = scope_of_set(card);
  card.take_input();
  while (card.next()) {
    if (card.has("GENERATE")) {
      if (const auto range = generated_range(card, scope)) set.items.push_back(*range);
      continue;
    }
    for (const std::string_view field : card.fields) {
      if (field.empty()) continue;
      AbaqusReference item = content.reference(field, card.here());
      if (scope != content.scope) item.scope = scope;
      if (item.name < 0 || may_be_name(field))
        set.items.push_back(item);
      else
        card.error_in_line(ErrorCode::not_a_number, "{} number: {}", of_nodes ? "node" : "element",
                           not_an_integer(field));
    }
  }
}

void read_abaqus_surface(AbaqusCard& card) {
  const std::string_view name = card.required("NAME");
  const bool of_nodes = same_word(card.value("TYPE"), "NODE");
  card.is_one_of("TYPE", "NODE ELEMENT", "has the type {}, expected ELEMENT or NODE");
  AbaqusSurface* const surface = name.empty() ? nullptr : begin_surface(card, of_nodes);
  while (surface != nullptr && card.next()) {
    AbaqusSurface::Item item{{card.reference(0)}};
    const std::string_view face = card.field(1);
    if (of_nodes) item.weight = card.real_or(1, 1.0, "area of a node");
    if (!of_nodes) item.face = face_of(face);
    if (!of_nodes && item.face < 0)
      card.error_in_line(ErrorCode::missing,
                         "surface {}: the face is {}, expected S1 to S6, SPOS or SNEG", shown(name),
                         face.empty() ? "missing" : shown(face));
    else
      surface->items.push_back(item);
  }
}

}  // namespace floatframe
