// Outputs relative to a moving frame and in its axes, angles that go on, quantities of all bodies.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/stepping/stepping.hpp"
#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// Two bodies that tumble, one drawn turned, a flexible arm that flies.
const std::string tumbling = R"(
gravity: [0, 0, -9.81]
points: {root: [0, 0, 3], tip: [1, 0, 3]}
bodies:
  a:
    orientation: [0.3, 0.5, -0.4]
    rigid: {mass: 2, centre_of_mass: [0.1, 0, 0], inertia: [0.1, 0.2, 0.25]}
  b:
    position: [1, 2, 0.5]
    rigid: {mass: 3, centre_of_mass: [1, 2.2, 0.5], inertia: [0.3, 0.2, 0.25]}
  arm:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: root, to: tip, elements: 4, section: {round: 0.02}}}
      clamped: [root]
      static_modes: [{point: tip, dofs: [x, y, z]}]
      mass_model: hermite
      section_inertia: true
joints:
  a: {type: free, child: a, velocity: [3, -0.4, 0.5, 1, 2, -3]}
  b: {type: free, child: b, velocity: [-1, 0.4, 2, -2, 1, 2]}
  arm: {type: free, child: arm, at: root, velocity: [1, 0, 2, 0.5, -1, 2]}
initial: {amplitudes: {arm: [0, 2.0e-4, -3.0e-4]}}
)";

class Sampled {
 public:
  Sampled(const std::string& text, Coordinates coordinates, double step, double duration) {
    ModelDescription d = description_of(text);
    d.simulation.coordinates = coordinates;
    d.simulation.step = step;
    d.simulation.duration = duration;
    table_ = completed_run(d).table;
  }
  std::size_t rows() const { return table_.rows(); }
  double at(std::size_t row, const std::string& column) const {
    for (std::size_t k = 0; k < table_.columns.size(); ++k)
      if (table_.columns[k].name == column) return table_.at(row, k);
    ADD_FAILURE() << "no column " << column;
    return 0.0;
  }
  Vec3 vector(std::size_t row, const std::string& name) const {
    return {at(row, name + ".x"), at(row, name + ".y"), at(row, name + ".z")};
  }
  Eigen::Quaterniond quaternion(std::size_t row, const std::string& name) const {
    const Vec3 v = vector(row, name);
    return {at(row, name + ".w"), v.x(), v.y(), v.z()};
  }

 private:
  ResultTable table_;
};

constexpr Coordinates both[] = {Coordinates::absolute, Coordinates::relative};

TEST(OutputFrames, RelativeRatesAreDerivativesOfWhatTheyAreRatesOf) {
  const std::string columns = R"(
outputs:
  p: {position: {body: b, at: [1, 2.2, 0.5]}, relative_to: a}
  v: {velocity: {body: b, at: [1, 2.2, 0.5]}, relative_to: a}
  acc: {acceleration: {body: b, at: [1, 2.2, 0.5]}, relative_to: a}
  q: {quaternion: b, relative_to: a}
  w: {angular_velocity: b, relative_to: a}
  alpha: {angular_acceleration: b, relative_to: a}
  c: {centre_of_mass: b, relative_to: {body: a, at: [0.1, 0, 0]}}
  cv: {velocity: {body: b, at: [1, 2.2, 0.5]}, relative_to: {body: a, at: [0.1, 0, 0]}}
  d: {distance: {from: b, to: a}}
  rate: {distance_rate: {from: b, to: a}}
)";
  const double h = 1e-4;
  for (const Coordinates coordinates : both) {
    const Sampled s(tumbling + columns, coordinates, h, 40 * h);
    for (std::size_t k = 1; k + 1 < s.rows(); ++k) {
      const auto slope = [&](const std::string& name) {
        return Vec3((s.vector(k + 1, name) - s.vector(k - 1, name)) / (2.0 * h));
      };
      EXPECT_LT((slope("p") - s.vector(k, "v")).norm(), 1e-5);
      EXPECT_LT((slope("v") - s.vector(k, "acc")).norm(), 1e-4);
      EXPECT_LT((slope("w") - s.vector(k, "alpha")).norm(), 1e-4);
      EXPECT_LT((slope("c") - s.vector(k, "cv")).norm(), 1e-5);
      const Eigen::Quaterniond q = s.quaternion(k, "q");
      const Vec3 w = s.vector(k, "w");
      const Eigen::Vector4d q_dot =
          0.5 * (Eigen::Quaterniond(0.0, w.x(), w.y(), w.z()) * q).coeffs();
      const Eigen::Vector4d found =
          (s.quaternion(k + 1, "q").coeffs() - s.quaternion(k - 1, "q").coeffs()) / (2.0 * h);
      EXPECT_LT((found - q_dot).norm(), 1e-5);
      EXPECT_NEAR((s.at(k + 1, "d") - s.at(k - 1, "d")) / (2.0 * h), s.at(k, "rate"), 1e-5);
    }
  }
}

