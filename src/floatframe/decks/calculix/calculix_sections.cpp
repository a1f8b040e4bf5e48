// Materials, orientations and sections of a CalculiX deck. Elements with the same section, material
// and axes are a set.
#include <fmt/ranges.h>

#include <cmath>

#include "floatframe/decks/calculix/calculix_text.hpp"

namespace floatframe {
namespace {

/// Density added to that of the material (kg/m3 of the model) for a shell with further mass.
double further_density(const ShellSection& s) {
  return s.thickness > 0.0 ? s.mass / s.thickness : 0.0;
}

std::string offset_words(const std::array<double, 2>& offsets) {
  std::string out;
  for (std::size_t k = 0; k < 2; ++k)
    if (std::abs(offsets[k]) > 1e-12) out += fmt::format(", OFFSET{}={:.10g}", k + 1, offsets[k]);
  return out;
}

/// Common data of the elements of one section.
struct SectionKey {
  ElementFamily family = ElementFamily::solid;
  int material = 0, section = 0, orientation = -1;
  int alone = -1;                     ///< axes that no other element has: the element
  std::array<double, 3> reference{};  ///< beams
  std::string offset = {};            ///< beams: ", OFFSET1=..."
  auto operator<=>(const SectionKey&) const = default;
};

class SectionWriter {
 public:
  explicit SectionWriter(CalculixText& deck) : deck_(deck), model_(deck.model) {}

  void add() {
    if (model_.materials.empty() && !model_.elements.empty())
      return deck_.errors.add(
          ErrorCode::incomplete, {model_.files.empty() ? std::string() : model_.files.front()},
          "the file has no material, which a deck needs: give one (--material E,NU,RHO)");
    std::map<SectionKey, std::vector<int>> sets;
    for (std::size_t e = 0; e < model_.elements.size(); ++e) {
      const FeElement& element = model_.elements[e];
      if (!writable(element, static_cast<int>(e))) continue;
      sets[key_of(element, static_cast<int>(e))].push_back(deck_.element(e));
    }
    say_refused();
    if (!deck_.errors.empty()) return;
    int number = 0;
    for (const auto& [key, elements] : sets) {
      const std::string set = written_name(fmt::format("SECTION_{}", ++number), true, deck_.names);
      deck_.add("*ELSET, ELSET={}\n", set);
      add_calculix_numbers(deck_.text, elements, false);
      add_section(key, set);
    }
  }

 private:
  const Material& material(int m) const { return model_.materials[m]; }
  const ShellSection& shell(int s) const { return model_.shells[s]; }
  const BeamSection& beam(int s) const { return model_.sections[s]; }

  /// The first element of each reason, and how many more there are.
  void say_refused() {
    for (const auto& [what, elements] : refused_) {
      const FeElement& first = model_.elements[elements.first];
      const std::string more = plural(elements.more, "more element", "more elements");
      deck_.error(first.source, "{} {}{}", model_.element_label(elements.first), what,
                  elements.more == 0 ? "" : "; the same holds for " + more);
    }
  }

  bool writable(const FeElement& e, int index) {
    const auto in = [](int i, const auto& list) {
      return i >= 0 && static_cast<std::size_t>(i) < list.size();
    };
    std::string what;
    if (!in(e.material, model_.materials))
      what = "has no material, which a deck needs";
    else if (e.layup >= 0)
      what =
          "is a solid with plies, which is not written as a CalculiX deck (.vtu and .msh show the "
          "mesh)";
    else if (is_panel(e.type))
      what = "is a shear panel, which CalculiX has not (.vtu and .msh show the mesh)";
    else if ((is_shell(e.type) || is_membrane(e.type)) && in(e.section, model_.shells))
      what = shell_error(e);
    else if (is_beam(e.type) && in(e.section, model_.sections))
      what = beam_error(e);
    else if (is_rod(e.type) && in(e.section, model_.sections))
      what = material(e.material).elasticity ? "is a rod of a material with axes" : "";
    else if (has_shell_section(e.type) || is_beam(e.type) || is_rod(e.type))
      what = "has no section";
    if (what.empty()) return true;
    if (const auto [it, fresh] = refused_.try_emplace(what, Refused{index}); !fresh)
      ++it->second.more;
    return false;
  }

