// Cards of bars, beams and rods, with what bars leave to BAROR and BEAMOR.
#include <fmt/format.h>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// OFFT; of BAROR only the first letter counts. CBEAM may have a number (BIT) there.
void bar_axes(NastranFields& f, char* axes) {
  if (f.blank(7) || parse_real(f.text(7))) return;
  const std::string word = upper_case(f.text(7));
  const auto one_of = [&](std::size_t i, std::string_view letters) {
    return i >= word.size() || letters.find(word[i]) != std::string_view::npos;
  };
  if (word.size() > 3 || !one_of(0, "GB") || !one_of(1, "GO") || !one_of(2, "GO"))
    return f.error(ErrorCode::wrong_value,
                   "OFFT is {}, expected GGG, BGG, GGO, BGO, GOG, BOG, GOO or BOO",
                   shown(f.text(7)));
  for (std::size_t i = 0; i < word.size(); ++i) axes[i] = word[i];
}

NastranElement line_element(NastranFields& f, ElementType type) {
  auto e = f.entity<NastranElement>("the number of the element");
  e.type = type;
  e.count = 2;
  return e;
}

void read_nastran_bar(NastranFields& f, NastranContent& c) {
  NastranElement e = line_element(f, ElementType::beam2);
  e.default_property = f.blank(1);
  e.property = f.label(1, "the property", e.id);
  e.nodes[0] = f.label(2, "node GA");
  e.nodes[1] = f.label(3, "node GB");
  e.default_orientation = !read_nastran_direction(f, "node G0", e.orientation);
  NastranBarEnds ends;
  bar_axes(f, ends.axes);
  for (int k = 0; k < 2; ++k) {
    ends.pins[k] = f.components(8 + k, k == 0 ? "the pins PA" : "the pins PB");
    ends.offset[k] = f.vector(10 + 3 * k, k == 0 ? "the offset WA" : "the offset WB");
  }
  if (ends.axes[0] != 'G' || !ends.plain()) {
    e.ends = static_cast<int>(c.bar_ends.size());
    c.bar_ends.push_back(ends);
  }
  c.elements.push_back(std::move(e));
}

void read_nastran_bar_default(NastranFields& f, NastranContent& c) {
  NastranBarDefault d;
  d.at = f.at();
  d.property = f.label(1, "the property", 0);
  read_nastran_direction(f, "node G0", d.orientation);
  char axes[3] = {'G', 'G', 'G'};
  bar_axes(f, axes);
  d.axes = axes[0];
  const auto [it, fresh] = c.bar_defaults.try_emplace(f.name() == "BAROR" ? "CBAR" : "CBEAM", d);
  if (!fresh)
    f.error(ErrorCode::duplicate, "it is in the file twice, first in line {}", it->second.at.line);
}

/// A CONROD is its own property, by a number that no card has.
void read_nastran_rod(NastranFields& f, NastranContent& c) {
  NastranElement e = line_element(f, ElementType::rod2);
  const bool own = f.name() == "CONROD";
  const std::size_t first = own ? 1 : 2;
  if (!own) e.property = f.label(1, "the property", e.id);
  e.nodes[0] = f.label(first, "node G1");
  e.nodes[1] = f.label(first + 1, "node G2");
  if (own && e.id > 0) {
    e.property = -e.id;
    const auto [it, fresh] = c.properties.try_emplace(e.property);
    NastranProperty& p = it->second;
    if (fresh) {
      NastranEntity& entity = p;
      entity = e;
      read_nastran_rod_section(f, 3, p);
    } else {
      f.twice(p.at);
    }
  }
  c.elements.push_back(std::move(e));
}

}  // namespace

bool read_nastran_direction(NastranFields& f, const char* node, NastranDirection& direction) {
  if (f.blank(4) && f.blank(5) && f.blank(6)) return false;
  if (f.blank(5) && f.blank(6) && parse_label(f.text(4))) {
    direction.node = f.label(4, node);
  } else {
    direction.vector = f.vector(4, "the orientation vector");
  }
  return true;
}

void complete_nastran_bars(NastranContent& c, TextSource& source) {
  for (NastranElement& e : c.elements) {
    if (!e.default_property && !e.default_orientation) continue;
    const auto it = c.bar_defaults.find(e.card);
    const NastranBarDefault* d = it == c.bar_defaults.end() ? nullptr : &it->second;
    if (e.default_property && d != nullptr && d->property > 0) e.property = d->property;
    if (!e.default_orientation) continue;
    if (d == nullptr || (d->orientation.node == 0 && d->orientation.vector == Vec3::Zero())) {
      source.error(ErrorCode::missing, e.at, "{}: the orientation vector is missing", e.label());
      continue;
    }
    e.orientation = d->orientation;
    if (d->axes == 'G') continue;
    if (e.ends < 0) {
      e.ends = static_cast<int>(c.bar_ends.size());
      c.bar_ends.emplace_back();
    }
    c.bar_ends[e.ends].axes[0] = d->axes;
  }
}

std::span<const NastranCardReader> nastran_bar_cards() {
  static constexpr NastranCardReader cards[] = {{"CBAR CBEAM", read_nastran_bar},
                                                {"BAROR BEAMOR", read_nastran_bar_default},
                                                {"CROD CTUBE CONROD", read_nastran_rod}};
  return cards;
}

}  // namespace floatframe
