// Mass, centre and inertia tensor of whole models against closed forms, and against the mass
// matrix: the kinetic energy of the motions of the whole as one rigid body.
#include "floatframe/analyses/mass_properties.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/start/system_state.hpp"
#include "floatframe/stepping/simulation_options.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/random_mechanism.hpp"

namespace floatframe::test {
namespace {

double off(const MatX& a, const MatX& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// What moves a tensor of mass m by d.
Mat3 parallel_axes(double m, const Vec3& d) {
  return m * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
}

// A block, and a rod on a hinge that is turned by 0.7 about y at the start.
const char* const block_and_rod = R"(
bodies:
  block: {position: [1, 2, 3], rigid: {mass: 3, centre_of_mass: [1.1, 2, 2.8],
      inertia: [0.1, 0.2, 0.25]}}
  rod: {position: [4, 0, 0], rigid: {mass: 2, centre_of_mass: [4.5, 0, 0],
      inertia: [0.05, 0.3, 0.32]}}
joints:
  slide: {type: prismatic, child: block, at: [1, 2, 3], axis: x, position: 0.5}
  hinge: {type: revolute, child: rod, at: [4, 0, 0], axis: y, position: 0.7}
simulation: {step: 0.001, duration: 1}
)";

TEST(MassProperties, RigidBodiesByTheTheoremOfParallelAxes) {
  const ModelMass p = mass_properties(model_of(block_and_rod));
  const Mat3 R = Eigen::AngleAxisd(0.7, Vec3::UnitY()).toRotationMatrix();
  const Vec3 block(1.6, 2, 2.8), rod = Vec3(4, 0, 0) + R * Vec3(0.5, 0, 0);
  const Vec3 centre = (3 * block + 2 * rod) / 5;
  EXPECT_DOUBLE_EQ(p.mass, 5);
  EXPECT_LT(off(p.centre, centre), 1e-14);
  ASSERT_EQ(p.bodies.size(), 2u);
  EXPECT_EQ(p.bodies[1].name, "rod");
  EXPECT_DOUBLE_EQ(p.bodies[1].mass, 2);
  EXPECT_LT(off(p.bodies[0].centre, block), 1e-14);
  EXPECT_LT(off(p.bodies[1].centre, rod), 1e-14);
  const Mat3 J_block = Vec3(0.1, 0.2, 0.25).asDiagonal();
  const Mat3 J_rod = R * Vec3(0.05, 0.3, 0.32).asDiagonal() * R.transpose();
  EXPECT_LT(off(p.bodies[1].inertia, J_rod), 1e-14);
  EXPECT_LT(off(p.inertia, J_block + J_rod + parallel_axes(3, block - centre) +
                               parallel_axes(2, rod - centre)),
            1e-13);
}

TEST(MassProperties, PrincipalAxesGiveTheTensorBack) {
  const ModelMass p = mass_properties(model_of(block_and_rod));
  const Mat3 A = p.principal_axes;
  EXPECT_LT(off(A.transpose() * A, Mat3::Identity()), 1e-14);
  EXPECT_NEAR(A.determinant(), 1, 1e-14);
  EXPECT_LT(off(A * p.principal_moments.asDiagonal() * A.transpose(), p.inertia), 1e-13);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(A.col(i).maxCoeff(), A.col(i).cwiseAbs().maxCoeff());
  EXPECT_LE(p.principal_moments[0], p.principal_moments[1]);
  EXPECT_LE(p.principal_moments[1], p.principal_moments[2]);
}

/// A round bar from the origin to (0, 0, 2), held at its lower end.
std::string bar(const std::string& mass_model) {
  return R"(
points: {a: [0, 0, 0], b: [0, 0, 2]}
bodies:
  bar:
    flexible:
      material: {young: 70e9, poisson: 0.3, density: 2700}
      bars: {b: {from: a, to: b, elements: 5, section: {round: 0.1}}}
      clamped: [a]
      static_modes: [{point: b, dofs: [x, y]}]
      mass_model: )" +
         mass_model + R"(
joints: {weld: {type: weld, child: bar, at: a}}
simulation: {step: 0.001, duration: 1})";
}

