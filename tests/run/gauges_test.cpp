// Gauges in runs: stress, strains and section forces against closed forms, in both formulations.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

#include "floatframe/analysis.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/model/gauge_place.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "support/allocation_counter.hpp"
#include "support/error_of.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

ResultTable table_of(const std::string& text, Coordinates coordinates) {
  ModelDescription d = description_of(text);
  d.simulation.coordinates = coordinates;
  return completed_run(d).table;
}

// A rod that turns about its end at W: stress rho W^2 (L^2 - x^2) / 2, whatever its modes.
const char* const turning_rod = R"(
gravity: [0, 0, 0]
points: {hub: [0, 0, 0], tip: [0.8, 0, 0]}
bodies:
  rod:
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7850}
      bars:
        bar: {from: hub, to: tip, elements: 8, section: {round: 0.02}}
      clamped: [hub]
      static_modes: []
      normal_modes: 4
joints:
  hub: {type: revolute, child: rod, at: hub, axis: z, motion: {polynomial: [0, 60]}}
outputs:
  root: {stress: {body: rod, node: hub, toward: y}, component: xx}
  middle: {stress: {body: rod, at: [0.4, 0, 0], toward: z}, component: von_mises}
  modes: {stress: {body: rod, node: hub, toward: y}, component: xx, inertia_loads: false}
  force: {section_force: {body: rod, at: [0.4, 0, 0]}, component: N}
  strain: {strain: {body: rod, node: hub, toward: y}, direction: x}
simulation: {step: 1e-3, duration: 0.1, output_interval: 0.01}
)";

TEST(Gauges, TurningRod) {
  for (const Coordinates coordinates : both_coordinates) {
    const ResultTable t = table_of(turning_rod, coordinates);
    const double W = 60.0, L = 0.8, root = 0.5 * 7850.0 * W * W * L * L;
    const std::size_t row = t.rows() - 1;
    std::printf("[ figure ] turning rod, %s: root %.6f of rho W^2 L^2 / 2, by modes alone %.4f\n",
                name_of(coordinates).c_str(), entry(t, row, "root") / root,
                entry(t, row, "modes") / root);
    EXPECT_NEAR(entry(t, row, "root") / root, 1.0, 1e-2);
    EXPECT_NEAR(entry(t, row, "middle") / (0.75 * root), 1.0, 1e-2);
    EXPECT_NEAR(entry(t, row, "force") / (0.75 * root * 1e-4 * M_PI), 1.0, 1e-2);
    EXPECT_NEAR(entry(t, row, "strain") / (root / 2e11), 1.0, 1e-2);
    EXPECT_GT(std::abs(entry(t, row, "modes") / root - 1.0), 0.2);
  }
}

// A cantilever in equilibrium under its weight and a force at its tip: beam theory.
const char* const cantilever = R"(
gravity: [0, 0, -9.81]
points: {root: [0, 0, 0], tip: [1, 0, 0]}
bodies:
  beam:
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7850}
      bars:
        bar: {from: root, to: tip, elements: 10, section: {rectangle: [0.02, 0.04]}, reference: y}
      clamped: [root]
      static_modes: [tip]
      normal_modes: 4
      mass_model: hermite
joints:
  wall: {type: weld, parent: ground, child: beam, at: root}
forces:
  pull: {type: force, body: beam, at: tip, direction: [0, 0, -1], magnitude: 100}
outputs:
  top: {stress: {body: beam, node: root, toward: z}, component: xx}
  signed: {stress: {body: beam, node: root, toward: -z}, component: signed_von_mises}
  My: {section_force: {body: beam, node: root}, component: My}
  Vz: {section_force: {body: beam, node: root}, component: Vz}
simulation: {step: 1e-3, duration: 0.002, start: equilibrium}
)";

TEST(Gauges, CantileverInEquilibrium) {
  for (const Coordinates coordinates : both_coordinates) {
    const ResultTable t = table_of(cantilever, coordinates);
    const double q = 7850.0 * 8e-4 * 9.81, M = 100.0 + 0.5 * q, W = 0.02 * 0.04 * 0.04 / 6.0;
    std::printf("[ figure ] cantilever: stress at the root %.7g MPa, beam theory %.7g MPa\n",
                1e-6 * entry(t, 0, "top"), 1e-6 * M / W);
    // Along local axes: z of the section is -z or z of the world, as the bar's reference says.
    EXPECT_NEAR(std::abs(entry(t, 0, "top")) / (M / W), 1.0, 1e-3);
    EXPECT_LT(entry(t, 0, "signed"), 0.0);
    EXPECT_NEAR(std::abs(entry(t, 0, "My")) / M, 1.0, 1e-3);
    EXPECT_NEAR(std::abs(entry(t, 0, "Vz")) / (100.0 + q), 1.0, 1e-3);
  }
}

