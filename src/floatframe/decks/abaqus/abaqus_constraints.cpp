// Rigid bodies, couplings, equations and supports of Abaqus decks; and multi-point constraints that
// are linear in small displacements: BEAM (a rigid bar between two nodes), PIN (equal
// displacements) and TIE of coincident nodes. The first node or set of *MPC depends on the second
// one. Source: Abaqus Keywords Guide.
#include <algorithm>

#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr int most_terms = 100000;
constexpr unsigned all_directions = 63u, all_translations = 7u;

/// COUPLING=STRUCTURAL: the mean includes rotations, where nodes have them.
void check_rotations_of_nodes(AbaqusCard& kind) {
  if (kind.is_one_of("COUPLING", "CONTINUUM STRUCTURAL",
                     "has COUPLING={}, expected CONTINUUM or STRUCTURAL") &&
      same_word(kind.value("COUPLING"), "STRUCTURAL"))
    kind.note(
        "*DISTRIBUTING, COUPLING=STRUCTURAL is taken as CONTINUUM: the reference follows the "
        "displacements of its nodes, rotations of nodes of shells and beams do not count");
}

/// *KINEMATIC or *DISTRIBUTING behind *COUPLING.
void read_kind_of_coupling(AbaqusCard& kind, AbaqusSpider& spider) {
  unsigned mask = 0;
  while (kind.next()) mask |= kind.dofs(0, kind.shown);
  if (mask == 0) mask = all_directions;
  if (kind.name == "KINEMATIC") {
    kind.allow_only("");
    spider.in_model.mask = mask;
    return;
  }
  kind.allow_only("WEIGHTINGMETHOD COUPLING");
  spider.in_model.kind = Spider::Kind::mean;
  kind.is_one_of("WEIGHTINGMETHOD", "UNIFORM", "has the weighting {}, expected UNIFORM");
  check_rotations_of_nodes(kind);
  if (mask != all_directions)
    kind.note(
        "*DISTRIBUTING names some degrees of freedom; the reference follows its nodes in all six");
}

/// The terms of an equation, `count` in all; false if the rest cannot be read.
bool read_terms(AbaqusCard& card, std::size_t count, AbaqusEquation& equation) {
  while (equation.terms.size() < count) {
    if (!card.next()) {
      card.source.error(ErrorCode::wrong_count, equation.at, "*EQUATION has {} terms, expected {}",
                        equation.terms.size(), count);
      return false;
    }
    if (card.fields.size() % 3 != 0) {
      card.error_in_line(ErrorCode::wrong_value,
                         "*EQUATION: a line of terms is node, degree of freedom, factor, ...");
      return false;
    }
    for (std::size_t k = 0; k < card.fields.size(); k += 3) {
      AbaqusEquation::Term term{{card.reference(k)}};
      const std::optional<int> dof = parse_integer(card.field(k + 1));
      if (!dof || *dof < 1 || *dof > 6)
        card.error_in_line(ErrorCode::out_of_range,
                           "*EQUATION: the degree of freedom is {}, expected 1 to 6",
                           shown(card.field(k + 1)));
      term.axis = dof.value_or(1) - 1;
      term.factor = card.real(k + 2, "factor");
      equation.terms.push_back(term);
    }
  }
  return true;
}

void add_mpc_bar(AbaqusContent& content, const AbaqusReference& node,
                 const AbaqusReference& reference) {
  // Bars that end at the same node are one spider.
  for (AbaqusSpider& s : content.spiders) {
    const bool same = s.where.name == reference.name && s.where.first == reference.first &&
                      s.where.scope == reference.scope;
    if (same && s.in_model.name.starts_with("MPC ")) return s.nodes.push_back(node);
  }
  AbaqusSpider spider;
  spider.where = reference;
  spider.in_model.name = "MPC " + content.text(reference, "node");
  spider.nodes = {node};
  content.spiders.push_back(std::move(spider));
}

/// Two coincident nodes that are defined before the line.
bool are_at_one_place(const AbaqusContent& content, const AbaqusReference& first,
                      const AbaqusReference& second) {
  std::vector<Vec3> places;
  for (const AbaqusReference* const r : {&first, &second}) {
    const int node =
        r->name < 0 && r->first == r->last ? content.nodes.find(r->scope, r->first) : -1;
    if (node < 0) return false;
    places.push_back(content.placement(r->scope).at(content.nodes[node].p));
  }
  return places[0] == places[1];
}

void read_mpc_line(AbaqusCard& card) {
  AbaqusContent& content = card.content;
  const std::string type = upper_case(card.field(0));
  if (!has_word("BEAM PIN TIE", type))
    return card.error_in_line(ErrorCode::unsupported,
                              "*MPC: the type {} is not supported, expected BEAM, PIN or TIE; use "
                              "*RIGID BODY, *COUPLING or *EQUATION",
                              shown(card.field(0)));
  if (card.fields.size() != 3)
    return card.error_in_line(ErrorCode::wrong_count, "*MPC: {} has {} nodes or sets, expected 2",
                              type, card.fields.size() - 1);
  const AbaqusReference node = card.reference(1), reference = card.reference(2);
  if (type == "PIN") {
    for (int axis = 0; axis < 3; ++axis)
      content.equations.push_back({{{{node}, axis, 1.0}, {{reference}, axis, -1.0}}, node.at});
  } else if (type == "TIE" && !are_at_one_place(content, node, reference)) {
    card.error_in_line(ErrorCode::unsupported,
                       "*MPC: TIE is read of two nodes at one place that stand before this line; "
                       "use PIN, or BEAM for a rigid bar");
  } else {
    add_mpc_bar(content, node, reference);
  }
}

