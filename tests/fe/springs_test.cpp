// Springs, bushings and rods against closed forms.
#include "floatframe/fe/springs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/fe/model_checks.hpp"
#include "floatframe/fe/strain_energy.hpp"
#include "floatframe/fe/unit_system.hpp"
#include "floatframe/math/rigid_motion.hpp"
#include "support/error_of.hpp"
#include "support/fe_models.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

Spring along(int a, int b, const Vec3& t, double k) {
  Spring s;
  s.nodes = {a, b};
  s.directions[0].head<3>() = -t;
  if (b >= 0) s.directions[1].head<3>() = t;
  s.stiffness = k;
  return s;
}

/// Largest force of the six rigid motions over the largest stiffness.
double rigid_force(const FeModel& model, const FeSystem& system) {
  MatX R(system.size(), 6);
  for (int row = 0; row < system.size(); ++row) {
    const Dof& dof = system.dofs[row];
    R.row(row) = rigid_motion_at(model.positions[dof.node]).row(dof.axis);
  }
  return (system.K * R).cwiseAbs().maxCoeff() / MatX(system.K).cwiseAbs().maxCoeff();
}

/// Two bodies with mass and inertia.
FeModel two_bodies(const Vec3& a, const Vec3& b) {
  FeModel model;
  model.positions = {a, b};
  model.masses = {{0, 2.0, Vec3(0.1, 0.2, 0.25).asDiagonal()},
                  {1, 5.0, Vec3(0.3, 0.4, 0.5).asDiagonal()}};
  return model;
}

// n equal masses in a row: w = 2 sqrt(k/m) sin(j pi / 2n).
TEST(Springs, ChainOfMasses) {
  const int n = 9;
  FeModel model;
  for (int i = 0; i < n; ++i) {
    model.positions.emplace_back(0.1 * i, 0, 0);
    model.masses.push_back({i, 3.0, Mat3::Zero()});
    if (i > 0) model.springs.push_back(along(i - 1, i, Vec3::UnitX(), 2e4));
  }
  validate(model);
  const VecX lambda = free_eigenvalues(assemble(model));
  ASSERT_EQ(lambda.size(), 3 * n);
  for (int j = 1; j < n; ++j)
    EXPECT_NEAR(std::sqrt(lambda(2 * n + j)),
                2 * std::sqrt(2e4 / 3) * std::sin(j * std::numbers::pi / (2 * n)),
                1e-9 * 2 * std::sqrt(2e4 / 3));
  EXPECT_LT(lambda.head(2 * n + 1).cwiseAbs().maxCoeff(), 1e-9 * lambda(3 * n - 1));
  EXPECT_LT(rigid_force(model, assemble(model)), 1e-14);
}

/// Two bodies at one place: each direction has the frequency of its own k and reduced mass.
TEST(Springs, BushingOfTwoBodiesAtOnePlace) {
  Random random(3);
  const Mat3 axes = random.rotation();
  FeModel model = two_bodies(Vec3(1, 2, 3), Vec3(1, 2, 3));
  model.masses[0].J = 0.2 * Mat3::Identity();
  model.masses[1].J = 0.3 * Mat3::Identity();
  Vec6 k;
  k << 1e4, 2e4, 3e4, 100, 200, 300;
  add_bushing(model, 0, 1, Vec3(1, 2, 3), axes, k, "B", {});
  EXPECT_EQ(model.springs.size(), 6u);
  validate(model);
  const VecX lambda = free_eigenvalues(assemble(model));
  std::vector<double> expected;
  for (int i = 0; i < 3; ++i) {
    expected.push_back(k(i) * (1 / 2.0 + 1 / 5.0));
    expected.push_back(k(i + 3) * (1 / 0.2 + 1 / 0.3));
  }
  std::sort(expected.begin(), expected.end());
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(lambda(6 + i) / expected[i], 1.0, 1e-12);
}