TEST(Gauges, PrincipalStressesAreEigenvalues) {
  Random random(5);
  const auto check = [](const Vec6& s) {
    Mat3 S;
    S << s(0), s(3), s(5), s(3), s(1), s(4), s(5), s(4), s(2);
    const Vec3 expected = Eigen::SelfAdjointEigenSolver<Mat3>(S).eigenvalues().reverse();
    EXPECT_LT((principal_stresses(s) - expected).norm(), 1e-7 * (S.norm() + 1e-300));
    const Vec3 d = expected.array() - expected.mean();
    EXPECT_NEAR(von_mises(s), std::sqrt(1.5 * d.squaredNorm()), 1e-7 * S.norm());
  };
  for (int k = 0; k < 200; ++k) {
    const Vec3 a = random.vec3(3e8), b = random.vec3(3e8);
    check((Vec6() << a, b).finished());
  }
  check(Vec6::Zero());
  check((Vec6() << 1, 1, 1, 0, 0, 0).finished());
  check((Vec6() << 2, 1, 1, 0, 0, 0).finished());
  check((Vec6() << 2, 2, 1, 0, 0, 0).finished());
  check((Vec6() << 0, 0, 0, 5, 0, 0).finished());
}

void check_allocations_of_gauges(Coordinates coordinates) {
  const Model model = model_of(turning_rod);
  const SimulationDescription options = with(model.simulation, coordinates);
  Stepper steps(model, options, {.duration = 0.02});
  std::vector<double> row(model.outputs.size() + 1);
  ASSERT_TRUE(steps.advance());
  double sum = 0.0;
  const AllocationScope scope;
  for (int k = 0; k < 10; ++k) {
    const bool good = steps.advance();
    steps.sample(row.data());
    for (const double x : row) sum += x;
    if (!good) break;
  }
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_GT(sum, 0.0);
}

TEST(Gauges, DoNotAllocate) {
  for (const Coordinates c : both_coordinates) check_allocations_of_gauges(c);
}

std::string with_output(const std::string& output) {
  const std::string text = cantilever;
  return text.substr(0, text.find("outputs:")) + "outputs:\n  a: " + output +
         "\nsimulation: {step: 1e-3, duration: 0.002}\n";
}

/// The code and place of what is wrong with a model.
std::string refused(const std::string& text) {
  return without_folders(error_of([&] { build_model(description_of(text)); }));
}

TEST(Gauges, WhatCannotBe) {
  const std::pair<const char*, const char*> cases[] = {
      {"{stress: {body: beam, node: root}}", "3: wrong_value"},
      {"{stress: {body: beam, node: rot, toward: y}}", "3: wrong_value"},
      {"{stress: {body: beam, node: 7, toward: y}}", "3: wrong_value"},
      {"{stress: {body: beam, node: root, layer: top, toward: y}}", "3: wrong_value"},
      {"{stress: {body: beam, at: [9, 0, 0]}}", "3: wrong_value"},
      {"{strain: {body: beam, node: root, toward: y}}", "3: outputs.a: missing"},
      {"{stress: {body: beam}}", "7: outputs.a.stress: missing"},
      {"{section_force: {body: beam, node: 3}}", "3: wrong_value"},
      {"{stress: {body: ground, node: 3}}", "22: outputs.a.stress.body: wrong_value"}};
  for (const auto& [output, expected] : cases)
    EXPECT_EQ(refused(with_output(output)), std::string("model.yaml:20:") + expected) << output;
}

// Two bars in a line and one that leaves them at `mid`.
const char* const frame = R"(
gravity: [0, 0, -9.81]
points: {root: [0, 0, 0], mid: [0.4, 0, 0], tip: [0.8, 0, 0], side: [0.4, 0.3, 0]}
bodies:
  beam:
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7850}
      bars:
        one: {from: root, to: mid, elements: 2, section: {rectangle: [0.02, 0.04]}, reference: y}
        two: {from: mid, to: tip, elements: 2, section: {rectangle: [0.02, 0.04]}, reference: y}
        arm: {from: mid, to: side, elements: 2, section: {rectangle: [0.02, 0.04]}, reference: x}
      clamped: [root]
      static_modes: [tip, side]
joints:
  wall: {type: weld, parent: ground, child: beam, at: root}
outputs:
  a: PLACE
simulation: {step: 1e-3, duration: 0.002, start: equilibrium}
)";

std::string frame_with(const std::string& output) {
  std::string text = frame;
  return text.replace(text.find("PLACE"), 5, output);
}

/// What a description does not tell apart is asked for, never chosen by rounding.
TEST(Gauges, AmbiguousPlacesAreErrors) {
  for (const char* output :
       {// On the axis of a bar: four places at the edges of the flat sides are equally near.
        "{stress: {body: beam, at: [0.2, 0, 0]}}",
        "{stress: {body: beam, at: [0.2, 0, 0], material: STEEL}}",
        "{section_force: {body: beam, node: mid}}",
        "{section_force: {body: beam, node: mid, along: z}}",
        "{section_force: {body: beam, at: [3, 0, 0]}}"})
    EXPECT_EQ(refused(frame_with(output)), "model.yaml:18:3: wrong_value") << output;
  EXPECT_EQ(
      model_of(frame_with("{section_force: {body: beam, node: mid, along: y}}")).gauges.size(), 1u);
  // Two elements of a straight bar: no question.
  EXPECT_EQ(model_of(frame_with("{section_force: {body: beam, at: [0.2, 0, 0]}}")).gauges.size(),
            1u);
}

