// The four inertia cells and the integrals against independently computed reference bodies, with
// the file's modes.
#include <gtest/gtest.h>

#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

constexpr double reference_tolerance = 1e-12;  // of the largest entry

struct State {
  Vec3 r0, omega, sdot;
  Mat3 A, Adot;
  VecX y, ydot;
};

/// Turns the relative Qv of the material convention into that for sddot = d(sdot)/dt:
///   Qv -= int B^T (omega x sdot) dm.
void subtract_literal_correction(const PreprocessingData& data, const DeformedInvariants& deformed,
                                 const Vec3& r0, const Mat3& A, const Vec3& omega, const Vec3& sdot,
                                 VecX& Qv) noexcept {
  const Vec3 a = omega.cross(sdot);
  const Vec3 m_vec = data.m * r0 + A * deformed.m_bar;
  const Vec3 a_body = A.transpose() * a;
  Qv.head<3>() -= data.m * a;
  Qv.segment<3>(3) -= m_vec.cross(a);
  for (int k = 0; k < data.modes(); ++k) Qv(6 + k) -= data.S.col(k).dot(a_body);
}

State to_state(const Json& j) {
  State s;
  s.r0 = to_vec3(j["r0"]);
  s.omega = to_vec3(j["omega"]);
  s.sdot = to_vec3(j["sdot"]);
  s.A = to_matrix(j["A"]);
  s.Adot = to_matrix(j["Adot"]);
  s.y = to_vector(j["y"]);
  s.ydot = to_vector(j["ydot"]);
  return s;
}

class Reference : public ::testing::TestWithParam<std::string> {
 protected:
  Json file = reference_body(GetParam());
};

void check_preprocessing(const InertiaInvariants& invariants, const Json& outputs, const State& s) {
  const int nm = invariants.modes();
  const PreprocessingData data(invariants);
  PreprocessingWorkspace work(nm);

  MatX M(12 + nm, 12 + nm);
  VecX Qv(12 + nm);
  absolute_preprocessing(data, s.A, s.Adot, s.y.data(), s.ydot.data(), work, M, Qv);
  EXPECT_LT(relative_error(work.deformed.m_bar, to_vector(outputs["m_bar"])), reference_tolerance);
  EXPECT_LT(relative_error(work.deformed.P_bar, to_matrix(outputs["P_bar"])), reference_tolerance);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(relative_error(work.deformed.S_d.middleRows<3>(3 * i), to_matrix(outputs["S_d"][i])),
              reference_tolerance);
  }
  EXPECT_LT(relative_error(M, to_matrix(outputs["absolute"]["M"])), reference_tolerance);
  EXPECT_LT(relative_error(Qv, to_vector(outputs["absolute"]["Qv"])), reference_tolerance);
  const VecX qdot = to_vector(outputs["absolute"]["qdot"]);
  EXPECT_NEAR(0.5 * qdot.dot(M * qdot) / outputs["kinetic_energy"].get<double>(), 1.0,
              reference_tolerance);

  const Json& any = outputs["absolute_nonorthonormal"];
  absolute_preprocessing(data, to_matrix(any["A"]), to_matrix(any["Adot"]), s.y.data(),
                         s.ydot.data(), work, M, Qv);
  EXPECT_LT(relative_error(M, to_matrix(any["M"])), reference_tolerance);
  EXPECT_LT(relative_error(Qv, to_vector(any["Qv"])), reference_tolerance);

  MatX Mr(6 + nm, 6 + nm);
  VecX Qr(6 + nm);
  relative_preprocessing(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, Mr, Qr);
  const Json& relative = outputs["relative"];
  EXPECT_LT(relative_error(Mr, to_matrix(relative["M"])), reference_tolerance);
  EXPECT_LT(relative_error(Qr, to_vector(relative["Qv_sddot_material_paper"])),
            reference_tolerance);
  subtract_literal_correction(data, work.deformed, s.r0, s.A, s.omega, s.sdot, Qr);
  EXPECT_LT(relative_error(Qr, to_vector(relative["Qv_sddot_literal"])), reference_tolerance);
}

