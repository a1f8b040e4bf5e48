// Geometric stiffening of beams: rotating cantilevers against Wright et al. (1982), Euler's load,
// a spin-up against sixteen welded beams, energy and momenta of a free spin.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "floatframe/body/second_order_on_masses.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/results.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/tangents/small_motions.hpp"
#include "support/error_of.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

/// L = rho A = E I = 1: frequencies and spins are those of the non-dimensional beam.
Model unit_cantilever(double spin, bool stiffening, double load = 0.0) {
  return model_of(
      "gravity: [0, 0, 0]\n"
      "points: {hub: [0, 0, 0], tip: [1, 0, 0]}\n"
      "bodies:\n"
      "  beam:\n"
      "    flexible:\n"
      "      material: {young: 7e10, poisson: 0.3, density: 1000}\n"
      "      bars: {b: {from: hub, to: tip, elements: 24, reference: y,\n"
      "                 section: {area: 1e-3, Iy: 1.4285714285714286e-11,\n"
      "                           Iz: 1.4285714285714286e-11, J: 1e-9}}}\n"
      "      clamped: [hub]\n"
      "      normal_modes: 12\n"
      "      mass_model: hermite\n"
      "    geometric_stiffening: " +
      std::string(stiffening ? "true" : "false") +
      "\n"
      "joints: {hub: {type: revolute, child: beam, at: hub, axis: z, velocity: " +
      std::to_string(spin) +
      "}}\n"
      "forces: {load: {type: force, body: beam, at: tip, direction: [-1, 0, 0], magnitude: " +
      std::to_string(load) +
      "}}\n"
      "simulation: {step: 0.001, duration: 1}\n");
}

/// Squares of the frequencies of the modes with the hub driven, without Coriolis terms.
VecX mode_squares(const Model& model) {
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  State s;
  f.start(s.q, s.v);
  s.lambda = VecX::Zero(0);
  const SmallMotions l = small_motions(f, s);
  const Eigen::Index nm = model.bodies[0].modes();
  const MatX K = l.K.bottomRightCorner(nm, nm), M = l.M.bottomRightCorner(nm, nm);
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatX>(0.5 * (K + K.transpose()), M).eigenvalues();
}

double nearest(const VecX& values, double x) {
  Eigen::Index k = 0;
  (values.array() - x).abs().minCoeff(&k);
  return values[k];
}

struct Wright {
  double spin;
  std::array<double, 3> flap;
};
constexpr std::array<Wright, 12> wright{{{0, {3.516015268, 22.03449156, 61.69721441}},
                                         {1, {3.681646814, 22.18101115, 61.84176859}},
                                         {2, {4.137319573, 22.61492196, 62.27318411}},
                                         {3, {4.797278533, 23.32026367, 62.98496748}},
                                         {4, {5.585001421, 24.27334939, 63.96676049}},
                                         {5, {6.449544749, 25.44608036, 65.20504052}},
                                         {6, {7.360373019, 26.80908168, 66.68391438}},
                                         {7, {8.299636928, 28.33408302, 68.38595069}},
                                         {8, {9.256837601, 29.99538189, 70.29296219}},
                                         {9, {10.22568628, 31.77051373, 72.38668066}},
                                         {10, {11.20232776, 33.64036585, 74.64929460}},
                                         {12, {13.17015049, 37.60311233, 79.61447849}}}};

TEST(Stiffened, RotatingCantilever) {
  double first = 0.0, third = 0.0;
  for (const Wright& w : wright) {
    SCOPED_TRACE(w.spin);
    const VecX on = mode_squares(unit_cantilever(w.spin, true));
    const VecX off = mode_squares(unit_cantilever(w.spin, false));
    for (std::size_t k = 0; k < 3; ++k) {
      const double flap2 = nearest(on, w.flap[k] * w.flap[k]);
      const double fault = std::abs(std::sqrt(flap2) / w.flap[k] - 1.0);
      EXPECT_LT(fault, k == 0 ? 1e-3 : 1e-2);
      if (k == 0) first = std::max(first, fault);
      if (k == 2) third = std::max(third, fault);
      const double lag2 = flap2 - w.spin * w.spin;
      EXPECT_NEAR(nearest(on, lag2), lag2, 1e-6 * flap2);
      const double rest2 = wright[0].flap[k] * wright[0].flap[k];
      EXPECT_NEAR(nearest(off, rest2), rest2, 1e-3 * rest2);
      EXPECT_NEAR(nearest(off, rest2 - w.spin * w.spin), rest2 - w.spin * w.spin, 1e-3 * rest2);
    }
  }
  figure("largest fault of the first frequency", first);
  figure("largest fault of the third frequency", third);
}