/// Three bars meet at `mid`, all with outer points above it: a gauge there says along which bar.
TEST(Gauges, ABarIsChosenByItsDirection) {
  const auto on = [](const std::string& along) {
    const Model model =
        model_of(frame_with("{stress: {body: beam, node: mid, toward: z" + along + "}}"));
    const BodyStress& stress = *model.bodies[0].data->stress;
    const int place = model.gauges.at(0).place;
    int k = 0;
    while (stress.first_place[k + 1] <= place) ++k;
    return stress.sections[k].name;
  };
  EXPECT_EQ(without_folders(error_of([&] { on(""); })), "model.yaml:18:3: wrong_value");
  EXPECT_EQ(without_folders(error_of([&] { on(", along: z"); })), "model.yaml:18:3: wrong_value");
  EXPECT_EQ(on(", along: -x"), "bar 'one', element 2");
  EXPECT_EQ(on(", along: x"), "bar 'two', element 1");
  EXPECT_EQ(on(", along: [-0.1, 1, 0]"), "bar 'arm', element 1");
}

/// All six components of a place that is not there: one sentence.
TEST(Gauges, AWrongPlaceIsReportedOnce) {
  const std::string said = sentences_of(
      [] { build_model(description_of(frame_with("{stress: {body: beam, node: nowhere}}"))); });
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  EXPECT_TRUE(contains(said, "body 'beam' has no node 'nowhere'"));
}

TEST(Gauges, OfASectionGivenByConstants) {
  std::string text = turning_rod;
  const std::string round = "{round: 0.02}";
  text.replace(text.find(round), round.size(), "{area: 3e-4, Iy: 8e-9, Iz: 8e-9, J: 1.6e-8}");
  EXPECT_EQ(refused(text),
            "model.yaml:17:3: wrong_value\nmodel.yaml:18:3: wrong_value\n"
            "model.yaml:19:3: wrong_value\nmodel.yaml:21:3: wrong_value");
}

/// Towards a flat side the middle of its edge, not one of its corners.
TEST(Gauges, TowardIsTheMiddleOfAnEdge) {
  const Model model = model_of(frame_with("{stress: {body: beam, node: root, toward: z}}"));
  ASSERT_EQ(model.gauges.size(), 1u);
  const StressPlace& place = model.bodies[0].data->stress->places[model.gauges[0].place];
  const Vec3 p = model.bodies[0].X_WB * place.p;
  EXPECT_LT((p - Vec3(0.0, 0.0, p.z())).norm(), 1e-12);
  EXPECT_GT(p.z(), 0.009);
}

/// Node 7: solids of two materials. Node 8: both sides of a shell. At the same points.
TEST(Gauges, MaterialsAndLayersOfANode) {
  auto stress = std::make_shared<BodyStress>();
  stress->groups = {{"STEEL", 2e11, 0.3}, {"SOFT", 1e10, 0.3}};
  const auto add = [&](StressPlace::Layer layer, int number, int group, const Vec3& p) {
    stress->places.push_back(
        {.layer = layer, .node = number - 1, .number = number, .group = group, .p = p});
  };
  add(StressPlace::Layer::solid, 7, 0, Vec3::Zero());
  add(StressPlace::Layer::solid, 7, 1, Vec3::Zero());
  add(StressPlace::Layer::top, 8, 0, Vec3(1.0, 0.0, 0.01));
  add(StressPlace::Layer::bottom, 8, 0, Vec3(1.0, 0.0, -0.01));
  FlexibleBody body = *model_of(turning_rod).bodies[0].data;
  body.stress = stress;
  GaugeDescription gauge;
  const Vec3 up = Vec3::UnitZ(), none = Vec3::Zero(), middle = Vec3::UnitX();
  const auto found = [&](int node, const Vec3& toward, const Vec3* point = nullptr) {
    gauge.node = node;
    gauge.toward = toward;
    return find_place(body, "part", gauge, point, "", false);
  };
  EXPECT_EQ(found(7, none).error,
            "body 'part' has 2 places with stress at node 7 (solid of STEEL, solid of SOFT), "
            "expected 'material', the name of the one that is meant");
  EXPECT_EQ(found(7, up).place, -1);  // no direction tells them apart
  EXPECT_EQ(found(0, none, &none).place, -1);
  EXPECT_TRUE(contains(found(8, none).error, "(top of STEEL, bottom of STEEL), expected 'toward'"));
  EXPECT_EQ(found(0, none, &middle).place, -1);  // between the two sides
  EXPECT_EQ(found(8, up).place, 2);
  EXPECT_EQ(found(0, -up, &middle).place, 3);
  gauge.layer = GaugeDescription::Layer::bottom;
  EXPECT_EQ(found(0, none, &middle).place, 3);
  gauge.layer = GaugeDescription::Layer::any;
  gauge.material = "SOFT";
  EXPECT_EQ(found(7, none).place, 1);
  EXPECT_EQ(found(0, none, &none).place, 1);
  EXPECT_TRUE(contains(found(8, none).error, "in the material 'SOFT'"));
}

}  // namespace
}  // namespace floatframe::test
