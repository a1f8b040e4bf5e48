// Cards of materials: MAT1, and elasticity in axes of the material, MAT2, MAT8 (layers of shells)
// and MAT9 (solids).
#include <fmt/format.h>

#include "floatframe/decks/nastran/nastran_content.hpp"
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

}  // namespace

std::string nastran_plane_error(const NastranMaterial& m) {
  return m.card == "MAT2" ? elasticity_error(*m.elasticity, true, plane_constant) : std::string();
}

std::span<const NastranCardReader> nastran_material_cards() {
  static constexpr NastranCardReader cards[] = {{"MAT1", read_nastran_material<read_mat1>},
                                                {"MAT2", read_nastran_material<read_mat2>},
                                                {"MAT8", read_nastran_material<read_mat8>},
                                                {"MAT9", read_nastran_material<read_mat9>}};
  return cards;
}

}  // namespace floatframe
