#include "floatframe/decks/nastran/nastran_content.hpp"

#include <fmt/ranges.h>

namespace floatframe {
namespace {

using ReadCard = decltype(NastranCardReader::read);

const std::unordered_map<std::string_view, ReadCard>& card_readers() {
  static const std::unordered_map<std::string_view, ReadCard> readers = [] {
    std::unordered_map<std::string_view, ReadCard> all;
    for (const auto list :
         {nastran_mesh_cards(), nastran_bar_cards(), nastran_material_cards(),
          nastran_property_cards(), nastran_scalar_cards(), nastran_constraint_cards()})
      for (auto [cards, read] : list)
        for (auto card = next_word(cards); !card.empty(); card = next_word(cards)) all[card] = read;
    return all;
  }();
  return readers;
}

/// Cards selected by the case control.
const WordList& selected_cards() {
  static const WordList cards("DMIG DMIAX NSM*");
  return cards;
}

class ContentReader {
 public:
  ContentReader(TextSource& source, bool only_nodes) : source_(source), only_nodes_(only_nodes) {}

  NastranContent read(bool has_control) {
    NastranCards cards(source_, has_control, only_nodes_ ? NastranBegin::any : NastranBegin::bulk);
    c_.control = cards.control();
    NastranCard card;
    while (cards.next(card)) {
      NastranFields fields(source_, card, &c_.whole_numbers);
      one(fields);
    }
    if (const auto& at = c_.control.preload)
      c_.notes.push_back(
          fmt::format("{}:{}: STATSUB is ignored: the part is free of the stress of a preload, the "
                      "frequencies of Nastran are not",
                      source_.files()[at->file], at->line));
    if (has_control && !cards.ended())
      c_.notes.emplace_back("the file has no ENDDATA: if it is not cut short, nothing is missing");
    finish();
    c_.names = cards.names();
    return std::move(c_);
  }

 private:
  void one(NastranFields& f) {
    const std::string& name = f.name();
    static const WordList of_nodes("GRID GRDSET CORD* SPC* SET*");
    if (only_nodes_ && !of_nodes.contains(name)) return;
    const auto reader = card_readers().find(name);
    if (reader != card_readers().end()) {
      reader->second(f, c_);
      return once(f);
    }
    if (name == "PARAM") return parameter(f);
    if (name == "SET" || name == "SET1" || name == "SET3") return set(f);
    // Matrices and nonstructural mass that the case control would select (finish refuses that).
    const bool selected_only = selected_cards().contains(name) && c_.control.there;
    if (!selected_only && !is_harmless_nastran_card(name)) return refuse(name, f.at());
    if (name.starts_with("CORD3")) {
      if (const auto id = parse_label(f.text(0))) c_.other_systems[*id] = name;
    } else if (name.starts_with("MAT") && !name.starts_with("MATT")) {
      if (const auto id = parse_label(f.text(0))) c_.other_materials[*id] = name;
    }
    pass(name, f.at());
  }

  /// Masses and rigid elements given twice would count twice.
  void once(NastranFields& f) {
    static const WordList masses("CONM* CMASS*"), rigid("RBE* RBAR RROD RTRPLT");
    const bool mass = masses.contains(f.name());
    if (!mass && !rigid.contains(f.name())) return;
    const auto id = parse_label(f.text(0));
    if (!id) return;
    const auto [it, fresh] = once_.try_emplace({mass, *id}, f.at());
    if (!fresh) f.twice(it->second);
  }

  void refuse(const std::string& name, const FeSource& at) {
    unknown_[name].add(at);
    if (unknown_.size() > TextSource::most_errors) finish();  // throws
  }

  void pass(const std::string& name, const FeSource& at) {
    const bool known = passed_.contains(name);
    if (known || passed_.size() < most_passed) passed_[known ? name : name.substr(0, 40)].add(at);
  }

  void set(NastranFields& f) {
    auto s = f.entity<NastranSet>("the number of the set");
    s.strict = f.name() != "SET1";
    s.elements = same_word(f.text(1), "ELEM");
    const bool nodes = f.name() == "SET1" || same_word(f.text(1), "GRID");
    const bool list = f.name() != "SET" || same_word(f.text(2), "LIST");
    if ((!nodes && !s.elements) || !list) return pass(f.name() + " of other things", f.at());
    for (std::size_t i = f.name() == "SET" ? 8 : f.name() == "SET3" ? 2 : 1; i < f.size(); ++i) {
      if (f.blank(i) || same_word(f.text(i), "SKIN")) continue;
      s.ranges.push_back(f.range(i, "a member"));
    }
    c_.sets.push_back(std::move(s));
  }

  void parameter(NastranFields& f) {
    const std::string name = upper_case(f.text(0)).substr(0, 40);
    if (name == "WTMASS" || name == "CM1")
      c_.mass_factor *= factor(f, name);
    else if (name == "CK1")
      c_.stiffness_factor *= factor(f, name);
    else if (name == "COUPMASS")
      c_.coupled_mass = same_word(f.text(1), "YES") || same_word(f.text(1), "ON") ||
                        parse_real(f.text(1)).value_or(0.0) > 0.0;
    else if (is_harmless_nastran_parameter(name))
      pass("PARAM", f.at());
    else
      refuse("PARAM " + name, f.at());
  }

