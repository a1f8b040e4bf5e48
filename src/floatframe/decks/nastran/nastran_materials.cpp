// Cards of materials: MAT1, and elasticity in axes of the material, MAT2, MAT8 (layers of shells)
// and MAT9 (solids).
#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/fe/elasticity.hpp"

namespace floatframe {
namespace {

/// "G12" of MAT9; of MAT2, whose third is shear in the plane.
std::string solid_constant(int i, int j) {
  return fmt::format("G{}{}", std::min(i, j) + 1, std::max(i, j) + 1);
}
std::string plane_constant(int i, int j) { return solid_constant(std::min(i, 2), std::min(j, 2)); }

void read_mat1(NastranFields& f, NastranMaterial& m) {
  m.young = f.real_if_given(1, "E");
  m.shear = f.real_if_given(2, "G");
  m.poisson = f.real_if_given(3, "NU");
  m.density = f.real_if_given(4, "RHO");
}

void read_mat8(NastranFields& f, NastranMaterial& m) {
  EngineeringConstants c;
  c.E1 = f.real(1, "E1");
  c.E2 = f.real(2, "E2");
  c.nu12 = f.real(3, "NU12");
  c.G12 = f.real(4, "G12", 0.0);
  c.G13 = f.real(5, "G1Z", 0.0);
  c.G23 = f.real(6, "G2Z", 0.0);
  m.density = f.real_if_given(7, "RHO");
  if (f.blank(1) || f.blank(2) || f.blank(3)) return;
  const std::string error = engineering_error(c, true);
  if (!error.empty()) return f.error(ErrorCode::wrong_value, "{}", error);
  m.elasticity = lamina_elasticity(c);
  m.plane = true;
}

/// The upper half of a matrix from field 1 on, then RHO.
template <class Matrix>
Matrix read_upper_half(NastranFields& f, NastranMaterial& m) {
  Matrix D;
  std::size_t k = 1;
  for (int i = 0; i < D.rows(); ++i)
    for (int j = i; j < D.cols(); ++j) D(i, j) = D(j, i) = f.real(k++, "an elastic constant", 0.0);
  m.density = f.real_if_given(k, "RHO");
  return D;
}

void read_mat2(NastranFields& f, NastranMaterial& m) {
  // Checked where it is used: not as MID4.
  m.elasticity = layer_elasticity(read_upper_half<Mat3>(f, m), 0.0, 0.0);
  m.plane = true;
}

void read_mat9(NastranFields& f, NastranMaterial& m) {
  const auto D = read_upper_half<Mat6>(f, m);
  const std::string error = elasticity_error(D, false, solid_constant);
  if (!error.empty()) return f.error(ErrorCode::wrong_value, "{}", error);
  m.elasticity = D;
}

template <void (*read)(NastranFields&, NastranMaterial&)>
void read_nastran_material(NastranFields& f, NastranContent& c) {
  auto m = f.entity<NastranMaterial>("the number of the material");
  read(f, m);
  if (f.name() != "MAT1" && m.density && *m.density < 0.0)
    f.error(ErrorCode::out_of_range, "RHO is {:g}, expected no negative density", *m.density);
  f.keep(c.materials, std::move(m));
}

/// The cards that a property of a kind could have in place of a material; empty if it may have it.
std::string material_misfit(const NastranMaterial& m, std::string_view card) {
  const std::string_view have = m.card;
  const bool shell = card == "PSHELL" || card.starts_with("PCOMP"), solid = card == "PSOLID";
  if (have == "MAT1" || (solid && have == "MAT9") || (shell && have != "MAT9")) return {};
  return solid ? "MAT1 or MAT9" : shell ? "MAT1, MAT2 or MAT8" : "MAT1";
}

/// Errors in the constants of a MAT2 that is the material of a shell.
std::string nastran_plane_error(const NastranMaterial& m) {
  return m.card == "MAT2" ? elasticity_error(*m.elasticity, true, plane_constant) : std::string();
}

}  // namespace

std::span<const NastranCardReader> nastran_material_cards() {
  static constexpr NastranCardReader cards[] = {{"MAT1", read_nastran_material<read_mat1>},
                                                {"MAT2", read_nastran_material<read_mat2>},
                                                {"MAT8", read_nastran_material<read_mat8>},
                                                {"MAT9", read_nastran_material<read_mat9>}};
  return cards;
}

double NastranMaterials::own_shear(int id) {
  const auto it = c_.materials.find(id);
  if (it == c_.materials.end()) return 1.0;
  const NastranMaterial& m = it->second;
  if (!m.young || !m.shear || !m.poisson) return 1.0;
  if (!(*m.shear > 0.0)) {
    if (unfit_for_bars_.insert(id).second)
      b_.error(ErrorCode::out_of_range, m, "G is {:g}, expected more than 0 for bars", *m.shear);
    return 1.0;
  }
  return *m.shear * 2.0 * (1.0 + *m.poisson) / *m.young;
}

int NastranMaterials::massless(int material) {
  const auto [it, fresh] =
      massless_.try_emplace(material, static_cast<int>(b_.model.materials.size()));
  if (!fresh) return it->second;
  b_.model.materials.push_back(b_.model.materials[material]);
  b_.model.materials.back().density = 0.0;
  b_.model.material_names.push_back(b_.model.material_names[material]);
  return it->second;
}

int NastranMaterials::index(const NastranProperty& p, double nonstructural, int id, bool weighs) {
  const auto key = std::tuple{id, nonstructural, weighs};
  const auto it = indices_.find(key);
  if (it != indices_.end()) return it->second;
  Material m;
  // Pieces of a tapered beam and thicknesses of shells are several materials of one property.
  const bool first = checked_properties_.insert({p.at.file, p.at.line, id}).second;
  const auto found = c_.materials.find(id);
  if (found != c_.materials.end()) {
    const std::string misfit = material_misfit(found->second, p.card);
    if (!misfit.empty() && first)
      b_.source.error(ErrorCode::wrong_value, p.at, "{}: material {} is a {}, expected a {}",
                      p.card, id, found->second.card, misfit);
    m = elastic(found->first, found->second);
    m.density = (found->second.density.value_or(0.0) + nonstructural) * c_.mass_factor;
    if (!found->second.density && weighs)
      b_.model.without_density[static_cast<int>(b_.model.materials.size())] = {found->second.at,
                                                                               c_.mass_factor};
    if (m.density < 0.0 && nonstructural < 0.0 && found->second.density.value_or(-1.0) >= 0.0 &&
        negative_.insert({p.at.file, p.at.line}).second)
      b_.source.error(ErrorCode::out_of_range, p.at,
                      "{}: its nonstructural mass makes the density of material {} {:g}, expected "
                      "no negative number",
                      p.card, id, m.density / c_.mass_factor);
    if (nonstructural != 0.0 && noted_.insert({p.at.file, p.at.line}).second)
      b_.note(p.at,
              fmt::format("{}: its nonstructural mass is added to the density of its material",
                          p.card));
  } else if (first) {
    const auto other = c_.other_materials.find(id);
    b_.source.error(
        ErrorCode::not_found, p.at,
        other == c_.other_materials.end()
            ? fmt::format("{}: material {} is not in the file", p.card, id)
            : fmt::format("{}: material {} is a {}, which is not read", p.card, id, other->second));
  }
  const int fresh = static_cast<int>(b_.model.materials.size());
  b_.model.materials.push_back(m);
  const auto name = c_.names.materials.find(id);
  b_.model.material_names.push_back(
      name == c_.names.materials.end()
          ? fmt::format("{} {}", found == c_.materials.end() ? "MAT1" : found->second.card, id)
          : name->second);
  return indices_[key] = fresh;
}

/// E, G and NU: two give the third.
Material NastranMaterials::elastic(int id, const NastranMaterial& m) {
  Material result;
  // The same sentence for each use of the material would not help.
  const bool first = checked_.insert(id).second;
  if (m.elasticity && first) {
    const std::string error = nastran_plane_error(m);
    if (!error.empty()) b_.error(ErrorCode::wrong_value, m, "{}", error);
  }
  if (m.elasticity) return anisotropic_material(c_.stiffness_factor * *m.elasticity, m.plane, 0.0);
  if (m.card != "MAT1") return result;  // rejected already
  const int given = (m.young ? 1 : 0) + (m.shear ? 1 : 0) + (m.poisson ? 1 : 0);
  if (given < 2) {
    if (first)
      b_.error(ErrorCode::wrong_count, m, "{} of E, G and NU given, expected two",
               given == 0 ? "none" : "one");
    return result;
  }
  result.young = m.young ? *m.young : 2.0 * (1.0 + *m.poisson) * *m.shear;
  if (m.poisson) {
    result.poisson = *m.poisson;
  } else if (*m.shear > 0.0) {
    result.poisson = *m.young / (2.0 * *m.shear) - 1.0;
  } else {
    if (first)
      b_.error(ErrorCode::out_of_range, m,
               "G is {:g}, expected more than 0 where it gives NU with E", *m.shear);
    return result;
  }
  if (first && given == 3 && std::abs(result.shear() - *m.shear) > 0.01 * std::abs(*m.shear))
    b_.note(m.at, fmt::format("MAT1 {}: G is {:.6g}, but E and NU give {:.6g}: bars twist by G, "
                              "shells and solids have E and NU, as in Nastran",
                              id, *m.shear, result.shear()));
  const auto expect = [&](bool valid, const char* what, double found, const std::string& origin,
                          const char* expected) {
    if (first && !valid)
      b_.error(origin.empty() ? ErrorCode::out_of_range : ErrorCode::contradiction, m,
               "{} is {:g}{}, expected {}", what, found, origin, expected);
  };
  const auto from = [](const std::optional<double>& own, const char* a, double x, const char* b,
                       double y) {
    return own ? "" : fmt::format(" (from {} = {:g} and {} = {:g})", a, x, b, y);
  };
  const double shear = m.shear.value_or(0.0);
  expect(result.young > 0.0, "E", result.young, from(m.young, "G", shear, "NU", result.poisson),
         "more than 0");
  expect(result.poisson > -1.0 && result.poisson < 0.5, "NU", result.poisson,
         from(m.poisson, "E", result.young, "G", shear), "more than -1 and less than 0.5");
  const double density = m.density.value_or(0.0);
  expect(density >= 0.0, "RHO", density, "", "no negative density");
  result.young *= c_.stiffness_factor;
  return result;
}

}  // namespace floatframe
