// MP, MPTEMP, MPDATA and linear TB; from their labels to a material.
#include <algorithm>
#include <cmath>
#include <set>

#include "floatframe/decks/ansys/ansys_content.hpp"
#include "floatframe/decks/temperature_table.hpp"
#include "floatframe/fe/elasticity.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_temperatures = 100;

/// Labels that the part needs.
constexpr std::string_view needed_labels =
    "EX EY EZ PRXY PRYZ PRXZ NUXY NUYZ NUXZ GXY GYZ GXZ DENS";

AnsysMaterial& open_ansys_material(AnsysFields& f, AnsysContent& c, int id) {
  AnsysMaterial& m = c.materials[id];
  if (m.at.file < 0) m.at = f.at();
  return m;
}

/// Tables of TB that do not change the linear part, and those in addition to elastic
/// constants: the part is linear with these.
constexpr std::string_view harmless_tables =
    "UVID PARA FCON FLIM CTE THER SPEC FRIC PELE CGCR FATI ACP";
constexpr std::string_view linear_beside =
    "BISO MISO BKIN MKIN KINH NLIS CHAB PLAS CREE PRON RATE CONC DP EDP SDAM DMGI DMGE SHIF VISC "
    "HILL GURS";

class AnsysElastic {
 public:
  AnsysElastic(const AnsysMaterial& m, int id, std::optional<double> temperature,
               AnsysContent& content, TextSource& source)
      : m_(m), id_(id), temperature_(temperature), content_(content), source_(source) {}

  Material made() {
    Material result;
    result.density = value("DENS").value_or(0.0);
    if (result.density < 0.0)
      error(ErrorCode::out_of_range, "DENS is {:g}, no negative density is expected",
            result.density);
    refuse_two();
    if (!said_.empty()) return result;
    if (!m_.anisotropic.empty()) return anisotropic(result.density);
    const auto E = value("EX");
    if (!E) return error(ErrorCode::missing, "it has no EX"), result;
    result.young = *E;
    const bool directions = value("EY") || value("EZ") || value("GYZ") || value("GXZ") ||
                            value("PRYZ") || value("PRXZ");
    return directions ? orthotropic(result) : isotropic(result);
  }

 private:
  /// At the temperature; those at its end if that cannot be, with the reason.
  std::pair<double, AtTemperature> at(const AnsysMaterial::Values::mapped_type& table) const {
    std::vector<TemperatureRow> rows;
    for (const auto& [T, x] : table) rows.push_back({T, {x}});
    AtTemperature found = at_temperature(rows, temperature_);
    const double x = found.error.empty() ? found.values[0] : rows.front().values[0];
    return {x, std::move(found)};
  }
  std::optional<double> at(const AnsysMaterial::Values& values, const char* label) const {
    const auto it = values.find(label);
    if (it == values.end() || it->second.empty()) return std::nullopt;
    return at(it->second).first;
  }

  std::optional<double> value(const char* label) {
    const auto* const table = m_.find(label);
    if (table == nullptr) return std::nullopt;
    const auto& [x, found] = at(*table);
    if (!found.error.empty())
      error(ErrorCode::wrong_value, "its {} {}", label, found.error);
    else if (found.chosen && temperatures_noted_++ == 0)
      source_.note(
          content_.model, m_.at,
          "material {} is taken at the temperature {:g} (its table of {} goes from {:g} to {:g})",
          id_, *temperature_, label, table->front().first, table->back().first);
    return x;
  }

  /// MP and TB may both give constants: the file does not determine which of them counts.
  void refuse_two() {
    const auto compare = [&](const char* by_mp, const char* by_tb) {
      const auto mp = at(m_.values, by_mp), tb = at(m_.tables, by_tb);
      if (mp && tb && *mp != *tb)
        error(ErrorCode::exclusive,
              "{} is {:g} by MP and {} is {:g} by TB,{}, leave one of the two in the file", by_mp,
              *mp, by_tb, *tb, std::string_view(by_tb) == "DENS" ? "DENS" : "ELASTIC");
    };
    compare("DENS", "DENS");
    const bool isotropic = m_.tables.contains("EX"), any = !m_.anisotropic.empty();
    if (any && m_.find("EX") != nullptr)
      source_.note(content_.model, m_.at,
                   "material {} has TB,ANEL, which is taken, and EX by {}, which is not", id_,
                   isotropic ? "TB,ELASTIC" : "MP");
    if (any || !isotropic) return;
    compare("EX", "EX");
    compare("PRXY", "PRXY");
    if (!m_.values.contains("PRXY")) compare("NUXY", "PRXY");
    for (const char* label : {"EY", "EZ", "PRYZ", "PRXZ", "NUYZ", "NUXZ", "GXY", "GYZ", "GXZ"})
      if (m_.values.contains(label))
        error(
            ErrorCode::exclusive,
            "{} by MP and TB,ELASTIC, which is isotropic, exclude each other; remove one from the "
            "file",
            label);
  }

