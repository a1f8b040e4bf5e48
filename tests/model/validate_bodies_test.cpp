// Descriptions made in C++ are checked as strictly as model files: one change of a valid
// description at a time, each with the whole sentence it must give. Here: bodies.
#include <gtest/gtest.h>

#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

TEST(Validate, WhatIsValidIsBuilt) {
  const Model model = build_model(valid_description());
  EXPECT_EQ(model.bodies.size(), 3u);
  EXPECT_EQ(model.bodies[1].modes(), 4);
  EXPECT_EQ(model.outputs.size(), 6u);
}

TEST(Validate, Model) {
  check({
      {[](D& d) { d.name = "a/b"; },
       "name: found 'a/b', expected a name without slashes and control characters"},
      {[](D& d) { d.name = std::string(101, 'n'); },
       "name: found '" + std::string(101, 'n') + "', expected a name of at most 100 characters"},
      {[](D& d) { d.name = " "; }, "name: found ' ', expected a name without blanks at its ends"},
      {[](D& d) { d.gravity.z() = nan; },
       "gravity[3]: found nan, expected a number [m/s2] (numbers must be finite)"},
      {[](D& d) { d = ModelDescription(); }, "bodies: found none, expected at least one body"},
  });
}

TEST(Validate, Bodies) {
  check({
      {[](D& d) {
         d.bodies[0].name = "";
         d.outputs.clear();
         d.forces.clear();
         d.rods.clear();
         d.joints.clear();
         d.joints.clear();
       },
       "bodies: found the name '', expected letters, digits, _ and -, with a letter first"},
      {[](D& d) {
         d.bodies[2].name = "block";
         d.joints.pop_back();
         d.outputs.clear();
         d.forces.clear();
         d.amplitudes.clear();
         d.amplitude_rates.clear();
       },
       "bodies.block: the name is taken, expected a name used once"},
      {[](D& d) {
         d.bodies.push_back(d.bodies[0]);
         d.bodies.back().name = "ground";
       },
       "bodies.ground: the name 'ground' is taken by the ground"},
      {[](D& d) { d.bodies[0].X_WB.p.x() = inf; },
       "bodies.block.position[1]: found inf, expected a number [m] (numbers must be finite)"},
      {[](D& d) { d.bodies[0].X_WB.R *= 2.0; },
       "bodies.block.orientation: found a matrix R with |R^T R - 1| = 3, expected a rotation "
       "matrix: orthonormal axes"},
      {[](D& d) { d.bodies[0].X_WB.R(0, 0) = -1.0; },
       "bodies.block.orientation: found a reflection (determinant -1), expected a rotation matrix: "
       "right-handed axes"},
      {[](D& d) { d.bodies[0].X_WB.R(0, 1) = nan; },
       "bodies.block.orientation: found a matrix with numbers that are not finite, expected a "
       "rotation matrix"},
      {[](D& d) { d.bodies[1].X_WT.R *= 2.0; },
       "bodies.arm.template.orientation: found a matrix R with |R^T R - 1| = 3, expected a "
       "rotation matrix: orthonormal axes"},
      {[](D& d) { d.bodies[1].X_WT.p.y() = nan; },
       "bodies.arm.template.position[2]: found nan, expected a number [m] (numbers must be "
       "finite)"},
      {[](D& d) { d.bodies[1].mirror(0, 0) = 2.0; },
       "bodies.arm.mirror: found a matrix that is not diagonal with 1 and -1, expected a "
       "reflection at planes normal to the axes"},
      {[](D& d) { rigid(d).mass = -1.0; },
       "bodies.block.rigid.mass: found -1, expected a number >= 0 [kg]"},
      {[](D& d) { rigid(d).mass = nan; },
       "bodies.block.rigid.mass: found nan, expected a number >= 0 [kg] (numbers must be finite)"},
      {[](D& d) { rigid(d).p_BC.z() = nan; },
       "bodies.block.rigid.centre_of_mass[3]: found nan, expected a number [m] (numbers must be "
       "finite)"},
      {[](D& d) { rigid(d).J_C(0, 1) = 0.01; },
       "bodies.block.rigid.inertia: found a tensor that is not symmetric, expected equal products "
       "of inertia on both sides of the diagonal [kg m2]"},
      {[](D& d) { rigid(d).J_C(1, 1) = -1.0; },
       "bodies.block.rigid.inertia: found the principal moment -1, expected none below 0 [kg m2]"},
      {[](D& d) { rigid(d).J_C(1, 1) = 3.0; },
       "bodies.block.rigid.inertia: found the principal moments 0.1, 0.25 and 3, expected none "
       "larger than the sum of the other two [kg m2]"},
      {[](D& d) { rigid(d).J_C(2, 2) = inf; },
       "bodies.block.rigid.inertia: found numbers that are not finite, expected an inertia tensor "
       "[kg m2]"},
  });
}

