// Cards of spiders, linear equations and supports.
#include <bit>

#include "floatframe/decks/nastran/nastran_content.hpp"

namespace floatframe {
namespace {

bool is_real(std::string_view field) {
  return field.find_first_of(".eEdD") != std::string_view::npos && parse_real(field).has_value();
}

void read_nastran_rbe2(NastranFields& f, NastranContent& c) {
  auto s = f.entity<NastranSpider>("the number of the element");
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

/// UM of RBE3 selects the dependent components: the equations are equivalent, so it is only
/// checked.
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

void read_nastran_rbe3(NastranFields& f, NastranContent& c) {
  auto s = f.entity<NastranSpider>("the number of the element");
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
      weight = f.real(i, "a weight", std::nullopt, NastranRange::positive);
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

/// For a rigid element, whose independent components must be six.
void check_independent(NastranFields& f, const NastranRigid& r) {
  int count = 0;
  for (const NastranRigid::Part& p : r.independent) count += std::popcount(p.mask);
  if (count != 6)
    f.error(ErrorCode::wrong_count, "it has {} independent components, expected 6 in all", count);
}

/// Nodes from field 1 on, their independent components at `first`, the dependent ones at `other`;
/// if these are blank, all that are not independent.
void read_nastran_rigid(NastranFields& f, NastranContent& c, std::size_t nodes, std::size_t first,
                        std::size_t other) {
  auto r = f.entity<NastranRigid>("the number of the element");
  for (std::size_t k = 0; k < nodes; ++k) {
    const int node = f.label(1 + k, "a node");
    r.independent.push_back({node, f.components(first + k, "the independent components")});
  }
  check_independent(f, r);
  for (std::size_t k = 0; k < nodes; ++k)
    r.dependent.push_back(
        {r.independent[k].node, f.components(other + k, "the dependent components")});
  const auto none = [](const NastranRigid::Part& p) { return p.mask == 0; };
  if (std::all_of(r.dependent.begin(), r.dependent.end(), none))
    for (NastranRigid::Part& rest : r.dependent) {
      rest.mask = 63u;
      for (const NastranRigid::Part& p : r.independent)
        if (p.node == rest.node) rest.mask &= ~p.mask;
    }
  std::erase_if(r.independent, none);
  std::erase_if(r.dependent, none);
  c.rigids.push_back(std::move(r));
}

void read_nastran_rbar(NastranFields& f, NastranContent& c) {
  auto s = f.entity<NastranSpider>("the number of the element");
  s.card = "RBAR";
  s.reference = f.label(1, "node GA");
  s.nodes = {f.label(2, "node GB")};
  if (f.name() == "RBAR1") {
    if (!f.blank(3)) s.mask = f.components(3, "CB");
    return c.spiders.push_back(std::move(s));
  }
  const unsigned na = f.components(3, "CNA"), nb = f.components(4, "CNB");
  const bool from_a = na == 63u && nb == 0, from_b = nb == 63u && na == 0;
  if (!from_a && !from_b) return read_nastran_rigid(f, c, 2, 3, 5);
  const std::size_t dependent = from_a ? 6 : 5;
  if (from_b) std::swap(s.reference, s.nodes[0]);
  if (!f.blank(dependent)) s.mask = f.components(dependent, from_a ? "CMB" : "CMA");
  c.spiders.push_back(std::move(s));
}

void read_nastran_rtrplt(NastranFields& f, NastranContent& c) { read_nastran_rigid(f, c, 3, 4, 8); }

/// Pairs of nodes and components, three on a line, then UM and those that depend.
void read_nastran_rbe1(NastranFields& f, NastranContent& c) {
  auto r = f.entity<NastranRigid>("the number of the element");
  bool dependent = false;
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
    (dependent ? r.dependent : r.independent).push_back({node, mask});
  }
  check_independent(f, r);
  if (r.dependent.empty())
    f.error(ErrorCode::missing, "UM with the dependent components is missing");
  c.rigids.push_back(std::move(r));
}

void read_nastran_rrod(NastranFields& f, NastranContent& c) {
  auto r = f.entity<NastranRigid>("the number of the element");
  r.independent.push_back({f.label(1, "node GA")});
  r.dependent.push_back({f.label(2, "node GB")});
  c.rigids.push_back(std::move(r));
}

void read_nastran_mpc(NastranFields& f, NastranContent& c) {
  auto e = f.entity<NastranEquation>("the set");
  for (std::size_t i = 1; i + 1 < f.size(); i += 3) {
    if (i % 8 == 7) i += 2;  // field 9 and the first of the next line are blank
    if (f.blank(i)) continue;
    const int component = f.component(i + 1, false);  // none: of a scalar point
    if (component == 6) return;
    e.terms.push_back({f.label(i, "a node"), component, f.real(i + 2, "a coefficient", 0.0)});
  }
  if (e.terms.empty() || e.terms[0].factor == 0.0)
    return f.error(ErrorCode::incomplete, "the first term needs a coefficient that is not zero");
  c.equations.push_back(std::move(e));
}

/// MPCADD, SPCADD.
template <std::map<int, std::vector<int>> NastranContent::*added>
void read_nastran_added_sets(NastranFields& f, NastranContent& c) {
  std::vector<int>& sets = (c.*added)[f.label(0, "the set")];
  for (std::size_t i = 1; i < f.size(); ++i)
    if (!f.blank(i)) sets.push_back(f.label(i, "a set"));
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

}  // namespace

std::span<const NastranCardReader> nastran_constraint_cards() {
  static constexpr NastranCardReader cards[] = {
      {"RBE1", read_nastran_rbe1},
      {"RBE2", read_nastran_rbe2},
      {"RBE3", read_nastran_rbe3},
      {"RBAR RBAR1", read_nastran_rbar},
      {"RTRPLT", read_nastran_rtrplt},
      {"RROD", read_nastran_rrod},
      {"MPC", read_nastran_mpc},
      {"MPCADD", read_nastran_added_sets<&NastranContent::added_mpc_sets>},
      {"SPC", read_nastran_spc},
      {"SPC1", read_nastran_spc1},
      {"SPCADD", read_nastran_added_sets<&NastranContent::added_spc_sets>}};
  return cards;
}

}  // namespace floatframe
