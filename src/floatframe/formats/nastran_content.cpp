#include "floatframe/formats/nastran_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "floatframe/formats/nastran_fields.hpp"
#include "floatframe/formats/text_fields.hpp"

namespace floatframe {
namespace {

class ContentReader {
 public:
  ContentReader(TextSource& source, bool only_nodes) : source_(source), only_nodes_(only_nodes) {}

  NastranContent read(bool has_control) {
    NastranCards cards(source_, has_control);
    c_.control = cards.control();
    NastranCard card;
    while (cards.next(card)) {
      NastranFields fields(source_, card);
      one(fields);
    }
    finish();
    c_.property_names = cards.property_names();
    c_.material_names = cards.material_names();
    c_.set_names = cards.set_names();
    return std::move(c_);
  }

 private:
  using F = NastranFields;
  using Handler = void (ContentReader::*)(F&);

  struct Passed {
    int number = 0;
    FeSource at;
    void add(const FeSource& where) {
      if (number++ == 0) at = where;
    }
  };

  void one(F& f) {
    static const std::map<std::string, Handler> handlers = {
        {"GRID", &ContentReader::grid},      {"GRDSET", &ContentReader::grid_default},
        {"CORD2R", &ContentReader::system},  {"CORD2C", &ContentReader::system},
        {"CORD2S", &ContentReader::system},  {"CTETRA", &ContentReader::solid},
        {"CHEXA", &ContentReader::solid},    {"CPENTA", &ContentReader::solid},
        {"CTRIA3", &ContentReader::surface}, {"CQUAD4", &ContentReader::surface},
        {"CTRIA6", &ContentReader::surface}, {"CQUAD8", &ContentReader::surface},
        {"CTRIAR", &ContentReader::surface}, {"CQUADR", &ContentReader::surface},
        {"CBAR", &ContentReader::bar},       {"CBEAM", &ContentReader::bar},
        {"MAT1", &ContentReader::material},  {"CONM2", &ContentReader::mass},
        {"RBE2", &ContentReader::rbe2},      {"RBE3", &ContentReader::rbe3},
        {"RBAR", &ContentReader::rbar},      {"MPC", &ContentReader::mpc},
        {"MPCADD", &ContentReader::mpc_add}, {"SPC", &ContentReader::spc},
        {"SPC1", &ContentReader::spc1},      {"PARAM", &ContentReader::parameter},
        {"SET", &ContentReader::set},        {"SET1", &ContentReader::set},
        {"SET3", &ContentReader::set},
    };
    const std::string& name = f.name();
    if (only_nodes_ && name != "GRID" && name != "GRDSET" && !name.starts_with("CORD") &&
        !name.starts_with("SPC") && !name.starts_with("SET")) {
      return;
    }
    if (const auto it = handlers.find(name); it != handlers.end()) {
      (this->*it->second)(f);
      return;
    }
    NastranProperty property;
    if (read_nastran_property(f, property)) {
      const int id = f.label(0, "the number of the property");
      const auto [it, fresh] = c_.properties.try_emplace(id, property);
      if (!fresh && id > 0) twice(f, it->second.at);
      return;
    }
    const bool units = name == "DTI" && same_word(f.text(0), "UNITS");
    if (!units && !is_harmless_nastran_card(name)) {
      unknown_[name].add(f.at());
      if (unknown_.size() > TextSource::most_faults) finish();  // throws
      return;
    }
    if (name.starts_with("CORD1")) {
      if (const auto id = parse_label(f.text(0))) c_.other_systems[*id] = name;
    } else if (name.starts_with("MAT") && !name.starts_with("MATT")) {
      if (const auto id = parse_label(f.text(0))) c_.other_materials[*id] = name;
    }
    pass(name, f.at());
  }

  void pass(const std::string& name, const FeSource& at) {
    const bool known = passed_.contains(name);
    if (known || passed_.size() < most_passed) passed_[known ? name : name.substr(0, 40)].add(at);
  }

  void twice(F& f, const FeSource& first) {
    f.fault(fmt::format("this number is in the file twice, first in line {}", first.line));
  }

  void grid(F& f) {
    NastranGrid g;
    g.at = f.at();
    g.id = f.label(0, "the number of the node");
    g.cp = f.integer(1, "the coordinate system CP", -1);
    g.x = f.vector(2, "a coordinate");
    g.cd = f.integer(5, "the coordinate system CD", -1);
    if (!f.blank(6)) g.held = f.components(6, "the held components PS");
    c_.grids.push_back(g);
  }

