// Cards of spiders, linear equations and supports.
#include <fmt/format.h>

#include <bit>
#include <utility>
#include <vector>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

NastranSpider spider(NastranFields& f, const char* card) {
  NastranSpider s;
  s.card = card;
  s.at = f.at();
  s.id = f.label(0, "the number of the element");
  return s;
}

bool is_real(std::string_view field) {
  return field.find_first_of(".eEdD") != std::string_view::npos && parse_real(field).has_value();
}

/// UM of RBE3 says which components depend: the equations are the same whichever do, so it is only
/// looked at.
void dependent_components(NastranFields& f, std::size_t i, int expected) {
  int count = 0;
  for (; i < f.size() && !same_word(f.text(i), "ALPHA"); i += 2) {
    if (f.blank(i)) {
      --i;  // fields between lines
      continue;
    }
    f.label(i, "a node of UM");
    count += std::popcount(f.components(i + 1, "the components of UM"));
  }
  if (count != expected)
    f.error(ErrorCode::wrong_count, "UM has {} components, expected {} as in REFC", count,
            expected);
}

}  // namespace

void read_nastran_rbe2(NastranFields& f, NastranContent& c) {
  NastranSpider s = spider(f, "RBE2");
  s.reference = f.label(1, "node GN");
  s.mask = f.components(2, "the components CM");
  for (std::size_t i = 3; i < f.size(); ++i) {
    if (i + 1 == f.size() && is_real(f.text(i))) break;  // ALPHA
    if (same_word(f.text(i), "THRU"))
      return f.error_in(
          ErrorCode::unsupported, i,
          "its list of nodes has THRU, which RBE2 does not know; expected each node by its number");
    if (!f.blank(i)) s.nodes.push_back(f.label(i, "a node GM"));
  }
  c.spiders.push_back(std::move(s));
}

void read_nastran_rbe3(NastranFields& f, NastranContent& c) {
  NastranSpider s = spider(f, "RBE3");
  s.kind = Spider::Kind::mean;
  s.reference = f.label(2, "node REFGRID");
  s.mask = f.components(3, "the components REFC");
  double weight = 1.0;
  unsigned mask = 7u;
  for (std::size_t i = 4; i < f.size(); ++i) {
    if (f.blank(i)) continue;
    if (same_word(f.text(i), "ALPHA")) break;
    if (same_word(f.text(i), "UM")) {
      dependent_components(f, i + 1, std::popcount(s.mask));
      break;
    }
    if (is_real(f.text(i))) {
      weight = f.real(i, "a weight");
      if (!(weight > 0.0))
        f.error(ErrorCode::out_of_range, "a weight is {:g}, expected more than 0", weight);
      mask = f.components(++i, "the components of a weight");
      if (mask == 0) f.error(ErrorCode::missing, "the components of a weight are missing");
      continue;
    }
    s.nodes.push_back(f.label(i, "a node"));
    s.weights.push_back(weight);
    s.components.push_back(mask);
  }
  c.spiders.push_back(std::move(s));
}

namespace {

/// What the independent components of a node leave.
void complement(NastranRigid& r, const std::vector<int>& nodes) {
  for (const int node : nodes) {
    unsigned mask = 63u;
    for (const NastranRigid::Part& p : r.independent)
      if (p.node == node) mask &= ~p.mask;
    if (mask != 0) r.dependent.push_back({node, mask});
  }
}

/// Nodes at `node`, their independent components at `first`, the dependent ones at `other`; if
/// these are blank, all that are not independent.
void read_nastran_rigid(NastranFields& f, NastranContent& c, const char* card, std::size_t nodes,
                        std::size_t first, std::size_t other) {
  NastranRigid r;
  r.card = card;
  r.at = f.at();
  r.id = f.label(0, "the number of the element");
  std::vector<int> names;
  int count = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    names.push_back(f.label(1 + k, "a node"));
    const unsigned mask = f.components(first + k, "the independent components");
    count += std::popcount(mask);
    if (mask != 0) r.independent.push_back({names.back(), mask});
  }
  if (count != 6)
    f.error(ErrorCode::wrong_count, "it has {} independent components, expected 6 in all", count);
  for (std::size_t k = 0; k < nodes; ++k) {
    const unsigned mask = f.components(other + k, "the dependent components");
    if (mask != 0) r.dependent.push_back({names[k], mask});
  }
  if (r.dependent.empty()) complement(r, names);
  c.rigids.push_back(std::move(r));
}

}  // namespace