TEST_P(Reference, PreprocessingFromFileIntegrals) {
  const State s = to_state(file["state"]);
  check_preprocessing(to_invariants(file["invariants"]), file["outputs"], s);
  if (file.contains("isoparametric_approximation")) {
    const Json& iso = file["isoparametric_approximation"];
    check_preprocessing(to_invariants(iso["invariants"]), iso["outputs"], s);
  }
}

TEST_P(Reference, IntegralsFromElements) {
  const FeModel model = to_model(file);
  validate(model);
  const MatX X = to_matrix(file["X"]);
  const State s = to_state(file["state"]);
  if (hermite(file)) {
    const InertiaInvariants exact = invariants_hermite(model, X, section_inertia(file));
    EXPECT_LT(relative_error(exact, to_invariants(file["invariants"])), reference_tolerance);
    check_preprocessing(exact, file["outputs"], s);
    const Json& iso = file["isoparametric_approximation"];
    const InertiaInvariants linear = invariants_isoparametric(model, X);
    EXPECT_LT(relative_error(linear, to_invariants(iso["invariants"])), reference_tolerance);
    check_preprocessing(linear, iso["outputs"], s);
  } else {
    const InertiaInvariants linear = invariants_isoparametric(model, X);
    EXPECT_LT(relative_error(linear, to_invariants(file["invariants"])), reference_tolerance);
    check_preprocessing(linear, file["outputs"], s);
    EXPECT_LT(
        relative_error(invariants_isoparametric(model, to_matrix(file["X_translation"])), linear),
        1e-14);
  }
}

TEST_P(Reference, MassMatrices) {
  const FeModel model = to_model(file);
  EXPECT_LT(
      relative_error(MatX(assemble_scalar_mass(model)), to_matrix(file["M_scalar_isoparametric"])),
      reference_tolerance);
  if (file.contains("M_FE_6dof")) {
    EXPECT_LT(relative_error(MatX(assemble_mass(model, section_inertia(file), 6)),
                             to_matrix(file["M_FE_6dof"])),
              reference_tolerance);
  }
}

TEST_P(Reference, ProjectionOfIsoparametricBodies) {
  const FeModel model = to_model(file);
  const State s = to_state(file["state"]);
  ProjectionData data;
  data.p.resize(3, model.nodes());
  for (int k = 0; k < model.nodes(); ++k) data.p.col(k) = model.positions[k];
  data.X = to_matrix(file["X_translation"]);
  data.M_s = assemble_scalar_mass(model);
  const Json& outputs =
      hermite(file) ? file["isoparametric_approximation"]["outputs"] : file["outputs"];
  const int nm = static_cast<int>(data.X.cols());
  ProjectionWorkspace work(data);
  MatX M(12 + nm, 12 + nm);
  VecX Qv(12 + nm);
  absolute_projection(data, s.A, s.Adot, s.y.data(), s.ydot.data(), work, M, Qv);
  EXPECT_LT(relative_error(M, to_matrix(outputs["absolute"]["M"])), reference_tolerance);
  EXPECT_LT(relative_error(Qv, to_vector(outputs["absolute"]["Qv"])), reference_tolerance);
  const Json& any = outputs["absolute_nonorthonormal"];
  absolute_projection(data, to_matrix(any["A"]), to_matrix(any["Adot"]), s.y.data(), s.ydot.data(),
                      work, M, Qv);
  EXPECT_LT(relative_error(M, to_matrix(any["M"])), reference_tolerance);
  EXPECT_LT(relative_error(Qv, to_vector(any["Qv"])), reference_tolerance);
  MatX Mr(6 + nm, 6 + nm);
  VecX Qr(6 + nm);
  relative_projection(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, Mr, Qr);
  EXPECT_LT(relative_error(Mr, to_matrix(outputs["relative"]["M"])), reference_tolerance);
  EXPECT_LT(relative_error(Qr, to_vector(outputs["relative"]["Qv_sddot_material_paper"])),
            reference_tolerance);
}

INSTANTIATE_TEST_SUITE_P(Bodies, Reference, ::testing::ValuesIn(reference_bodies()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace floatframe::test
