// Multi-point constraints of Abaqus decks that are linear in small displacements: BEAM (a rigid bar
// between two nodes), PIN (equal displacements) and TIE of nodes at one place.
// Source: Abaqus Keywords Guide, *MPC; the first node or set depends on the second one.
#include <fmt/format.h>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// The node of a single number; null if it is a set or has not been read.
const AbaqusNode* mpc_node(const AbaqusContent& content, const AbaqusReference& r) {
  if (r.name >= 0 || r.first != r.last) return nullptr;
  const auto it = content.node_of_label.find(AbaqusContent::label(r.scope, r.first));
  return it == content.node_of_label.end() ? nullptr : &content.nodes[it->second];
}

void add_mpc_bar(AbaqusContent& content, const AbaqusReference& node,
                 const AbaqusReference& reference) {
  // Bars that end at one node are one spider.
  for (AbaqusSpider& s : content.spiders) {
    const bool same = s.reference.name == reference.name && s.reference.first == reference.first &&
                      s.reference.scope == reference.scope;
    if (same && s.name.starts_with("MPC ")) {
      s.nodes.push_back(node);
      return;
    }
  }
  AbaqusSpider spider;
  spider.name = "MPC " + content.text(reference, "node");
  spider.reference = reference;
  spider.nodes = {node};
  spider.at = node.at;
  content.spiders.push_back(std::move(spider));
}

void add_mpc_pin(AbaqusContent& content, const AbaqusReference& node,
                 const AbaqusReference& reference) {
  for (int axis = 0; axis < 3; ++axis) {
    AbaqusEquation equation;
    equation.at = node.at;
    equation.terms = {{node, axis, 1.0}, {reference, axis, -1.0}};
    content.equations.push_back(std::move(equation));
  }
}

}  // namespace

void read_abaqus_mpc(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content) {
  lines.allow_only(keyword, {"INPUT"});
  lines.take_input(keyword);
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    const std::string_view type = fields[0];
    const bool beam = same_word(type, "BEAM"), pin = same_word(type, "PIN"),
               tie = same_word(type, "TIE");
    if (!beam && !pin && !tie) {
      lines.source().error(ErrorCode::unsupported,
                           "*MPC: the type {} is not supported, expected BEAM, PIN or TIE; use "
                           "*RIGID BODY, *COUPLING or *EQUATION",
                           shown(type));
      continue;
    }
    if (fields.size() != 3) {
      lines.source().error(ErrorCode::wrong_count, "*MPC: {} has {} nodes or sets, expected 2",
                           upper_case(type), fields.size() - 1);
      continue;
    }
    const FeSource at = lines.source().here();
    const AbaqusReference node = content.reference(fields[1], at),
                          reference = content.reference(fields[2], at);
    if (pin) {
      add_mpc_pin(content, node, reference);
      continue;
    }
    if (tie) {
      const AbaqusNode *a = mpc_node(content, node), *b = mpc_node(content, reference);
      if (a == nullptr || b == nullptr ||
          content.placement(a->scope).at(a->p) != content.placement(b->scope).at(b->p)) {
        lines.source().error(ErrorCode::unsupported,
                             "*MPC: TIE is read of two nodes at one place that stand before this "
                             "line; use PIN, or BEAM for a rigid bar");
        continue;
      }
    }
    add_mpc_bar(content, node, reference);
  }
}

}  // namespace floatframe
