// Rigid bodies, couplings, equations and supports of Abaqus decks.
#include <fmt/format.h>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr int most_terms = 100000;

unsigned bits(int first, int last) noexcept {
  unsigned mask = 0;
  for (int k = first; k <= last; ++k) mask |= 1u << (k - 1);
  return mask;
}

std::string_view reference_node(AbaqusLines& lines, const AbaqusKeyword& keyword) {
  return lines.required(keyword, "REF NODE");
}

/// COUPLING=STRUCTURAL: the mean is one of rotations too, where nodes have them.
void check_rotations_of_nodes(AbaqusLines& lines, const AbaqusKeyword& kind,
                              AbaqusContent& content) {
  const std::string_view found = kind.value("COUPLING");
  if (found.empty() || same_word(found, "CONTINUUM")) return;
  if (!same_word(found, "STRUCTURAL"))
    return lines.error(ErrorCode::wrong_value, kind,
                       "has COUPLING={}, expected CONTINUUM or STRUCTURAL", shown(found));
  content.note(
      lines.source().mark(kind.at),
      "*DISTRIBUTING, COUPLING=STRUCTURAL is taken as CONTINUUM: the reference follows the "
      "displacements of its nodes, rotations of nodes of shells and beams do not count");
}

}  // namespace

unsigned abaqus_dofs(AbaqusLines& lines, const std::vector<std::string_view>& fields,
                     std::size_t index, std::string_view what) {
  const std::string_view field = index < fields.size() ? fields[index] : std::string_view{};
  const std::optional<int> first = parse_integer(field);
  std::optional<int> last = first;
  if (index + 1 < fields.size() && !fields[index + 1].empty()) {
    last = parse_integer(fields[index + 1]);
  }
  if (!first || !last || *first < 1 || *last > 6 || *last < *first) {
    lines.source().error(
        ErrorCode::missing, "{}: the degrees of freedom are {}{}{}, expected numbers from 1 to 6",
        what, field.empty() ? "missing" : shown(field), last != first ? " to " : "",
        last != first ? shown(fields[index + 1]) : "");
    return 0;
  }
  return bits(*first, *last);
}

void read_abaqus_rigid_body(AbaqusLines& lines, const AbaqusKeyword& keyword,
                            AbaqusContent& content) {
  lines.allow_only(keyword,
                   {"NSET", "ELSET", "REFNODE", "ROTNODE", "TIENSET", "PINNSET", "POSITION"});
  AbaqusSpider spider;
  spider.at = keyword.at;
  const std::string_view reference = reference_node(lines, keyword);
  if (!keyword.value("POSITION").empty() && !same_word(keyword.value("POSITION"), "INPUT")) {
    lines.error(ErrorCode::unsupported, keyword,
                "moves its reference to the centre of mass (POSITION), which is not supported");
  }
  for (const char* parameter : {"NSET", "TIENSET", "PINNSET"}) {
    if (keyword.has(parameter)) {
      spider.nodes.push_back(content.named(keyword.value(parameter), keyword.at));
      spider.name = abaqus_name(keyword.value(parameter));
    }
  }
  if (keyword.has("PINNSET")) {
    // Pinned nodes follow in translation only: for nodes without rotations there is no difference.
    if (spider.nodes.size() == 1) {
      spider.mask = bits(1, 3);
    } else {
      lines.error(ErrorCode::unsupported, keyword,
                  "has PIN NSET beside another set, which is not supported");
    }
  }
  if (keyword.has("ELSET")) {
    spider.elements.push_back(content.named(keyword.value("ELSET"), keyword.at));
    spider.name = abaqus_name(keyword.value("ELSET"));
  }
  if (spider.nodes.empty() && spider.elements.empty()) {
    lines.error(ErrorCode::incomplete, keyword, "needs the parameter NSET or ELSET");
  }
  lines.skip_data();
  if (reference.empty()) return;
  spider.reference = content.reference(reference, keyword.at);
  if (keyword.has("ROTNODE")) {
    spider.rotation = content.reference(keyword.value("ROTNODE"), keyword.at);
  }
  content.spiders.push_back(std::move(spider));
}

void read_abaqus_coupling(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  lines.allow_only(keyword, {"CONSTRAINTNAME", "REFNODE", "SURFACE"});
  AbaqusSpider spider;
  spider.at = keyword.at;
  spider.name = abaqus_name(keyword.value("CONSTRAINTNAME"));
  const std::string_view reference = reference_node(lines, keyword);
  const std::string_view surface = lines.required(keyword, "SURFACE");
  lines.skip_data();
  AbaqusKeyword kind;
  std::string_view line;
  if (!lines.next_keyword(kind) || (kind.name != "KINEMATIC" && kind.name != "DISTRIBUTING")) {
    lines.error(ErrorCode::incomplete, keyword, "is not followed by *KINEMATIC or *DISTRIBUTING");
    if (!kind.name.empty()) lines.source().stop(ErrorCode::missing, kind.at, "reading ends here");
    return;
  }
  unsigned mask = 0;
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) mask |= abaqus_dofs(lines, fields, 0, kind.shown);
  if (mask == 0) mask = 63u;
  if (kind.name == "KINEMATIC") {
    lines.allow_only(kind, {});
    spider.mask = mask;
  } else {
    lines.allow_only(kind, {"WEIGHTINGMETHOD", "COUPLING"});
    spider.kind = Spider::Kind::mean;
    const std::string_view method = kind.value("WEIGHTINGMETHOD");
    if (!method.empty() && !same_word(method, "UNIFORM")) {
      lines.error(ErrorCode::wrong_value, kind, "has the weighting {}, expected UNIFORM",
                  shown(method));
    }
    check_rotations_of_nodes(lines, kind, content);
    if (mask != 63u) {
      const SourceMark mark = lines.source().mark(kind.at);
      content.notes.push_back(
          fmt::format("{}:{}: *DISTRIBUTING names some degrees of freedom; the reference follows "
                      "its nodes in all six",
                      mark.file, mark.line));
    }
  }
  if (reference.empty() || surface.empty()) return;
  spider.reference = content.reference(reference, keyword.at);
  spider.surface = content.named(surface, keyword.at);
  content.spiders.push_back(std::move(spider));
}

