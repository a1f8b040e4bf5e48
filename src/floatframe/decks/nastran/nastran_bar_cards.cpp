// Cards of bars and beams, with what they leave to BAROR and BEAMOR.
#include <fmt/format.h>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Fields 5 to 8: a vector or a node, and OFFT; false if the vector is blank.
bool bar_orientation(NastranFields& f, Vec3& vector, int& node) {
  if (f.blank(4) && f.blank(5) && f.blank(6)) return false;
  if (f.blank(5) && f.blank(6) && parse_label(f.text(4))) {
    node = f.label(4, "node G0");
  } else {
    vector = f.vector(4, "the orientation vector");
  }
  return true;
}

/// OFFT; of BAROR only the first letter counts. CBEAM may have a number (BIT) there.
void bar_axes(NastranFields& f, char* axes) {
  if (f.blank(7) || parse_real(f.text(7))) return;
  const std::string word = upper_case(f.text(7));
  const auto one_of = [&](std::size_t i, std::string_view letters) {
    return i >= word.size() || letters.find(word[i]) != std::string_view::npos;
  };
  if (word.size() > 3 || !one_of(0, "GB") || !one_of(1, "GO") || !one_of(2, "GO")) {
    f.error(ErrorCode::wrong_value, "OFFT is {}, expected GGG, BGG, GGO, BGO, GOG, BOG, GOO or BOO",
            shown(f.text(7)));
    return;
  }
  for (std::size_t i = 0; i < word.size(); ++i) axes[i] = word[i];
}

}  // namespace

void read_nastran_bar(NastranFields& f, NastranContent& c) {
  NastranElement e;
  e.card = f.name() == "CBAR" ? "CBAR" : "CBEAM";
  e.at = f.at();
  e.type = ElementType::beam2;
  e.count = 2;
  e.id = f.label(0, "the number of the element");
  e.default_property = f.blank(1);
  e.property = f.blank(1) ? e.id : f.label(1, "the property");
  e.nodes[0] = f.label(2, "node GA");
  e.nodes[1] = f.label(3, "node GB");
  e.default_orientation = !bar_orientation(f, e.orientation, e.orientation_node);
  NastranBarEnds ends;
  bar_axes(f, ends.axes);
  bool special = ends.axes[0] != 'G';
  for (int k = 0; k < 2; ++k) {
    ends.pins[k] = f.components(8 + k, k == 0 ? "the pins PA" : "the pins PB");
    ends.offset[k] = f.vector(10 + 3 * k, k == 0 ? "the offset WA" : "the offset WB");
    special = special || ends.pins[k] != 0 || ends.offset[k] != Vec3::Zero();
  }
  if (special) {
    e.ends = static_cast<int>(c.bar_ends.size());
    c.bar_ends.push_back(ends);
  }
  c.elements.push_back(e);
}

void read_nastran_bar_default(NastranFields& f, NastranContent& c) {
  NastranBarDefault d;
  d.at = f.at();
  if (!f.blank(1)) d.property = f.label(1, "the property");
  bar_orientation(f, d.orientation, d.orientation_node);
  char axes[3] = {'G', 'G', 'G'};
  bar_axes(f, axes);
  d.axes = axes[0];
  const auto [it, fresh] = c.bar_defaults.try_emplace(f.name() == "BAROR" ? "CBAR" : "CBEAM", d);
  if (!fresh)
    f.error(ErrorCode::duplicate, "it is in the file twice, first in line {}", it->second.at.line);
}

void complete_nastran_bars(NastranContent& c, TextSource& source) {
  for (NastranElement& e : c.elements) {
    if (!e.default_property && !e.default_orientation) continue;
    const auto it = c.bar_defaults.find(e.card);
    const NastranBarDefault* d = it == c.bar_defaults.end() ? nullptr : &it->second;
    if (e.default_property && d != nullptr && d->property > 0) e.property = d->property;
    if (!e.default_orientation) continue;
    if (d == nullptr || (d->orientation_node == 0 && d->orientation == Vec3::Zero())) {
      source.error(ErrorCode::missing, e.at, "{} {}: the orientation vector is missing", e.card,
                   e.id);
      continue;
    }
    e.orientation = d->orientation;
    e.orientation_node = d->orientation_node;
    if (d->axes == 'G') continue;
    if (e.ends < 0) {
      e.ends = static_cast<int>(c.bar_ends.size());
      c.bar_ends.emplace_back();
    }
    c.bar_ends[e.ends].axes[0] = d->axes;
  }
}

}  // namespace floatframe
