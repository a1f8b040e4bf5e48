// Eigenfrequencies, Guyan matrices, static cases and the convergence of Craig-Bampton modes of
// meshed parts against CalculiX 2.20. Its tables print seven digits.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <sstream>

#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/fixed_interface.hpp"
#include "floatframe/reduction/free_structure.hpp"
#include "support/arm_statics.hpp"
#include "support/fe_parts.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

VecX table(const std::string& job) {
  static const Json all = read_json(fe_data("reference_frequencies.json"));
  return to_vector(all.at(job).at("freq_Hz"));
}

void expect_frequencies(const VecX& lambda, const std::string& job) {
  const VecX expected = table(job);
  ASSERT_GE(lambda.size(), expected.size()) << job;
  double worst = 0.0;
  for (Eigen::Index k = 0; k < expected.size(); ++k) {
    const double f = std::sqrt(lambda(k)) / (2.0 * std::numbers::pi);
    worst = std::max(worst, std::abs(f / expected(k) - 1.0));
  }
  EXPECT_LT(worst, 1e-6) << job;
}

VecX free_lambda(const FeModel& model, int count, const std::string& job) {
  const FeSystem system = assemble(model, Integration::ccx);
  const MatX R = rigid_motions(model, system, Vec3::Zero());
  const FreeStructure structure(system.K, system.M, R, 0.01 * elastic_estimate(model, system));
  const Eigenpairs pairs = structure.modes(6 + count);
  EXPECT_LT(pairs.lambda.head<6>().cwiseAbs().maxCoeff(), 1e-6 * pairs.lambda(6)) << job;
  const MatX MX = system.M * pairs.shapes;
  EXPECT_LT(
      (pairs.shapes.transpose() * MX - MatX::Identity(6 + count, 6 + count)).cwiseAbs().maxCoeff(),
      1e-9)
      << job;
  return pairs.lambda.tail(count);
}

/// The sets' nodes clamped (spiders in the model: their references).
VecX held_lambda(const FeModel& model, const std::vector<int>& nodes, int count) {
  const FeSystem system = assemble(model, Integration::ccx);
  std::vector<int> zero;
  for (const int node : nodes)
    for (int axis = 0; axis < 6; ++axis)
      if (const int row = system.row(node, axis); row >= 0) zero.push_back(row);
  const FixedInterface fixed(system.K, system.M, {}, zero, [](int) { return std::string(); });
  return fixed.normal_modes(count).omega.cwiseAbs2();
}

void check_part(const std::string& name, const std::vector<InterfaceDescription>& bores) {
  const FeModel plain = steel_part(name + "_mesh.inp.gz", "mm-t-s");
  expect_frequencies(free_lambda(plain, 20, name), name + "_free");
  std::vector<int> nodes;
  for (const InterfaceDescription& d : bores) {
    const std::vector<int>& set = plain.node_sets.at(d.name);
    nodes.insert(nodes.end(), set.begin(), set.end());
  }
  expect_frequencies(held_lambda(plain, nodes, 20), name + "_fixed");
  FeModel spiders = plain;
  nodes.clear();
  for (const InterfaceDescription& d : bores) nodes.push_back(add_interface(spiders, d));
  expect_frequencies(free_lambda(spiders, 20, name), name + "_rbe2_free");
  expect_frequencies(held_lambda(spiders, nodes, 20), name + "_rbe2_fixed");
}

TEST(FrequenciesAgainstCalculix, Arm) { check_part("aarm_coarse", arm_bores()); }

TEST(FrequenciesAgainstCalculix, ConnectingRod) {
  check_part("conrod_coarse",
             {bore("BIG_END", Vec3(0, 0, 0)), bore("SMALL_END", Vec3(0.14, 0, 0))});
}

TEST(FrequenciesAgainstCalculix, BeamsOfBricksWithDoubleModes) {
  for (const std::string name : {"beam_c3d20", "beam_c3d20r"}) {
    const FeModel model = steel_part(name + "_mesh.inp.gz", "m-kg-s");
    expect_frequencies(free_lambda(model, 14, name), name + "_free");
    std::vector<int> nodes = model.node_sets.at("END_A");
    const VecX cantilever = held_lambda(model, nodes, 12);
    expect_frequencies(cantilever, name + "_cant");
    if (name == "beam_c3d20r") expect_frequencies(cantilever, "beam_rot_0");
    const std::vector<int>& other = model.node_sets.at("END_B");
    nodes.insert(nodes.end(), other.begin(), other.end());
    expect_frequencies(held_lambda(model, nodes, 12), name + "_clcl");
  }
}

TEST(FrequenciesAgainstCalculix, BeamElements) {
  // CalculiX makes bricks of beam elements: b31 of incompatible bricks, b32 of full, b32r of
  // reduced quadratic ones. Bending and stretching of ours agree to what shear and rotary inertia
  // leave, and to the mesh of the bricks: its upper modes of b31 are 0.4 to 0.8 % above those of
  // its b32r, ours, with the shear factor of Abaqus, as much below. In torsion the bricks' section
  // cannot warp (8 % high), ours has St Venant's constant: 1473.1 Hz.
  const struct {
    const char* name;
    double tolerance;
  } cases[] = {{"beam_b31", 0.014}, {"beam_b32", 0.017}, {"beam_b32r", 0.006}};
  for (const auto& c : cases) {
    const FeModel model = read_fe_file(fe_data(std::string(c.name) + "_free.inp"));
    const VecX lambda = free_lambda(model, 14, c.name);
    const VecX expected = table(std::string(c.name) + "_free");
    for (Eigen::Index k = 0; k < 14; ++k) {
      const double f = std::sqrt(lambda(k)) / (2.0 * std::numbers::pi);
      if (k == 10) {
        EXPECT_NEAR(f, 1473.1, 0.002 * 1473.1) << c.name;
        EXPECT_NEAR(expected(k) / f, 1.088, 0.001) << c.name;
      } else {
        EXPECT_NEAR(f, expected(k), c.tolerance * expected(k)) << c.name << " " << k;
      }
    }
  }
}

