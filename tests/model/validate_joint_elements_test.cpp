// Every field of stops and of friction on coordinates of joints, one change at a time.
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/port_measures.hpp"
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

JointStop& stop(ModelDescription& d) { return std::get<JointStop>(d.forces[0].kind); }
BristleFriction& rub(ModelDescription& d) { return std::get<BristleFriction>(d.forces[1].kind); }

BristleFriction& by_reaction(ModelDescription& d) {
  rub(d).reaction = true;
  return rub(d);
}

ModelDescription with_stop() {
  ModelDescription d = valid_description();
  d.bodies.push_back(make_body("nut", RigidDescription{1.0, Vec3::Zero(), Mat3::Identity()}));
  d.joints.push_back(make_joint("nut", JointType::cylindrical, "ground", "nut"));
  d.forces.clear();
  d.outputs.clear();
  JointStop keys;
  keys.joint = "nut";
  keys.coordinate = 1;
  keys.lower = -1.0;
  keys.upper = 1.0;
  keys.stiffness = 100.0;
  d.forces.push_back({"stop", keys, {}});
  BristleFriction friction;
  friction.joint = "slide";
  friction.breakaway = 1.0;
  friction.stiffness = 1e4;
  d.forces.push_back({"rub", friction, {}});
  return d;
}

TEST(ValidateJointElements, NamesWhatIsWrong) {
  EXPECT_EQ(errors(with_stop()), "no error");
  const std::vector<DescriptionCase> cases{
      {[](D& d) { stop(d).joint = "x"; }, "forces.stop.joint: not_found"},
      {[](D& d) { stop(d).coordinate = 2; }, "forces.stop.coordinate: out_of_range"},
      {[](D& d) { stop(d).coordinate = -1; }, "forces.stop: incomplete"},
      {[](D& d) { stop(d).joint = "ball"; }, "forces.stop.joint: unsupported"},
      {[](D& d) { stop(d).lower = nan; }, "forces.stop.lower: out_of_range"},
      {[](D& d) { stop(d).lower = 1.0; }, "forces.stop.upper: out_of_range"},
      {[](D& d) {
         stop(d).lower.reset();
         stop(d).upper.reset();
       },
       "forces.stop: missing"},
      {[](D& d) { stop(d).stiffness = 0.0; }, "forces.stop.stiffness: out_of_range"},
      {[](D& d) { stop(d).exponent = 0.9; }, "forces.stop.exponent: out_of_range"},
      {[](D& d) { stop(d).restitution = 0.0; }, "forces.stop.restitution: out_of_range"},
      {[](D& d) { stop(d).least_speed = -1.0; }, "forces.stop.least_speed: out_of_range"},
      {[](D& d) { rub(d).joint = "nut"; }, "forces.rub: incomplete"},
      {[](D& d) { rub(d).coordinate = 1; }, "forces.rub.coordinate: out_of_range"},
      {[](D& d) { rub(d).kinetic = 2.0; }, "forces.rub.kinetic: out_of_range"},
      {[](D& d) { rub(d).preload = -1.0; }, "forces.rub.preload: out_of_range"},
      {[](D& d) { rub(d).radius = 0.0; }, "forces.rub.radius: out_of_range"},
      {[](D& d) { rub(d).reaction = true; }, "no error"},
      {[](D& d) { rub(d).bearing_length = 0.1; }, "forces.rub.bearing_length: incomplete"},
      {[](D& d) { rub(d).axial_radius = 0.1; }, "forces.rub.axial_radius: incomplete"},
      {[](D& d) { by_reaction(d).bearing_length = 0.0; },
       "forces.rub.bearing_length: out_of_range"},
      {[](D& d) { by_reaction(d).bearing_radius = 0.1; }, "forces.rub.bearing_radius: wrong_value"},
      {[](D& d) { by_reaction(d).axial_radius = 0.1; }, "forces.rub.axial_radius: wrong_value"},
      {[](D& d) {
         by_reaction(d).joint = "pin";
         rub(d).coordinate = 0;
       },
       "forces.rub.reaction: unsupported"},
      {[](D& d) {
         by_reaction(d).joint = "nut";
         rub(d).coordinate = 1;
       },
       "forces.rub.reaction: incomplete"},
      {[](D& d) {
         by_reaction(d).joint = "nut";
         rub(d).coordinate = 1;
         rub(d).axial_radius = 0.1;
         rub(d).bearing_length = 0.1;
       },
       "forces.rub.bearing_length: incomplete"}};
  for (const DescriptionCase& c : cases) {
    ModelDescription d = with_stop();
    c.change(d);
    EXPECT_EQ(errors(d), c.expected);
  }
}

// What an element measures of a joint is its coordinate, and the rate that of the joint.
TEST(MeasuredCoordinates, AreThoseOfTheJoint) {
  const double displaced[7] = {0.3, -0.4, 0.5, 1.0, 0.0, 0.0, 0.0},
               turned[4] = {1.0, 0.0, 0.0, 0.0};
  const double v[6] = {1.1, -0.7, 0.9, 0.2, 0.3, -0.6};
  const Vec3 axis_2 = Vec3(0.6, 0.0, 0.8);
  for (const JointType type : joint_types) {
    Joint joint;
    joint.type = type;
    joint.axis_2 = type == JointType::universal ? axis_2 : Vec3::UnitX().eval();
    const double* q = is_of_rotation_vector(type, 0) ? turned : displaced;
    JointMotion m;
    joint_motion(type, {Vec3::UnitZ(), joint.axis_2}, q, m);
    MarkerState F, M;
    F.R = rotation_exp(Vec3(0.4, -0.2, 0.7));
    F.r = Vec3(0.1, 0.2, 0.3);
    M.R = F.R * m.R_FM;
    M.r = F.r + F.R * m.p_FM;
    Vec6 twist = Vec6::Zero();
    for (int k = 0; k < joint_velocities(type); ++k) twist += v[k] * m.H.col(k);
    F.v = F.w = F.a_bias = F.alpha_bias = Vec3::Zero();
    M.v = F.R * twist.head<3>();
    M.w = F.R * twist.tail<3>();
    M.a_bias = M.alpha_bias = Vec3::Zero();
    for (int k = 0; k < joint_velocities(type); ++k) {
      if (is_of_rotation_vector(type, k)) continue;
      const AxisMeasure<double> measured =
          coordinate_measure<double>(measured_coordinate(joint, k), F, M, 0.0);
      EXPECT_NEAR(measured.s, q[k], 1e-14) << joint_type_name(type) << " " << k;
      EXPECT_NEAR(measured.rate, v[k], 1e-14) << joint_type_name(type) << " " << k;
    }
  }
}

}  // namespace
}  // namespace floatframe::test