void read_nastran_rbar(NastranFields& f, NastranContent& c) {
  NastranSpider s = spider(f, "RBAR");
  s.reference = f.label(1, "node GA");
  s.nodes = {f.label(2, "node GB")};
  if (f.name() == "RBAR1") {
    if (!f.blank(3)) s.mask = f.components(3, "CB");
    return c.spiders.push_back(std::move(s));
  }
  const unsigned na = f.components(3, "CNA"), nb = f.components(4, "CNB");
  const bool from_a = na == 63u && nb == 0, from_b = nb == 63u && na == 0;
  if (!from_a && !from_b) return read_nastran_rigid(f, c, "RBAR", 2, 3, 5);
  const std::size_t dependent = from_a ? 6 : 5;
  if (from_b) std::swap(s.reference, s.nodes[0]);
  if (!f.blank(dependent)) s.mask = f.components(dependent, from_a ? "CMB" : "CMA");
  c.spiders.push_back(std::move(s));
}

void read_nastran_rtrplt(NastranFields& f, NastranContent& c) {
  read_nastran_rigid(f, c, "RTRPLT", 3, 4, 8);
}

/// Pairs of nodes and components, three on a line, then UM and those that depend.
void read_nastran_rbe1(NastranFields& f, NastranContent& c) {
  NastranRigid r;
  r.card = "RBE1";
  r.at = f.at();
  r.id = f.label(0, "the number of the element");
  bool dependent = false;
  int count = 0;
  for (std::size_t i = 1; i < f.size(); ++i) {
    if (f.blank(i)) continue;
    if (same_word(f.text(i), "UM")) {
      dependent = true;
      continue;
    }
    if (i + 1 == f.size() || is_real(f.text(i))) break;  // ALPHA
    const int node = f.label(i, "a node");
    const unsigned mask = f.components(++i, "the components of a node");
    if (mask == 0) f.error(ErrorCode::missing, "the components of node {} are missing", node);
    if (!dependent) count += std::popcount(mask);
    (dependent ? r.dependent : r.independent).push_back({node, mask});
  }
  if (count != 6)
    f.error(ErrorCode::wrong_count, "it has {} independent components, expected 6 in all", count);
  if (r.dependent.empty())
    f.error(ErrorCode::missing, "UM with the dependent components is missing");
  c.rigids.push_back(std::move(r));
}

void read_nastran_rrod(NastranFields& f, NastranContent& c) {
  NastranRigidRod r;
  r.at = f.at();
  r.id = f.label(0, "the number of the element");
  r.a = f.label(1, "node GA");
  r.b = f.label(2, "node GB");
  c.rigid_rods.push_back(r);
}

void read_nastran_mpc(NastranFields& f, NastranContent& c) {
  NastranEquation e;
  e.at = f.at();
  e.set = f.label(0, "the set");
  for (std::size_t i = 1; i + 1 < f.size(); i += 3) {
    if (i % 8 == 7) i += 2;  // field 9 and the first of the next line are blank
    if (f.blank(i)) continue;
    const unsigned mask = f.components(i + 1, "the component");
    int component = mask == 0 ? -1 : 0;  // none: of a scalar point
    while (component >= 0 && component < 6 && mask != (1u << component)) ++component;
    if (component == 6) {
      f.error(ErrorCode::out_of_range, "the component is {}, expected one of 1 to 6",
              shown(f.text(i + 1)));
      return;
    }
    e.terms.push_back({f.label(i, "a node"), component, f.real(i + 2, "a coefficient", 0.0)});
  }
  if (e.terms.empty() || e.terms[0].factor == 0.0) {
    f.error(ErrorCode::incomplete, "the first term needs a coefficient that is not zero");
    return;
  }
  c.equations.push_back(std::move(e));
}

void read_nastran_mpc_add(NastranFields& f, NastranContent& c) {
  std::vector<int>& sets = c.added_mpc_sets[f.label(0, "the set")];
  for (std::size_t i = 1; i < f.size(); ++i) {
    if (!f.blank(i)) sets.push_back(f.label(i, "a set"));
  }
}

void read_nastran_spc_add(NastranFields& f, NastranContent& c) {
  std::vector<int>& sets = c.added_spc_sets[f.label(0, "the set")];
  for (std::size_t i = 1; i < f.size(); ++i) {
    if (!f.blank(i)) sets.push_back(f.label(i, "a set"));
  }
}

void read_nastran_spc(NastranFields& f, NastranContent& c) {
  const int set = f.label(0, "the set");
  for (std::size_t i = 1; i < 7; i += 3) {
    if (f.blank(i)) continue;
    const int node = f.label(i, "a node");
    c.supports.push_back({node, node, f.components(i + 1, "the components"), f.at(), set});
  }
}

void read_nastran_spc1(NastranFields& f, NastranContent& c) {
  const int set = f.label(0, "the set");
  const unsigned mask = f.components(1, "the components");
  for (std::size_t i = 2; i < f.size(); ++i) {
    if (f.blank(i)) continue;
    const auto [first, last] = f.range(i, "a node");
    c.supports.push_back({first, last, mask, f.at(), set});
  }
}

}  // namespace floatframe