// Apart, at any place and in any axes: rigid motions are free, and a turned model is the same.
TEST(Springs, BushingApartLetsRigidMotionsFree) {
  Random random(4);
  const Vec3 a = random.vec3(), b = random.vec3(), at = random.vec3();
  const Mat3 axes = random.rotation(), R = random.rotation();
  Vec6 k;
  k << 1e4, 2e4, 3e4, 100, 0, 300;
  FeModel model = two_bodies(a, b), turned = two_bodies(R * a, R * b);
  for (PointMass& m : turned.masses) m.J = (R * m.J * R.transpose()).eval();
  add_bushing(model, 0, 1, at, axes, k, "B", {});
  add_bushing(turned, 0, 1, R * at, R * axes, k, "B", {});
  EXPECT_EQ(model.springs.size(), 5u);
  const FeSystem system = assemble(model);
  EXPECT_LT(rigid_force(model, system), 1e-14);
  const VecX x = free_eigenvalues(system), y = free_eigenvalues(assemble(turned));
  EXPECT_GT(x(7), 1.0);
  EXPECT_LT(std::abs(x(6)), 1e-9);  // k5 = 0
  EXPECT_LT((x - y).cwiseAbs().maxCoeff(), 1e-11 * x(11));
  // The energy of a motion of the second body alone.
  VecX q = VecX::Zero(12);
  q.segment<6>(6) = random.matrix(6, 1);
  const Vec3 u = axes.transpose() * (q.segment<3>(6) + Vec3(q.segment<3>(9)).cross(at - b)),
             theta = axes.transpose() * q.segment<3>(9);
  const double energy = u.cwiseAbs2().dot(k.head<3>()) + theta.cwiseAbs2().dot(k.tail<3>());
  EXPECT_NEAR(q.dot(system.K * q) / energy, 1.0, 1e-13);
  const MatX U = system.T * q, Theta = system.T_theta * q;
  EXPECT_NEAR(strain_energy(model, U, Theta)(0) / energy, 1.0, 1e-13);
  EXPECT_NEAR(strain_energy_of_each(model, U, Theta)(0) / energy, 1.0, 1e-13);
}

/// Masses without inertia have no rotations of their own: springs over a node without mass.
FeModel masses(std::initializer_list<Vec3> places) {
  FeModel model;
  for (const Vec3& p : places) {
    model.masses.push_back({model.nodes(), 1.0, Mat3::Zero()});
    model.positions.push_back(p);
  }
  return model;
}

