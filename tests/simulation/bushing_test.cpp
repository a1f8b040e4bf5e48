// Bushings against what is known without them: eigenfrequencies of a body from the 6 x 6 stiffness
// and mass matrices written down by hand, a large rotation in closed form, model files.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/math/dense.hpp"
#include "floatframe/simulation/simulation.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr const char* laws[] = {"spring_x",  "spring_y",  "spring_z",
                                "spring_rx", "spring_ry", "spring_rz"};

ModelDescription on_bushing(const RigidDescription& rigid, const Vec3& at) {
  ModelDescription d;
  d.gravity.setZero();
  BodyDescription b;
  b.name = "block";
  b.kind = rigid;
  d.bodies.push_back(b);
  JointDescription j;
  j.name = "free";
  j.child.body = "block";
  d.joints.push_back(j);
  AttachmentDescription ground, block;
  ground.point = block.point = at;
  block.body = "block";
  ForceDescription f;
  f.name = "bushing";
  f.kind = ForceValues{ForceType::bushing, {{"from", ground}, {"to", block}}};
  d.forces.push_back(f);
  for (int k = 0; k < 6; ++k) {
    OutputDescription o;
    o.name = std::string("q") + std::to_string(k);
    o.type = OutputType::joint_position;
    o.entity = "free";
    o.component = k;
    d.outputs.push_back(o);
  }
  return d;
}

std::map<std::string, ForceValue>& values(ModelDescription& d) {
  return std::get<ForceValues>(d.forces[0].kind).values;
}

// Started in the shape of an eigenmode a body is in the opposite one after half its period: all six
// stiffnesses in turned axes, the bushing away from the centre of mass.
TEST(Bushing, EigenfrequenciesOfABodyAreThoseOfItsMatrices) {
  const Vec3 at(0.3, -0.2, 0.15);
  const Vec3 axis = Vec3(0.2, -0.5, 1.0).normalized();
  const Vec3 across = Vec3(1.0, 0.3, 0.4), e1 = (across - axis.dot(across) * axis).normalized();
  Mat3 R;
  R << e1, axis.cross(e1), axis;
  const double k[] = {4000.0, 7000.0, 12000.0, 150.0, 260.0, 390.0};
  RigidDescription rigid;
  rigid.mass = 3.0;
  rigid.J_C << 0.05, 0.004, -0.002, 0.004, 0.08, 0.006, -0.002, 0.006, 0.11;
  ModelDescription d = on_bushing(rigid, at);
  values(d)["axis"] = axis;
  values(d)["axis_2"] = across;
  for (int i = 0; i < 6; ++i) values(d)[laws[i]] = PiecewisePolynomial::linear(k[i], 0.0);

  // Small motions (r, phi) of the frame at the centre of mass: displacement r + phi x at.
  Mat6 K = Mat6::Zero(), M = Mat6::Zero();
  for (int i = 0; i < 3; ++i) {
    Eigen::Matrix<double, 6, 1> moves, turns = Eigen::Matrix<double, 6, 1>::Zero();
    moves << R.col(i), at.cross(R.col(i));
    turns.tail<3>() = R.col(i);
    K += k[i] * moves * moves.transpose() + k[3 + i] * turns * turns.transpose();
  }
  M.topLeftCorner<3, 3>() = rigid.mass * Mat3::Identity();
  M.bottomRightCorner<3, 3>() = rigid.J_C;
  const SymmetricEigen modes = generalised_eigen(K, M);
  ASSERT_TRUE(modes.found);
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute})
    for (int mode = 0; mode < 6; ++mode) {
      const double half_period = std::numbers::pi / std::sqrt(modes.values[mode]);
      const VecX shape = 1e-5 * modes.vectors.col(mode) / modes.vectors.col(mode).norm();
      d.joints[0].position.assign(shape.begin(), shape.end());
      d.simulation.coordinates = coordinates;
      d.simulation.duration = half_period;
      d.simulation.step = half_period / 500.0;  // the error of the period: (omega h)^2 / 12, 3e-6
      d.simulation.tolerance = 1e-13;
      const Model model = build_model(d);
      const RunResult r = run(model, model.simulation);
      ASSERT_EQ(r.summary.status, "completed") << r.summary.message;
      const std::size_t end = r.table.rows() - 1;
      for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(r.table.at(end, 1 + i), -shape[i], 1e-4 * 1e-5) << mode << " " << i;
    }
}