/// Reads the spider of a keyword with REF NODE, if it has one.
void add_spider(AbaqusCard& card, AbaqusSpider& spider) {
  if (card.value("REFNODE").empty()) return;
  spider.where = card.reference_of("REFNODE");
  if (card.has("ROTNODE")) spider.rotation = card.reference_of("ROTNODE");
  if (card.has("SURFACE")) spider.surface = card.named("SURFACE");
  card.content.spiders.push_back(std::move(spider));
}

}  // namespace

void read_abaqus_rigid_body(AbaqusCard& card) {
  AbaqusSpider spider;
  card.required("REF NODE");
  if (!card.value("POSITION").empty() && !same_word(card.value("POSITION"), "INPUT"))
    card.error(ErrorCode::unsupported,
               "moves its reference to the centre of mass (POSITION), which is not supported");
  for (const char* parameter : {"NSET", "TIENSET", "PINNSET", "ELSET"}) {
    if (!card.has(parameter)) continue;
    (parameter == std::string_view("ELSET") ? spider.elements : spider.nodes)
        .push_back(card.named(parameter));
    spider.in_model.name = card.word(parameter);
  }
  // Pinned nodes follow in translation only: for nodes without rotations there is no difference.
  if (card.has("PINNSET")) spider.in_model.mask = all_translations;
  if (card.has("PINNSET") && spider.nodes.size() != 1)
    card.error(ErrorCode::unsupported, "has PIN NSET and another set, which is not supported");
  if (spider.nodes.empty() && spider.elements.empty())
    card.error(ErrorCode::incomplete, "needs the parameter NSET or ELSET");
  add_spider(card, spider);
}

void read_abaqus_coupling(AbaqusCard& card) {
  AbaqusSpider spider;
  spider.in_model.name = card.word("CONSTRAINTNAME");
  card.required("REF NODE");
  const bool of_surface = !card.required("SURFACE").empty();
  AbaqusKeyword following;
  if (!card.lines.next_keyword(following) || !has_word("KINEMATIC DISTRIBUTING", following.name)) {
    card.error(ErrorCode::incomplete, "is not followed by *KINEMATIC or *DISTRIBUTING");
    if (!following.name.empty())
      card.source.stop(ErrorCode::missing, following.at, "reading ends here");
    return;
  }
  AbaqusCard kind(following, card.lines, card.content);
  read_kind_of_coupling(kind, spider);
  if (of_surface) add_spider(card, spider);
}

void read_abaqus_kinematic_coupling(AbaqusCard& card) {
  AbaqusSpider spider;
  card.required("REF NODE");
  unsigned mask = 0;
  while (card.next()) {
    spider.nodes.push_back(card.reference(0));
    const unsigned dofs = card.fields.size() > 1 ? card.dofs(1, card.shown) : all_directions;
    if (mask != 0 && dofs != mask)
      card.error_in_line(ErrorCode::unsupported,
                         "*KINEMATIC COUPLING has other degrees of freedom than in the line "
                         "before, which is not supported");
    mask = dofs;
  }
  if (spider.nodes.empty()) return card.error(ErrorCode::missing, "has no nodes");
  spider.in_model.mask = mask;
  add_spider(card, spider);
}

void read_abaqus_distributing_coupling(AbaqusCard& card) {
  AbaqusSpider spider;
  spider.in_model.kind = Spider::Kind::mean;
  const bool named = !card.required("ELSET").empty();
  while (card.next()) {
    spider.nodes.push_back(card.reference(0));
    spider.weights.push_back(card.field(1).empty() ? 1.0
                                                   : card.positive(1, "the weight of a node"));
  }
  if (spider.nodes.empty()) return card.error(ErrorCode::missing, "has no nodes");
  if (!named) return;
  spider.where = card.named("ELSET");
  spider.reference_by_element = true;
  card.content.spiders.push_back(std::move(spider));
}

void read_abaqus_equation(AbaqusCard& card) {
  card.take_input();
  while (card.next()) {
    AbaqusEquation equation;
    equation.at = card.here();
    const std::size_t before = card.source.errors();
    const std::optional<int> count = parse_integer(card.field(0));
    if (!count || *count < 1 || *count > most_terms || card.fields.size() != 1)
      return card.error_in_line(ErrorCode::not_a_number, "*EQUATION: {} is no number of terms",
                                shown(card.field(0)));
    if (!read_terms(card, static_cast<std::size_t>(*count), equation)) return;
    if (card.source.errors() != before) continue;
    if (equation.terms.front().factor == 0.0)
      card.source.error(ErrorCode::out_of_range, equation.at,
                        "*EQUATION: the factor of the first term is zero");
    card.content.equations.push_back(std::move(equation));
  }
}

void read_abaqus_boundary(AbaqusCard& card) {
  constexpr std::pair<const char*, unsigned> words[] = {
      {"ENCASTRE", 63u}, {"PINNED", 7u},  {"XSYMM", 49u},  {"YSYMM", 42u},
      {"ZSYMM", 28u},    {"XASYMM", 14u}, {"YASYMM", 21u}, {"ZASYMM", 35u}};
  while (card.next()) {
    AbaqusSupport support{{card.reference(0)}};
    if (card.field(1) == "11") continue;  // the temperature
    const auto* const word = std::find_if(std::begin(words), std::end(words), [&](const auto& w) {
      return same_word(card.field(1), w.first);
    });
    support.mask = word == std::end(words) ? card.dofs(1, card.shown) : word->second;
    if (support.mask != 0) card.content.supports.push_back(support);
  }
}

void read_abaqus_mpc(AbaqusCard& card) {
  card.take_input();
  while (card.next()) read_mpc_line(card);
}

}  // namespace floatframe