TEST(Springs, NodesWithoutMassAreCondensed) {
  FeModel model = masses({Vec3(0, 0, 0), Vec3(2, 0, 0)});
  model.positions.emplace_back(1, 0, 0);
  model.positions.emplace_back(0, 5, 0);
  model.springs = {along(0, 2, Vec3::UnitX(), 300.0), along(2, 1, Vec3::UnitX(), 600.0),
                   along(0, 3, Vec3::UnitY(), 1e9)};  // ends in the air
  validate(model);
  const FeSystem system = assemble(model);
  ASSERT_EQ(system.size(), 6);
  MatX expected = MatX::Zero(6, 6);  // in series
  expected(0, 0) = expected(3, 3) = 200.0;
  expected(0, 3) = expected(3, 0) = -200.0;
  EXPECT_LT((MatX(system.K) - expected).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(nodes_on_springs(model), (std::vector<int>{2, 3}));
  EXPECT_TRUE(contains(model_warnings(model), "2 nodes hang on springs alone"));
  // An interface stays.
  model.node_names = {"", "", "mount", ""};
  EXPECT_EQ(assemble(model).size(), 9);
}

// A node without mass that an equation carries in one direction.
TEST(Springs, EndsThatEquationsCarry) {
  FeModel model = masses({Vec3(0, 0, 0), Vec3(2, 0, 0)});
  model.positions.emplace_back(1, 0, 0);
  model.springs = {along(0, 2, Vec3(0.6, 0.8, 0.0), 100.0)};
  model.equations = {{{{2, 0, 1.0}, {1, 0, -1.0}}, {}}};
  validate(model);
  const FeSystem system = assemble(model);
  EXPECT_EQ(system.size(), 6);
  EXPECT_LT(MatX(system.K).cwiseAbs().maxCoeff(), 1e-12);  // it can move along y
  model.springs.push_back(along(2, 1, Vec3::UnitY(), 36.0));
  const MatX K = assemble(model).K;
  // y of the end follows: 100 (0.6 u - 0.8 v)^2 + 36 v^2, u the difference along x
  EXPECT_NEAR(K(0, 0), 36.0 - 48.0 * 48.0 / 100.0, 1e-12);
}

// Between nodes without rotations a bushing can turn about them: only its length resists, whatever
// its other stiffness is. About an end at one of them (k4 to k6 zero) likewise.
TEST(Springs, BushingBetweenNodesWithoutRotations) {
  Random random(6);
  const Vec3 a = random.vec3(), b = random.vec3();
  const Vec3 t = (b - a).normalized();
  Mat3 axes;
  axes.col(0) = t;
  axes.col(1) = t.cross(random.vec3()).normalized();
  axes.col(2) = t.cross(Vec3(axes.col(1)));
  for (const double turning : {0.0, 500.0}) {
    FeModel model = masses({a, b});
    Vec6 k;
    k << 1e4, 2e5, 3e6, turning, turning, turning;
    add_bushing(model, 0, 1, a + 0.3 * (b - a), axes, k, "B", {});
    const FeSystem system = assemble(model);
    ASSERT_EQ(system.size(), 6);
    MatX expected(6, 6);
    expected << 1e4 * t * t.transpose(), -1e4 * t * t.transpose(), -1e4 * t * t.transpose(),
        1e4 * t * t.transpose();
    EXPECT_LT((MatX(system.K) - expected).cwiseAbs().maxCoeff(), 1e-7) << turning;
  }
  // A spring between rotations that nothing else uses does nothing.
  FeModel model = masses({a, b});
  Vec6 k = Vec6::Zero();
  k(3) = 7.0;
  add_bushing(model, 0, 1, a, axes, k, "torsion", {});
  EXPECT_EQ(assemble(model).size(), 6);
  EXPECT_EQ(assemble(model).K.nonZeros(), 0);
}

/// A rod hangs at two nodes; torsion by way of a third node whose rotations nothing else uses.
TEST(Springs, TorsionPassesNodesWithoutRotations) {
  FeModel model = two_bodies(Vec3(0, 0, 0), Vec3(2, 0, 0));
  model.positions.emplace_back(1, 0, 0);
  model.masses.push_back({2, 1.0, Mat3::Zero()});
  for (const auto& [a, b] : {std::pair{0, 2}, std::pair{2, 1}}) {
    Spring s;
    s.nodes = {a, b};
    s.directions[0](3) = -1.0;
    s.directions[1](3) = 1.0;
    s.stiffness = 10.0;
    model.springs.push_back(s);
  }
  const FeSystem system = assemble(model);
  ASSERT_EQ(system.size(), 15);
  EXPECT_NEAR(system.K.coeff(system.row(0, 3), system.row(1, 3)), -5.0, 1e-13);
  EXPECT_NEAR(system.K.coeff(system.row(0, 3), system.row(0, 3)), 5.0, 1e-13);
}

FeModel rods(std::vector<Vec3> places, const std::vector<std::pair<int, int>>& pairs) {
  FeModel model;
  model.positions = std::move(places);
  model.materials = {{2.1e11, 0.3, 7800.0}};
  model.sections = {{2e-4, 0, 0, 0}};
  for (const auto& [a, b] : pairs) add_element(model, FeElementType::rod2, {a, b});
  return model;
}

// Rods in a row: EA/L (2 - 2 cos) and rho A L/6 (4 + 2 cos) with the angle j pi / n; lumped without
// the cosine.
TEST(Rods, RowOfRods) {
  const int n = 8;
  const double L = 0.1, EA = 2.1e11 * 2e-4, m = 7800.0 * 2e-4 * L;
  std::vector<Vec3> places;
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i <= n; ++i) {
    places.emplace_back(0, 0, L * i);
    if (i > 0) pairs.emplace_back(i - 1, i);
  }
  FeModel model = rods(places, pairs);
  validate(model);
  EXPECT_NEAR(volume_times_density(model), n * m, 1e-12);
  for (const bool lumped : {false, true}) {
    for (FeElement& e : model.elements)
      e.mass_form = lumped ? MassForm::lumped : MassForm::consistent;
    const FeSystem system = assemble(model);
    const VecX lambda = free_eigenvalues(system);
    for (int j = 1; j <= n; ++j) {
      const double c = std::cos(j * std::numbers::pi / n);
      const double expected = EA / L * (2 - 2 * c) / (lumped ? m : m / 6.0 * (4 + 2 * c));
      EXPECT_NEAR(lambda(2 * (n + 1) + j) / expected, 1.0, 1e-9) << j;
    }
    EXPECT_LT(rigid_force(model, system), 1e-14);
  }
}