TEST(Stiffened, EulerLoad) {
  const double euler = 0.25 * std::numbers::pi * std::numbers::pi;
  EXPECT_GT(mode_squares(unit_cantilever(0.0, true, 0.99 * euler)).minCoeff(), 0.0);
  EXPECT_LT(mode_squares(unit_cantilever(0.0, true, 1.01 * euler)).minCoeff(), 0.0);
  EXPECT_GT(mode_squares(unit_cantilever(0.0, false, 1.01 * euler)).minCoeff(), 12.0);
}

/// The tip in axes of the hub.
struct Tip {
  std::vector<double> stretch, deflection;
};
Tip tip_of(const ResultTable& t) {
  const std::size_t x = column(t, "tip.x"), y = column(t, "tip.y"), angle = column(t, "hub.angle");
  Tip tip;
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const double c = std::cos(t.at(i, angle)), s = std::sin(t.at(i, angle));
    tip.stretch.push_back(c * t.at(i, x) + s * t.at(i, y) - 10.0);
    tip.deflection.push_back(c * t.at(i, y) - s * t.at(i, x));
  }
  return tip;
}

ModelDescription spin_up(bool stiffening) {
  return read_model(FLOATFRAME_EXAMPLES "/spin_up/spin_up.yaml",
                    {{"stiffening", stiffening ? "true" : "false"}});
}

/// The same beam as sixteen bodies welded to each other, without geometric stiffening.
Model welded_beams() {
  const ModelDescription one = spin_up(false);
  ModelDescription d = one;
  d.bodies.clear();
  d.joints.clear();
  const int n = 16;
  const auto point = [](int k) { return Vec3(10.0 * k / n, 0.0, 0.0); };
  for (int k = 0; k < n; ++k) {
    BodyDescription b = one.bodies[0];
    b.name = "beam" + std::to_string(k);
    b.X_WB.p = b.X_WT.p = point(k);
    b.geometric_stiffening = false;
    auto& f = std::get<FlexibleDescription>(b.kind);
    f.points["hub"] = point(k);
    f.points["tip"] = point(k + 1);
    f.bars[0].elements = 2;
    f.normal_modes = 0;
    d.bodies.push_back(b);
    JointDescription j = one.joints[0];
    j.child.body = b.name;
    j.parent.point = j.child.point = point(k);
    if (k > 0) {
      j.name = "weld" + std::to_string(k);
      j.type = JointType::weld;
      j.motion.reset();
      j.parent.body = "beam" + std::to_string(k - 1);
    }
    d.joints.push_back(j);
  }
  for (OutputDescription& o : d.outputs)
    if (o.name.starts_with("tip")) o.at.body = "beam15";
  return build_model(d);
}

TEST(Stiffened, SpinUp) {
  const Tip welded = tip_of(run(welded_beams()).table);
  double largest = 0.0;
  for (const double v : welded.deflection) largest = std::max(largest, std::abs(v));
  EXPECT_NEAR(largest, 0.5755, 1e-3);
  for (const Coordinates coordinates : both_coordinates) {
    ModelDescription d = spin_up(true);
    d.simulation.coordinates = coordinates;
    const RunResult r = run(build_model(d));
    for (const std::string& w : sentences(r.summary.warnings))
      EXPECT_FALSE(contains(w, "spins too fast"));
    const Tip tip = tip_of(r.table);
    ASSERT_EQ(tip.stretch.size(), welded.stretch.size());
    double fault = 0.0;
    for (std::size_t i = 0; i < tip.stretch.size(); ++i)
      fault = std::max({fault, std::abs(tip.deflection[i] - welded.deflection[i]),
                        std::abs(tip.stretch[i] - welded.stretch[i])});
    figure("largest difference of the tip, part of its largest deflection", fault / largest);
    EXPECT_LT(fault, 0.01 * largest);
    figure("stretch at full speed [m]", tip.stretch.back());
    EXPECT_NEAR(tip.stretch.back(), 5.14e-4, 0.01 * 5.14e-4);
  }
}

