// Nodes, elements, sets and surfaces of Abaqus decks.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "floatframe/core/plural.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
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
    if (const std::optional<int> id = parse_label(rest)) {
      r.first = r.last = *id;
    } else {
      r.name = intern(rest);
    }
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

AbaqusReference number(int id, AbaqusScope scope, const FeSource& at) {
  return {id, id, 1, -1, scope, at};
}

/// The set that a parameter names, for elements and nodes that are put into it as they are read.
AbaqusSet* set_of_parameter(std::map<AbaqusContent::Key, AbaqusSet>& sets,
                            const AbaqusKeyword& keyword, std::string_view parameter,
                            AbaqusContent& content) {
  const std::string_view name = keyword.value(parameter);
  if (name.empty()) return nullptr;
  AbaqusSet& set = sets[{content.scope, content.intern(abaqus_name(name))}];
  if (set.at.line == 0) set.at = keyword.at;
  return &set;
}

/// Fields of an element: id, nodes. A line that ends with a comma, or that has fifteen nodes and
/// more, goes on in the next one. False at the end of the data.
bool element_fields(AbaqusLines& lines, std::size_t count, std::vector<std::string_view>& fields,
                    FeSource& at) {
  std::string_view line;
  if (!lines.next_data(line)) return false;
  at = lines.source().here();
  split_commas(line, fields);
  std::vector<std::string_view> more;
  for (;;) {
    const bool comma = fields.size() > 1 && fields.back().empty();
    if (comma) fields.pop_back();
    if (fields.size() >= count || (!comma && fields.size() < 16) || !lines.next_data(line)) {
      return true;
    }
    split_commas(line, more);
    fields.insert(fields.end(), more.begin(), more.end());
  }
}

void read_set(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
              bool of_nodes) {
  const std::string_view parameter = of_nodes ? "NSET" : "ELSET";
  lines.allow_only(keyword,
                   {parameter, "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED", "ELSET", "INPUT"});
  const std::string_view name = lines.required(keyword, parameter);
  if (name.empty()) return lines.skip_data();
  AbaqusSet& set =
      (of_nodes ? content.node_sets
                : content.element_sets)[{content.scope, content.intern(abaqus_name(name))}];
  if (set.at.line == 0) set.at = keyword.at;
  set.internal = keyword.has("INTERNAL");
  if (of_nodes && keyword.has("ELSET")) {
    lines.error(ErrorCode::unsupported, keyword,
                "has the parameter 'ELSET', which is not supported; an element set can be used "
                "wherever its nodes are wanted");
  }
  AbaqusScope scope = content.scope;
  if (const std::string_view instance = keyword.value("INSTANCE"); !instance.empty()) {
    const auto it = content.scope_of_instance.find(abaqus_name(instance));
    if (it == content.scope_of_instance.end()) {
      lines.error(ErrorCode::not_found, keyword, "names the instance {}, which does not exist",
                  shown(instance));
    } else {
      scope = it->second;
    }
  }
  const std::string_view what = of_nodes ? "node number" : "element number";
  lines.take_input(keyword);
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    const FeSource at = lines.source().here();
    if (keyword.has("GENERATE")) {
      if (fields.size() < 2 || fields.size() > 3) {
        lines.source().error(
            ErrorCode::wrong_count,
            "a line of GENERATE has {} numbers, expected first, last and increment", fields.size());
        continue;
      }
      AbaqusReference range;
      range.first = lines.integer(fields[0], "first number");
      range.last = lines.integer(fields[1], "last number");
      range.step = fields.size() == 3 ? lines.integer(fields[2], "increment") : 1;
      range.scope = scope;
      range.at = at;
      if (lines.misread()) continue;
      if (range.first < 1 || range.last < range.first || range.step < 1) {
        lines.source().error(ErrorCode::out_of_range,
                             "GENERATE from {} to {} by {} gives no numbers", range.first,
                             range.last, range.step);
        continue;
      }
      set.items.push_back(range);
      continue;
    }
    for (const std::string_view field : fields) {
      if (field.empty()) continue;
      AbaqusReference item = content.reference(field, at);
      if (scope != content.scope) item.scope = scope;
      const bool letter = field.front() == '"' || field.front() == '_' ||
                          (field.front() >= 'A' && field.front() <= 'Z') ||
                          (field.front() >= 'a' && field.front() <= 'z');
      // "1.5", "-3" and "0" are no names.
      if (item.name >= 0 && !letter && parse_real(field).has_value()) {
        lines.source().error(ErrorCode::not_a_number, "{}: {}", what, not_an_integer(field));
        continue;
      }
      set.items.push_back(item);
    }
  }
}

}  // namespace

