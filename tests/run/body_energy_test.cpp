// The kinetic energy of a body without its mass matrix against that with it.
#include "floatframe/run/body_energy.hpp"

#include <gtest/gtest.h>

#include <random>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/math/so3.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

TEST(BodyEnergy, IsThatOfTheMassMatrix) {
  const Model model = model_of(stepped_machine);
  std::mt19937_64 random(3);
  std::normal_distribution<double> number;
  const auto vector = [&] { return Vec3(number(random), number(random), number(random)); };
  int flexible = 0;
  for (const Body& body : model.bodies) {
    const InertiaInvariants& invariants = body.data->invariants;
    const int nm = invariants.modes();
    flexible += nm > 0 ? 1 : 0;
    const BodyEnergy energy(invariants);
    const PreprocessingData data(invariants);
    PreprocessingWorkspace work(nm);
    MatX M = MatX::Zero(12 + nm, 12 + nm);
    VecX Qv = VecX::Zero(12 + nm), rates = VecX::Zero(12 + nm);
    for (int trial = 0; trial < 20; ++trial) {
      const Vec3 v = vector(), w = vector();
      VecX y(nm), ydot(nm);
      for (int k = 0; k < nm; ++k) {
        y[k] = 0.3 * number(random);
        ydot[k] = number(random);
      }
      const Mat3 A = Eigen::AngleAxisd(1.3, vector().normalized()).toRotationMatrix();
      const Mat3 Adot = A * skew(w);
      absolute_preprocessing(data, A, Adot, y.data(), ydot.data(), work, M, Qv);
      rates.head<3>() = A * v;
      rates.segment<9>(3) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(Adot.data());
      rates.tail(nm) = ydot;
      const double expected = 0.5 * rates.dot(M * rates);
      ASSERT_NEAR(energy.kinetic(v, w, y.data(), ydot.data()), expected, 1e-13 * expected)
          << body.name;
    }
  }
  EXPECT_EQ(flexible, 1);
}

}  // namespace
}  // namespace floatframe::test
