// Materials that depend on the temperature: taken at the one that the user says, else at the
// initial temperature of the deck (*INITIAL CONDITIONS, TYPE=TEMPERATURE) if all nodes of its
// elements have the same one. That may stand behind the materials, so their tables wait.
#include <algorithm>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/decks/abaqus/abaqus_resolve.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

void use_at_temperature(AbaqusCard& card, const AbaqusPendingConstants& p,
                        const AtTemperature& found) {
  const auto material = card.content.materials.find(p.material);
  if (material == card.content.materials.end()) return;
  if (found.chosen)
    card.note(
        "{} of material {} is taken at the temperature {:g} (its table goes from {:g} to {:g})",
        card.shown, shown(p.material), *card.content.temperature, p.rows.front().temperature,
        p.rows.back().temperature);
  p.use(card, material->second, found.values);
}

/// Why the deck says no temperature; empty: it says `content.temperature`.
std::string initial_temperature(AbaqusContent& content, TextSource& source) {
  const std::vector<AbaqusNodalValue>& all = content.initial_temperatures;
  const AbaqusNodalValue& first = all.front();
  for (const AbaqusNodalValue& t : all) {
    const std::string place = abaqus_place(source, t.where.at);
    if (t.gradient) return fmt::format("those of {} differ across the section", place);
    if (t.value != first.value)
      return fmt::format("they are {:g} and {:g} ({})", first.value, t.value, place);
  }
  if (source.errors() > 0) {  // elements may lack nodes
    content.temperature = first.value;
    return {};
  }
  std::vector<char> has(content.nodes.size(), 0);
  AbaqusResolver nodes(content, source, AbaqusResolver::Of::nodes);
  for (const AbaqusNodalValue& t : all)
    for (const int node : nodes.resolve(t.where)) has[node] = 1;
  for (const AbaqusElement& e : content.elements)
    for (int k = 0; k < e.type->nodes; ++k)
      if (const int node = content.node_of(e, k); node >= 0 && has[node] == 0)
        return fmt::format("node {}{} has none", content.prefix(e.scope),
                           content.element_nodes[e.first + k]);
  content.temperature = first.value;
  content.note(source.mark(first.where.at),
               fmt::format("materials are taken at {:g}, the initial temperature of the deck "
                           "(--temperature, key `temperature`, is another one)",
                           first.value));
  return {};
}

}  // namespace

void read_abaqus_initial_conditions(AbaqusCard& card) {
  const std::string type = card.word("TYPE");
  if (type != "TEMPERATURE" || card.has("FILE"))
    return card.note("{}{}{} is ignored", card.shown,
                     type.empty() ? "" : ", TYPE=", card.value("TYPE"));
  card.take_input();
  while (card.next()) {
    AbaqusNodalValue t{{card.reference(0)}, card.real_or(1, 0.0, "initial temperature")};
    for (std::size_t k = 2; k < card.fields.size(); ++k)
      t.gradient = t.gradient || card.real_or(k, 0.0, "initial temperature") != 0.0;
    card.content.initial_temperatures.push_back(t);
  }
}

bool has_abaqus_dependencies(AbaqusCard& card) {
  const bool any = card.has("DEPENDENCIES") && card.value("DEPENDENCIES") != "0";
  if (any)
    card.error(ErrorCode::unsupported,
               "depends on field variables (DEPENDENCIES), which is not supported");
  return any;
}

void take_abaqus_constants(AbaqusCard& card, std::vector<TemperatureRow> rows,
                           AbaqusPendingConstants::Use use) {
  AbaqusContent& content = card.content;
  if (rows.empty() && !card.wrong()) card.error(ErrorCode::missing, "has no data line");
  const auto found_material = content.materials.find(content.material);
  if (found_material == content.materials.end() || card.wrong()) return;
  AbaqusMaterial& material = found_material->second;
  const bool density = card.name == "DENSITY";
  if ((density ? material.density : material.young).has_value())
    return card.error(ErrorCode::duplicate, "is given a second time for its material");
  const AtTemperature found = at_temperature(rows, content.temperature);
  AbaqusPendingConstants p{card, content.material, std::move(rows), use};
  if (found.error.empty()) return use_at_temperature(card, p, found);
  // Given once, whatever becomes of them.
  if (density) {
    material.density = 0.0;
  } else {
    material.young = 1.0;
    material.poisson = 0.0;
  }
  if (content.temperature) return card.error(ErrorCode::incomplete, found.error);
  content.pending.push_back(std::move(p));
}

void finish_abaqus_constants(AbaqusLines& lines, AbaqusContent& content) {
  if (content.only_nodes) return;
  TextSource& source = lines.source();
  if (content.pending.empty()) {
    if (!content.initial_temperatures.empty())
      content.note(source.mark(content.initial_temperatures.front().where.at),
                   "*INITIAL CONDITIONS, TYPE=TEMPERATURE is ignored");
    return;
  }
  std::string why;
  if (!content.initial_temperatures.empty()) why = initial_temperature(content, source);
  if (!why.empty()) why = "; the initial temperatures of the deck say none: " + why;
  for (const AbaqusPendingConstants& p : content.pending) {
    const AtTemperature found = at_temperature(p.rows, content.temperature);
    AbaqusCard card(p.keyword, lines, content);
    if (found.error.empty())
      use_at_temperature(card, p, found);
    else
      card.error(ErrorCode::incomplete, found.error + why);
  }
}

}  // namespace floatframe
