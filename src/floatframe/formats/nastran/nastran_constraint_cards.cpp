// Cards of spiders, linear equations and supports.
#include <fmt/format.h>

#include <bit>

#include "floatframe/formats/nastran/nastran_content.hpp"
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
void dependent_components(NastranFields& f, std::size_t i) {
  int count = 0;
  for (; i < f.size() && !same_word(f.text(i), "ALPHA"); i += 2) {
    if (f.blank(i)) {
      --i;  // fields between lines
      continue;
    }
    f.label(i, "a node of UM");
    count += std::popcount(f.components(i + 1, "the components of UM"));
  }
  if (count != 6) f.error(fmt::format("UM has {} components, expected 6", count));
}

}  // namespace

void read_nastran_rbe2(NastranFields& f, NastranContent& c) {
  NastranSpider s = spider(f, "RBE2");
  s.reference = f.label(1, "node GN");
  s.mask = f.components(2, "the components CM");
  for (std::size_t i = 3; i < f.size(); ++i) {
    if (i + 1 == f.size() && is_real(f.text(i))) break;  // ALPHA
    if (!f.blank(i)) s.nodes.push_back(f.label(i, "a node GM"));
  }
  c.spiders.push_back(std::move(s));
}

void read_nastran_rbe3(NastranFields& f, NastranContent& c) {
  NastranSpider s = spider(f, "RBE3");
  s.kind = Spider::Kind::mean;
  s.reference = f.label(2, "node REFGRID");
  if (f.components(3, "the components REFC") != 63u) {
    f.error(fmt::format("REFC is {}, only 123456 is read", shown(f.text(3))));
  }
  double weight = 1.0;
  for (std::size_t i = 4; i < f.size(); ++i) {
    if (f.blank(i)) continue;
    if (same_word(f.text(i), "ALPHA")) break;
    if (same_word(f.text(i), "UM")) {
      dependent_components(f, i + 1);
      break;
    }
    if (is_real(f.text(i))) {
      weight = f.real(i, "a weight");
      const unsigned mask = f.components(++i, "the components of a weight");
      s.weighs_rotations = s.weighs_rotations || mask == 63u;
      if (mask != 7u && mask != 63u) {
        f.error(
            fmt::format("the components of a weight are {}, only 123 is read", shown(f.text(i))));
      }
      continue;
    }
    s.nodes.push_back(f.label(i, "a node"));
    s.weights.push_back(weight);
  }
  c.spiders.push_back(std::move(s));
}

void read_nastran_rbar(NastranFields& f, NastranContent& c) {
  NastranSpider s = spider(f, "RBAR");
  const int a = f.label(1, "node GA"), b = f.label(2, "node GB");
  const unsigned na = f.components(3, "CNA"), nb = f.components(4, "CNB");
  const bool from_a = na == 63u && nb == 0, from_b = nb == 63u && na == 0;
  if (!from_a && !from_b) {
    f.error("one of CNA and CNB must be 123456 and the other blank");
    return;
  }
  const std::size_t dependent = from_a ? 6 : 5;
  s.reference = from_a ? a : b;
  s.nodes = {from_a ? b : a};
  if (!f.blank(dependent)) s.mask = f.components(dependent, from_a ? "CMB" : "CMA");
  c.spiders.push_back(std::move(s));
}

void read_nastran_mpc(NastranFields& f, NastranContent& c) {
  NastranEquation e;
  e.at = f.at();
  e.set = f.label(0, "the set");
  for (std::size_t i = 1; i + 1 < f.size(); i += 3) {
    if (i % 8 == 7) i += 2;  // field 9 and the first of the next line are blank
    if (f.blank(i)) continue;
    const unsigned mask = f.components(i + 1, "the component");
    int component = 0;
    while (component < 6 && mask != (1u << component)) ++component;
    if (component == 6) {
      f.error(fmt::format("the component is {}, expected one of 1 to 6", shown(f.text(i + 1))));
      return;
    }
    e.terms.push_back({f.label(i, "a node"), component, f.real(i + 2, "a coefficient", 0.0)});
  }
  if (e.terms.empty() || e.terms[0].factor == 0.0) {
    f.error("the first term needs a coefficient that is not zero");
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

void read_nastran_spc(NastranFields& f, NastranContent& c) {
  for (std::size_t i = 1; i < 7; i += 3) {
    if (f.blank(i)) continue;
    const int node = f.label(i, "a node");
    c.supports.push_back({node, node, f.components(i + 1, "the components"), f.at()});
  }
}

void read_nastran_spc1(NastranFields& f, NastranContent& c) {
  const unsigned mask = f.components(1, "the components");
  for (std::size_t i = 2; i < f.size(); ++i) {
    if (f.blank(i)) continue;
    const int first = f.label(i, "a node");
    int last = first;
    if (same_word(f.text(i + 1), "THRU")) {
      last = f.label(i + 2, "the last node");
      i += 2;
    }
    c.supports.push_back({first, last, mask, f.at()});
  }
}

}  // namespace floatframe
