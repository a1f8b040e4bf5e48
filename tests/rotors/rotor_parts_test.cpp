// Rotors whose shafts are flexible bodies of every kind against a rotor assembled in axes that do
// not turn: whirl from 0 to 25 000 rev/min by linear systems and from a kick in runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/math/dense.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/rotors/turning_model.hpp"
#include "floatframe/run/run.hpp"
#include "support/error_of.hpp"
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

/// Frequencies [rad/s] of the first `pairs` modes of a round rotor: those against the rotor, then
/// those with it. At rest all of them.
std::vector<double> whirl(TurningModel& turning, double speed, std::size_t pairs) {
  std::vector<double> against, with;
  for (const TurningMode& m : turning.modes(speed)) {
    EXPECT_LT(m.lambda.real(), 1e-3) << "at " << speed << " rad/s: " << m.lambda;
    if (m.across > 0.5 && m.lambda.imag() > 1.0)
      (speed > 0.0 && m.whirl > 0.0 ? with : against).push_back(m.lambda.imag());
  }
  std::sort(against.begin(), against.end());
  std::sort(with.begin(), with.end());
  const std::size_t first = speed > 0.0 ? pairs : 2 * pairs;
  if (against.size() < first || with.size() < 2 * pairs - first) return {};
  against.resize(first);
  against.insert(against.end(), with.begin(),
                 with.begin() + static_cast<std::ptrdiff_t>(2 * pairs - first));
  return against;
}

std::vector<double> whirl(const AssembledRotor& rotor, double speed, std::size_t pairs) {
  std::vector<double> out;
  for (const double direction : {-1.0, 1.0}) {
    const std::vector<double> found = rotor.whirl(direction * speed);
    for (std::size_t k = 0; k < pairs; ++k) out.push_back(found[k]);
  }
  if (speed == 0.0) std::sort(out.begin(), out.end());
  return out;
}

/// Largest difference of the first four pairs of bending modes, in parts, over the range of speeds.
double difference(const AssembledRotor& rotor, const RotorOptions& options) {
  TurningModel turning = turning_of(rotor, options);
  double worst = 0.0;
  for (const double speed : {0.0, top_speed / 2, top_speed}) {
    const auto expected = whirl(rotor, speed, 4), found = whirl(turning, speed, 4);
    if (found.size() != expected.size()) return 1.0;
    for (std::size_t k = 0; k < found.size(); ++k)
      worst = std::max(worst, std::abs(found[k] / expected[k] - 1.0));
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
        const double worst = difference(rotor, o);
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
    const double worst = difference(rotor, o);
    std::printf("[ figure ] rotor_lumped %.1e\n", worst);
    EXPECT_LT(worst, 1e-3);
  }
}

// Discs as point masses that follow the mean motion of sections; the spin itself changes the
// stiffness of a body of bricks, so geometric stiffening belongs to it.
TEST(RotorParts, SolidsAreTimoshenkos) {
  AssembledRotor rotor = lalanne_ferraris(true);
  rotor.shear_factor = 6.0 * (1.0 + rotor.poisson) / (7.0 + 6.0 * rotor.poisson);
  for (const bool node_frame : {false, true}) {
    RotorOptions o;
    o.kind = RotorKind::solids, o.node_frame = node_frame, o.stiffening = "true";
    const double worst = difference(rotor, o);
    std::printf("[ figure ] rotor_solids_%s %.1e\n", node_frame ? "node" : "mean_axis", worst);
    EXPECT_LT(worst, 3e-3);
  }
}

/// Largest difference of the first four pairs between the two body frames, in parts.
double frame_difference(TurningModel& mean, TurningModel& node, double speed) {
  const auto a = whirl(mean, speed, 4), b = whirl(node, speed, 4);
  if (a.empty() || b.empty()) return 1.0;
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(a[k] / b[k] - 1.0));
  return worst;
}

// Beams have no strain by spin about their axis. Bricks are strained by rho W^2 R^2/E, 7e-4 at the
// top speed, which modal masses do not see: frames differ by a part of that, with W^2.
TEST(RotorParts, FramesAgreeWithStiffening) {
  const AssembledRotor rotor = lalanne_ferraris(true);
  for (const RotorKind kind : {RotorKind::cbar, RotorKind::solids}) {
    RotorOptions o;
    o.kind = kind, o.stiffening = "true";
    TurningModel mean = turning_of(rotor, o);
    o.node_frame = true;
    TurningModel node = turning_of(rotor, o);
    const double at_rest = frame_difference(mean, node, 0.0);
    const double half = frame_difference(mean, node, top_speed / 2);
    const double full = frame_difference(mean, node, top_speed);
    std::printf("[ figure ] rotor_frames_%s %.1e %.1e %.1e\n", word(kind), at_rest, half, full);
    EXPECT_LT(at_rest, 1e-6);
    EXPECT_LT(half, 1e-4);
    EXPECT_LT(full, kind == RotorKind::solids ? 4e-4 : 1e-4);
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

// About another axis than that of its bearings it has no steady state: the bearings' is named.
TEST(RotorParts, WrongAxis) {
  RotorOptions o;
  o.kind = RotorKind::cbar;
  const TemporaryFolder folder;
  const Model model = load_model(write_rotor(folder, lalanne_ferraris(true), o));
  TurningModel turning(model, "motor", Vec3::UnitZ());
  EXPECT_TRUE(contains(sentences_of([&] { turning.modes(top_speed); }),
                       "the bearings of the rotor have the axis x of the joint"));
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
  struct Case {
    const char* coordinates;
    bool node_frame;
  };
  for (const auto& [coordinates, node_frame] :
       {Case{"relative", false}, Case{"absolute", false}, Case{"relative", true}}) {
    RotorOptions o;
    o.kind = RotorKind::cbar, o.coordinates = coordinates, o.speed = speed;
    o.node_frame = node_frame;
    o.step = 5e-6, o.duration = 0.16;
    o.extra =
        "  kick: {type: force, body: shaft, node: B, direction: [0, 1, 0.4], magnitude: "
        "{piecewise: [{below: 0.002, polynomial: [0, 1e7]}, {below: 0.004, polynomial: [4e4, "
        "-1e7]}, {polynomial: [0]}]}}\n"
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
    std::printf("[ figure ] rotor_kick_%s%s %.1e\n", coordinates, node_frame ? "_node" : "", worst);
    EXPECT_LT(worst, 1e-3) << coordinates << (node_frame ? ", frame at a node" : "");
  }
}

}  // namespace
}  // namespace floatframe::test
