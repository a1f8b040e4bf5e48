#include "floatframe/body/body_stress.hpp"

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// Of xx yy zz xy yz zx, and of N Vy Vz T My Mz, when coordinates change sign: the third local axis
/// of a section is reversed in a mirror.
Vec6 stress_signs(const Vec3& s) {
  return (Vec6() << 1.0, 1.0, 1.0, s(0) * s(1), s(1) * s(2), s(2) * s(0)).finished();
}
Vec6 section_signs(double d) { return (Vec6() << 1.0, 1.0, d, d, d, 1.0).finished(); }

void scale_rows(const Vec6& signs, MatX& m) {
  for (Eigen::Index r = 0; r < m.rows(); ++r) m.row(r) *= signs(r % 6);
}

/// Loads rho e_j and rho r_i e_j of the mirrored body are those of this one with these signs.
void scale_loads(const Vec3& s, MatX& loads) {
  if (loads.size() == 0) return;
  for (int j = 0; j < 3; ++j) {
    loads.col(j) *= s(j);
    for (int i = 0; i < 3; ++i) loads.col(3 + 3 * i + j) *= s(i) * s(j);
  }
}

/// Modal forces of the loads, nm x (12 + nm).
MatX modal_loads(const InertiaInvariants& v) {
  const Eigen::Index nm = v.modes();
  MatX f(nm, body_load_cases + nm);
  for (int j = 0; j < 3; ++j) {
    f.col(j) = v.S.row(j).transpose();
    for (int i = 0; i < 3; ++i) f.col(3 + 3 * i + j) = v.Si[i].row(j).transpose();
  }
  f.rightCols(nm) = modal_mass(v);
  return f;
}

MatX kept_loads(const MatX& modes, const MatX& loads, const MatX& answers,
                const std::vector<int>& keep) {
  if (loads.size() == 0) return {};
  const MatX all = loads + modes * answers;
  MatX out(loads.rows(), body_load_cases + static_cast<Eigen::Index>(keep.size()));
  out.leftCols<body_load_cases>() = all.leftCols<body_load_cases>();
  for (std::size_t k = 0; k < keep.size(); ++k)
    out.col(body_load_cases + static_cast<Eigen::Index>(k)) = all.col(body_load_cases + keep[k]);
  return out;
}

}  // namespace

BodyStress mirrored(const BodyStress& stress, const Vec3& s) {
  BodyStress out = stress;
  for (StressPlace& place : out.places) place.p = s.cwiseProduct(place.p);
  for (BeamSectionPlace& section : out.sections) section.p = s.cwiseProduct(section.p);
  for (MatX* m : {&out.modes, &out.loads}) scale_rows(stress_signs(s), *m);
  for (MatX* m : {&out.section_modes, &out.section_loads}) scale_rows(section_signs(s.prod()), *m);
  for (MatX* m : {&out.loads, &out.section_loads}) scale_loads(s, *m);
  return out;
}

BodyStress with_kept_modes(const BodyStress& stress, const FlexibleBody& body,
                           const std::vector<int>& keep) {
  BodyStress out = stress;
  out.modes = stress.modes(Eigen::all, keep);
  out.section_modes = stress.section_modes(Eigen::all, keep);
  if (stress.loads.size() == 0 && stress.section_loads.size() == 0) return out;
  const MatX f = modal_loads(body.invariants);
  MatX answers = ldlt_solve(body.K, f);
  if (!keep.empty()) {
    const MatX K = body.K(keep, keep);
    const MatX left = ldlt_solve(K, MatX(f(keep, Eigen::all)));
    for (std::size_t k = 0; k < keep.size(); ++k)
      answers.row(keep[k]) -= left.row(static_cast<Eigen::Index>(k));
  }
  out.loads = kept_loads(stress.modes, stress.loads, answers, keep);
  out.section_loads = kept_loads(stress.section_modes, stress.section_loads, answers, keep);
  return out;
}

}  // namespace floatframe