TEST(Validate, ReducedBodies) {
  check({
      {[](D& d) { part(d).mass_model = static_cast<MassModel>(-1); },
       "bodies.part.flexible.mass_model: found -1, expected isoparametric, six_dof or hermite"},
      {[](D& d) {
         part(d).K.resize(2, 2);
         part(d).K.setIdentity();
       },
       "bodies.part.flexible.K: found 2 x 2 numbers, expected 1 x 1 for 1 modes"},
      {[](D& d) { part(d).D.resize(0, 0); },
       "bodies.part.flexible.D: found 0 x 0 numbers, expected 1 x 1 for 1 modes"},
      {[](D& d) { part(d).K(0, 0) = nan; },
       "bodies.part.flexible.K: found numbers that are not finite, expected finite ones"},
      {[](D& d) { part(d).invariants.Si[1].resize(3, 0); },
       "bodies.part.flexible.invariants.Si[1]: found 3 x 0 numbers, expected 3 x 1 for 1 modes"},
      {[](D& d) { part(d).invariants.Sij[0][2].resize(3, 1); },
       "bodies.part.flexible.invariants.Sij[0][2]: found 3 x 1 numbers, expected 1 x 1 for 1 "
       "modes"},
      {[](D& d) { part(d).invariants.P_u(0, 0) = nan; },
       "bodies.part.flexible.invariants.P_u: found numbers that are not finite, expected finite "
       "ones"},
      {[](D& d) {
         part(d).nodes[1].X.resize(3, 4);
         part(d).nodes[1].X.setZero();
       },
       "bodies.part.flexible.nodes[1].X: found 3 x 4 numbers, expected 3 x 1 for 1 modes"},
      {[](D& d) { part(d).nodes[0].p.x() = inf; },
       "bodies.part.flexible.nodes[0].p: found numbers that are not finite, expected finite "
       "ones"},
      {[](D& d) {
         auto p = std::make_shared<ProjectionData>(*part(d).projection);
         p->X.resize(9, 1);
         p->X.setZero();
         part(d).projection = p;
       },
       "bodies.part.flexible.projection.X: found 9 x 1 numbers, expected 6 x 1 for 1 modes"},
      {[](D& d) {
         auto p = std::make_shared<ProjectionData>(*part(d).projection);
         p->M_s.resize(3, 3);
         part(d).projection = p;
       },
       "bodies.part.flexible.projection.M_s: found 3 x 3 numbers, expected 2 x 2"},
      {[](D& d) { d.amplitudes["part"] = VecX::Zero(3); },
       "initial.amplitudes.part: found a list of 3, expected a list of 1 amplitudes, one per mode"},
      {[](D& d) { d.amplitude_rates["part"][0] = nan; },
       "initial.amplitude_rates.part[1]: found nan, expected a number (numbers must be finite)"},
      {[](D& d) { d.amplitudes["block"] = VecX::Zero(1); },
       "initial.amplitudes.block: found a rigid body, expected a flexible one"},
      {[](D& d) { d.amplitudes["blok"] = VecX::Zero(1); },
       "initial.amplitudes.blok: unknown body 'blok', did you mean 'block'?"},
  });
}

}  // namespace
}  // namespace floatframe
