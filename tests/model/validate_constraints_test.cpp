// Every field of constraints, of cams and of what refers to them, one change at a time.
#include <numbers>

#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

template <class Keys>
Keys constraint_of(Keys keys, const Vec3& axis) {
  keys.a = place_on("ground", {0, 0, 0});
  keys.b = place_on("block", {0, 0, 1});
  keys.axis = axis;
  return keys;
}

ModelDescription held() {
  ModelDescription d = valid_description();
  d.bodies.push_back(make_body("nut", RigidDescription{1.0, Vec3::Zero(), Mat3::Identity()}));
  d.joints.push_back(make_joint("nut", JointType::cylindrical, "ground", "nut"));
  d.joints.back().axis = Vec3::UnitX();
  Perpendicular square = constraint_of(Perpendicular(), Vec3::UnitZ());
  ConstantVelocity shafts = constraint_of(ConstantVelocity(), Vec3::UnitX());
  shafts.axis_2 = Vec3(1.0, 0.5, 0.0);
  PointOnCurve groove;
  groove.a = place_on("ground", {0, 0, 0});
  groove.b = place_on("block", {0, 0, 1});
  groove.points = MatX{{0.0, 0.0, 0.0}, {1.0, 0.0, 1.0}, {2.0, 1.0, 1.0}};
  CurveOnCurve touch = constraint_of(CurveOnCurve(), Vec3::UnitZ());
  touch.x = formula("cos(u)");
  touch.y = formula("sin(u)");
  touch.range = MatX{{0.0, 2.0 * std::numbers::pi}};
  touch.closed = true;
  touch.points_2 = MatX{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  SlideAlong path;
  path.a = groove.a;
  path.b = groove.b;
  path.points = groove.points;
  d.constraints = {{"line", constraint_of(InLine(), Vec3::UnitX()), {}},
                   {"square", square, {}},
                   {"shafts", shafts, {}},
                   {"groove", groove, {}},
                   {"touch", touch, {}},
                   {"path", path, {}}};
  Cam cam{.follower = {"nut", 0}, .cam = {"nut", 1}};
  cam.segments = MatX{{1.0, 0.1}, {2.0, -0.05}};
  d.couplings = {{"cam", cam, {}}};
  d.outputs.push_back(make_output("F", OutputType::joint_force, "line"));
  d.outputs.back().name = "line.F";
  d.outputs.back().constraint = true;
  return d;
}

template <class Keys>
Keys& keys_of(ModelDescription& d, std::size_t k) {
  return std::get<Keys>(d.constraints[k].kind);
}
Cam& cam_of(ModelDescription& d) { return std::get<Cam>(d.couplings[0].kind); }

TEST(ValidateConstraints, NamesWhatIsWrong) {
  using D = ModelDescription;
  EXPECT_EQ(errors(held()), "no error");
  const std::vector<DescriptionCase> cases{
      {[](D& d) { keys_of<InLine>(d, 0).a.body = "block"; }, "constraints.line: geometry"},
      {[](D& d) { keys_of<InLine>(d, 0).b.body = "x"; }, "constraints.line.to.body: not_found"},
      {[](D& d) { keys_of<InLine>(d, 0).axis.setZero(); }, "constraints.line.axis: out_of_range"},
      {[](D& d) { keys_of<Perpendicular>(d, 1).axis_2 = Vec3::UnitZ(); },
       "constraints.square.axis_2: geometry"},
      {[](D& d) { keys_of<ConstantVelocity>(d, 2).axis_2 = Vec3::UnitY(); },
       "constraints.shafts.axis_2: geometry"},
      {[](D& d) { keys_of<PointOnCurve>(d, 3).points.resize(0, 0); },
       "constraints.groove: missing"},
      {[](D& d) { keys_of<PointOnCurve>(d, 3).x = formula("u"); }, "constraints.groove: exclusive"},
      {[](D& d) { keys_of<PointOnCurve>(d, 3).points(1, 1) = nan; },
       "constraints.groove.points: out_of_range"},
      {[](D& d) { keys_of<PointOnCurve>(d, 3).points.row(1).setZero(); },
       "constraints.groove.points: geometry"},
      {[](D& d) {
         keys_of<PointOnCurve>(d, 3).range = MatX{{0.0, 1.0}};
       },
       "constraints.groove.range: incomplete"},
      {[](D& d) { keys_of<CurveOnCurve>(d, 4).axis.setZero(); },
       "constraints.touch.axis: out_of_range"},
      {[](D& d) { keys_of<CurveOnCurve>(d, 4).points_2.resize(0, 0); },
       "constraints.touch: missing"},
      {[](D& d) { keys_of<CurveOnCurve>(d, 4).range.resize(0, 0); }, "constraints.touch: missing"},
      {[](D& d) {
         keys_of<CurveOnCurve>(d, 4).range_2 = MatX{{0.0, 1.0}};
       },
       "constraints.touch.range_2: incomplete"},
      {[](D& d) { keys_of<CurveOnCurve>(d, 4).x_2 = formula("u"); },
       "constraints.touch: exclusive"},
      {[](D& d) { keys_of<SlideAlong>(d, 5).points.conservativeResize(1, 3); },
       "constraints.path.points: wrong_count"},
      {[](D& d) { keys_of<SlideAlong>(d, 5).points(2, 0) = inf; },
       "constraints.path.points: out_of_range"},
      {[](D& d) {
         keys_of<SlideAlong>(d, 5).points.row(2) = keys_of<SlideAlong>(d, 5).points.row(1);
       },
       "constraints.path.points: geometry"},
      {[](D& d) {
         d.outputs.back().type = OutputType::travel;
         d.outputs.back().constraint = false;
       },
       "outputs.line.F.travel: wrong_value"},
      {[](D& d) { d.constraints.push_back(d.constraints[0]); }, "constraints.line: duplicate"},
      {[](D& d) { d.constraints.push_back(d.rods[0]); }, "constraints.rod.type: wrong_value"},
      {[](D& d) { d.outputs.back().entity = "x"; }, "outputs.line.F.joint_force: not_found"},
      {[](D& d) { d.outputs.back().in = OutputAxes::child; }, "outputs.line.F.in: wrong_value"},
      {[](D& d) { cam_of(d).segments.resize(0, 0); }, "couplings.cam: missing"},
      {[](D& d) { cam_of(d).formula = formula("x"); }, "couplings.cam: exclusive"},
      {[](D& d) { cam_of(d).segments(1, 0) = 0.5; }, "couplings.cam.segments: wrong_value"},
      {[](D& d) { cam_of(d).segments(0, 1) = inf; }, "couplings.cam.segments: out_of_range"},
      {[](D& d) { cam_of(d).phase = nan; }, "couplings.cam.phase: out_of_range"},
      {[](D& d) { cam_of(d).cam.coordinate = 0; }, "couplings.cam.cam: duplicate"},
      {[](D& d) {
         cam_of(d).segments.resize(0, 0);
         cam_of(d).points = MatX{{0.0, 0.0}, {1.0, 0.1}};
       },
       "couplings.cam.points: wrong_count"},
      {[](D& d) {
         cam_of(d).segments.resize(0, 0);
         cam_of(d).formula = formula("y");
       },
       "couplings.cam.formula: not_found"}};
  for (const DescriptionCase& c : cases) {
    ModelDescription d = held();
    c.change(d);
    EXPECT_EQ(errors(d), c.expected);
  }
}

}  // namespace
}  // namespace floatframe::test