MatX matrix(const std::string& file) {
  std::istringstream text(read_whole_file(fe_data(file)));
  std::vector<double> values;
  for (double x; text >> x;) values.push_back(x);
  const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(double(values.size()))));
  return Eigen::Map<const MatX>(values.data(), n, n).transpose();
}

/// mm-t-s to SI: energies are N mm, displacements mm.
MatX to_si(const MatX& A) {
  VecX s(A.rows());
  for (Eigen::Index i = 0; i < s.size(); ++i) s(i) = i % 6 < 3 ? 1e3 : 1.0;
  return 1e-3 * s.asDiagonal() * A * s.asDiagonal();
}

struct Condensed {
  FeModel model;
  FeSystem system;
  std::vector<int> boundary;
  std::optional<FixedInterface> fixed;
  MatX X, K, M;
};

Condensed condense(const std::string& name, const std::vector<InterfaceDescription>& bores) {
  Condensed c;
  c.model = steel_part(name + "_mesh.inp.gz", "mm-t-s");
  std::vector<int> nodes;
  for (const InterfaceDescription& d : bores) nodes.push_back(add_interface(c.model, d));
  c.system = assemble(c.model, Integration::ccx);
  for (const int node : nodes)
    for (int axis = 0; axis < 6; ++axis) c.boundary.push_back(c.system.row(node, axis));
  c.fixed.emplace(c.system.K, c.system.M, c.boundary, std::vector<int>{},
                  [](int) { return std::string(); });
  c.X = c.fixed->constraint_modes();
  c.K = c.fixed->guyan_stiffness(c.X);
  c.M = c.X.transpose() * (c.system.M * c.X);
  return c;
}

/// Entries are compared in units of the diagonal.
double distance(const MatX& A, const MatX& B) {
  const VecX s = B.diagonal().cwiseSqrt().cwiseInverse();
  return (s.asDiagonal() * (A - B) * s.asDiagonal()).cwiseAbs().maxCoeff();
}

TEST(Guyan, ConnectingRodAsShipped) {
  const Condensed c = condense(
      "conrod_coarse", {bore("BIG_END", Vec3(0, 0, 0)), bore("SMALL_END", Vec3(0.14, 0, 0))});
  EXPECT_LT(distance(c.K, to_si(matrix("conrod_coarse_guyan_K.txt.gz"))), 1e-8);
  EXPECT_LT(distance(c.M, to_si(matrix("conrod_coarse_guyan_M.txt.gz"))), 1e-9);
}

TEST(ArmAgainstCalculix, GuyanStaticsAndConvergenceOfCraigBampton) {
  const Condensed c = condense("aarm_coarse", arm_bores());
  EXPECT_LT(distance(c.K, to_si(matrix("aarm_coarse_guyan_K.txt.gz"))), 1e-8);
  EXPECT_LT(distance(c.M, to_si(matrix("aarm_coarse_guyan_M.txt.gz"))), 1e-9);

  const MatX K = c.K.bottomRightCorner(18, 18);
  for (const StaticCase& load : static_cases) {
    VecX f = VecX::Zero(18);
    if (load.interface >= 0) {
      f(6 * (load.interface - 2) + load.axis) = load.load;
    } else {
      f(6 + load.axis) = f(12 + load.axis) = load.load;
    }
    VecX u = ldlt_solve(K, f), expected = Eigen::Map<const VecX>(load.expected, 18);
    for (int i = 0; i < 18; ++i)
      if (i % 6 < 3) u(i) *= 1e3;  // [mm]
    double scale[2] = {0.0, 0.0};
    for (int i = 0; i < 18; ++i)
      scale[i % 6 / 3] = std::max(scale[i % 6 / 3], std::abs(expected(i)));
    for (int i = 0; i < 18; ++i)
      EXPECT_NEAR(u(i), expected(i), 1e-6 * scale[i % 6 / 3]) << load.interface << " " << i;
  }

  // Free frequencies with 30 constraint modes and 0, 10, 40 fixed-interface modes.
  const Eigenmodes normal = c.fixed->normal_modes(40);
  const char* printed[3] = {"459.166 534.563 746.790 1260.955 ",
                            "448.203 527.585 745.962 1176.772 ",
                            "448.172 527.315 745.314 1169.871 "};
  const int counts[3] = {0, 10, 40};
  for (int k = 0; k < 3; ++k) {
    const int m = counts[k];
    MatX X(c.X.rows(), 30 + m);
    X << c.X, normal.shapes.leftCols(m);
    MatX Kr = MatX::Zero(30 + m, 30 + m);
    Kr.topLeftCorner(30, 30) = c.K;
    Kr.diagonal().tail(m) = normal.omega.head(m).cwiseAbs2();
    const MatX Mr = X.transpose() * (c.system.M * X);
    const VecX lambda = generalised_eigenvalues(Kr, Mr).values;
    std::string text;
    for (int i = 6; i < 10; ++i) {
      char number[32];
      std::snprintf(number, sizeof number, "%.3f ",
                    std::sqrt(lambda(i)) / (2.0 * std::numbers::pi));
      text += number;
    }
    EXPECT_EQ(text, printed[k]) << m;
  }
}

}  // namespace
}  // namespace floatframe::test
