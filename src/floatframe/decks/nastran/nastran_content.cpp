#include "floatframe/decks/nastran/nastran_content.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

const std::map<std::string_view, NastranCardReader>& card_readers() {
  static const std::map<std::string_view, NastranCardReader> readers = {
      {"GRID", read_nastran_grid},
      {"GRDSET", read_nastran_grid_default},
      {"CORD2R", read_nastran_system},
      {"CORD2C", read_nastran_system},
      {"CORD2S", read_nastran_system},
      {"CTETRA", read_nastran_solid},
      {"CPYRAM", read_nastran_solid},
      {"CPYRA", read_nastran_solid},
      {"CHEXA", read_nastran_solid},
      {"CPENTA", read_nastran_solid},
      {"CTRIA3", read_nastran_surface},
      {"CQUAD4", read_nastran_surface},
      {"CTRIA6", read_nastran_surface},
      {"CQUAD8", read_nastran_surface},
      {"CTRIAR", read_nastran_surface},
      {"CQUADR", read_nastran_surface},
      {"CSHEAR", read_nastran_panel},
      {"CBAR", read_nastran_bar},
      {"CBEAM", read_nastran_bar},
      {"MAT1", read_nastran_material},
      {"CONM2", read_nastran_mass},
      {"CONM1", read_nastran_mass_matrix},
      {"CMASS1", read_nastran_scalar_mass},
      {"CMASS2", read_nastran_scalar_mass},
      {"CMASS3", read_nastran_mass_of_points},
      {"CMASS4", read_nastran_mass_of_points},
      {"PMASS", read_nastran_pmass},
      {"MAT2", read_nastran_anisotropic},
      {"MAT8", read_nastran_anisotropic},
      {"MAT9", read_nastran_anisotropic},
      {"RBE2", read_nastran_rbe2},
      {"RBE3", read_nastran_rbe3},
      {"RBAR", read_nastran_rbar},
      {"RBAR1", read_nastran_rbar},
      {"RBE1", read_nastran_rbe1},
      {"RTRPLT", read_nastran_rtrplt},
      {"RROD", read_nastran_rrod},
      {"MPC", read_nastran_mpc},
      {"MPCADD", read_nastran_mpc_add},
      {"CELAS1", read_nastran_celas},
      {"CELAS2", read_nastran_celas},
      {"CELAS3", read_nastran_scalar_spring},
      {"CELAS4", read_nastran_scalar_spring},
      {"PELAS", read_nastran_pelas},
      {"CBUSH", read_nastran_bush},
      {"PBUSH", read_nastran_pbush},
      {"CBUSH1D", read_nastran_bush1d},
      {"PBUSH1D", read_nastran_pbush1d},
      {"CROD", read_nastran_rod},
      {"CTUBE", read_nastran_rod},
      {"CONROD", read_nastran_rod},
      {"SPC", read_nastran_spc},
      {"SPC1", read_nastran_spc1},
      {"SPCADD", read_nastran_spc_add},
      {"BAROR", read_nastran_bar_default},
      {"BEAMOR", read_nastran_bar_default},
      {"CORD1R", read_nastran_node_system},
      {"CORD1C", read_nastran_node_system},
      {"CORD1S", read_nastran_node_system},
      {"SPOINT", read_nastran_scalar_points},
  };
  return readers;
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
    c_.property_names = cards.property_names();
    c_.material_names = cards.material_names();
    c_.set_names = cards.set_names();
    return std::move(c_);
  }

 private:
  using F = NastranFields;

  struct Passed {
    int number = 0;
    FeSource at;
    void add(const FeSource& where) {
      if (number++ == 0) at = where;
    }
  };

  /// WTMASS, CM1 or CK1.
  struct Factor {
    double value = 1.0;
    FeSource at;
  };

  void one(F& f) {
    const std::string& name = f.name();
    if (only_nodes_ && name != "GRID" && name != "GRDSET" && !name.starts_with("CORD") &&
        !name.starts_with("SPC") && !name.starts_with("SET")) {
      return;
    }
    const auto reader = card_readers().find(name);
    if (reader != card_readers().end()) {
      reader->second(f, c_);
      return once(f);
    }
    if (name == "PARAM") return parameter(f);
    if (name == "SET" || name == "SET1" || name == "SET3") return set(f);
    NastranProperty property;
    if (read_nastran_property(f, property)) {
      const int id = f.label(0, "the number of the property");
      const auto [it, fresh] = c_.properties.try_emplace(id, property);
      if (!fresh && id > 0) nastran_twice(f, it->second.at);
      return;
    }
    // Matrices and nonstructural mass that the case control would select (finish refuses that).
    const bool selected_only = name == "DMIG" || name == "DMIAX" || name.starts_with("NSM");
    if (!(selected_only && c_.control.there) && !is_harmless_nastran_card(name)) {
      unknown_[name].add(f.at());
      if (unknown_.size() > TextSource::most_errors) finish();  // throws
      return;
    }
    if (name.starts_with("CORD3")) {
      if (const auto id = parse_label(f.text(0))) c_.other_systems[*id] = name;
    } else if (name.starts_with("MAT") && !name.starts_with("MATT")) {
      if (const auto id = parse_label(f.text(0))) c_.other_materials[*id] = name;
    }
    pass(name, f.at());
  }

  /// Masses and rigid elements given twice would count twice.
  void once(F& f) {
    const std::string& name = f.name();
    const bool mass = name.starts_with("CONM") || name.starts_with("CMASS");
    if (!mass && !name.starts_with("RBE") && name != "RBAR" && name != "RROD" && name != "RTRPLT")
      return;
    const auto id = parse_label(f.text(0));
    if (!id || *id <= 0) return;
    const auto [it, fresh] = once_.try_emplace({mass, *id}, f.at());
    if (!fresh) nastran_twice(f, it->second);
  }

  void pass(const std::string& name, const FeSource& at) {
    const bool known = passed_.contains(name);
    if (known || passed_.size() < most_passed) passed_[known ? name : name.substr(0, 40)].add(at);
  }

  void set(F& f) {
    NastranSet s;
    s.at = f.at();
    s.id = f.label(0, "the number of the set");
    s.strict = f.name() != "SET1";
    s.elements = same_word(f.text(1), "ELEM");
    const bool nodes = f.name() == "SET1" || same_word(f.text(1), "GRID");
    const bool list = f.name() != "SET" || same_word(f.text(2), "LIST");
    if ((!nodes && !s.elements) || !list) {
      pass(f.name() + " of other things", f.at());
      return;
    }
    for (std::size_t i = f.name() == "SET" ? 8 : f.name() == "SET3" ? 2 : 1; i < f.size(); ++i) {
      if (f.blank(i) || same_word(f.text(i), "SKIN")) continue;
      s.ranges.push_back(f.range(i, "a member"));
    }
    c_.sets.push_back(std::move(s));
  }

  void parameter(F& f) {
    const std::string name = upper_case(f.text(0)).substr(0, 40);
    switch (nastran_parameter(name)) {
      case NastranParameter::mass_factor:
        c_.mass_factor *= factor(f, name);
        break;
      case NastranParameter::stiffness_factor:
        c_.stiffness_factor *= factor(f, name);
        break;
      case NastranParameter::coupled_mass:
        c_.coupled_mass = same_word(f.text(1), "YES") || same_word(f.text(1), "ON") ||
                          parse_real(f.text(1)).value_or(0.0) > 0.0;
        break;
      case NastranParameter::harmless:
        pass("PARAM", f.at());
        break;
      case NastranParameter::unknown:
        unknown_["PARAM " + name].add(f.at());
        if (unknown_.size() > TextSource::most_errors) finish();  // throws
    }
  }

  /// A positive factor, 1 if an entry before has given it. Subcases may repeat it; two values
  /// would be two parts.
  double factor(F& f, const std::string& name) {
    const double value = f.real(1, name.c_str());
    if (!(value > 0.0)) {
      f.error(ErrorCode::out_of_range, "{} is {}, expected more than 0", name, shown(f.text(1)));
      return 1.0;
    }
    f.must_be_zero(2, "an imaginary part");
    const auto [it, fresh] = factors_.try_emplace(name, Factor{value, f.at()});
    if (fresh) return value;
    if (value != it->second.value) {
      const SourceMark first = source_.mark(it->second.at);
      f.error(ErrorCode::exclusive,
              "{} is {}, but {:g} in {}:{}; a part can have only one of them, remove the other",
              name, shown(f.text(1)), it->second.value, first.file, first.line);
    }
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
      source_.error(ErrorCode::unsupported, passed.at,
                    why == nullptr
                        ? fmt::format("{} is not read and may change stiffness or mass{}",
                                      name.substr(0, 40), number)
                        : fmt::format("{} is not read{}: {}", name, number, why));
    }
    for (const auto& [name, factor] : factors_) {
      const double value = factor.value;
      if (value == 1.0) continue;
      c_.notes.push_back(fmt::format("PARAM {}: the {} of the part is multiplied by {:g}", name,
                                     name == "CK1" ? "stiffness" : "mass", value));
    }
    if (!c_.control.missing_includes.empty()) {
      c_.notes.push_back(
          fmt::format("files that the executive control includes are missing and ignored: {}",
                      fmt::join(c_.control.missing_includes, ", ")));
    }
    std::string list, dampers, nominal, unselected;
    for (const auto& [name, passed] : passed_) {
      if (name.starts_with("CDAMP") || name == "CVISC")
        dampers += fmt::format("{}{} {}", dampers.empty() ? "" : ", ", passed.number, name);
      const bool varies = name == "PELAST" || name == "PBUSHT" || name == "PDAMPT";
      const bool by_control = name == "DMIG" || name == "DMIAX" || name.starts_with("NSM");
      std::string& of = varies ? nominal : by_control ? unselected : list;
      of += fmt::format("{}{}", of.empty() ? "" : ", ", name);
    }
    if (!nominal.empty())
      c_.notes.push_back(
          fmt::format("tables of stiffness and damping over frequency or load are ignored, the "
                      "part has the constant ones: {}",
                      nominal));
    if (!unselected.empty())
      c_.notes.push_back(
          fmt::format("cards that the case control does not select are ignored: {}", unselected));
    if (!dampers.empty())
      c_.notes.push_back(
          fmt::format("dampers are ignored, the part has modal damping (--damping): {}", dampers));
    if (!list.empty()) {
      c_.notes.push_back(
          fmt::format("cards that change neither stiffness nor mass are ignored: {}", list));
    }
  }

  /// Nodes that are in the file twice with the same numbers are one, as in Nastran.
  void once_each_grid() {
    std::unordered_map<int, std::size_t> first;
    std::size_t kept = 0, twice = 0;
    FeSource at;
    for (std::size_t i = 0; i < c_.grids.size(); ++i) {
      const NastranGrid& g = c_.grids[i];
      const auto [it, fresh] = first.try_emplace(g.id, kept);
      const NastranGrid& other = c_.grids[fresh ? i : it->second];
      if (!fresh && g.id > 0 && g.cp == other.cp && g.cd == other.cd && g.held == other.held &&
          g.x == other.x) {
        if (twice++ == 0) at = g.at;
        continue;
      }
      if (kept != i) c_.grids[kept] = g;
      ++kept;
    }
    c_.grids.resize(kept);
    if (twice > 0)
      c_.notes.push_back(
          fmt::format("{} nodes are in the file twice with the same numbers, first in line {}: "
                      "each is one, as in Nastran",
                      twice, at.line));
  }

  TextSource& source_;
  bool only_nodes_;
  NastranContent c_;
  static constexpr std::size_t most_passed = 300;
  std::map<std::string, Passed> passed_, unknown_;
  std::map<std::pair<bool, int>, FeSource> once_;  ///< masses, rigid elements by their numbers
  std::map<std::string, Factor> factors_;
};

}  // namespace

void nastran_twice(NastranFields& f, const FeSource& first) {
  f.error(ErrorCode::duplicate, "this number is in the file twice, first in line {}", first.line);
}

NastranContent read_nastran_content(TextSource& source, bool has_control, bool only_nodes) {
  return ContentReader(source, only_nodes).read(has_control);
}

}  // namespace floatframe