/// A beam that spins freely and vibrates; its sections turn mass, stiffened or not.
ModelDescription free_beam(double step, Coordinates coordinates, bool stiffening) {
  ModelDescription d = test::description_of(
      "gravity: [0, 0, 0]\n"
      "points: {hub: [0, 0, 0], tip: [1, 0, 0]}\n"
      "bodies:\n"
      "  beam:\n"
      "    flexible:\n"
      "      material: {young: 7e7, poisson: 0.3, density: 1000}\n"
      "      bars: {b: {from: hub, to: tip, elements: 12, reference: y,\n"
      "                 section: {area: 1e-3, Iy: 1.4e-8, Iz: 1.4e-8, J: 2e-8}}}\n"
      "      clamped: [hub]\n"
      "      static_modes: [{point: tip, dofs: [y, z]}]\n"
      "      mass_model: hermite\n"
      "      section_inertia: true\n"
      "joints: {hub: {type: free, child: beam, at: hub, velocity: [0.1, 0.2, 0, 0.3, 0.5, 4]}}\n"
      "initial: {amplitudes: {beam: [0.03, 0.05]}}\n"
      "simulation: {duration: 2}\n");
  d.simulation.step = step;
  d.simulation.coordinates = coordinates;
  d.simulation.geometric_stiffening = stiffening;
  return d;
}

TEST(Stiffened, FreeSpinKeepsEnergy) {
  // The energy left over falls with the square of the step.
  for (const bool stiffening : {true, false})
    for (const Coordinates coordinates : both_coordinates) {
      SCOPED_TRACE(static_cast<int>(coordinates));
      const auto remainder = [&](double step) {
        const RunResult r = run(build_model(free_beam(step, coordinates, stiffening)));
        return std::abs(r.summary.energy.largest_remainder);
      };
      const double coarse = remainder(0.004), fine = remainder(0.002), finest = remainder(0.001);
      figure("energy left over [J]", finest);
      EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.25);
      EXPECT_NEAR(std::log2(fine / finest), 2.0, 0.25);
    }
}

/// Momentum and angular momentum about the world's origin of the one body, from its mass matrix.
template <class F>
Vec6 beam_momenta(F& f, const State& s) {
  const Body& body = f.model().bodies[0];
  const int nm = body.modes();
  const PreprocessingData data(body.data->invariants);
  StiffeningData stiffening(data, *second_order_on_masses(*body.data, body.stiffens()));
  PreprocessingWorkspace work(nm);
  MatX M(6 + nm, 6 + nm);
  VecX Qv(6 + nm), v(6 + nm);
  evaluate_at(f, s.t, s.q, s.v);
  const BodyKinematics& b = f.motion().body(0);
  v << b.v_WB - b.w_WB.cross(b.p_WB), b.w_WB, b.yd;
  relative_stiffened(data, stiffening, b.p_WB, b.R_WB, b.w_WB, b.y.data(), b.yd.data(), work, M,
                     Qv);
  return (M * v).head<6>();
}

/// Largest drift over 2 s relative to the start, of the momentum and the angular momentum.
template <class F>
std::array<double, 2> drift(double step, Coordinates coordinates, bool stiffening) {
  const Model model = build_model(free_beam(step, coordinates, stiffening));
  RelativeFormulation tree(model, InertiaMethod::preprocessing);
  F f(model, InertiaMethod::preprocessing);
  const StepOptions options{.tolerance = 1e-12,
                            .penalty_mass = default_penalty_mass(model, coordinates)};
  State s;
  const State start = relative_start(tree, Start::given);
  if constexpr (std::is_same_v<F, RelativeFormulation>)
    s = start;
  else
    f.start_from(tree, start.q, start.v, s.q, s.v);
  start_accelerations(f, s, options.penalty_mass);
  const Vec6 first = beam_momenta(f, s);
  AugmentedLagrangian<F> integrator(f, options);
  std::array<double, 2> worst{};
  for (long k = 0, n = std::lround(2.0 / step); k < n; ++k) {
    EXPECT_TRUE(integrator.attempt(s, step).accepted()) << "step " << k;
    const Vec6 now = beam_momenta(f, s);
    for (int part = 0; part < 2; ++part)
      worst[part] = std::max(worst[part], (now - first).segment<3>(3 * part).norm() /
                                              first.segment<3>(3 * part).norm());
  }
  return worst;
}

