// Materials of Abaqus decks. Elastic constants that are not isotropic:
//   ENGINEERING CONSTANTS  E1 E2 E3 nu12 nu13 nu23 G12 G13 G23, nu_ij: strain along j by stress
//                          along i
//   ORTHOTROPIC            D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323
//   ANISOTROPIC            the upper triangle by columns, in the order 11 22 33 12 13 23
//   LAMINA                 E1 E2 nu12 G12 G13 G23 of plane stress
// Eight numbers per line, and after the last one the temperature.
// Constants that depend on the temperature are taken at the user's temperature, else at the
// initial temperature of the deck (*INITIAL CONDITIONS, TYPE=TEMPERATURE) if all nodes of its
// elements have the same one. It may follow the materials, so their tables are kept until then.
#include <algorithm>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/fe/elasticity.hpp"
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
        card.shown, shown(p.material), *card.content.options.temperature,
        p.rows.front().temperature, p.rows.back().temperature);
  p.use(card, material->second, found.values);
}

/// Do constants depend on field variables? An error if they do.
bool has_dependencies(AbaqusCard& card) {
  const bool any = card.has("DEPENDENCIES") && card.value("DEPENDENCIES") != "0";
  if (any)
    card.error(ErrorCode::unsupported,
               "depends on field variables (DEPENDENCIES), which is not supported");
  return any;
}

/// For the last *MATERIAL: the values of a table at the user's temperature, with a
/// note. Without one they are kept until the initial temperature of the deck is known.
void take_constants(AbaqusCard& card, std::vector<TemperatureRow> rows,
                    AbaqusPendingConstants::Use use) {
  AbaqusContent& content = card.content;
  if (rows.empty() && !card.wrong()) card.error(ErrorCode::missing, "has no data line");
  const auto found_material = content.materials.find(content.material);
  if (found_material == content.materials.end() || card.wrong()) return;
  AbaqusMaterial& material = found_material->second;
  const bool density = card.name == "DENSITY";
  if ((density ? material.density : material.young).has_value())
    return card.error(ErrorCode::duplicate, "is given a second time for its material");
  const AtTemperature found = at_temperature(rows, content.options.temperature);
  AbaqusPendingConstants p{card, content.material, std::move(rows), use};
  if (found.error.empty()) return use_at_temperature(card, p, found);
  // Defined once, even if invalid.
  if (density) {
    material.density = 0.0;
  } else {
    material.young = 1.0;
    material.poisson = 0.0;
  }
  if (content.options.temperature) return card.error(ErrorCode::incomplete, found.error);
  content.pending.push_back(std::move(p));
}

struct ElasticType {
  const char* names;  ///< without blanks, between blanks
  std::size_t constants;
  enum class Form { engineering, orthotropic, anisotropic, lamina } form;
};
using Form = ElasticType::Form;

constexpr ElasticType elastic_types[] = {{"ENGINEERINGCONSTANTS ENGINEERING", 9, Form::engineering},
                                         {"ORTHO ORTHOTROPIC", 9, Form::orthotropic},
                                         {"ANISO ANISOTROPIC", 21, Form::anisotropic},
                                         {"LAMINA", 6, Form::lamina}};

/// Place among xx yy zz xy yz zx of the program's 11 22 33 12 13 23, and their names.
constexpr int place_of[6] = {0, 1, 2, 3, 5, 4};
constexpr const char* index_names[6] = {"11", "22", "33", "12", "23", "13"};

std::string constant_name(int i, int j) {
  const bool ordered = std::find(place_of, place_of + 6, i) <= std::find(place_of, place_of + 6, j);
  return fmt::format("D{}{}", index_names[ordered ? i : j], index_names[ordered ? j : i]);
}

Mat6 constants_matrix(const std::vector<double>& c, Form form) {
  Mat6 D = Mat6::Zero();
  std::size_t k = 0;
  for (int column = 0; column < 6; ++column)
    for (int row = 0; row <= column; ++row) {
      const bool there = form == Form::anisotropic || column < 3 || row == column;
      if (there) D(place_of[row], place_of[column]) = D(place_of[column], place_of[row]) = c[k++];
    }
  return D;
}

const ElasticType* elastic_type(const AbaqusCard& card) {
  const auto it =
      std::find_if(std::begin(elastic_types), std::end(elastic_types),
                   [&](const ElasticType& t) { return has_word(t.names, card.word("TYPE")); });
  return it == std::end(elastic_types) ? nullptr : it;
}

/// The constants of one temperature; false after the last line.
bool next_constants(AbaqusCard& card, std::size_t count, TemperatureRow& row) {
  std::vector<double>& out = row.values;
  while (out.size() < count) {
    if (!card.next()) {
      if (!out.empty())
        card.error(ErrorCode::wrong_count, "has {} constants, expected {}", out.size(), count);
      return false;
    }
    const std::size_t here = std::min<std::size_t>(8, count - out.size());
    if (card.fields.size() < here) {
      card.error(ErrorCode::missing, "has no constant {} of {}: eight stand in a line",
                 out.size() + card.fields.size() + 1, count);
      return false;
    }
    for (std::size_t k = 0; k < here; ++k)
      out.push_back(card.real_or(k, 0.0, fmt::format("elastic constant {}", out.size() + 1)));
    if (out.size() == count) row.temperature = card.real_or(here, 0.0, "temperature");
  }
  return true;
}