  void grid_default(F& f) {
    default_.cp = f.integer(1, "the coordinate system CP", 0);
    default_.cd = f.integer(5, "the coordinate system CD", 0);
    if (!f.blank(6)) default_.held = f.components(6, "the held components PS");
  }

  void system(F& f) {
    NastranSystem s;
    s.kind = f.name().back();
    s.at = f.at();
    const int id = f.label(0, "the number of the coordinate system");
    s.rid = f.integer(1, "the reference system RID", 0);
    s.a = f.vector(2, "a coordinate of A");
    s.b = f.vector(5, "a coordinate of B");
    s.c = f.vector(8, "a coordinate of C");
    const auto [it, fresh] = c_.systems.try_emplace(id, s);
    if (!fresh && id > 0) twice(f, it->second.at);
  }

  NastranElement element(F& f, const char* card) {
    NastranElement e;
    e.card = card;
    e.at = f.at();
    e.id = f.label(0, "the number of the element");
    e.property = f.blank(1) ? e.id : f.label(1, "the property");
    return e;
  }

  void solid(F& f) {
    const bool tetra = f.name() == "CTETRA", hexa = f.name() == "CHEXA";
    NastranElement e = element(f, tetra ? "CTETRA" : hexa ? "CHEXA" : "CPENTA");
    const std::size_t corners = tetra ? 4 : hexa ? 8 : 6, all = tetra ? 10 : hexa ? 20 : 15;
    std::size_t given = 0;
    for (std::size_t k = corners; k < all; ++k) given += f.blank(2 + k) ? 0 : 1;
    if (given > 0 && given < all - corners) {
      f.fault(fmt::format("{} of its {} mid-side nodes are given; all or none must be", given,
                          all - corners));
      return;
    }
    if (f.size() > 2 + all) {
      f.fault(fmt::format("it has more than {} nodes", all));
      return;
    }
    e.count = static_cast<int>(given > 0 ? all : corners);
    for (std::size_t k = 0; k < static_cast<std::size_t>(e.count); ++k) {
      // Nastran: bottom edges, vertical edges, top edges; here the vertical ones come last.
      std::size_t to = k;
      if (hexa && k >= 12) to = k < 16 ? k + 4 : k - 4;
      if (!tetra && !hexa && k >= 9) to = k < 12 ? k + 3 : k - 3;
      e.nodes[to] = f.label(2 + k, "a node");
    }
    e.type = tetra  ? (given > 0 ? ElementType::tet10 : ElementType::tet4)
             : hexa ? (given > 0 ? ElementType::hex20 : ElementType::hex8)
                    : (given > 0 ? ElementType::wedge15 : ElementType::wedge6);
    c_.elements.push_back(e);
  }

  void surface(F& f) {
    static const char* const cards[] = {"CTRIA3", "CQUAD4", "CTRIA6", "CQUAD8", "CTRIAR", "CQUADR"};
    NastranElement e = element(f, *std::find_if(std::begin(cards), std::end(cards),
                                                [&f](const char* c) { return f.name() == c; }));
    const bool triangle = f.name().starts_with("CTRIA");
    const std::size_t corners = triangle ? 3 : 4;
    e.surface = true;
    e.other = f.name() != "CTRIA3" && f.name() != "CQUAD4";
    e.type = triangle ? ElementType::tri3 : ElementType::quad4;
    const bool midside = f.name() == "CTRIA6" || f.name() == "CQUAD8";
    const std::size_t all = midside ? 2 * corners : corners;
    for (std::size_t k = 0; k < all; ++k) {
      if (k >= corners && f.blank(2 + k)) continue;
      e.nodes[static_cast<std::size_t>(e.count++)] = f.label(2 + k, "a node");
    }
    if (!e.other) {
      f.must_be_zero(3 + corners, "the offset ZOFFS");
      for (std::size_t k = 10; k < 10 + corners; ++k) {
        if (!f.blank(k)) {
          f.fault("thicknesses of the corners are not supported; give one with PSHELL");
          break;
        }
      }
    }
    c_.elements.push_back(e);
  }