// Equal rotational stiffness about all axes is a moment k theta along the rotation vector, however
// large: a ball turns as theta_0 cos(sqrt(k/J) t) about any axis.
TEST(Bushing, LargeRotationsAboutAnyAxisAreHarmonic) {
  const double J = 0.02, k = 3.0, theta = 2.6, omega = std::sqrt(k / J);
  const Vec3 about = Vec3(0.5, -0.7, 0.4).normalized();
  RigidDescription ball;
  ball.mass = 1.0;
  ball.J_C = J * Mat3::Identity();
  ModelDescription d = on_bushing(ball, Vec3::Zero());
  values(d)["axis"] = Vec3(1.0, 1.0, 0.2);
  for (int i = 0; i < 3; ++i) values(d)[laws[i]] = PiecewisePolynomial::linear(500.0, 0.0);
  for (int i = 3; i < 6; ++i) values(d)[laws[i]] = PiecewisePolynomial::linear(k, 0.0);
  const Vec3 start = theta * about;
  d.joints[0].position = {0.0, 0.0, 0.0, start.x(), start.y(), start.z()};
  d.simulation.duration = 0.4;
  d.simulation.step = 2e-4;
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    d.simulation.coordinates = coordinates;
    const Model model = build_model(d);
    const RunResult r = run(model, model.simulation);
    ASSERT_EQ(r.summary.status, "completed") << r.summary.message;
    EXPECT_NEAR(r.summary.energy.total_start, 0.5 * k * theta * theta, 1e-12);
    for (std::size_t row = 0; row < r.table.rows(); row += 50) {
      const Vec3 exact = std::cos(omega * r.table.at(row, 0)) * start;
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(r.table.at(row, 4 + i), exact[i], 1e-4) << row;
        EXPECT_NEAR(r.table.at(row, 1 + i), 0.0, 1e-9) << row;
      }
    }
  }
}

// A damper about one axis alone: theta decays as that of a damped oscillator.
TEST(Bushing, DampersActOnTheRatesOfTheirAngles) {
  const double J = 0.02, k = 3.0, c = 0.1, theta = 0.8;
  RigidDescription ball;
  ball.mass = 1.0;
  ball.J_C = J * Mat3::Identity();
  ModelDescription d = on_bushing(ball, Vec3::Zero());
  values(d)["spring_ry"] = PiecewisePolynomial::linear(k, 0.0);
  values(d)["damper_ry"] = PiecewisePolynomial::linear(c, 0.0);
  d.joints[0].position = {0.0, 0.0, 0.0, 0.0, theta, 0.0};
  d.simulation.duration = 0.5;
  d.simulation.step = 2e-4;
  const Model model = build_model(d);
  const RunResult r = run(model, model.simulation);
  ASSERT_EQ(r.summary.status, "completed") << r.summary.message;
  const double decay = 0.5 * c / J, omega = std::sqrt(k / J - decay * decay);
  for (std::size_t row = 0; row < r.table.rows(); row += 100) {
    const double t = r.table.at(row, 0);
    const double exact =
        theta * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
    EXPECT_NEAR(r.table.at(row, 5), exact, 1e-5) << t;
  }
}

ModelDescription read(const std::string& force) {
  return description_of(
      "bodies:\n  block: {position: [0, 0, 1], rigid: {mass: 2, inertia: [1, 1, 1]}}\n"
      "forces:\n  mount: " +
      force + "\n");
}

TEST(Bushing, InModelFiles) {
  ModelDescription d = read(
      "{type: bushing, from: {body: ground, at: [0, 0, 0.9]}, to: {body: block, at: [0, 0, 1]}, "
      "axis: x, axis_2: z, spring_x: 1000, spring_z: {linear: {stiffness: 2000, preload: 30}}, "
      "spring_rx: 5, damper_x: 7}");
  const Model model = build_model(d);
  const Force& f = model.forces.at(0);
  EXPECT_EQ(f.type, ForceType::bushing);
  // The first axis is z: displacements count from the 0.1 m of the design configuration.
  EXPECT_NEAR(f.laws.at(0)(0.1).f, 0.0, 1e-12);
  EXPECT_NEAR(f.laws.at(0)(0.2).f, 100.0, 1e-12);
  EXPECT_EQ(f.laws.at(2)(0.0).f, 30.0);
  EXPECT_EQ(f.laws.at(3)(0.1).f, 0.5);
  EXPECT_EQ(f.laws.at(6)(1.0).f, 7.0);
  const Mat3 R = model.bodies.at(0).X_WB.R * model.markers.at(f.b).X_NM.R;
  EXPECT_LT((R.col(0) - Vec3::UnitZ()).norm() + (R.col(2) - Vec3::UnitX()).norm(), 1e-15);
}

TEST(Bushing, SaysWhatIsWrong) {
  const std::string ends =
      "{type: bushing, from: {body: ground, at: [0, 0, 0.9]}, to: {body: block, at: [0, 0, 1]}";
  const auto error = [](const std::string& force) {
    const std::string text = error_of([&] { read(force); });
    return text.substr(text.find("forces."));
  };
  EXPECT_EQ(error(ends + "}").substr(0, 66),
            "forces.mount: found no law, expected spring_x, spring_y, spring_z,");
  EXPECT_EQ(error(ends + ", axis: y, axis_2: [0, -2, 0], spring_x: 1}").substr(0, 20),
            "forces.mount.axis_2:");
  EXPECT_EQ(error(ends + ", spring_w: 1, spring_x: 1}"),
            "forces.mount: unknown key 'spring_w', did you mean 'spring_y'?");
  EXPECT_EQ(
      error("{type: bushing, from: {body: block}, to: {body: block, at: [0, 0, 1]}, spring_x: 1}"),
      "forces.mount: found both ends on 'block', expected two bodies");
}

}  // namespace
}  // namespace floatframe::test