void use_anisotropic(AbaqusCard& card, AbaqusMaterial& material, const std::vector<double>& c) {
  const Form form = elastic_type(card)->form;
  std::string error;
  if (form == Form::engineering || form == Form::lamina) {
    const bool lamina = form == Form::lamina;
    const EngineeringConstants e =
        lamina ? EngineeringConstants{c[0], c[1], 0.0, c[2], 0.0, 0.0, c[3], c[4], c[5]}
               : EngineeringConstants{c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]};
    error = engineering_error(e, lamina);
    if (error.empty()) material.elasticity = lamina ? lamina_elasticity(e) : elasticity_of(e);
    material.plane = lamina;
  } else {
    const Mat6 D = constants_matrix(c, form);
    error = elasticity_error(D, false, constant_name);
    if (error.empty()) material.elasticity = D;
  }
  if (!error.empty()) card.error(ErrorCode::wrong_value, "TYPE={}: {}", card.word("TYPE"), error);
  material.young = c[0];
}

/// Constants of *ELASTIC that are not isotropic; false if it is of no such type.
bool read_anisotropic(AbaqusCard& card) {
  const ElasticType* const type = elastic_type(card);
  if (type == nullptr) return false;
  has_dependencies(card);
  std::vector<TemperatureRow> rows;
  for (TemperatureRow row; next_constants(card, type->constants, row); row = {})
    rows.push_back(row);
  take_constants(card, std::move(rows), use_anisotropic);
  return true;
}

/// *ELASTIC and *DENSITY belong to the last *MATERIAL; their data are read in any case.
void needs_material(AbaqusCard& card) {
  if (!card.content.materials.contains(card.content.material))
    card.error(ErrorCode::missing, "belongs to no *MATERIAL");
  card.start();
}

/// Lines of values and a temperature; the first value must be there.
void read_table(AbaqusCard& card, std::initializer_list<const char*> names,
                AbaqusPendingConstants::Use use) {
  std::vector<TemperatureRow> rows;
  const bool of_fields = has_dependencies(card);
  while (!of_fields && card.next()) {
    TemperatureRow row;
    for (const char* const name : names) {
      const std::size_t k = row.values.size();
      row.values.push_back(k == 0 ? card.real(k, name) : card.real_or(k, 0.0, name));
    }
    row.temperature = card.real_or(names.size(), 0.0, "temperature");
    rows.push_back(std::move(row));
  }
  take_constants(card, std::move(rows), use);
}

void use_isotropic(AbaqusCard& card, AbaqusMaterial& material, const std::vector<double>& values) {
  material.young = values[0];
  material.poisson = values[1];
  if (!(values[0] > 0.0))
    card.error(ErrorCode::out_of_range, "has Young's modulus {:g}, expected more than 0",
               values[0]);
  if (!(values[1] > -1.0 && values[1] < 0.5))
    card.error(ErrorCode::out_of_range,
               "has Poisson's ratio {:g}, expected more than -1 and less than 0.5", values[1]);
}

void use_density(AbaqusCard& card, AbaqusMaterial& material, const std::vector<double>& values) {
  material.density = values[0];
  if (!(values[0] >= 0.0))
    card.error(ErrorCode::out_of_range, "is {:g}, expected no negative density", values[0]);
}

/// Why the deck defines no temperature; empty: it sets `content.options.temperature`.
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
    content.options.temperature = first.value;
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
  content.options.temperature = first.value;
  content.note(source.mark(first.where.at),
               fmt::format("materials are taken at {:g}, the initial temperature of the deck "
                           "(--temperature, key `temperature`, is another one)",
                           first.value));
  return {};
}

}  // namespace

void read_abaqus_material(AbaqusCard& card) {
  AbaqusContent& content = card.content;
  const std::string name = abaqus_name(card.required("NAME"));
  content.material = name;
  const auto [it, added] = content.materials.emplace(name, AbaqusMaterial{});
  if (added) {
    it->second.at = card.at;
    content.material_order.push_back(name);
    return;
  }
  card.error(ErrorCode::duplicate, "names the material {} a second time ({})", shown(name),
             card.place(it->second.at));
  // The following data belong to a material without a name.
  content.material = fmt::format("{} (line {})", name, card.at.line);
  content.materials.emplace(content.material, AbaqusMaterial{});
}

void read_abaqus_elastic(AbaqusCard& card) {
  needs_material(card);
  const std::string type = card.word("TYPE");
  if (read_anisotropic(card)) return;
  if (type.empty() || type == "ISO" || type == "ISOTROPIC")
    return read_table(card, {"Young's modulus", "Poisson's ratio"}, use_isotropic);
  card.error(ErrorCode::wrong_value,
             "has the type {}, expected ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC, "
             "ANISOTROPIC or LAMINA",
             shown(card.value("TYPE")));
}

void read_abaqus_density(AbaqusCard& card) {
  needs_material(card);
  read_table(card, {"density"}, use_density);
}

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
    const AtTemperature found = at_temperature(p.rows, content.options.temperature);
    AbaqusCard card(p.keyword, lines, content);
    if (found.error.empty())
      use_at_temperature(card, p, found);
    else
      card.error(ErrorCode::incomplete, found.error + why);
  }
}

}  // namespace floatframe
