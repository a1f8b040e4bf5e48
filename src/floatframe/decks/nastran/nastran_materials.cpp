// MAT2, MAT8 (layers of shells) and MAT9 (solids): elasticity in axes of the material.
#include <fmt/format.h>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/fe/elasticity.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"

namespace floatframe {
namespace {

/// "G12" of MAT9; of MAT2, whose third is shear in the plane.
std::string solid_constant(int i, int j) {
  return fmt::format("G{}{}", std::min(i, j) + 1, std::max(i, j) + 1);
}
std::string plane_constant(int i, int j) {
  const auto number = [](int k) { return k == 3 ? 3 : k + 1; };
  return fmt::format("G{}{}", std::min(number(i), number(j)), std::max(number(i), number(j)));
}

void mat8(NastranFields& f, NastranMaterial& m) {
  EngineeringConstants c;
  c.E1 = f.real(1, "E1");
  c.E2 = f.real(2, "E2");
  c.nu12 = f.real(3, "NU12");
  c.G12 = f.real(4, "G12", 0.0);
  c.G13 = f.real(5, "G1Z", 0.0);
  c.G23 = f.real(6, "G2Z", 0.0);
  if (!f.blank(7)) m.density = f.real(7, "RHO");
  if (f.blank(1) || f.blank(2) || f.blank(3)) return;
  const std::string error = engineering_error(c, true);
  if (!error.empty()) return f.error(ErrorCode::wrong_value, error);
  m.elasticity = lamina_elasticity(c);
  m.plane = true;
}

void mat2(NastranFields& f, NastranMaterial& m) {
  Mat3 Q;
  std::size_t k = 1;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) Q(i, j) = Q(j, i) = f.real(k++, "an elastic constant", 0.0);
  if (!f.blank(7)) m.density = f.real(7, "RHO");
  m.elasticity = layer_elasticity(Q, 0.0, 0.0);  // checked where it is used: not as MID4
  m.plane = true;
}

void mat9(NastranFields& f, NastranMaterial& m) {
  Mat6 D;
  std::size_t k = 1;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) D(i, j) = D(j, i) = f.real(k++, "an elastic constant", 0.0);
  if (!f.blank(22)) m.density = f.real(22, "RHO");
  const std::string error = elasticity_error(D, false, solid_constant);
  if (!error.empty()) return f.error(ErrorCode::wrong_value, error);
  m.elasticity = D;
}

}  // namespace

std::string nastran_plane_error(const NastranMaterial& m) {
  return m.card == std::string_view("MAT2") ? elasticity_error(*m.elasticity, true, plane_constant)
                                            : std::string();
}

void read_nastran_anisotropic(NastranFields& f, NastranContent& c) {
  NastranMaterial m;
  m.at = f.at();
  m.card = f.name() == "MAT2" ? "MAT2" : f.name() == "MAT8" ? "MAT8" : "MAT9";
  const int id = f.label(0, "the number of the material");
  (f.name() == "MAT2" ? mat2 : f.name() == "MAT8" ? mat8 : mat9)(f, m);
  if (m.density && *m.density < 0.0)
    f.error(ErrorCode::out_of_range, "RHO is {:g}, expected no negative density", *m.density);
  const auto [it, fresh] = c.materials.try_emplace(id, m);
  if (!fresh && id > 0) nastran_twice(f, it->second.at);
}

}  // namespace floatframe