  std::string shell_error(const FeElement& e) const {
    const ShellSection& s = shell(e.section);
    if (!s.plies.empty() || s.bending >= 0 || s.bending_factor != 1.0 || !s.coupling.isZero(0.0))
      return "has layers or bending of its own, which are not written as a CalculiX deck (.vtu and "
             ".msh show the mesh)";
    if (material(e.material).elasticity && (e.orientation < 0 || e.angle != 0.0))
      return "is a shell of a material with axes along its side, which CalculiX has not";
    if (material(e.material).plane)
      return "has an elasticity of plane stress, which CalculiX has not";
    return "";
  }

  std::string beam_error(const FeElement& e) const {
    if (material(e.material).elasticity) return "is a beam of a material with axes";
    switch (beam(e.section).outline) {
      case BeamSection::Outline::rectangle:
        return "";
      case BeamSection::Outline::round:
        return e.type == FeElementType::beam3
                   ? ""
                   : "is round, and CalculiX has round sections in 3-node beams only";
      case BeamSection::Outline::unknown:
        break;
    }
    return "has a section that is neither a rectangle nor round: a box, a profile or constants (A, "
           "I, J), of which CalculiX makes no beams as they are here (.vtu and .msh show the mesh)";
  }

  SectionKey key_of(const FeElement& e, int index) const {
    SectionKey key{.family = element_kernel(e.type).family, .material = e.material};
    if (key.family != ElementFamily::solid) key.section = e.section;
    if (key.family == ElementFamily::beam)
      key.reference = {e.reference(0), e.reference(1), e.reference(2)};
    if (key.family == ElementFamily::beam && deck_.beside != nullptr)
      key.offset = offset_words(deck_.beside->offsets[index]);
    if (material(e.material).elasticity && e.orientation >= 0) {
      key.orientation = e.orientation;
      const Orientation& o = model_.orientations[e.orientation];
      const bool plain = o.kind == Orientation::Kind::rectangular ||
                         (o.kind == Orientation::Kind::cylindrical && o.turn.isIdentity(0.0));
      if (!plain) key.alone = index;
    }
    return key;
  }

  /// Written once per density.
  std::string material_name(int m, double further) {
    const auto [it, fresh] = materials_.try_emplace({m, further});
    if (!fresh) return it->second;
    const std::string name = further == 0.0
                                 ? deck_.name_of(written_material(model_, m))
                                 : written_name(written_material(model_, m), true, deck_.names);
    it->second = name;
    const Material& given = material(m);
    deck_.add("*MATERIAL, NAME={}\n", name);
    if (given.elasticity) {
      // The columns of the upper half of the symmetric matrix, shear in the order 12, 13, 23.
      constexpr std::array<int, 6> order{0, 1, 2, 3, 5, 4};
      std::vector<std::string> terms;
      for (std::size_t j = 0; j < 6; ++j)
        for (std::size_t i = 0; i <= j; ++i)
          terms.push_back(calculix_number((*given.elasticity)(order[i], order[j])));
      deck_.add("*ELASTIC, TYPE=ANISO\n{}\n{}\n{}\n",
                fmt::join(terms.begin(), terms.begin() + 8, ", "),
                fmt::join(terms.begin() + 8, terms.begin() + 16, ", "),
                fmt::join(terms.begin() + 16, terms.end(), ", "));
    } else {
      deck_.add("*ELASTIC\n{}, {}\n", calculix_number(given.young), calculix_number(given.poisson));
    }
    if (given.density + further > 0.0)
      deck_.add("*DENSITY\n{}\n", calculix_number(given.density + further));
    return name;
  }