TEST(OutputFrames, AxesTurnComponentsAndRotations) {
  const std::string columns = R"(
outputs:
  v: {velocity: b}
  v_child: {velocity: b, in: child}
  v_a: {velocity: b, in: {body: a}}
  w: {angular_velocity: b}
  w_b: {angular_velocity: b, in: b}
  p: {position: b}
  p_a: {position: a}
  between: {position: b, relative_to: a, in: world}
  Q: {quaternion: b}
  Q_a: {quaternion: a}
  R: {quaternion: b, relative_to: a}
  turned: {quaternion: b, in: a}
  angles: {rotation: b, relative_to: a}
measures:
  q: {joint_position: b, coordinate: 4}
)";
  const Model model = model_of(tumbling + columns);
  EXPECT_EQ(model.measures.size(), 1u);
  for (const Coordinates coordinates : both) {
    const Sampled s(tumbling + columns, coordinates, 1e-3, 0.05);
    for (std::size_t k = 0; k < s.rows(); ++k) {
      const Mat3 b = s.quaternion(k, "Q").toRotationMatrix(),
                 a = s.quaternion(k, "Q_a").toRotationMatrix();
      EXPECT_LT((b.transpose() * s.vector(k, "v") - s.vector(k, "v_child")).norm(), 1e-8);
      EXPECT_LT((a.transpose() * s.vector(k, "v") - s.vector(k, "v_a")).norm(), 1e-8);
      EXPECT_LT((b.transpose() * s.vector(k, "w") - s.vector(k, "w_b")).norm(), 1e-8);
      EXPECT_LT((s.vector(k, "p") - s.vector(k, "p_a") - s.vector(k, "between")).norm(), 1e-8);
      const Mat3 R = s.quaternion(k, "R").toRotationMatrix();
      EXPECT_LT((a.transpose() * b - R).norm(), 1e-8);
      EXPECT_LT((a.transpose() * b * a - s.quaternion(k, "turned").toRotationMatrix()).norm(),
                1e-8);
      const Mat3 angles = (Eigen::AngleAxisd(s.at(k, "angles.yaw"), Vec3::UnitZ()) *
                           Eigen::AngleAxisd(s.at(k, "angles.pitch"), Vec3::UnitY()) *
                           Eigen::AngleAxisd(s.at(k, "angles.roll"), Vec3::UnitX()))
                              .toRotationMatrix();
      EXPECT_LT((angles - R).norm(), 1e-8);
    }
  }
}

TEST(OutputFrames, MomentaOfAllBodies) {
  const std::string columns = R"(
outputs:
  P: {momentum: model}
  P_b: {momentum: b}
  v_b: {velocity: {body: b, at: [1, 2.2, 0.5]}}
  P_arm: {momentum: arm}
  c_arm: {centre_of_mass: arm}
  L: {angular_momentum: model}
  L_c: {angular_momentum: b, about: {body: b, at: [1, 2.2, 0.5]}, in: b}
  w_b: {angular_velocity: b, in: b}
  c: {centre_of_mass: model}
  T: {kinetic_energy: model}
  T_a: {kinetic_energy: a}
  T_b: {kinetic_energy: b}
  T_arm: {kinetic_energy: arm}
)";
  const double h = 1e-4, mass = 5.0 + 2700.0 * M_PI * 1e-4;
  for (const Coordinates coordinates : both) {
    const Sampled s(tumbling + columns, coordinates, h, 40 * h);
    const Vec3 P = s.vector(0, "P"), L = s.vector(0, "L"), c = s.vector(0, "c");
    const Vec3 g(0.0, 0.0, -9.81);
    for (std::size_t k = 0; k < s.rows(); ++k) {
      const double t = static_cast<double>(k) * h;
      EXPECT_LT((s.vector(k, "P") - P - mass * t * g).norm(), 1e-6);
      const Vec3 at = c + t * P / mass + 0.5 * t * t * g;
      EXPECT_LT((s.vector(k, "c") - at).norm(), 1e-7);
      // Weight has a moment about the origin: dL/dt = m c x g.
      const Vec3 moment = mass * t * (c + 0.5 * t * P / mass).cross(g);
      EXPECT_LT((s.vector(k, "L") - L - moment).norm(), 1e-5);
      EXPECT_LT((s.vector(k, "P_b") - 3.0 * s.vector(k, "v_b")).norm(), 1e-12);
      const Vec3 spin = Vec3(0.3, 0.2, 0.25).cwiseProduct(s.vector(k, "w_b"));
      EXPECT_LT((s.vector(k, "L_c") - spin).norm(), 1e-7);
      EXPECT_NEAR(s.at(k, "T"), s.at(k, "T_a") + s.at(k, "T_b") + s.at(k, "T_arm"), 1e-12);
      if (k == 0 || k + 1 == s.rows()) continue;
      const Vec3 v_arm = (s.vector(k + 1, "c_arm") - s.vector(k - 1, "c_arm")) / (2.0 * h);
      EXPECT_LT((s.vector(k, "P_arm") - (mass - 5.0) * v_arm).norm(), 1e-3);
    }
  }
}