  /// A positive factor, 1 if an entry before has given it. Subcases may repeat it; two values
  /// would be two parts.
  double factor(NastranFields& f, const std::string& name) {
    const double value = f.real(1, name.c_str());
    if (!(value > 0.0)) {
      f.error(ErrorCode::out_of_range, "{} is {}, expected more than 0", name, shown(f.text(1)));
      return 1.0;
    }
    f.must_be_zero(2, "an imaginary part");
    const auto [it, fresh] = factors_.try_emplace(name, value, f.at());
    if (fresh) return value;
    const auto& [before, at] = it->second;
    const SourceMark first = source_.mark(at);
    if (value != before)
      f.error(ErrorCode::exclusive,
              "{} is {}, but {:g} in {}:{}; a part can have only one of them, remove the other",
              name, shown(f.text(1)), before, first.file, first.line);
    return 1.0;
  }

  void finish() {
    for (NastranGrid& g : c_.grids) {
      if (g.cp == -1) g.cp = c_.grid_default.cp;
      if (g.cd == -1) g.cd = c_.grid_default.cd;
      const unsigned held = g.held.value_or(c_.grid_default.held.value_or(0u));
      if (held != 0) c_.supports.push_back({g.id, g.id, held, g.at});
    }
    once_each_grid();
    complete_nastran_bars(c_, source_);
    c_.scalar_points.finish();
    if (!only_nodes_) {
      const bool mass_sets = std::any_of(passed_.begin(), passed_.end(),
                                         [](const auto& p) { return p.first.starts_with("NSM"); });
      for (const auto& [command, at] : c_.control.additions) {
        if (command.starts_with("NSM") && !mass_sets) continue;
        source_.error(ErrorCode::unsupported, at,
                      "the case control has {}, which adds stiffness or mass and is not read",
                      command);
      }
    }
    for (const auto& [name, passed] : unknown_) {
      const std::string number =
          passed.number > 1 ? fmt::format(" ({} cards in the file)", passed.number) : "";
      const char* why = why_nastran_card_is_refused(name);
      source_.error(ErrorCode::unsupported, passed.first,
                    why == nullptr
                        ? fmt::format("{} is not read and may change stiffness or mass{}",
                                      name.substr(0, 40), number)
                        : fmt::format("{} is not read{}: {}", name, number, why));
    }
    for (const auto& [name, factor] : factors_)
      if (factor.first != 1.0)
        c_.notes.push_back(fmt::format("PARAM {}: the {} of the part is multiplied by {:g}", name,
                                       name == "CK1" ? "stiffness" : "mass", factor.first));
    if (!c_.control.missing_includes.empty())
      c_.notes.push_back(
          fmt::format("files that the executive control includes are missing and ignored: {}",
                      fmt::join(c_.control.missing_includes, ", ")));
    note_passed();
  }

  void note_passed() {
    static const WordList damper("CDAMP* CVISC"), varying("PELAST PBUSHT PDAMPT");
    std::string list, dampers, nominal, unselected;
    const auto append = [](std::string& names, const std::string& name) {
      names += (names.empty() ? "" : ", ") + name;
    };
    for (const auto& [name, passed] : passed_) {
      if (damper.contains(name)) append(dampers, fmt::format("{} {}", passed.number, name));
      append(varying.contains(name)            ? nominal
             : selected_cards().contains(name) ? unselected
                                               : list,
             name);
    }
    const std::pair<const char*, const std::string&> notes[] = {
        {"tables of stiffness and damping over frequency or load are ignored, the part has the "
         "constant ones: ",
         nominal},
        {"cards that the case control does not select are ignored: ", unselected},
        {"dampers are ignored, the part has modal damping (--damping): ", dampers},
        {"cards that change neither stiffness nor mass are ignored: ", list}};
    for (const auto& [text, names] : notes)
      if (!names.empty()) c_.notes.push_back(text + names);
  }

  /// Nodes that are in the file twice with the same numbers are merged, as in Nastran.
  void once_each_grid() {
    std::unordered_map<int, std::size_t> first;
    std::size_t kept = 0;
    NastranCount twice;
    for (std::size_t i = 0; i < c_.grids.size(); ++i) {
      const NastranGrid& g = c_.grids[i];
      const auto [it, fresh] = first.try_emplace(g.id, kept);
      const NastranGrid& other = c_.grids[fresh ? i : it->second];
      if (!fresh && g.id > 0 && g.cp == other.cp && g.cd == other.cd && g.held == other.held &&
          g.x == other.x) {
        twice.add(g.at);
        continue;
      }
      if (kept != i) c_.grids[kept] = g;
      ++kept;
    }
    c_.grids.resize(kept);
    if (twice.number > 0)
      c_.notes.push_back(
          fmt::format("{} nodes are in the file twice with the same numbers, first in line {}: "
                      "each is one, as in Nastran",
                      twice.number, twice.first.line));
  }

  TextSource& source_;
  bool only_nodes_;
  NastranContent c_;
  static constexpr std::size_t most_passed = 300;
  std::map<std::string, NastranCount> passed_, unknown_;
  std::map<std::pair<bool, int>, FeSource> once_;  ///< masses, rigid elements by their numbers
  std::map<std::string, std::pair<double, FeSource>> factors_;  ///< WTMASS, CM1, CK1
};

}  // namespace

NastranContent read_nastran_content(TextSource& source, bool has_control, bool only_nodes) {
  return ContentReader(source, only_nodes).read(has_control);
}

}  // namespace floatframe
