// Rotors whose shafts are flexible bodies of every kind against a rotor assembled in axes that do
// not turn: whirl from 0 to 25 000 rev/min by linear systems and from a kick in runs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/math/dense.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/simulation/simulation.hpp"
#include "floatframe/simulation/turning_model.hpp"
#include "support/whirl_rotors.hpp"

namespace floatframe::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double top_speed = 2617.99;  // 25 000 rev/min [rad/s]

/// Eigenvalues of bending, ascending; of an unstable one an error.
std::vector<std::complex<double>> bending(TurningModel& turning, double speed) {
  std::vector<std::complex<double>> out;
  for (const TurningMode& m : turning.modes(speed)) {
    EXPECT_LT(m.lambda.real(), 1e-3) << "at " << speed << " rad/s: " << m.lambda;
    if (m.across > 0.5 && m.lambda.imag() > 1.0) out.push_back(m.lambda);
  }
  std::sort(out.begin(), out.end(),
            [](const auto& a, const auto& b) { return a.imag() < b.imag(); });
  return out;
}

TurningModel turning_of(const AssembledRotor& rotor, const RotorOptions& options) {
  const TemporaryFolder folder;
  return {load_model(write_rotor(folder, rotor, options)), "motor", Vec3::UnitX()};
}

/// Largest difference of the first `count` frequencies, in parts, over the range of speeds.
double difference(const AssembledRotor& rotor, const RotorOptions& options, std::size_t count) {
  TurningModel turning = turning_of(rotor, options);
  double worst = 0.0;
  for (const double speed : {0.0, top_speed / 2, top_speed}) {
    const auto expected = rotor.eigenvalues(speed), found = bending(turning, speed);
    if (found.size() < count) return 1.0;
    for (std::size_t k = 0; k < count; ++k)
      worst = std::max(worst, std::abs(found[k].imag() / expected[k].imag() - 1.0));
  }
  return worst;
}

const char* word(RotorKind kind) {
  constexpr const char* words[] = {"cbar", "b33", "bars", "solids"};
  return words[static_cast<int>(kind)];
}

// The first four pairs of bending modes, without and with stiffening.
TEST(RotorParts, BeamsAreRayleighs) {
  const AssembledRotor rotor = lalanne_ferraris(true);
  for (const RotorKind kind : {RotorKind::cbar, RotorKind::b33, RotorKind::bars})
    for (const bool node_frame : {false, true})
      for (const char* stiffening : {"false", "true"}) {
        if (kind == RotorKind::bars && node_frame) continue;
        RotorOptions o;
        o.kind = kind, o.node_frame = node_frame, o.stiffening = stiffening;
        const double worst = difference(rotor, o, 8);
        std::printf("[ figure ] rotor_%s_%s_stiffening_%s %.1e\n", word(kind),
                    node_frame ? "node" : "mean_axis", stiffening, worst);
        EXPECT_LT(worst, 1e-3) << word(kind) << node_frame << stiffening;
      }
}

TEST(RotorParts, LumpedMassIsTheRotorAssembledFromIt) {
  AssembledRotor rotor = lalanne_ferraris(true);
  rotor.lumped = true;
  for (const bool node_frame : {false, true}) {
    RotorOptions o;
    o.lumped = true, o.node_frame = node_frame;
    const double worst = difference(rotor, o, 8);
    std::printf("[ figure ] rotor_lumped %.1e\n", worst);
    EXPECT_LT(worst, 1e-3);
  }
}

// Discs as point masses on rigid spiders.
TEST(RotorParts, SolidsAreTimoshenkos) {
  AssembledRotor rotor = lalanne_ferraris(true);
  rotor.shear_factor = 6.0 * (1.0 + rotor.poisson) / (7.0 + 6.0 * rotor.poisson);
  RotorOptions o;
  o.kind = RotorKind::solids;
  const double worst = difference(rotor, o, 8);
  std::printf("[ figure ] rotor_solids %.1e\n", worst);
  EXPECT_LT(worst, 3e-3);
}

TEST(RotorParts, FramesAgreeWithStiffening) {
  const AssembledRotor rotor = lalanne_ferraris(true);
  for (const RotorKind kind : {RotorKind::cbar, RotorKind::solids}) {
    RotorOptions o;
    o.kind = kind, o.stiffening = "true";
    TurningModel mean = turning_of(rotor, o);
    o.node_frame = true;
    TurningModel node = turning_of(rotor, o);
    double worst = 0.0;
    for (const double speed : {0.0, top_speed / 2, top_speed}) {
      const auto a = bending(mean, speed), b = bending(node, speed);
      ASSERT_GE(std::min(a.size(), b.size()), 8u);
      for (std::size_t k = 0; k < 8; ++k)
        worst = std::max(worst, std::abs(a[k].imag() / b[k].imag() - 1.0));
    }
    std::printf("[ figure ] rotor_frames_%s %.1e\n", word(kind), worst);
    EXPECT_LT(worst, 1e-4);
  }
}