void read_abaqus_nodes(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  lines.allow_only(keyword, {"NSET", "SYSTEM", "INPUT"});
  const bool round = same_word(keyword.value("SYSTEM"), "C");
  if (keyword.has("SYSTEM") && !round && !same_word(keyword.value("SYSTEM"), "R"))
    lines.error(ErrorCode::wrong_value, keyword,
                "has SYSTEM={}, expected R (rectangular) or C (cylindrical)",
                shown(keyword.value("SYSTEM")));
  AbaqusSet* const set = set_of_parameter(content.node_sets, keyword, "NSET", content);
  lines.take_input(keyword);
  std::vector<std::string_view> fields;
  long further = 0;
  FeSource first_further;
  while (lines.next_fields(fields)) {
    const FeSource at = lines.source().here();
    const std::optional<int> id = parse_label(fields[0]);
    if (!id) {
      lines.source().error(ErrorCode::not_a_number, "node number: " + not_an_integer(fields[0]));
      continue;
    }
    // Direction cosines of shells and beams in Abaqus; CalculiX looks at nothing there.
    if (fields.size() > 4) {
      if (further++ == 0) first_further = at;
      fields.resize(4);
    }
    AbaqusNode node{*id, content.scope, Vec3::Zero(), at};
    for (std::size_t k = 1; k < fields.size(); ++k) {
      if (fields[k].empty()) continue;
      const std::optional<double> value = parse_real(fields[k]);
      if (!value) {
        lines.source().error(ErrorCode::not_a_number, "coordinate {} of node {}: {}", k, *id,
                             not_a_real(fields[k]));
        continue;
      }
      node.p[static_cast<Eigen::Index>(k) - 1] = *value;
    }
    if (round) {
      const double angle = node.p.y() * std::numbers::pi / 180.0, r = node.p.x();
      node.p.head<2>() << r * std::cos(angle), r * std::sin(angle);
    }
    if (content.system) node.p = content.system->axes * node.p + content.system->origin;
    const auto [it, added] = content.node_of_label.emplace(AbaqusContent::label(content.scope, *id),
                                                           static_cast<int>(content.nodes.size()));
    if (!added) {
      const SourceMark first = lines.source().mark(content.nodes[it->second].at);
      lines.source().error(ErrorCode::duplicate, "node {} is there already ({}:{})", *id,
                           first.file, first.line);
      continue;
    }
    content.nodes.push_back(node);
    if (set != nullptr) set->items.push_back(number(*id, content.scope, at));
  }
  if (further > 0) {
    content.note(lines.source().mark(first_further),
                 fmt::format("what stands behind the coordinates of {} is ignored",
                             plural(further, "node")));
  }
}

void read_abaqus_elements(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  lines.allow_only(keyword, {"TYPE", "ELSET", "INPUT"});
  const std::string_view type_name = lines.required(keyword, "TYPE");
  if (type_name.empty()) return lines.skip_data();
  const AbaqusType* const type = find_abaqus_type(type_name);
  if (type == nullptr) {
    const bool connector = abaqus_name(type_name).starts_with("CONN");
    lines.error(ErrorCode::unsupported, keyword, "has the type {}, which is not supported{}",
                shown(type_name),
                connector ? ": cut the deck there, each body is a part of its own, and the joint "
                            "is one of the model"
                          : did_you_mean(type_name, abaqus_type_names()));
    return lines.skip_data();
  }
  content.clues.look_at_type(type->name, keyword.at);
  AbaqusSet* const set = set_of_parameter(content.element_sets, keyword, "ELSET", content);
  lines.take_input(keyword);
  std::vector<std::string_view> fields;
  const std::size_t count = type->nodes + 1;
  long further = 0;
  FeSource first_further;
  FeSource at;
  while (element_fields(lines, count, fields, at)) {
    const std::optional<int> id = parse_label(fields[0]);
    if (!id) {
      lines.source().error(ErrorCode::not_a_number, at,
                           "element number: " + not_an_integer(fields[0]));
      continue;
    }
    const bool directed = type->family == AbaqusType::Family::beam && fields.size() == count + 1;
    if (directed && content.dialect == DeckDialect::calculix) {
      lines.source().error(ErrorCode::unsupported, at,
                           "element {} ({}) has a node for its orientation, which CalculiX does "
                           "not know: give the direction in *BEAM SECTION",
                           *id, type->name);
      continue;
    }
    if (directed)
      content.clues.add(DeckDialect::abaqus,
                        fmt::format("a node for the orientation of element {}", *id), at);
    if (fields.size() > count && type->family == AbaqusType::Family::solid) {
      if (further++ == 0) first_further = at;
      fields.resize(count);
    }
    if (fields.size() != count + directed) {
      lines.source().error(ErrorCode::wrong_count, at, "element {} ({}) has {} nodes, expected {}",
                           *id, type->name, fields.size() - 1, type->nodes);
      continue;
    }
    AbaqusElement element{*id, content.scope, type, content.element_nodes.size(), directed, at};
    bool valid = true;
    for (std::size_t k = 1; k < count + directed && valid; ++k) {
      const std::optional<int> node = parse_label(fields[k]);
      if (!node) {
        lines.source().error(ErrorCode::not_a_number, at, "node {} of element {}: {}", k, *id,
                             not_an_integer(fields[k]));
      }
      valid = node.has_value();
      content.element_nodes.push_back(node.value_or(0));
    }
    const auto [it, added] = content.element_of_label.emplace(
        AbaqusContent::label(content.scope, *id), static_cast<int>(content.elements.size()));
    if (!added) {
      const SourceMark first = lines.source().mark(content.elements[it->second].at);
      lines.source().error(ErrorCode::duplicate, at, "element {} is there already ({}:{})", *id,
                           first.file, first.line);
      continue;
    }
    content.elements.push_back(element);
    if (set != nullptr) set->items.push_back(number(*id, content.scope, at));
  }
  if (further > 0) {
    content.note(
        lines.source().mark(first_further),
        fmt::format(
            "{} of type {} with more than {} nodes: the others are ignored, as CalculiX does",
            plural(further, "element"), type->name, type->nodes));
  }
}