  template <class... Args>
  void error(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
    const std::string text = fmt::format(format, std::forward<Args>(args)...);
    if (said_.insert(text).second) source_.error(code, m_.at, "material {}: {}", id_, text);
  }

  Material isotropic(Material m) {
    auto nu = value("PRXY");
    if (!nu) nu = value("NUXY");
    if (const auto G = value("GXY"); !nu && G && *G > 0.0) nu = m.young / (2.0 * *G) - 1.0;
    if (!nu) return error(ErrorCode::missing, "it has no PRXY"), m;
    m.poisson = *nu;
    if (!(m.young > 0.0))
      error(ErrorCode::out_of_range, "EX is {:g}, expected more than 0", m.young);
    if (!(m.poisson > -1.0 && m.poisson < 0.5))
      error(ErrorCode::out_of_range, "PRXY is {:g}, expected more than -1 and less than 0.5",
            m.poisson);
    if (const auto G = value("GXY"); G && std::abs(*G - m.shear()) > 1e-3 * std::abs(m.shear()))
      error(ErrorCode::incomplete,
            "GXY is {:g}, but EX and PRXY give {:g}: an orthotropic material needs EY and EZ", *G,
            m.shear());
    return m;
  }

  /// PR is major: -eps_y/eps_x under stress along x; NU minor: NUXY = PRXY EY/EX.
  double major(const char* pr, const char* nu, double along, double across) {
    if (const auto x = value(pr)) return *x;
    if (const auto x = value(nu)) return *x * along / across;
    error(ErrorCode::missing, "it has no {}", pr);
    return 0.0;
  }

  Material orthotropic(const Material& plain) {
    EngineeringConstants e;
    e.E1 = plain.young;
    e.E2 = value("EY").value_or(e.E1);
    e.E3 = value("EZ").value_or(e.E1);
    e.nu12 = major("PRXY", "NUXY", e.E1, e.E2);
    e.nu23 = major("PRYZ", "NUYZ", e.E2, e.E3);
    e.nu13 = major("PRXZ", "NUXZ", e.E1, e.E3);
    const auto G = value("GXY");
    if (!G) error(ErrorCode::incomplete, "it has EY or EZ, and no GXY");
    e.G12 = G.value_or(1.0);
    e.G23 = value("GYZ").value_or(e.G12);
    e.G13 = value("GXZ").value_or(e.G12);
    if (std::string wrong = engineering_error(e, false); !wrong.empty()) {
      for (const auto& [ours, theirs] : {std::pair{"NU12", "PRXY"},
                                         {"NU13", "PRXZ"},
                                         {"NU23", "PRYZ"},
                                         {"E1", "EX"},
                                         {"E2", "EY"},
                                         {"E3", "EZ"},
                                         {"G12", "GXY"},
                                         {"G13", "GXZ"},
                                         {"G23", "GYZ"}})
        if (const std::size_t at = wrong.find(ours); at != std::string::npos)
          wrong.replace(at, std::string_view(ours).size(), theirs);
      error(ErrorCode::wrong_value, "{}", wrong);
      return plain;
    }
    // The same in all directions is isotropic.
    Material isotropic = plain;
    isotropic.poisson = e.nu12;
    const Mat6 D = elasticity_of(e);
    if (isotropic.poisson < 0.5 && (D - elasticity_matrix(isotropic)).norm() < 1e-6 * D.norm())
      return isotropic;
    return anisotropic_material(D, false, plain.density);
  }