void read_abaqus_kinematic_coupling(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                    AbaqusContent& content) {
  lines.allow_only(keyword, {"REFNODE"});
  AbaqusSpider spider;
  spider.at = keyword.at;
  const std::string_view reference = reference_node(lines, keyword);
  std::vector<std::string_view> fields;
  unsigned mask = 0;
  while (lines.next_fields(fields)) {
    spider.nodes.push_back(content.reference(fields[0], lines.source().here()));
    const unsigned dofs = fields.size() > 1 ? abaqus_dofs(lines, fields, 1, keyword.shown) : 63u;
    if (mask != 0 && dofs != mask) {
      lines.source().error(ErrorCode::unsupported,
                           "*KINEMATIC COUPLING has other degrees of freedom than in the line "
                           "before, which is not supported");
    }
    mask = dofs;
  }
  if (spider.nodes.empty()) return lines.error(ErrorCode::missing, keyword, "has no nodes");
  if (reference.empty()) return;
  spider.mask = mask;
  spider.reference = content.reference(reference, keyword.at);
  content.spiders.push_back(std::move(spider));
}

void read_abaqus_distributing_coupling(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                       AbaqusContent& content) {
  lines.allow_only(keyword, {"ELSET"});
  AbaqusSpider spider;
  spider.kind = Spider::Kind::mean;
  spider.at = keyword.at;
  const std::string_view elements = lines.required(keyword, "ELSET");
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    spider.nodes.push_back(content.reference(fields[0], lines.source().here()));
    const bool given = fields.size() > 1 && !fields[1].empty();
    spider.weights.push_back(given ? positive_real(lines, fields[1], "the weight of a node") : 1.0);
  }
  if (spider.nodes.empty()) return lines.error(ErrorCode::missing, keyword, "has no nodes");
  if (elements.empty()) return;
  spider.reference = content.named(elements, keyword.at);
  spider.reference_by_element = true;
  content.spiders.push_back(std::move(spider));
}

void read_abaqus_equation(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  lines.allow_only(keyword, {"INPUT"});
  lines.take_input(keyword);
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    AbaqusEquation equation;
    equation.at = lines.source().here();
    const std::size_t before = lines.source().errors();
    const std::optional<int> count = parse_integer(fields[0]);
    if (!count || *count < 1 || *count > most_terms || fields.size() != 1) {
      lines.source().error(ErrorCode::not_a_number, "*EQUATION: {} is no number of terms",
                           shown(fields[0]));
      return lines.skip_data();
    }
    while (equation.terms.size() < static_cast<std::size_t>(*count)) {
      if (!lines.next_fields(fields)) {
        lines.source().error(ErrorCode::wrong_count, equation.at,
                             "*EQUATION has {} terms, expected {}", equation.terms.size(), *count);
        return;
      }
      if (fields.size() % 3 != 0) {
        lines.source().error(ErrorCode::wrong_value,
                             "*EQUATION: a line of terms is node, degree of freedom, factor, ...");
        return lines.skip_data();
      }
      for (std::size_t k = 0; k + 2 < fields.size(); k += 3) {
        AbaqusEquation::Term term;
        term.nodes = content.reference(fields[k], lines.source().here());
        const std::optional<int> dof = parse_integer(fields[k + 1]);
        if (!dof || *dof < 1 || *dof > 6) {
          lines.source().error(ErrorCode::out_of_range,
                               "*EQUATION: the degree of freedom is {}, expected 1 to 6",
                               shown(fields[k + 1]));
        }
        term.axis = dof.value_or(1) - 1;
        term.factor = lines.real(fields[k + 2], "factor");
        equation.terms.push_back(term);
      }
    }
    if (lines.source().errors() != before) continue;
    if (equation.terms.front().factor == 0.0) {
      lines.source().error(ErrorCode::out_of_range, equation.at,
                           "*EQUATION: the factor of the first term is zero");
    }
    content.equations.push_back(std::move(equation));
  }
}

void read_abaqus_boundary(AbaqusLines& lines, const AbaqusKeyword& keyword,
                          AbaqusContent& content) {
  struct Named {
    const char* name;
    unsigned mask;
  };
  constexpr std::array words{Named{"ENCASTRE", 63u}, Named{"PINNED", 7u}, Named{"XSYMM", 49u},
                             Named{"YSYMM", 42u},    Named{"ZSYMM", 28u}, Named{"XASYMM", 14u},
                             Named{"YASYMM", 21u},   Named{"ZASYMM", 35u}};
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    AbaqusSupport support;
    support.at = lines.source().here();
    support.nodes = content.reference(fields[0], support.at);
    for (const Named& word : words) {
      if (fields.size() > 1 && same_word(fields[1], word.name)) support.mask = word.mask;
    }
    // Degree of freedom 11 is the temperature.
    if (support.mask == 0 && fields.size() > 1 && fields[1] == "11") continue;
    if (support.mask == 0) support.mask = abaqus_dofs(lines, fields, 1, keyword.shown);
    if (support.mask != 0) content.supports.push_back(support);
  }
}

}  // namespace floatframe