  /// ", ORIENTATION=NAME" of an orientation that is written now or was; empty if there is none.
  std::string orientation_word(const SectionKey& key) {
    if (key.orientation < 0) return "";
    const auto [it, fresh] = orientations_.try_emplace({key.orientation, key.alone});
    if (fresh) {
      it->second = written_name(fmt::format("AXES_{}", orientations_.size()), true, deck_.names);
      const Orientation& o = model_.orientations[key.orientation];
      Vec3 a = o.origin, b = o.origin + o.axes.col(2);
      const bool cylinder = key.alone < 0 && o.kind == Orientation::Kind::cylindrical;
      if (!cylinder) {
        const Mat3 axes = key.alone < 0 ? Mat3(o.axes * o.turn) : o.at(centre(key.alone));
        a = axes.col(0);
        b = axes.col(1);
      }
      deck_.add("*ORIENTATION, NAME={}, SYSTEM={}\n{}, {}\n", it->second,
                cylinder ? "CYLINDRICAL" : "RECTANGULAR", calculix_vector(a), calculix_vector(b));
      if (key.alone >= 0 && !std::exchange(centre_noted_, true))
        deck_.note(
            "axes of materials that turn from place to place are those of the middle of each "
            "element");
    }
    return ", ORIENTATION=" + it->second;
  }

  Vec3 centre(int element) const {
    const std::span<const int> nodes = nodes_of_element(model_.elements[element]);
    Vec3 sum = Vec3::Zero();
    for (const int node : nodes) sum += model_.positions[node];
    return sum / static_cast<double>(nodes.size());
  }

  void add_section(const SectionKey& key, const std::string& set) {
    const bool is_of_shell =
        key.family == ElementFamily::shell || key.family == ElementFamily::membrane;
    const std::string of_material =
        material_name(key.material, is_of_shell ? further_density(shell(key.section)) : 0.0);
    const std::string axes = orientation_word(key);
    const std::string words = fmt::format("ELSET={}, MATERIAL={}{}", set, of_material, axes);
    if (key.family == ElementFamily::solid)
      deck_.add("*SOLID SECTION, {}\n", words);
    else if (key.family == ElementFamily::rod)
      deck_.add("*SOLID SECTION, {}\n{}\n", words, calculix_number(beam(key.section).A));
    else if (is_of_shell)
      add_sheet(key, words);
    else
      add_beam(key, words);
  }

  void add_sheet(const SectionKey& key, const std::string& words) {
    const ShellSection& s = shell(key.section);
    const std::string offset =
        s.offset == 0.0 ? "" : ", OFFSET=" + calculix_number(-s.offset / s.thickness);
    deck_.add("*{} SECTION, {}{}\n{}\n", key.family == ElementFamily::shell ? "SHELL" : "MEMBRANE",
              words, offset, calculix_number(s.thickness));
  }

  void add_beam(const SectionKey& key, const std::string& words) {
    const BeamSection& s = beam(key.section);
    const bool rectangle = s.outline == BeamSection::Outline::rectangle;
    const bool pipe = !rectangle && s.bore > 0.0;
    const double first = pipe ? 0.5 * s.width : s.width;
    const double second = rectangle ? s.height : pipe ? 0.5 * (s.width - s.bore) : s.width;
    const Vec3 reference(key.reference[0], key.reference[1], key.reference[2]);
    deck_.add("*BEAM SECTION, {}, SECTION={}{}\n{}, {}\n{}\n", words,
              rectangle ? "RECT"
              : pipe    ? "PIPE"
                        : "CIRC",
              key.offset, calculix_number(first), calculix_number(second),
              calculix_vector(reference));
  }

  CalculixText& deck_;
  const FeModel& model_;
  struct Refused {
    int first = 0;
    long more = 0;
  };
  std::map<std::string, Refused> refused_;  // by the reason
  bool centre_noted_ = false;
  std::map<std::pair<int, double>, std::string> materials_;
  std::map<std::pair<int, int>, std::string> orientations_;
};

}  // namespace

void add_calculix_sections(CalculixText& deck) { SectionWriter(deck).add(); }

}  // namespace floatframe