  /// The upper triangle by rows, in the order xx, yy, zz, xy, yz, xz.
  Material anisotropic(double density) {
    if (m_.anisotropic.size() != 21) {
      error(ErrorCode::wrong_count, "TB,ANEL has {} constants, expected 21", m_.anisotropic.size());
      return {};
    }
    Mat6 D;
    std::size_t k = 0;
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j) D(i, j) = D(j, i) = m_.anisotropic[k++];
    const std::string wrong = elasticity_error(D, false, elasticity_name);
    if (!wrong.empty()) {
      error(ErrorCode::wrong_value, "TB,ANEL: {}", wrong);
      return {};
    }
    if (m_.compliance) D = D.inverse().eval();
    return anisotropic_material(D, false, density);
  }

  const AnsysMaterial& m_;
  int id_;
  std::optional<double> temperature_;
  AnsysContent& content_;
  TextSource& source_;
  int temperatures_noted_ = 0;
  std::set<std::string> said_;
};

/// MP,EX,1,2.1e5: with further constants it is a polynomial of the temperature.
void read_ansys_material(AnsysFields& f, AnsysContent& c) {
  const std::string label = f.word(1);
  if (!has_word(needed_labels, label)) return;
  AnsysMaterial& m = open_ansys_material(f, c, f.label(2, "the number of the material"));
  for (std::size_t k = 4; k < f.size(); ++k)
    if (f.real(k, "the coefficient") != 0.0)
      f.stop(ErrorCode::unsupported, "MP: {} depends on the temperature, only constants are read",
             label);
  m.values[label] = {{0.0, f.real(3, label.c_str())}};
}

/// The fields of a line that begins at place `start` of a list, with their places from 0.
template <class Use>
void each_place(AnsysFields& f, const char* command, int start, std::size_t first, Use use) {
  for (std::size_t k = first; k < f.size(); ++k) {
    if (f.blank(k)) continue;
    const std::size_t place = start - 1 + k - first;
    if (place >= most_temperatures)
      f.stop(ErrorCode::too_large, "{}: more than 100 temperatures", command);
    use(k, place);
  }
}

/// MPTEMP,R5.0,count,start,T1,T2,T3; MPTEMP,start,T1,...,T6; MPTEMP: none.
void read_ansys_temperatures(AnsysFields& f, AnsysContent& c) {
  const std::size_t at = ansys_written(f) ? 3 : 1;
  if (f.blank(at) && f.blank(at + 1)) return c.temperatures.clear();
  const int start = f.blank(at) ? 1 : f.label(at, "the place");
  if (start == 1) c.temperatures.clear();
  each_place(f, "MPTEMP", start, at + 1, [&](std::size_t k, std::size_t place) {
    c.temperatures.resize(std::max(c.temperatures.size(), place + 1), 0.0);
    c.temperatures[place] = f.real(k, "the temperature");
  });
}

/// MPDATA,R5.0,count,label,material,start,C1,C2,C3; MPDATA,label,material,start,C1,...,C6.
void read_ansys_material_data(AnsysFields& f, AnsysContent& c) {
  const std::size_t at = ansys_written(f) ? 3 : 1;
  const std::string label = f.word(at);
  if (!has_word(needed_labels, label)) return;
  const int id = f.label(at + 1, "the number of the material");
  auto& table = open_ansys_material(f, c, id).values[label];
  const int start = f.blank(at + 2) ? 1 : f.label(at + 2, "the place");
  if (start == 1) table.clear();
  each_place(f, "MPDATA", start, at + 3, [&](std::size_t k, std::size_t place) {
    if (place > table.size())
      f.stop(ErrorCode::wrong_count, "MPDATA: {} begins at place {}, but {} are there", label,
             start, table.size());
    const double T = place < c.temperatures.size() ? c.temperatures[place] : 0.0;
    const double value = f.real(k, label.c_str());
    table.resize(std::max(table.size(), place + 1));
    table[place] = {T, value};
  });
}

void read_ansys_table(AnsysFields& f, AnsysContent& c) {
  c.table = f.word(1).substr(0, 4);
  c.table_material = f.integer(2, "the number of the material", 1);
  if (c.table == "ANEL") {
    AnsysMaterial& m = open_ansys_material(f, c, f.label(2, "the number of the material"));
    m.anisotropic.clear();
    m.compliance = f.word(5) == "1" || f.word(5) == "FLEX";
    if (f.integer(3, "the number of temperatures", 1) > 1)
      f.stop(ErrorCode::duplicate, "TB,ANEL: several temperatures; leave one in the file");
    return;
  }
  c.table_temperature = 0.0;
  if (c.table == "ELAS" || c.table == "DENS") {  // replaces previous values
    AnsysMaterial& m = open_ansys_material(f, c, c.table_material);
    for (const std::string_view label : {"EX", "PRXY", "DENS"})
      if ((c.table == "DENS") == (label == "DENS")) m.tables.erase(std::string(label));
    return;
  }
  if (has_word(harmless_tables, c.table)) return;
  if (has_word(linear_beside, c.table))
    return f.source().note(
        c.model, f.at(),
        "TB,{} of material {} is not linear: the part has the elastic constants given with it",
        f.word(1), c.table_material);
  f.stop(ErrorCode::unsupported,
         "TB,{}: this table is not read; a part needs EX and PRXY, EX to GXZ, or TB,ANEL",
         f.word(1));
}

