// Every field of couplings and of what refers to them, one change at a time.
#include "floatframe/model/joint_motion.hpp"
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

Coupling& coupling(ModelDescription& d) { return std::get<Coupling>(d.couplings[0].kind); }

ModelDescription coupled() {
  ModelDescription d = valid_description();
  d.bodies.push_back(make_body("nut", RigidDescription{1.0, Vec3::Zero(), Mat3::Identity()}));
  d.joints.push_back(make_joint("nut", JointType::cylindrical, "ground", "nut"));
  d.couplings = {{"screw", Coupling{{{"nut", 0}, {"nut", 1, -0.001}, {"slide"}}, {}}, {}}};
  d.outputs.push_back(make_output("F", OutputType::coupling_force, "screw"));
  d.outputs.back().name = "screw.F";
  return d;
}

TEST(ValidateCouplings, NamesWhatIsWrong) {
  EXPECT_EQ(errors(coupled()), "no error");
  const std::vector<DescriptionCase> cases{
      {[](D& d) { coupling(d).terms.clear(); }, "couplings.screw.terms: missing"},
      {[](D& d) { coupling(d).terms[1].joint = "x"; }, "couplings.screw.terms[2].joint: not_found"},
      {[](D& d) { coupling(d).terms[0].factor = nan; },
       "couplings.screw.terms[1].factor: out_of_range"},
      {[](D& d) { coupling(d).terms[2].factor = 0.0; }, "couplings.screw.terms: out_of_range"},
      {[](D& d) { coupling(d).terms[0].coordinate = -1; }, "couplings.screw.terms: incomplete"},
      {[](D& d) { coupling(d).terms[0].coordinate = 2; }, "couplings.screw.terms: incomplete"},
      {[](D& d) { coupling(d).terms[0].coordinate = 1; }, "couplings.screw.terms: duplicate"},
      {[](D& d) { coupling(d).terms[2].joint = "pin"; }, "couplings.screw.terms: wrong_value"},
      {[](D& d) { coupling(d).terms[2].joint = "ball"; }, "couplings.screw.terms: wrong_value"},
      {[](D& d) {
         coupling(d).value.emplace();
         coupling(d).value->pieces = PiecewisePolynomial({1.0}, {{0.0, {0.0}}, {0.0, {1.0}}});
       },
       "couplings.screw.value.piecewise[1]: contradiction"},
      {[](D& d) {
         coupling(d).value.emplace();
         coupling(d).value->sines = {{.amplitude = 1.0}};
       },
       "couplings.screw.value.sine.frequency: out_of_range"},
      {[](D& d) { d.couplings.push_back(d.couplings[0]); }, "couplings.screw: duplicate"},
      {[](D& d) { d.couplings.push_back(d.rods[0]); }, "couplings.rod.type: wrong_value"},
      {[](D& d) { d.rods.push_back(d.couplings[0]); }, "rods.screw.type: wrong_value"},
      {[](D& d) { d.outputs.back().entity = "x"; }, "outputs.screw.F.coupling_force: not_found"}};
  for (const DescriptionCase& c : cases) {
    ModelDescription d = coupled();
    c.change(d);
    EXPECT_EQ(errors(d), c.expected);
  }
}

// Of each coordinate of the list of joints: what holds a constant direction in the joint frame.
TEST(CoordinateAxes, AreDisplacementsAndAnglesAboutTheAxis) {
  const auto axis = [](JointType type, int k) {
    return coordinate_axis(type, Vec3(0.6, 0.8, 0.0), k);
  };
  EXPECT_TRUE(axis(JointType::revolute, 0)->turns);
  EXPECT_FALSE(axis(JointType::prismatic, 0)->turns);
  EXPECT_EQ(axis(JointType::cylindrical, 0)->direction, Vec3::UnitZ());
  EXPECT_TRUE(axis(JointType::cylindrical, 1)->turns);
  EXPECT_EQ(axis(JointType::planar, 1)->direction, Vec3(-0.8, 0.6, 0.0));
  EXPECT_TRUE(axis(JointType::planar, 2)->turns);
  for (const JointType type : {JointType::universal, JointType::spherical, JointType::free})
    for (int k = 0; k < joint_velocities(type); ++k) EXPECT_FALSE(axis(type, k));
}

}  // namespace
}  // namespace floatframe::test