TEST(Stiffened, FreeSpinKeepsMomenta) {
  const auto check = [](const auto& of_step) {
    const std::array<double, 2> coarse = of_step(0.004), fine = of_step(0.002),
                                finest = of_step(0.001);
    for (int part = 0; part < 2; ++part) {
      figure(part == 0 ? "drift of the momentum" : "drift of the angular momentum", finest[part]);
      figure("order", std::log2(fine[part] / finest[part]));
      // What is conserved to rounding has no order.
      EXPECT_LT(fine[part], coarse[part] / 3.4 + 1e-11);
      EXPECT_LT(finest[part], fine[part] / 3.4 + 1e-11);
      EXPECT_LT(finest[part], 1e-4);
    }
  };
  for (const bool on : {true, false}) {
    check([=](double h) { return drift<RelativeFormulation>(h, Coordinates::relative, on); });
    check([=](double h) { return drift<AbsoluteFormulation>(h, Coordinates::absolute, on); });
  }
}

TEST(Stiffened, SpinUpWithoutItFailsAndWarns) {
  const RunResult r = run(build_model(spin_up(false)));
  EXPECT_NE(r.summary.status, "completed");
  bool warned = false;
  for (const std::string& w : sentences(r.summary.warnings)) {
    if (!contains(w, "spins too fast for its stiffness")) continue;
    warned = true;
    std::printf("[ figure ] %s\n", w.c_str());
    const std::string words = "would raise its lowest stiffness by about ";
    const std::size_t at = w.find(words);
    ASSERT_NE(at, std::string::npos) << w;
    // Southwell: 1.193 W^2 over 3.516^2, with W = 5.807 rad/s in units of 1.0801 rad/s.
    EXPECT_NEAR(std::stod(w.substr(at + words.size())), 279.0, 3.0) << w;
  }
  EXPECT_TRUE(warned);
}

/// Of a channel, the largest distance of two runs over its largest value.
double apart(const RunResult& a, const RunResult& b, std::size_t column) {
  double worst = 0.0, size = 0.0;
  for (std::size_t row = 0; row < std::min(a.table.rows(), b.table.rows()); ++row) {
    worst = std::max(worst, std::abs(a.table.at(row, column) - b.table.at(row, column)));
    size = std::max(size, std::abs(a.table.at(row, column)));
  }
  return worst / size;
}

TEST(Stiffened, BarsByProjection) {
  // The same spin-up by both methods. Projection leaves nothing out of what the displacements make
  // of the mass, preprocessing what is of second order: the tip bends by a twentieth of the length.
  const auto spun = [](InertiaMethod method, Coordinates coordinates) {
    ModelDescription d = spin_up(true);
    std::get<FlexibleDescription>(d.bodies[0].kind).mass_model = MassModel::isoparametric;
    d.simulation.inertia = method;
    d.simulation.coordinates = coordinates;
    return completed_run(d);
  };
  const RunResult reference = spun(InertiaMethod::preprocessing, Coordinates::relative);
  for (const Coordinates coordinates : both_coordinates) {
    const RunResult r = spun(InertiaMethod::projection, coordinates);
    for (std::size_t k = 1; k < r.table.columns.size(); ++k) {
      const std::string& name = r.table.columns[k].name;
      if (name == "tip.z") continue;  // zero
      const double off = apart(reference, r, k);
      figure("projection against preprocessing, " + name, off);
      EXPECT_LT(off, 5e-4) << name;
      EXPECT_TRUE(off > 1e-6 || name == "hub.angle") << "the same method?";
    }
  }
}

TEST(Stiffened, ReportsMissingSecondOrder) {
  ModelDescription d = spin_up(true);
  d.simulation.duration = 0.05;
  Model model = build_model(d);
  EXPECT_TRUE(run(model).summary.start.notes.empty());
  FlexibleBody data = *model.bodies[0].data;
  SecondOrder less = *data.second_order;
  less.nodes.clear();
  data.second_order = std::make_shared<const SecondOrder>(less);
  model.bodies[0].data = std::make_shared<const FlexibleBody>(data);
  const std::vector<std::string> notes = run(model).summary.start.notes;
  ASSERT_EQ(notes.size(), 1u);  // the tip; the hub is held
  EXPECT_EQ(notes[0].find("body 'beam': geometric stiffening has no displacements of second order"),
            0u)
      << notes[0];
}

TEST(Stiffened, WhatCannotBe) {
  ModelDescription rigid = spin_up(true);
  rigid.bodies[0].kind = RigidDescription{};
  rigid.outputs.clear();
  const std::string error = error_of([&] { build_model(rigid); });
  EXPECT_EQ(error.substr(error.rfind('/') + 1), "spin_up.yaml:36:27: wrong_value") << error;
}

}  // namespace
}  // namespace floatframe::test