  void bar(F& f) {
    NastranElement e = element(f, f.name() == "CBAR" ? "CBAR" : "CBEAM");
    e.type = ElementType::beam2;
    e.count = 2;
    e.nodes[0] = f.label(2, "node GA");
    e.nodes[1] = f.label(3, "node GB");
    if (f.blank(4) && f.blank(5) && f.blank(6)) {
      f.fault("the orientation vector is missing");
    } else if (f.blank(5) && f.blank(6) && parse_label(f.text(4))) {
      e.orientation_node = f.label(4, "node G0");
    } else {
      e.orientation = f.vector(4, "the orientation vector");
    }
    for (std::size_t i = 8; i < 10; ++i) {
      if (!f.blank(i) && f.text(i) != "0") f.fault("pins (PA, PB) are not supported");
    }
    for (std::size_t i = 10; i < 16; ++i) f.must_be_zero(i, "an offset of the ends (WA, WB)");
    c_.elements.push_back(e);
  }

  void material(F& f) {
    NastranMaterial m;
    m.at = f.at();
    const int id = f.label(0, "the number of the material");
    if (!f.blank(1)) m.young = f.real(1, "E");
    if (!f.blank(2)) m.shear = f.real(2, "G");
    if (!f.blank(3)) m.poisson = f.real(3, "NU");
    if (!f.blank(4)) m.density = f.real(4, "RHO");
    const auto [it, fresh] = c_.materials.try_emplace(id, m);
    if (!fresh && id > 0) twice(f, it->second.at);
  }

  void mass(F& f) {
    NastranMass m;
    m.at = f.at();
    m.id = f.label(0, "the number of the element");
    m.node = f.label(1, "the node");
    m.system = f.integer(2, "the coordinate system CID", 0);
    m.mass = f.real(3, "the mass");
    m.offset = f.vector(4, "the offset");
    const double I11 = f.real(8, "I11", 0.0), I21 = f.real(9, "I21", 0.0);
    const double I22 = f.real(10, "I22", 0.0), I31 = f.real(11, "I31", 0.0);
    const double I32 = f.real(12, "I32", 0.0), I33 = f.real(13, "I33", 0.0);
    m.J << I11, -I21, -I31, -I21, I22, -I32, -I31, -I32, I33;
    c_.masses.push_back(m);
  }

  NastranSpider spider(F& f, const char* card) {
    NastranSpider s;
    s.card = card;
    s.at = f.at();
    s.id = f.label(0, "the number of the element");
    return s;
  }

  static bool is_real(std::string_view field) {
    return field.find_first_of(".eEdD") != std::string_view::npos && parse_real(field).has_value();
  }

  void rbe2(F& f) {
    NastranSpider s = spider(f, "RBE2");
    s.reference = f.label(1, "node GN");
    s.mask = f.components(2, "the components CM");
    for (std::size_t i = 3; i < f.size(); ++i) {
      if (i + 1 == f.size() && is_real(f.text(i))) break;  // ALPHA
      if (!f.blank(i)) s.nodes.push_back(f.label(i, "a node GM"));
    }
    c_.spiders.push_back(std::move(s));
  }

  void rbe3(F& f) {
    NastranSpider s = spider(f, "RBE3");
    s.kind = Spider::Kind::mean;
    s.reference = f.label(2, "node REFGRID");
    if (f.components(3, "the components REFC") != 63u) {
      f.fault(fmt::format("REFC is {}, only 123456 is read", shown(f.text(3))));
    }
    double weight = 1.0;
    for (std::size_t i = 4; i < f.size(); ++i) {
      if (f.blank(i)) continue;
      if (same_word(f.text(i), "ALPHA")) break;
      if (same_word(f.text(i), "UM")) {
        f.fault("dependent components of its own (UM) are not supported");
        break;
      }
      if (is_real(f.text(i))) {
        weight = f.real(i, "a weight");
        const unsigned mask = f.components(++i, "the components of a weight");
        s.weighs_rotations = s.weighs_rotations || mask == 63u;
        if (mask != 7u && mask != 63u) {
          f.fault(
              fmt::format("the components of a weight are {}, only 123 is read", shown(f.text(i))));
        }
        continue;
      }
      s.nodes.push_back(f.label(i, "a node"));
      s.weights.push_back(weight);
    }
    c_.spiders.push_back(std::move(s));
  }

  void rbar(F& f) {
    NastranSpider s = spider(f, "RBAR");
    const int a = f.label(1, "node GA"), b = f.label(2, "node GB");
    const unsigned na = f.components(3, "CNA"), nb = f.components(4, "CNB");
    const bool from_a = na == 63u && nb == 0, from_b = nb == 63u && na == 0;
    if (!from_a && !from_b) {
      f.fault("one of CNA and CNB must be 123456 and the other blank");
      return;
    }
    const std::size_t dependent = from_a ? 6 : 5;
    s.reference = from_a ? a : b;
    s.nodes = {from_a ? b : a};
    if (!f.blank(dependent)) s.mask = f.components(dependent, from_a ? "CMB" : "CMA");
    c_.spiders.push_back(std::move(s));
  }