TEST(MassProperties, UndeformedBarIsACylinder) {
  const double L = 2, r = 0.05, m = 2700 * std::numbers::pi * r * r * L;
  const double thin = m * L * L / 12;
  for (const InertiaMethod method : {InertiaMethod::preprocessing, InertiaMethod::projection}) {
    const bool projected = method == InertiaMethod::projection;
    for (const bool section : {false, true}) {
      if (!section) {  // nodes with the mass of linear elements: exact for a straight bar
        const ModelMass p = mass_properties(model_of(bar("isoparametric")), {.inertia = method});
        EXPECT_NEAR(p.mass, m, 1e-12 * m);
        EXPECT_LT(off(p.inertia, Vec3(thin, thin, 0).asDiagonal().toDenseMatrix()), 1e-12 * thin);
      }
      const std::string model = bar(projected ? "six_dof" : "hermite");
      const ModelMass p = mass_properties(
          model_of(section ? std::string(model).insert(model.find("mass_model"),
                                                       "section_inertia: true\n      ")
                           : model),
          {.inertia = method});
      const double across = section ? m * r * r / 4 : 0, axial = 2 * across;
      EXPECT_NEAR(p.mass, m, 1e-12 * m);
      EXPECT_LT(off(p.centre, Vec3(0, 0, 1)), 1e-13);
      EXPECT_LT(
          off(p.inertia, Vec3(thin + across, thin + across, axial).asDiagonal().toDenseMatrix()),
          1e-12 * thin)
          << p.inertia;
    }
  }
}

TEST(MassProperties, BelongsToTheRequestedStart) {
  const Model model = model_of(bar("isoparametric") + "\ngravity: [30, 0, -9.81]\n");
  const ModelMass given = mass_properties(model, {.start = Start::given});
  const ModelMass sagged = mass_properties(model, {.start = Start::equilibrium});
  EXPECT_EQ(given.centre.x(), 0.0);
  // A cantilever under its own weight q, with the shape of a load at its tip as its only mode: the
  // mean of that shape at the ends of five elements is a, and its stiffness 3 E I / L^3.
  const double q = 2700 * std::numbers::pi * 0.05 * 0.05 * 30, a = 0.38;
  const double EI = 70e9 * std::numbers::pi / 4 * std::pow(0.05, 4);
  const double sag = a * a * q * 16 / (3 * EI);
  EXPECT_NEAR(sagged.centre.x(), sag, 1e-9 * sag);
  EXPECT_GT(sagged.inertia(2, 2), given.inertia(2, 2));
  EXPECT_EQ(sagged.mass, given.mass);
}

/// V^T M V: twice the kinetic energy of the bodies `first` to `last` in the six motions V of a
/// rigid body, translations along the world's axes and rotations about them.
MatX rigid_motion_energy(const AbsoluteFormulation& f, const VecX& q, const MatX& M, int first,
                         int last) {
  MatX V = MatX::Zero(q.size(), 6);
  int at = 0;
  for (int i = 0; i <= last; at += f.kinematics().bodies()[i++].size()) {
    if (i < first) continue;
    for (int k = 0; k < 3; ++k) {
      V.block<3, 1>(at, k) = Vec3::Unit(k);
      for (int column = 0; column < 4; ++column)  // the origin, then the three axes
        V.block<3, 1>(at + 3 * column, 3 + k) =
            Vec3::Unit(k).cross(Vec3(q.segment<3>(at + 3 * column)));
    }
  }
  return V.transpose() * M * V;
}

MatX rigid_body_energy(double m, const Vec3& c, const Mat3& J) {
  MatX G(6, 6);
  G << m * Mat3::Identity(), -m * skew(c), m * skew(c), J + parallel_axes(m, c);
  return G;
}

