// Materials that depend on the temperature: taken at the one that the user says, else at the
// initial temperature of the deck (*INITIAL CONDITIONS, TYPE=TEMPERATURE) if all nodes of its
// elements have the same one. That may stand behind the materials, so their tables wait.
#include <fmt/format.h>

#include <algorithm>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/decks/abaqus/abaqus_resolve.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

void use_at_temperature(AbaqusLines& lines, AbaqusContent& content, const AbaqusPendingConstants& p,
                        const AtTemperature& found) {
  const auto material = content.materials.find(p.material);
  if (material == content.materials.end()) return;
  if (found.chosen)
    content.note(
        lines.source().mark(p.keyword.at),
        fmt::format(
            "{} of material {} is taken at the temperature {:g} (its table goes from {:g} to {:g})",
            p.keyword.shown, shown(p.material), *content.temperature, p.rows.front().temperature,
            p.rows.back().temperature));
  p.use(lines, p.keyword, material->second, found.values);
}

/// Why the deck says no temperature; empty: it says `content.temperature`.
std::string initial_temperature(AbaqusLines& lines, AbaqusContent& content) {
  const std::vector<AbaqusInitialTemperature>& all = content.initial_temperatures;
  const AbaqusInitialTemperature& first = all.front();
  for (const AbaqusInitialTemperature& t : all) {
    const SourceMark mark = lines.source().mark(t.nodes.at);
    if (t.gradient)
      return fmt::format("those of {}:{} differ across the section", mark.file, mark.line);
    if (t.value != first.value)
      return fmt::format("they are {:g} and {:g} ({}:{})", first.value, t.value, mark.file,
                         mark.line);
  }
  if (lines.source().errors() > 0) {  // elements may lack nodes
    content.temperature = first.value;
    return {};
  }
  std::vector<char> has(content.nodes.size(), 0);
  AbaqusResolver nodes(content, lines.source(), AbaqusResolver::Of::nodes);
  for (const AbaqusInitialTemperature& t : all)
    for (const int node : nodes.resolve(t.nodes)) has[static_cast<std::size_t>(node)] = 1;
  for (const AbaqusElement& e : content.elements)
    for (int k = 0; k < e.type->nodes; ++k) {
      const int id = content.element_nodes[e.first + static_cast<std::size_t>(k)];
      const auto it = content.node_of_label.find(AbaqusContent::label(e.scope, id));
      if (it != content.node_of_label.end() && has[static_cast<std::size_t>(it->second)] == 0)
        return fmt::format("node {}{} has none", content.prefix(e.scope), id);
    }
  content.temperature = first.value;
  content.note(lines.source().mark(first.nodes.at),
               fmt::format("materials are taken at {:g}, the initial temperature of the deck "
                           "(--temperature, key `temperature`, is another one)",
                           first.value));
  return {};
}

}  // namespace

void read_abaqus_initial_conditions(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                    AbaqusContent& content) {
  const std::string type = abaqus_name(keyword.value("TYPE"));
  if (type != "TEMPERATURE" || keyword.has("FILE")) {
    content.note(lines.source().mark(keyword.at),
                 fmt::format("{}{}{} is ignored", keyword.shown,
                             type.empty() ? "" : ", TYPE=", keyword.value("TYPE")));
    return lines.skip_data();
  }
  lines.take_input(keyword);
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    AbaqusInitialTemperature t;
    t.nodes = content.reference(fields[0], lines.source().here());
    t.value = lines.real_or(fields, 1, 0.0, "initial temperature");
    for (std::size_t k = 2; k < fields.size(); ++k)
      t.gradient = t.gradient || lines.real_or(fields, k, 0.0, "initial temperature") != 0.0;
    content.initial_temperatures.push_back(t);
  }
}

void take_abaqus_constants(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
                           AbaqusMaterial& material, std::vector<TemperatureRow> rows,
                           AbaqusPendingConstants::Use use) {
  const AtTemperature found = at_temperature(rows, content.temperature);
  AbaqusPendingConstants p{keyword, content.material, std::move(rows), use};
  if (found.error.empty()) return use_at_temperature(lines, content, p, found);
  // Given once, whatever becomes of them.
  if (keyword.name == "DENSITY") {
    material.density = 0.0;
  } else {
    material.young = 1.0;
    material.poisson = 0.0;
  }
  if (content.temperature) return lines.error(ErrorCode::incomplete, keyword, found.error);
  content.pending.push_back(std::move(p));
}

void finish_abaqus_constants(AbaqusLines& lines, AbaqusContent& content) {
  if (content.only_nodes) return;
  if (content.pending.empty()) {
    if (!content.initial_temperatures.empty())
      content.note(lines.source().mark(content.initial_temperatures.front().nodes.at),
                   "*INITIAL CONDITIONS, TYPE=TEMPERATURE is ignored");
    return;
  }
  std::string why;
  if (!content.initial_temperatures.empty()) why = initial_temperature(lines, content);
  for (const AbaqusPendingConstants& p : content.pending) {
    const AtTemperature found = at_temperature(p.rows, content.temperature);
    if (found.error.empty()) {
      use_at_temperature(lines, content, p, found);
    } else {
      lines.error(ErrorCode::incomplete, p.keyword,
                  why.empty() ? found.error
                              : fmt::format("{}; the initial temperatures of the deck say none: {}",
                                            found.error, why));
    }
  }
}

}  // namespace floatframe
