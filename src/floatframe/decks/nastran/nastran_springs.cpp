// Cards of springs, bushings and rods.
#include "floatframe/decks/nastran/nastran_springs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

void damping(NastranFields& f, std::size_t i, NastranContent& c) {
  if (f.real(i, "the damping", 0.0) != 0.0 && !c.springs.damping) c.springs.damping = f.at();
}

/// A node and one of its components, or a scalar point; none: the ground.
void spring_end(NastranFields& f, std::size_t i, int end, NastranSpring& s) {
  if (f.blank(i) || f.text(i) == "0") return;
  s.nodes[end] = f.label(i, end == 0 ? "node G1" : "node G2");
  const unsigned mask = f.components(i + 1, "the component");
  int& component = s.components[end];
  if (mask == 0) {
    component = -1;
    return;
  }
  while (component < 5 && mask != (1u << component)) ++component;
  if (mask != (1u << component))
    f.error(ErrorCode::out_of_range, "the component is {}, expected one of 1 to 6",
            shown(f.text(i + 1)));
}

/// A CONROD, which is its own property, by a number that no card has.
NastranProperty* own_property(NastranFields& f, const NastranElement& e, NastranContent& c) {
  const auto [it, fresh] = c.properties.try_emplace(-e.id);
  if (!fresh) nastran_twice(f, it->second.at);
  return fresh ? &it->second : nullptr;
}

void rod_section(NastranFields& f, std::size_t material, NastranProperty& p) {
  p.material = f.label(material, "the material");
  p.section.A = f.real(material + 1, "A");
  p.section.J = f.real(material + 2, "J", 0.0);
  p.nonstructural = f.real(material + 4, "the nonstructural mass", 0.0);
  if (p.section.J < 0.0)
    f.error(ErrorCode::out_of_range, "J is {:g}, expected no negative number", p.section.J);
}

}  // namespace

void read_nastran_celas(NastranFields& f, NastranContent& c) {
  NastranSpring s;
  s.card = f.name() == "CELAS1" ? "CELAS1" : "CELAS2";
  s.at = f.at();
  s.id = f.label(0, "the number of the element");
  if (f.name() == "CELAS1") {
    s.property = f.blank(1) ? s.id : f.label(1, "the property");
  } else {
    s.stiffness = f.real(1, "K");
    damping(f, 6, c);
  }
  spring_end(f, 2, 0, s);
  spring_end(f, 4, 1, s);
  if (s.nodes[0] == 0) {  // the ground comes second
    std::swap(s.nodes[0], s.nodes[1]);
    std::swap(s.components[0], s.components[1]);
  }
  if (s.nodes[0] == 0) {
    f.error(ErrorCode::missing, "it has no node");
    return;
  }
  c.springs.list.push_back(s);
}

void read_nastran_pelas(NastranFields& f, NastranContent& c) {
  for (const std::size_t i : {0, 4}) {
    if (i > 0 && f.blank(i)) continue;
    const int id = f.label(i, "the number of the property");
    const auto [it, fresh] = c.springs.pelas.try_emplace(id, std::pair{f.real(i + 1, "K"), f.at()});
    if (!fresh && id > 0) nastran_twice(f, it->second.second);
    damping(f, i + 2, c);
  }
}

/// What CBUSH and CBUSH1D begin with.
static NastranSpring bush_between_nodes(NastranFields& f, const char* card) {
  NastranSpring s;
  s.card = card;
  s.at = f.at();
  s.id = f.label(0, "the number of the element");
  s.property = f.blank(1) ? s.id : f.label(1, "the property");
  s.nodes[0] = f.label(2, "node GA");
  s.nodes[1] = f.blank(3) ? 0 : f.label(3, "node GB");
  return s;
}

void read_nastran_bush(NastranFields& f, NastranContent& c) {
  NastranSpring s = bush_between_nodes(f, "CBUSH");
  if (f.blank(5) && f.blank(6) && !f.blank(4) && parse_label(f.text(4))) {
    s.orientation_node = f.label(4, "node GO");
  } else {
    s.orientation = f.vector(4, "the orientation vector");
  }
  s.system = f.integer(7, "the coordinate system CID", -1);
  s.place = f.real(8, "the place S", 0.5);
  s.offset_system = f.integer(9, "the coordinate system OCID", -1);
  s.offset = f.vector(10, "the offset");
  c.springs.list.push_back(s);
}