/// A cantilever under a load at its tip turns there by 3/2 of the displacement over the length.
TEST(OutputFrames, ElasticDisplacementIsFromTheUndeformedPlace) {
  const std::string columns = R"(
outputs:
  u: {elastic_displacement: {body: arm, at: tip}}
  u_world: {elastic_displacement: {body: arm, at: tip}, in: world}
  theta: {elastic_rotation: {body: arm, at: tip}}
  p: {position: {body: arm, at: tip}, relative_to: arm}
  Q: {quaternion: arm}
  still: {elastic_displacement: {body: b, at: [1, 2.2, 0.5]}}
)";
  for (const Coordinates coordinates : both) {
    const Sampled s(tumbling + columns, coordinates, 1e-3, 0.01);
    for (std::size_t k = 0; k < s.rows(); ++k) {
      const Vec3 u = s.vector(k, "u"), theta = s.vector(k, "theta");
      EXPECT_GT(u.norm(), 1e-6);
      EXPECT_LT((s.vector(k, "p") - Vec3::UnitX() - u).norm(), 1e-12);
      EXPECT_LT((s.quaternion(k, "Q") * u - s.vector(k, "u_world")).norm(), 1e-8);
      EXPECT_NEAR(theta.y(), -1.5 * u.z(), 1e-9);
      EXPECT_NEAR(theta.z(), 1.5 * u.y(), 1e-9);
      EXPECT_LT(s.vector(k, "still").norm(), 1e-14);
    }
  }
}

/// A rotor about `axis` [rad/s].
std::string rotor(const std::string& axis, int speed) {
  return R"(
gravity: [0, 0, 0]
bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.1, 0.1, 0.1]}}}
joints: {j: {type: revolute, child: b, at: [0, 0, 0], axis: )" +
         axis + ", velocity: " + std::to_string(speed) + R"(}}
outputs: {r: {rotation: b}, q: {quaternion: b}, j: {joint_position: j}}
)";
}

void turn_about(int axis, Coordinates coordinates, double step, int speed) {
  const std::string names[] = {"r.roll", "r.pitch", "r.yaw"};
  const Sampled s(rotor(std::string(1, "xyz"[axis]), speed), coordinates, step, 2.0);
  for (std::size_t k = 0; k < s.rows(); ++k) {
    const double angle = s.at(k, "j");
    if (coordinates == Coordinates::relative) {
      EXPECT_NEAR(angle, speed * step * static_cast<double>(k), 1e-8);
    }
    for (int n = 0; n < 3; ++n)
      EXPECT_NEAR(s.at(k, names[n]), n == axis ? angle : 0.0, 1e-7) << names[n] << ' ' << k;
    const Eigen::Quaterniond q = s.quaternion(k, "q");
    // Of the two quaternions the nearest to the last one, so only where samples are close.
    if (speed * step > 1.0) continue;
    EXPECT_NEAR(q.w(), std::cos(0.5 * angle), 1e-7);
    EXPECT_NEAR(q.vec()[axis], std::sin(0.5 * angle), 1e-7);
  }
  EXPECT_GT(s.at(s.rows() - 1, "j"), 15.0);
}

TEST(OutputFrames, AnglesGoOnOverTurnsAndThroughTheLock) {
  for (int axis = 0; axis < 3; ++axis) {
    turn_about(axis, Coordinates::absolute, 0.01, 10);
    turn_about(axis, Coordinates::relative, 0.01, 10);
    turn_about(axis, Coordinates::relative, 0.1, 50);  // 5 rad from sample to sample
  }
}

TEST(OutputFrames, ColumnsInOtherUnits) {
  ModelDescription d = description_of(rotor("z", 10));
  d.outputs.back().unit = "deg";
  d.outputs.push_back(d.outputs.back());
  d.outputs.back().name = "speed";
  d.outputs.back().type = OutputType::joint_velocity;
  d.outputs.back().unit = "rpm";
  d.simulation.step = 0.01;
  d.simulation.duration = 1.0;
  const ResultTable t = completed_run(d).table;
  const std::size_t n = t.columns.size();
  EXPECT_EQ(t.columns[n - 2].unit, "deg");
  EXPECT_EQ(t.columns[n - 1].unit, "rpm");
  EXPECT_NEAR(t.at(t.rows() - 1, n - 2), 1800.0 / M_PI, 1e-6);
  EXPECT_NEAR(t.at(t.rows() - 1, n - 1), 300.0 / M_PI, 1e-6);
}

TEST(OutputFrames, SavedStatesKeepTheTurns) {
  ModelDescription d = description_of(rotor("y", 10));
  d.simulation.step = 0.01;
  Simulation whole(build_model(d));
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(whole.step());
  Simulation second(build_model(d));
  second.restore(SimulationState::from_bytes(whole.save().to_bytes()));
  for (int k = 0; k < 50; ++k) {
    ASSERT_TRUE(whole.step());
    ASSERT_TRUE(second.step());
  }
  ASSERT_GT(whole.output("r.pitch"), 14.0);
  for (const std::string& name : whole.output_names())
    EXPECT_EQ(whole.output(name), second.output(name)) << name;
}

}  // namespace
}  // namespace floatframe::test
