// The same motion twice is found whatever the size of the body.
#include "floatframe/body/modal_mass.hpp"

#include <gtest/gtest.h>

namespace floatframe {
namespace {

TEST(ModalMass, OfSmallBodies) {
  for (const double s : {1.0, 1e-3, 1e-5}) {
    // A rotation of 1 rad, the same again, a normal mode of unit mass, a mode without mass.
    InertiaInvariants v = InertiaInvariants::zero(4);
    v.m = s * s * s;
    v.P_u = std::pow(s, 5) * Mat3::Identity();
    v.Sij[0][0].topLeftCorner(2, 2).setConstant(std::pow(s, 5));
    v.Sij[0][0](2, 2) = 1.0;
    v.Sij[0][0](3, 3) = 1e-20 * std::pow(s, 5);
    MatX K = MatX::Zero(4, 4);
    K.diagonal() << 1e6 * std::pow(s, 3), 1e6 * std::pow(s, 3), 4e6 / (s * s), 1e6 * std::pow(s, 3);
    EXPECT_LT(relative_modal_mass(v, Mat6X::Zero(6, 0), K), least_modal_mass) << s;
    v.Sij[0][0](0, 1) = v.Sij[0][0](1, 0) = 0.0;
    EXPECT_NEAR(relative_modal_mass(v, Mat6X::Zero(6, 0), K), 1.0, 1e-9) << s;
  }
}

}  // namespace
}  // namespace floatframe