void read_abaqus_node_set(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  read_set(lines, keyword, content, true);
}

void read_abaqus_element_set(AbaqusLines& lines, const AbaqusKeyword& keyword,
                             AbaqusContent& content) {
  read_set(lines, keyword, content, false);
}

void read_abaqus_surface(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  lines.allow_only(keyword, {"NAME", "TYPE", "INTERNAL"});
  const std::string_view name = lines.required(keyword, "NAME");
  const std::string_view type = keyword.value("TYPE");
  const bool of_nodes = same_word(type, "NODE");
  if (!type.empty() && !of_nodes && !same_word(type, "ELEMENT")) {
    lines.error(ErrorCode::wrong_value, keyword, "has the type {}, expected ELEMENT or NODE",
                shown(type));
  }
  if (name.empty()) return lines.skip_data();
  AbaqusSurface& surface = content.surfaces[{content.scope, content.intern(abaqus_name(name))}];
  if (surface.at.line != 0 && content.dialect == DeckDialect::abaqus) {
    lines.error(ErrorCode::duplicate, keyword, "names the surface {} a second time", shown(name));
    return lines.skip_data();
  }
  if (surface.at.line != 0) {
    // CalculiX adds to the first one, or keeps nodes and faces of one name beside each other.
    const SourceMark first = lines.source().mark(surface.at);
    const bool both = surface.of_nodes != of_nodes;
    content.note(
        lines.source().mark(keyword.at),
        fmt::format("*SURFACE has {} again ({}:{}): {}", shown(name), first.file, first.line,
                    both ? "of nodes and of faces those of faces count"
                         : "what it names is added, as in CalculiX"));
    if (both && of_nodes) return lines.skip_data();
    if (both) surface = {};
  }
  if (surface.at.line == 0) surface.at = keyword.at;
  surface.of_nodes = of_nodes;
  surface.internal = keyword.has("INTERNAL");
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    AbaqusSurface::Item item;
    item.where = content.reference(fields[0], lines.source().here());
    if (of_nodes) {
      item.weight = lines.real_or(fields, 1, 1.0, "area of a node");
    } else {
      const std::string_view face = fields.size() > 1 ? fields[1] : std::string_view{};
      if (same_word(face, "SPOS")) {
        item.face = 0;
      } else if (same_word(face, "SNEG")) {
        item.face = 1;
      } else if (face.size() == 2 && (face[0] == 'S' || face[0] == 's') && face[1] >= '1' &&
                 face[1] <= '6') {
        item.face = face[1] - '1';
      } else {
        lines.source().error(ErrorCode::missing,
                             "surface {}: the face is {}, expected S1 to S6, SPOS or SNEG",
                             shown(name), face.empty() ? "missing" : shown(face));
        continue;
      }
    }
    surface.items.push_back(item);
  }
}

}  // namespace floatframe
