// Descriptions made in C++ are checked as strictly as model files: one change of a valid
// description at a time, each with the code and path of its error. Here: bodies.
#include <gtest/gtest.h>

#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

TEST(Validate, ValidModelsAreBuilt) {
  const Model model = build_model(valid_description());
  EXPECT_EQ(model.bodies.size(), 3u);
  EXPECT_EQ(model.bodies[1].modes(), 4);
  EXPECT_EQ(model.outputs.size(), 6u);
}

TEST(Validate, Model) {
  check({
      {[](D& d) { d.name = "a/b"; }, "name: wrong_value"},
      {[](D& d) { d.name = std::string(101, 'n'); }, "name: wrong_value"},
      {[](D& d) { d.name = " "; }, "name: wrong_value"},
      {[](D& d) { d.gravity.z() = nan; }, "gravity[3]: out_of_range"},
      {[](D& d) { d = ModelDescription(); }, "missing"},
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
       "wrong_value"},
      {[](D& d) {
         d.bodies[2].name = "block";
         d.joints.pop_back();
         d.outputs.clear();
         d.forces.clear();
         d.amplitudes.clear();
         d.amplitude_rates.clear();
       },
       "bodies.block: duplicate"},
      {[](D& d) {
         d.bodies.push_back(d.bodies[0]);
         d.bodies.back().name = "ground";
       },
       "bodies.ground: duplicate"},
      {[](D& d) { d.bodies[0].X_WB.p.x() = inf; }, "bodies.block.position[1]: out_of_range"},
      {[](D& d) { d.bodies[0].X_WB.R *= 2.0; }, "bodies.block.orientation: wrong_value"},
      {[](D& d) { d.bodies[0].X_WB.R(0, 0) = -1.0; }, "bodies.block.orientation: wrong_value"},
      {[](D& d) { d.bodies[0].X_WB.R(0, 1) = nan; }, "bodies.block.orientation: not_finite"},
      {[](D& d) { d.bodies[1].X_WT.R *= 2.0; }, "bodies.arm.template.orientation: wrong_value"},
      {[](D& d) { d.bodies[1].X_WT.p.y() = nan; }, "bodies.arm.template.position[2]: out_of_range"},
      {[](D& d) { d.bodies[1].mirror(0, 0) = 2.0; }, "bodies.arm.mirror: wrong_value"},
      {[](D& d) { rigid(d).mass = -1.0; }, "bodies.block.rigid.mass: out_of_range"},
      {[](D& d) { rigid(d).mass = nan; }, "bodies.block.rigid.mass: out_of_range"},
      {[](D& d) { rigid(d).p_BC.z() = nan; }, "bodies.block.rigid.centre_of_mass[3]: out_of_range"},
      {[](D& d) { rigid(d).J_C(0, 1) = 0.01; }, "bodies.block.rigid.inertia: contradiction"},
      {[](D& d) { rigid(d).J_C(1, 1) = -1.0; }, "bodies.block.rigid.inertia: out_of_range"},
      {[](D& d) { rigid(d).J_C(1, 1) = 3.0; }, "bodies.block.rigid.inertia: out_of_range"},
      {[](D& d) { rigid(d).J_C(2, 2) = inf; }, "bodies.block.rigid.inertia: not_finite"},
  });
}

TEST(Validate, ReducedBodies) {
  check({
      {[](D& d) { part(d).mass_model = static_cast<MassModel>(-1); },
       "bodies.part.flexible.mass_model: wrong_value"},
      {[](D& d) {
         part(d).K.resize(2, 2);
         part(d).K.setIdentity();
       },
       "bodies.part.flexible.K: wrong_count"},
      {[](D& d) { part(d).D.resize(0, 0); }, "bodies.part.flexible.D: wrong_count"},
      {[](D& d) { part(d).K(0, 0) = nan; }, "bodies.part.flexible.K: not_finite"},
      {[](D& d) { part(d).invariants.Si[1].resize(3, 0); },
       "bodies.part.flexible.invariants.Si[1]: wrong_count"},
      {[](D& d) { part(d).invariants.Sij[0][2].resize(3, 1); },
       "bodies.part.flexible.invariants.Sij[0][2]: wrong_count"},
      {[](D& d) { part(d).invariants.P_u(0, 0) = nan; },
       "bodies.part.flexible.invariants.P_u: not_finite"},
      {[](D& d) {
         part(d).nodes[1].X.resize(3, 4);
         part(d).nodes[1].X.setZero();
       },
       "bodies.part.flexible.nodes[1].X: wrong_count"},
      {[](D& d) { part(d).nodes[0].p.x() = inf; }, "bodies.part.flexible.nodes[0].p: not_finite"},
      {[](D& d) {
         auto p = std::make_shared<ProjectionData>(*part(d).projection);
         p->X.resize(9, 1);
         p->X.setZero();
         part(d).projection = p;
       },
       "bodies.part.flexible.projection.X: wrong_count"},
      {[](D& d) {
         auto p = std::make_shared<ProjectionData>(*part(d).projection);
         p->M_s.resize(3, 3);
         part(d).projection = p;
       },
       "bodies.part.flexible.projection.M_s: wrong_count"},
      {[](D& d) { d.amplitudes["part"] = VecX::Zero(3); }, "wrong_count"},
      {[](D& d) { d.amplitude_rates["part"][0] = nan; },
       "initial.amplitude_rates.part[1]: out_of_range"},
      {[](D& d) { d.amplitudes["block"] = VecX::Zero(1); },
       "initial.amplitudes.block: wrong_value"},
      {[](D& d) { d.amplitudes["blok"] = VecX::Zero(1); }, "initial.amplitudes.blok: not_found"},
  });
}

}  // namespace
}  // namespace floatframe