// Bearings that are not round and have damping: frequencies and decay.
TEST(RotorParts, InTheirOwnBearings) {
  const AssembledRotor rotor = lalanne_ferraris(false);
  for (const RotorKind kind : {RotorKind::cbar, RotorKind::bars}) {
    RotorOptions o;
    o.kind = kind;
    TurningModel turning = turning_of(rotor, o);
    const auto expected = rotor.eigenvalues(top_speed), found = bending(turning, top_speed);
    ASSERT_GE(found.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(found[k].imag() / expected[k].imag(), 1.0, 1e-3) << word(kind);
      EXPECT_NEAR(found[k].real() / expected[k].real(), 1.0, 5e-3) << word(kind);
    }
    EXPECT_NEAR(found[0].imag() / (2.0 * pi), 55.573, 0.06);  // published model
    EXPECT_NEAR(found[1].imag() / (2.0 * pi), 67.547, 0.07);
    EXPECT_NEAR(-found[0].real(), 0.1037, 5e-4);
    EXPECT_NEAR(-found[1].real(), 0.2669, 1e-3);
  }
}

// Frequencies at 25 000 rev/min as published [Hz].
TEST(RotorParts, PublishedRotor) {
  const double published[] = {55.408, 67.209, 157.90, 193.71, 249.90, 407.62, 446.62};
  TurningModel turning(load_model(FLOATFRAME_EXAMPLES "/rotor/lalanne_ferraris.yaml"), "motor",
                       Vec3::UnitX());
  const auto found = bending(turning, 25000.0 * pi / 30.0);
  ASSERT_GE(found.size(), 8u);
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_NEAR(found[k].imag() / (2.0 * pi) / published[k], 1.0, 1e-3) << k;
}

/// Frequencies of sum_k c_k e^(i w_k t) from equally spaced samples, by a matrix pencil of `order`
/// terms (Hua, Sarkar, IEEE Trans. ASSP 38 (1990) 814-824) [rad/s].
std::vector<double> ringing_frequencies(const Eigen::VectorXcd& samples, double interval,
                                        int order) {
  const Eigen::Index n = samples.size(), columns = n / 2, rows = n - columns;
  Eigen::MatrixXcd Y(rows, columns + 1);
  for (Eigen::Index k = 0; k <= columns; ++k)
    Y.col(k) = samples.segment(std::min(k, n - rows), rows);
  const Eigen::BDCSVD<Eigen::MatrixXcd> svd(Y, Eigen::ComputeThinV);
  const Eigen::MatrixXcd V = svd.matrixV().leftCols(order);
  const Eigen::MatrixXcd V0 = V.topRows(columns), V1 = V.bottomRows(columns);
  const Eigen::MatrixXcd pencil = V0.colPivHouseholderQr().solve(V1);
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(pencil, false);
  std::vector<double> out;
  for (Eigen::Index k = 0; k < order; ++k)
    out.push_back(-std::arg(solver.eigenvalues()[k]) / interval);  // rows of V are conjugate
  return out;
}

// Kicked by a force of 4 ms the rotor rings with the frequencies of its bending modes: forward
// ones turn with the rotor.
TEST(RotorParts, RingsFromAKickInRuns) {
  const AssembledRotor rotor = lalanne_ferraris(true);
  constexpr double speed = 1000.0;
  const auto expected = rotor.eigenvalues(speed);
  for (const char* coordinates : {"relative", "absolute"}) {
    RotorOptions o;
    o.kind = RotorKind::cbar, o.coordinates = coordinates, o.speed = speed;
    o.step = 2e-5, o.duration = 0.16;
    o.extra =
        "  kick: {type: force, body: shaft, node: B, direction: [0, 1, 0.4], magnitude: "
        "{piecewise: [{below: 0.002, polynomial: [0, 1e5]}, {below: 0.004, polynomial: [400, "
        "-1e5]}, {polynomial: [0]}]}}\n"
        "outputs:\n  end: {position: {body: shaft, node: B}}\n";
    const TemporaryFolder folder;
    Model model = load_model(write_rotor(folder, rotor, o));
    model.simulation.output_interval = 5e-4;
    const RunResult r = run(model);
    const std::size_t y = r.table.column("end.y"), z = r.table.column("end.z");
    const std::size_t first = 10;
    Eigen::VectorXcd samples(static_cast<Eigen::Index>(r.table.rows() - first));
    for (std::size_t k = first; k < r.table.rows(); ++k)
      samples[static_cast<Eigen::Index>(k - first)] = {r.table.at(k, y), r.table.at(k, z)};
    const std::vector<double> found = ringing_frequencies(samples, 5e-4, 14);
    double worst = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double w = (k % 2 == 0 ? -1.0 : 1.0) * expected[k].imag();  // backward, forward
      double best = 1.0;
      for (const double f : found) best = std::min(best, std::abs(f / w - 1.0));
      worst = std::max(worst, best);
    }
    std::printf("[ figure ] rotor_kick_%s %.1e\n", coordinates, worst);
    EXPECT_LT(worst, 1e-3) << coordinates;
  }
}

}  // namespace
}  // namespace floatframe::test