bool is_elastic_table(const AnsysContent& c) {
  return c.table == "ANEL" || c.table == "ELAS" || c.table == "DENS";
}

/// Entries in the order of their temperatures.
void put_at(std::vector<std::pair<double, double>>& table, double T, double value) {
  const auto it = std::lower_bound(table.begin(), table.end(), T,
                                   [](const auto& entry, double t) { return entry.first < t; });
  if (it != table.end() && it->first == T)
    it->second = value;
  else
    table.insert(it, {T, value});
}

void read_ansys_table_temperature(AnsysFields& f, AnsysContent& c) {
  if (!is_elastic_table(c)) return;
  c.table_temperature = f.real(f.command() == "TBFIELD" ? 2 : 1, "the temperature");
  if (c.table == "ANEL" && !c.materials[c.table_material].anisotropic.empty())
    f.stop(ErrorCode::duplicate, "TB,ANEL: several temperatures; leave one in the file");
}

/// TBFIELD,TEMP,20 is TBTEMP,20.
void read_ansys_table_field(AnsysFields& f, AnsysContent& c) {
  if (is_elastic_table(c) && f.word(1) != "TEMP")
    f.stop(ErrorCode::unsupported,
           "TBFIELD: TB,{} of material {} depends on {}, only temperatures (TEMP) are read",
           c.table, c.table_material, shown(f.text(1)));
  read_ansys_table_temperature(f, c);
}

/// TBDATA,start,C1,...,C6
void read_ansys_table_data(AnsysFields& f, AnsysContent& c) {
  if (!is_elastic_table(c)) return;
  AnsysMaterial& m = open_ansys_material(f, c, c.table_material);
  std::vector<double> values;
  for (std::size_t k = 2; k < f.size(); ++k)
    if (!f.blank(k)) values.push_back(f.real(k, "the constant"));
  if (c.table == "DENS") {
    if (values.size() != 1)
      f.stop(ErrorCode::wrong_count, "TB,DENS: {} constants in a line, expected 1", values.size());
    return put_at(m.tables["DENS"], c.table_temperature, values[0]);
  }
  if (c.table == "ELAS") {
    if (values.size() != 2)
      f.stop(ErrorCode::wrong_count,
             "TB,ELASTIC: {} constants in a line, expected 2 of an isotropic material",
             values.size());
    put_at(m.tables["EX"], c.table_temperature, values[0]);
    return put_at(m.tables["PRXY"], c.table_temperature, values[1]);
  }
  const std::size_t place = m.anisotropic.size() + 1;
  if (f.integer(1, "the place", static_cast<int>(place)) != static_cast<int>(place))
    f.stop(ErrorCode::out_of_range, "TB,ANEL: constants from place {}, expected from {}", f.text(1),
           place);
  if (m.anisotropic.size() + values.size() > 21)
    f.stop(ErrorCode::too_large, "TB,ANEL: more than 21 constants of material {}",
           c.table_material);
  m.anisotropic.insert(m.anisotropic.end(), values.begin(), values.end());
}

constexpr AnsysCommand material_commands[] = {
    {"MP", read_ansys_material},
    {"MPTEMP", read_ansys_temperatures},
    {"MPDATA", read_ansys_material_data},
    {"TB", read_ansys_table},
    {"TBTEMP", read_ansys_table_temperature},
    {"TBFIELD", read_ansys_table_field},
    {"TBDATA", read_ansys_table_data},
};

}  // namespace

std::span<const AnsysCommand> ansys_material_commands() { return material_commands; }

Material ansys_material(const AnsysMaterial& m, int id, std::optional<double> temperature,
                        AnsysContent& content, TextSource& source) {
  return AnsysElastic(m, id, temperature, content, source).made();
}

}  // namespace floatframe