// A tetrahedron of rods with a load at its top, the feet held: the forces are known.
TEST(Rods, Tripod) {
  const double h = 2.0, r = 1.0;
  std::vector<Vec3> places = {Vec3(0, 0, h)};
  for (int i = 0; i < 3; ++i)
    places.emplace_back(r * std::cos(2 * std::numbers::pi * i / 3),
                        r * std::sin(2 * std::numbers::pi * i / 3), 0);
  const FeModel model = rods(places, {{0, 1}, {0, 2}, {3, 0}, {1, 2}, {2, 3}, {3, 1}});
  validate(model);
  const FeSystem system = assemble(model);
  const double L = std::hypot(h, r), k = 2.1e11 * 2e-4 / L;
  // sum k t t^T: vertical 3 k (h/L)^2, level 3/2 k (r/L)^2
  EXPECT_NEAR(system.K.coeff(2, 2) / (3 * k * h * h / (L * L)), 1.0, 1e-13);
  EXPECT_NEAR(system.K.coeff(0, 0) / (1.5 * k * r * r / (L * L)), 1.0, 1e-13);
  const VecX lambda = free_eigenvalues(system);
  EXPECT_GT(lambda(6), 1e-6 * lambda(11));  // no mechanism
  EXPECT_LT(std::abs(lambda(5)), 1e-9 * lambda(11));
}

TEST(Rods, Errors) {
  FeModel model = rods({Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)}, {{0, 1}, {1, 2}});
  model.sections[0].A = -1.0;
  const std::string text = error_of([&] { validate(model); });
  EXPECT_EQ(text, "geometry\ngeometry") << text;
}

TEST(Springs, Units) {
  Random random(8);
  FeModel model = two_bodies(random.vec3(), random.vec3());
  Vec6 k;
  k << 1e4, 2e4, 3e4, 100, 200, 300;
  add_bushing(model, 0, 1, random.vec3(), random.rotation(), k, "B", {});
  Spring mixed = along(0, 1, Vec3::UnitX(), 5.0);
  mixed.directions[1] << 0, 0, 0, 0, 1, 0;  // a displacement and a rotation
  model.springs.push_back(mixed);
  FeModel si = model;
  const UnitSystem units = *find_unit_system("mm-t-s");
  to_si(si, units);
  const FeSystem a = assemble(model), b = assemble(si);
  VecX q = random.matrix(12, 1), p = q;
  for (int i = 0; i < 12; ++i)
    if (i % 6 < 3) p(i) *= units.length;
  EXPECT_NEAR(p.dot(b.K * p) / (q.dot(a.K * q) * units.force() * units.length), 1.0, 1e-12);
  EXPECT_NEAR(p.dot(b.M * p) / (q.dot(a.M * q) * units.mass * units.length * units.length), 1.0,
              1e-12);
}

TEST(Springs, Errors) {
  FeModel model = two_bodies(Vec3(0, 0, 0), Vec3(1, 0, 0));
  model.springs = {along(0, -1, Vec3::UnitX(), 5.0), along(0, 1, Vec3::UnitX(), -5.0),
                   along(0, 7, Vec3::UnitX(), 5.0)};
  model.springs[0].name = "CELAS2 4";
  model.springs[0].source = {0, 12};
  model.files = {"arm.bdf"};
  const std::string text = error_of([&] { validate(model); });
  EXPECT_EQ(text,
            "contradiction\ncontradiction\narm.bdf:12: unsupported\nout_of_range\nout_of_range")
      << text;
  EXPECT_EQ(text,
            "contradiction\ncontradiction\narm.bdf:12: unsupported\nout_of_range\nout_of_range");
  EXPECT_EQ(remove_grounded_springs(model), 1);
  EXPECT_EQ(model.springs.size(), 2u);
  // A node without mass that ties thousands of others together.
  model = masses({Vec3::Zero()});
  for (int i = 0; i < 500; ++i) {
    model.positions.emplace_back(1, 0.001 * i, 0);
    model.masses.push_back({i + 1, 1.0, Mat3::Zero()});
    for (int axis = 0; axis < 3; ++axis)
      model.springs.push_back(along(501, i + 1, Vec3::Unit(axis), 1.0));
  }
  model.positions.emplace_back(0, 0, 0);
  EXPECT_EQ(error_of([&] { assemble(model); }), "too_large");
}

}  // namespace
}  // namespace floatframe::test