/// Lines "K", "B", "GE", ... with a value for each direction.
void read_nastran_pbush(NastranFields& f, NastranContent& c) {
  const int id = f.label(0, "the number of the property");
  Vec6 k = Vec6::Zero();
  for (std::size_t line = 0; line < f.size(); line += 8) {
    const std::string_view word = f.text(line + 1);
    const bool stiffness = same_word(word, "K"),
               lost = same_word(word, "B") || same_word(word, "GE");
    if (word.empty() || same_word(word, "RCV")) continue;
    if (!stiffness && !lost) {
      f.error(ErrorCode::unsupported,
              "found the line {}, expected K, B, GE or RCV; others are not read", shown(word));
      return;
    }
    for (int i = 0; i < 6; ++i) {
      const std::size_t at = line + 2 + static_cast<std::size_t>(i);
      if (lost) {
        damping(f, at, c);
      } else if (same_word(f.text(at), "RIGID")) {
        f.error(ErrorCode::not_a_number,
                "RIGID is not a stiffness; give a number, or join the nodes with RBE2");
      } else {
        k(i) = f.real(at, "a stiffness", 0.0);
      }
    }
  }
  const auto [it, fresh] = c.springs.pbush.try_emplace(id, std::pair{k, f.at()});
  if (!fresh && id > 0) nastran_twice(f, it->second.second);
}

void read_nastran_bush1d(NastranFields& f, NastranContent& c) {
  NastranSpring s = bush_between_nodes(f, "CBUSH1D");
  s.system = f.integer(4, "the coordinate system CID", -1);
  c.springs.list.push_back(s);
}

/// K, C and M, then lines of what is not linear: dampers do not count, springs would.
void read_nastran_pbush1d(NastranFields& f, NastranContent& c) {
  const int id = f.label(0, "the number of the property");
  const double k = f.real(1, "K", 0.0);
  damping(f, 2, c);
  f.must_be_zero(3, "the mass M");
  for (std::size_t i = 8; i < f.size(); i += 8) {
    const std::string_view word = f.text(i);
    const bool damper = same_word(word, "SHOCKA") || same_word(word, "DAMPER");
    if (damper && !c.springs.damping) c.springs.damping = f.at();
    if (same_word(word, "SPRING") || same_word(word, "GENER"))
      f.error(ErrorCode::unsupported,
              "{} gives a stiffness that is not linear; give its slope at rest as K",
              upper_case(word));
  }
  const auto [it, fresh] = c.springs.pbush1d.try_emplace(id, std::pair{k, f.at()});
  if (!fresh && id > 0) nastran_twice(f, it->second.second);
}

void read_nastran_rod(NastranFields& f, NastranContent& c) {
  NastranElement e;
  const bool own = f.name() == "CONROD";
  e.card = own ? "CONROD" : f.name() == "CROD" ? "CROD" : "CTUBE";
  e.at = f.at();
  e.type = ElementType::rod2;
  e.count = 2;
  e.id = f.label(0, "the number of the element");
  const std::size_t first = own ? 1 : 2;
  if (!own) e.property = f.blank(1) ? e.id : f.label(1, "the property");
  e.nodes[0] = f.label(first, "node G1");
  e.nodes[1] = f.label(first + 1, "node G2");
  if (own && e.id > 0) {
    e.property = -e.id;
    if (NastranProperty* p = own_property(f, e, c)) {
      p->card = "CONROD";
      p->at = f.at();
      rod_section(f, 3, *p);
    }
  }
  c.elements.push_back(e);
}

void read_nastran_rod_property(NastranFields& f, NastranProperty& p) {
  if (f.name() == "PROD") return rod_section(f, 1, p);
  p.material = f.label(1, "the material");
  const double outer = f.real(2, "OD"), wall = f.real(3, "T", 0.5 * outer);
  const double end = f.real(5, "OD2", outer);
  if (std::abs(end - outer) > 1e-6 * std::abs(outer))
    f.error(ErrorCode::unsupported, "a tapered tube is not supported: OD is {} and OD2 is {}",
            shown(f.text(2)), shown(f.text(5)));
  if (!(outer > 0.0) || wall < 0.0 || wall > 0.5 * outer) {
    f.error(ErrorCode::geometry, "OD is {:g} and T is {:g}, expected a tube", outer, wall);
    return;
  }
  const bool solid = wall == 0.0;
  p.section = BeamSection::hollow_round(outer, solid ? 0.0 : outer - 2.0 * wall);
  p.nonstructural = f.real(4, "the nonstructural mass", 0.0);
}

}  // namespace floatframe
