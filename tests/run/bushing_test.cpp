// Bushings against what is known without them: eigenfrequencies of a body from the 6 x 6 stiffness
// and mass matrices written down by hand, a large rotation in closed form, model files.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/element_keys.hpp"
#include "support/completed_run.hpp"
#include "support/descriptions.hpp"
#include "support/element_motion.hpp"
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
  d.bodies = {make_body("block", rigid)};
  d.joints = {make_joint("free", JointType::free, "ground", "block")};
  Bushing bushing;
  bushing.from = place_on("ground", at);
  bushing.to = place_on("block", at);
  d.forces = {{"bushing", bushing, {}}};
  for (int k = 0; k < 6; ++k)
    d.outputs.push_back(
        make_output("q" + std::to_string(k), OutputType::joint_position, "free", k));
  return d;
}

void set(ModelDescription& d, const std::string& key, const KeyValue& value) {
  set_key_value(d.forces[0], ElementView(d.forces[0]).key(key), value);
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
  set(d, "axis", axis);
  set(d, "axis_2", across);
  for (int i = 0; i < 6; ++i) set(d, laws[i], PiecewisePolynomial::linear(k[i], 0.0));

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
  for (const Coordinates coordinates : both_coordinates)
    for (int mode = 0; mode < 6; ++mode) {
      const double half_period = std::numbers::pi / std::sqrt(modes.values[mode]);
      const VecX shape = 1e-5 * modes.vectors.col(mode) / modes.vectors.col(mode).norm();
      d.joints[0].position.assign(shape.begin(), shape.end());
      d.simulation.coordinates = coordinates;
      d.simulation.duration = half_period;
      d.simulation.step = half_period / 500.0;  // the error of the period: (omega h)^2 / 12, 3e-6
      d.simulation.tolerance = 1e-13;
      const RunResult r = completed_run(d);
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
  const RigidDescription ball{1.0, Vec3::Zero(), J * Mat3::Identity()};
  ModelDescription d = on_bushing(ball, Vec3::Zero());
  set(d, "axis", Vec3(1.0, 1.0, 0.2));
  for (int i = 0; i < 3; ++i) set(d, laws[i], PiecewisePolynomial::linear(500.0, 0.0));
  for (int i = 3; i < 6; ++i) set(d, laws[i], PiecewisePolynomial::linear(k, 0.0));
  const Vec3 start = theta * about;
  d.joints[0].position = {0.0, 0.0, 0.0, start.x(), start.y(), start.z()};
  d.simulation.duration = 0.4;
  d.simulation.step = 2e-4;
  for (const Coordinates coordinates : both_coordinates) {
    d.simulation.coordinates = coordinates;
    const RunResult r = completed_run(d);
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
  const RigidDescription ball{1.0, Vec3::Zero(), J * Mat3::Identity()};
  ModelDescription d = on_bushing(ball, Vec3::Zero());
  set(d, "spring_ry", PiecewisePolynomial::linear(k, 0.0));
  set(d, "damper_ry", PiecewisePolynomial::linear(c, 0.0));
  d.joints[0].position = {0.0, 0.0, 0.0, 0.0, theta, 0.0};
  d.simulation.duration = 0.5;
  d.simulation.step = 2e-4;
  const RunResult r = completed_run(d);
  const double decay = 0.5 * c / J, omega = std::sqrt(k / J - decay * decay);
  for (std::size_t row = 0; row < r.table.rows(); row += 100) {
    const double t = r.table.at(row, 0);
    const double exact =
        theta * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
    EXPECT_NEAR(r.table.at(row, 5), exact, 1e-5) << t;
  }
}

// A viscous ball joint: with equal dampers of the angular velocity the moment is -c w, whatever the
// attitude, so a ball turns about a fixed axis by (J w0 / c) (1 - e^(-c t / J)): several turns,
// past half turns, where the rotation vector jumps. The damper takes what the ball loses.
TEST(Bushing, ViscousBallJointTurnsWithoutEnd) {
  const double J = 0.02, c = 0.01, w0 = 20.0, end = 1.0;
  const Vec3 about = Vec3(0.5, -0.7, 0.4).normalized();
  const RigidDescription ball{1.0, Vec3::Zero(), J * Mat3::Identity()};
  ModelDescription d = on_bushing(ball, Vec3::Zero());
  set(d, "axis", Vec3(1.0, 1.0, 0.2));
  for (const char* law : {"damper_rx", "damper_ry", "damper_rz"})
    set(d, law, PiecewisePolynomial::linear(c, 0.0));
  std::get<Bushing>(d.forces[0].kind).rotation_rate = RotationRate::angular_velocity;
  const Vec3 w = w0 * about;
  d.joints[0].velocity = {0.0, 0.0, 0.0, w.x(), w.y(), w.z()};
  for (int k = 0; k < 3; ++k)
    d.outputs.push_back(
        make_output("w" + std::to_string(k), place_on("block"), k, OutputType::angular_velocity));
  d.simulation.duration = end;
  const double exact = w0 * std::exp(-c * end / J);
  EXPECT_GT(w0 * J / c * (1.0 - std::exp(-c * end / J)), 2.0 * 2.0 * std::numbers::pi);
  for (const Coordinates coordinates : both_coordinates) {
    d.simulation.coordinates = coordinates;
    double error[3];
    for (int k = 0; k < 3; ++k) {
      // In absolute coordinates of the turn in a step, too.
      const double turn = w0 * 0.005 / std::pow(2.0, k);
      const double part = coordinates == Coordinates::relative ? 1e-6 : turn * turn / 4.0;
      d.simulation.step = 0.005 / std::pow(2.0, k);
      const RunResult r = completed_run(d);
      const std::size_t last = r.table.rows() - 1;
      const Vec3 found(r.table.at(last, 7), r.table.at(last, 8), r.table.at(last, 9));
      EXPECT_LT(found.cross(about).norm(), 1e-9);
      error[k] = std::abs(found.norm() - exact);
      const EnergySummary& e = r.summary.energy;
      EXPECT_LT(error[k], part * exact);
      EXPECT_NEAR(e.work[EnergyFlow::dampers], e.total_end - e.total_start,
                  2.0 * part * w0 * w0 * J);
      for (const RangeWarning& x : r.summary.warnings)
        EXPECT_NE(x.limit, RangeLimit::half_turn) << x.sentence;
    }
    for (int k = 0; k < 2; ++k) {
      EXPECT_GT(error[k] / error[k + 1], 3.8);
      EXPECT_LT(error[k] / error[k + 1], 4.2);
    }
  }
}

// Rates of the rotation vector are not the angular velocity: where the ball goes round on a cone,
// R = Rz(W t) Rx(theta) Rz(-W t), theta turns about z with |thetadot| = W theta, and
// |w|^2 = 2 W^2 (1 - cos theta).
TEST(Bushing, BothRatesOnACone) {
  const double c = 0.3, theta = 1.2;
  MarkerState a, b;
  a.R = b.R = Mat3::Identity();
  a.r = a.v = a.w = b.r = b.v = Vec3::Zero();
  const Vec3 across = theta * Vec3::UnitX();
  b.R = rotation_exp(across);
  const double W = 2.0 * std::numbers::pi;
  b.w = W * (Vec3::UnitZ() - b.R * Vec3::UnitZ());  // d(R)/dt = W (skew(z) R - R skew(z))
  Bushing f;
  f.damper_rx = f.damper_ry = f.damper_rz = PiecewisePolynomial::linear(c, 0.0);
  ElementExample x;
  x.markers = {a, b};
  x.keys(f);
  Efforts s = efforts(x);
  EXPECT_NEAR(s.damping, c * W * W * theta * theta, 1e-12 * s.damping);
  f.rotation_rate = RotationRate::angular_velocity;
  x.keys(f);
  s = efforts(x);
  EXPECT_NEAR(s.damping, c * W * W * 2.0 * (1.0 - std::cos(theta)), 1e-12 * s.damping);
  EXPECT_LT((s.wrench[1].T + c * b.w).norm() + (s.wrench[0].T - c * b.w).norm(), 1e-14);
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
  const Element& f = model.elements.at(0);
  EXPECT_EQ(f.type, ElementType::bushing);
  // The first axis is z: displacements count from the 0.1 m of the design configuration.
  EXPECT_NEAR(f.laws.at(0)(0.1).f, 0.0, 1e-12);
  EXPECT_NEAR(f.laws.at(0)(0.2).f, 100.0, 1e-12);
  EXPECT_EQ(f.laws.at(2)(0.0).f, 30.0);
  EXPECT_EQ(f.laws.at(3)(0.1).f, 0.5);
  EXPECT_EQ(f.laws.at(6)(1.0).f, 7.0);
  const Mat3 R = model.bodies.at(0).X_WB.R * model.markers.at(f.markers[1]).X_NM.R;
  EXPECT_LT((R.col(0) - Vec3::UnitZ()).norm() + (R.col(2) - Vec3::UnitX()).norm(), 1e-15);
  const std::string ends =
      "{type: bushing, from: {body: ground, at: [0, 0, 1]}, to: {body: block, at: [0, 0, 1]}, "
      "damper_rx: 1, rotation_rate: ";
  const auto rate = [&](const std::string& word) {
    return std::get<Bushing>(read(ends + word + "}").forces.at(0).kind).rotation_rate;
  };
  EXPECT_EQ(rate("rotation_vector"), RotationRate::rotation_vector);
  EXPECT_EQ(rate("angular_velocity"), RotationRate::angular_velocity);
}

TEST(Bushing, InvalidBushingsAreErrors) {
  const std::string ends =
      "{type: bushing, from: {body: ground, at: [0, 0, 0.9]}, to: {body: block, at: [0, 0, 1]}";
  const auto error = [](const std::string& force) {
    return without_folders(error_of([&] { read(force); }));
  };
  EXPECT_EQ(error(ends + "}"), "model.yaml:5:3: forces.mount: missing");
  EXPECT_EQ(error(ends + ", axis: y, axis_2: [0, -2, 0], spring_x: 1}"),
            "model.yaml:5:116: forces.mount.axis_2: geometry");
  EXPECT_EQ(error(ends + ", spring_w: 1, spring_x: 1}"),
            "model.yaml:5:99: forces.mount.spring_w: unknown_key");
  EXPECT_EQ(error(ends + ", damper_rx: 1, rotation_rate: angular}"),
            "model.yaml:5:128: forces.mount.rotation_rate: wrong_value");
  EXPECT_EQ(
      error("{type: bushing, from: {body: block}, to: {body: block, at: [0, 0, 1]}, spring_x: 1}"),
      "model.yaml:5:3: forces.mount: geometry");
}

}  // namespace
}  // namespace floatframe::test
