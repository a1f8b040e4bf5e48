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
  // leave; in torsion the bricks' section cannot warp (8 % high), ours has St Venant's constant:
  // 1473.1 Hz.
  const struct {
    const char* name;
    double tolerance;
  } cases[] = {{"beam_b31", 0.006}, {"beam_b32", 0.017}, {"beam_b32r", 0.006}};
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

/// Displacements of the spiders' references that CalculiX prints [mm, rad], bushings clamped: BALL,
/// DAMP_F, DAMP_R, six each.
struct StaticCase {
  int interface, axis;
  double load;  // SI
  double expected[18];
};
const StaticCase static_cases[] = {
    {2,
     0,
     1000.0,
     {6.644588E-03, 1.703858E-04, 5.654863E-04, 8.127652E-07, 1.398914E-04, -2.020221E-05,
      3.675677E-03, 4.493891E-04, -1.360713E-03, -1.168219E-05, 3.506994E-05, -7.939658E-06,
      3.818492E-03, -1.675474E-04, 1.054909E-04, 4.370666E-06, 3.827745E-05, -7.561445E-06}},
    {2,
     1,
     1000.0,
     {1.703858E-04, 3.589983E-03, -5.068778E-02, -3.063008E-04, -7.912000E-07, 1.654314E-06,
      1.113743E-04, 7.854938E-03, -1.128592E-02, -1.555171E-04, 4.848341E-07, -4.568842E-07,
      6.522716E-05, 7.899797E-03, -1.128594E-02, -1.567241E-04, -6.903758E-07, 9.955150E-07}},
    {2,
     2,
     1000.0,
     {5.654863E-04, -5.068778E-02, 1.579248E+00, 7.241331E-03, 7.954190E-05, -8.627823E-07,
      7.647656E-03, -2.415547E-01, 4.583592E-01, 5.368536E-03, 1.699777E-04, -1.720691E-05,
      2.629170E-04, -2.440497E-01, 4.617375E-01, 5.424140E-03, 4.889423E-06, -1.254661E-05}},
    {2,
     3,
     100.0,
     {8.127652E-05, -3.063008E-02, 7.241331E-01, 4.400702E-03, 8.943421E-06, -1.076960E-06,
      -2.856341E-04, -9.981324E-02, 1.612413E-01, 2.219240E-03, -6.566697E-06, -6.439705E-06,
      4.337313E-04, -1.006245E-01, 1.612330E-01, 2.237421E-03, 9.459051E-06, -3.925544E-06}},
    {-1,
     2,
     500.0,
     {-6.276108E-04, -1.128593E-02, 4.600484E-01, 1.612372E-03, -8.943040E-05, -4.622365E-08,
      6.584989E-03, -7.060127E-02, 1.919364E-01, 1.568479E-03, 1.475925E-04, -1.837311E-06,
      -6.243793E-03, -7.095868E-02, 1.921110E-01, 1.576471E-03, -1.403737E-04, -1.725511E-06}}};

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