  void mpc(F& f) {
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
        f.fault(fmt::format("the component is {}, expected one of 1 to 6", shown(f.text(i + 1))));
        return;
      }
      e.terms.push_back({f.label(i, "a node"), component, f.real(i + 2, "a coefficient", 0.0)});
    }
    if (e.terms.empty() || e.terms[0].factor == 0.0) {
      f.fault("the first term needs a coefficient that is not zero");
      return;
    }
    c_.equations.push_back(std::move(e));
  }

  void mpc_add(F& f) {
    std::vector<int>& sets = c_.added_mpc_sets[f.label(0, "the set")];
    for (std::size_t i = 1; i < f.size(); ++i) {
      if (!f.blank(i)) sets.push_back(f.label(i, "a set"));
    }
  }

  void spc(F& f) {
    for (std::size_t i = 1; i < 7; i += 3) {
      if (f.blank(i)) continue;
      const int node = f.label(i, "a node");
      c_.supports.push_back({node, node, f.components(i + 1, "the components"), f.at()});
    }
  }

  void spc1(F& f) {
    const unsigned mask = f.components(1, "the components");
    for (std::size_t i = 2; i < f.size(); ++i) {
      if (f.blank(i)) continue;
      const int first = f.label(i, "a node");
      int last = first;
      if (same_word(f.text(i + 1), "THRU")) {
        last = f.label(i + 2, "the last node");
        i += 2;
      }
      c_.supports.push_back({first, last, mask, f.at()});
    }
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
      const int first = f.label(i, "a member");
      int last = first;
      if (same_word(f.text(i + 1), "THRU")) {
        last = f.label(i + 2, "the last member");
        i += 2;
      }
      s.ranges.emplace_back(first, last);
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
      case NastranParameter::harmless:
        pass("PARAM", f.at());
        break;
      case NastranParameter::unknown:
        unknown_["PARAM " + name].add(f.at());
        if (unknown_.size() > TextSource::most_faults) finish();  // throws
    }
  }

  /// A positive factor; the last entry of a name counts.
  double factor(F& f, const std::string& name) {
    const double value = f.real(1, name.c_str());
    if (!(value > 0.0)) {
      f.fault(fmt::format("{} is {}, expected more than 0", name, shown(f.text(1))));
      return 1.0;
    }
    f.must_be_zero(2, "an imaginary part");
    double& last = factors_.try_emplace(name, 1.0).first->second;
    return value / std::exchange(last, value);
  }

  void finish() {
    for (NastranGrid& g : c_.grids) {
      if (g.cp == -1) g.cp = default_.cp;
      if (g.cd == -1) g.cd = default_.cd;
      const unsigned held = g.held.value_or(default_.held.value_or(0u));
      if (held != 0) c_.supports.push_back({g.id, g.id, held, g.at});
    }
    if (!only_nodes_) {
      for (const auto& [command, at] : c_.control.additions) {
        source_.fault(at, fmt::format("the case control has {}, which adds stiffness or mass and "
                                      "is not read",
                                      command));
      }
    }
    for (const auto& [name, passed] : unknown_) {
      source_.fault(
          passed.at,
          fmt::format(
              "{} is not read and may change stiffness or mass{}", name.substr(0, 40),
              passed.number > 1 ? fmt::format(" ({} cards in the file)", passed.number) : ""));
    }
    for (const auto& [name, value] : factors_) {
      if (name == "WTMASS" || value == 1.0) continue;
      c_.notes.push_back(fmt::format("PARAM {}: the {} of the part is multiplied by {:g}", name,
                                     name == "CK1" ? "stiffness" : "mass", value));
    }
    std::string list;
    for (const auto& [name, passed] : passed_) {
      list += fmt::format("{}{}", list.empty() ? "" : ", ", name);
    }
    if (!list.empty()) {
      c_.notes.push_back(
          fmt::format("cards that change neither stiffness nor mass are passed over: {}", list));
    }
  }

  TextSource& source_;
  bool only_nodes_;
  NastranContent c_;
  NastranGrid default_;
  static constexpr std::size_t most_passed = 300;
  std::map<std::string, Passed> passed_, unknown_;
  std::map<std::string, double> factors_;
};

}  // namespace

NastranContent read_nastran_content(TextSource& source, bool has_control, bool only_nodes) {
  return ContentReader(source, only_nodes).read(has_control);
}

}  // namespace floatframe