/// The largest difference between the mass properties of a model, and of each of its bodies, and
/// its mass matrix in absolute coordinates, as a part of the largest term.
double error_of_mass(const Model& model, InertiaMethod method) {
  const SimulationOptions options{.inertia = method};
  const ModelMass p = mass_properties(model, options);
  RelativeFormulation tree(model, method);
  const State start = start_state(tree, described(model, options));
  AbsoluteFormulation f(model, method);
  VecX q, v;
  f.start_from(tree, start.q, start.v, q, v);
  f.positions(start.t, q);
  f.velocities(v);
  f.dynamics();
  const MatX M = f.mass_matrix();
  const int last = static_cast<int>(model.bodies.size()) - 1;
  const MatX whole = rigid_motion_energy(f, q, M, 0, last);
  double error = off(whole, rigid_body_energy(p.mass, p.centre, p.inertia));
  for (int i = 0; i <= last; ++i) {
    const BodyMass& b = p.bodies[static_cast<std::size_t>(i)];
    error = std::max(error, off(rigid_motion_energy(f, q, M, i, i),
                                rigid_body_energy(b.mass, b.centre, b.inertia)));
  }
  return error / whole.cwiseAbs().maxCoeff();
}

TEST(MassProperties, DeformedBarMovesWithThem) {
  for (const std::string mass_model : {"isoparametric", "six_dof", "hermite"}) {
    const Model model = model_of(bar(mass_model) + "\ninitial: {amplitudes: {bar: [0.4, -0.3]}}\n");
    if (mass_model != "six_dof") {
      EXPECT_LT(error_of_mass(model, InertiaMethod::preprocessing), 1e-14) << mass_model;
    }
    if (mass_model != "hermite") {
      EXPECT_LT(error_of_mass(model, InertiaMethod::projection), 1e-14) << mass_model;
    }
  }
}

TEST(MassProperties, RandomMechanismsMoveWithThem) {
  int deformed = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Mechanism m = random_mechanism(seed);
    try {
      const Model model = build_model(m.description);
      EXPECT_LT(error_of_mass(model, m.absolute), 1e-12) << "seed " << seed;
      for (const Body& body : model.bodies) deformed += body.modes() > 0 ? 1 : 0;
    } catch (const InputError&) {  // what is drawn need not be a valid model
    } catch (const RunError&) {
    }
  }
  EXPECT_GT(deformed, 30);
}

TEST(MassProperties, WhatCannotBeIsRefused) {
  EXPECT_EQ(error_of([] { mass_properties(Model()); }), "missing");
  EXPECT_NE(error_of([] { mass_properties(model_of(block_and_rod), {.step = -1.0}); }), "no error");
  const std::string light = R"(
bodies: {point: {position: [0, 0, 0], rigid: {mass: 0}}}
joints: {weld: {type: weld, child: point, at: [0, 0, 0]}}
simulation: {step: 0.001, duration: 1}
)";
  EXPECT_EQ(error_of([&] { mass_properties(model_of(light)); }), "singular");
}

TEST(MassReport, TextAndJsonAgree) {
  const Model model = model_of(block_and_rod);
  const ModelMass p = mass_properties(model);
  const AnalysisReport report = mass_properties_analysis().run(model);
  EXPECT_NE(report.text.find("mass 5 kg, t = 0 s\n"), std::string::npos) << report.text;
  EXPECT_NE(report.text.find("  block          3      1.6      2        2.8\n"), std::string::npos)
      << report.text;
  const auto json = nlohmann::json::parse(report.json);
  EXPECT_EQ(json["mass_kg"], p.mass);
  EXPECT_EQ(json["inertia_kg_m2"][2][0], p.inertia(2, 0));
  EXPECT_EQ(json["principal_axes"][1][0], p.principal_axes(0, 1));
  EXPECT_EQ(json["bodies"][1]["centre_of_mass_m"][2], p.bodies[1].centre.z());
}

}  // namespace
}  // namespace floatframe::test
