#include "floatframe/decks/nastran/read_nastran.hpp"

#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {

bool looks_like_nastran(std::string_view beginning) {
  if (has_begin_bulk(beginning)) return true;
  constexpr std::array<std::string_view, 8> cards = {"GRID",   "CTETRA", "CHEXA", "CPENTA",
                                                     "CQUAD4", "CTRIA3", "CBAR",  "PSOLID"};
  while (!beginning.empty()) {
    const std::string_view line = next_line(beginning);
    if (line.starts_with('$') || trimmed(line).empty()) continue;
    const std::string_view name = card_name(line);
    if (same_word(name, "DMIG")) return false;  // matrices, also with nodes
    if (std::any_of(cards.begin(), cards.end(),
                    [name](std::string_view card) { return same_word(name, card); }))
      return true;
  }
  return false;
}

FeModel read_nastran(TextSource& source, bool has_control, const FeReadOptions& options,
                     NastranPart part) {
  const NastranContent content =
      read_nastran_content(source, has_control, part == NastranPart::nodes);
  source.throw_if_any();  // further missing items may be consequences; likewise below
  NastranBuild build(content, source);
  if (const NastranWholeNumbers& w = content.whole_numbers; w.count > 0)
    build.note(w.at,
               fmt::format("{}, a whole number where a real one is expected, and {} more such "
                           "fields: Nastran stops there; they are read as real ones",
                           w.first, w.count - 1));
  build_nastran_nodes(build);
  source.throw_if_any();
  if (part == NastranPart::all) {
    build.scalars.build(build);
    source.throw_if_any();
    build_nastran_elements(build, options);
    if (!content.properties.empty()) note_nastran_shells(build);
    nastran_mass_forms(build);
    build_nastran_springs(build);
    build_nastran_constraints(build);
    if (source.errors() == 0) build_nastran_torsion(build);
  } else {
    build.model.axes_of_rows.insert(build.turned_axes.begin(), build.turned_axes.end());
  }
  build_nastran_supports(build);
  build_nastran_sets(build, part == NastranPart::nodes);
  source.throw_if_any();
  build.model.files = source.files();
  for (const std::string& note : content.notes)
    build.model.notes.push_back(fmt::format("{}: {}", build.model.files[0], note));
  return std::move(build.model);
}

FeModel read_nastran(const std::filesystem::path& file, const FeReadOptions& options) {
  TextSource source(file);
  return read_nastran(source, has_begin_bulk(source.first_text()), options);
}

}  // namespace floatframe
