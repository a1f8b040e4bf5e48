#pragma once
// A model of solids, a beam, point masses and a spider.
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/math/so3.hpp"
#include "support/fe_models.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {

/// A brick of two elements with a beam on it, a heavy node and a spider.
inline FeModel mixed_model(Spider::Kind kind) {
  FeModel model;
  Random random(8);
  model.materials = {{2e11, 0.3, 7500.0}};
  model.sections = {BeamSection::rectangle(0.02, 0.05)};
  for (int k = 0; k < 12; ++k) {
    model.positions.push_back(Vec3(k / 4, k % 2, k / 2 % 2) * 0.1 + random.vec3(0.01));
  }
  for (int k = 0; k < 2; ++k) {
    const int a = 4 * k;
    add_element(model, FeElementType::hex8, {a, a + 4, a + 5, a + 1, a + 2, a + 6, a + 7, a + 3});
  }
  model.positions.emplace_back(0.25, 0.06, 0.04);  // 12: reference
  model.positions.emplace_back(0.45, 0.03, 0.07);  // 13: end of the beam
  add_element(model, FeElementType::beam2, {12, 13});
  Mat3 J;
  J << 3, 0.2, 0.1, 0.2, 4, -0.3, 0.1, -0.3, 5;
  model.masses.push_back({13, 1.5, J * 1e-2});
  model.masses.push_back({2, 0.3, Mat3::Zero()});
  add_spider(model, 12, {8, 9, 10, 11}, kind).name = "FLANGE";
  return model;
}

/// T rho = rigid motion of all points: dofs from the position of their nodes.
inline MatX rigid_motions_of(const FeModel& model, const FeSystem& system) {
  MatX R(system.size(), 6);
  for (int i = 0; i < system.size(); ++i) {
    const Dof& d = system.dofs[i];
    Eigen::Matrix<double, 6, 6> A = Mat6::Identity();
    A.topRightCorner<3, 3>() = -skew(model.positions[d.node]);
    R.row(i) = A.row(d.axis);
  }
  return R;
}

}  // namespace floatframe::test
