// A point that slides along a flexible beam against closed forms, in both formulations: static sag
// anywhere on it, a load that moves over it, a trolley that rolls on it; rigid paths with the same
// keys.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/stepping/stepper.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double beam_length = 2.0, young_I = 2.1e11 * 0.05 * 0.02 * 0.02 * 0.02 / 12.0,
                 mass_per_length = 7850.0 * 0.02 * 0.05, beam_gravity = 9.81;

/// Of 20 elements from x = 0 to 2; `ends`: its clamped dofs and modes.
std::string beam_with(const std::string& ends) {
  return R"(
points: {l: [0, 0, 0], m: [1, 0, 0], r: [2, 0, 0]}
bodies:
  beam:
    flexible:
      material: {young: 2.1e11, poisson: 0.3, density: 7850}
      bars:
        a: {from: l, to: m, elements: 10, section: {rectangle: [0.02, 0.05]}}
        b: {from: m, to: r, elements: 10, section: {rectangle: [0.02, 0.05]}}
      mass_model: hermite
)" + ends;
}

const std::string clamped_ends = R"(      clamped: [l, r]
)";
const std::string all_shapes =
    R"(      path_shapes: [{bar: a, dofs: [y, z]}, {bar: b, dofs: [y, z]}]
)";
const std::string welded = R"(  l: {type: weld, child: beam, at: l}
  r: {type: weld, child: beam, at: r}
)";

/// A trolley that is drawn at x and does not turn; `motion`: that of its path.
std::string trolley_at(double x, double mass, const std::string& joints,
                       const std::string& motion) {
  return fmt::format(
      R"(  cart: {{position: [{0:.15g}, 0, 0], rigid: {{mass: {1:.15g}, inertia: [1, 1, 1]}}}}
joints:
{2}constraints:
  upright: {{type: parallel, from: {{body: ground, at: [0, 0, 0]}}, to: {{body: cart}}, axis: x}}
  square:
    type: perpendicular
    from: {{body: ground, at: [0, 0, 0]}}
    to: {{body: cart}}
    axis: y
    axis_2: z
  slide:
    type: slide_along
    from: {{body: beam, at: l}}
    to: {{body: cart}}
    points: [[0, 0, 0], [2, 0, 0]]
{3}outputs:
  cart: {{position: cart}}
  F: {{joint_force: {{constraint: slide}}}}
  s: {{travel: slide}}
  v: {{travel_rate: slide}}
  mid: {{position: {{body: beam, at: m}}, axis: z}}
  T: {{kinetic_energy: model}}
  U: {{potential_energy: model}}
  W: {{elastic_energy: model}}
)",
      x, mass, joints, motion);
}

std::string held_at(double x) {
  return fmt::format("    motion: {{piecewise: [{{polynomial: [{:.15g}]}}]}}\n", x);
}

RunResult ran(const std::string& text, Coordinates c) {
  ModelDescription d = description_of(text);
  d.simulation.coordinates = c;
  return completed_run(d);
}

double at(const RunResult& r, std::size_t row, const std::string& column) {
  for (std::size_t k = 0; k < r.table.columns.size(); ++k)
    if (r.table.columns[k].name == column) return r.table.at(row, k);
  ADD_FAILURE() << "no column " << column;
  return NAN;
}

/// Below a load F at a of a beam with clamped ends, with its own weight.
double clamped_sag(double a, double F) {
  const double b = beam_length - a;
  return F * std::pow(a * b / beam_length, 3) / (3.0 * young_I) +
         mass_per_length * beam_gravity * a * a * b * b / (24.0 * young_I);
}

TEST(SlideAlong, SagsAsTheBeamAnywhere) {
  EXPECT_NEAR(100.0 * beam_gravity * std::pow(beam_length, 3) / (192.0 * young_I), 5.84e-3, 1e-5);
  for (const Coordinates c : both_coordinates)
    for (const double a : {1.0, 0.5, 1.4, 0.75, 0.33}) {
      const RunResult r =
          ran(beam_with(clamped_ends + all_shapes) + trolley_at(a, 100.0, welded, held_at(a)) +
                  "simulation: {step: 0.001, duration: 0, start: equilibrium}\n",
              c);
      // The foot is on the path: sags are those of points that the bending does not move along it.
      const double sag = clamped_sag(a, 100.0 * beam_gravity);
      const bool node = std::abs(10.0 * a - std::round(10.0 * a)) < 1e-9;
      EXPECT_NEAR(at(r, 0, "cart.z"), -sag, (node ? 1e-6 : 2e-3) * sag) << a;
      EXPECT_NEAR(at(r, 0, "s"), a, 1e-9);
      EXPECT_NEAR(at(r, 0, "F.z"), 100.0 * beam_gravity, 1e-6 * 100.0 * beam_gravity);
    }
}

TEST(SlideAlong, PointsOfAFlexibleBodyAreNodes) {
  const auto error = [](const std::string& points) {
    std::string text = beam_with(clamped_ends + all_shapes) + trolley_at(1.0, 100.0, welded, "") +
                       "simulation: {step: 0.001, duration: 0}\n";
    const std::string drawn = "[[0, 0, 0], [2, 0, 0]]";
    text.replace(text.find(drawn), drawn.size(), points);
    return error_of([&] { model_of(text); });
  };
  EXPECT_EQ(error("[[0, 0, 0], [0.5, 0, 0], [2, 0, 0]]"), "no error");
  EXPECT_NE(error("[[0, 0, 0], [1.95, 0, 0]]").find(": not_found"), std::string::npos);
  EXPECT_NE(error("[[0, 0, 0], [2, 0, 0.1]]").find(": not_found"), std::string::npos);
  EXPECT_NE(error("[[0, 0, 0], [1.0e-7, 0, 0]]").find(": geometry"), std::string::npos);
}

// Without the shapes of the path the modes leave out a part of the sag, which a hint names.
TEST(SlideAlong, HintsAtTheSagThatModesLeaveOut) {
  const auto hints = [](const std::string& modes) {
    const Model m =
        model_of(beam_with(clamped_ends + modes) + trolley_at(1.0, 100.0, welded, held_at(1.0)) +
                 "simulation: {step: 0.001, duration: 0, start: equilibrium}\n");
    std::string all;
    for (const std::string& note : m.hints.notes) all += note + "\n";
    return all;
  };
  EXPECT_EQ(hints(all_shapes).find("sag"), std::string::npos);
  const std::string few = hints("      normal_modes: 4\n");
  EXPECT_NE(few.find("constraint 'slide': the modes of body 'beam'"), std::string::npos) << few;
  EXPECT_NE(few.find("below a force on the path along z: path_shapes"), std::string::npos) << few;
}

/// Fryba, Vibration of Solids and Structures under Moving Loads, chapter 1: midspan of a simply
/// supported beam under a force that enters at t = 0.
double midspan_of_series(double force, double speed, double t) {
  double w = 0.0;
  for (int n = 1; n < 400; n += 2) {
    const double k = n * std::numbers::pi / beam_length,
                 omega = k * k * std::sqrt(young_I / mass_per_length);
    const double Omega = k * speed, shape = n % 4 == 1 ? 1.0 : -1.0;
    w += shape * (std::sin(Omega * t) - Omega / omega * std::sin(omega * t)) /
         (omega * omega - Omega * Omega);
  }
  return 2.0 * force / (mass_per_length * beam_length) * w;
}

TEST(SlideAlong, AMovingLoadIsThatOfTheSeries) {
  const double omega =
      std::pow(std::numbers::pi / beam_length, 2) * std::sqrt(young_I / mass_per_length);
  const double step = 2.0 * std::numbers::pi / omega / 200.0, force = 10.0, speed = 10.0;
  const std::string ends =
      R"(      clamped: [{point: l, dofs: [x, y, z, rx]}, {point: r, dofs: [y, z]}]
      normal_modes: 8
)" + all_shapes;
  const std::string joints = R"(  l: {type: revolute, child: beam, at: l, axis: y}
)";
  for (const Coordinates c : both_coordinates) {
    std::string text = "gravity: [0, 0, 0]\n" + beam_with(ends) +
                       trolley_at(0.0, 1e-3, joints, "    motion: {velocity: 10}\n");
    text.insert(text.find("  upright:"),
                "  roller: {type: in_plane, from: {body: ground, at: r}, to: {body: beam, at: r}, "
                "axis: z}\n");
    text += fmt::format(R"(forces:
  load: {{type: force, body: cart, direction: [0, 0, -1], magnitude: {:.15g}}}
simulation: {{step: {:.15g}, duration: {:.15g}}}
)",
                        force, step, std::floor(beam_length / speed / step) * step);
    const RunResult r = ran(text, c);
    double most = 0.0, worst = 0.0;
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      const double exact = midspan_of_series(force, speed, r.table.at(k, 0));
      most = std::max(most, std::abs(exact));
      worst = std::max(worst, std::abs(at(r, k, "mid") + exact));
      EXPECT_NEAR(at(r, k, "s"), speed * r.table.at(k, 0), 1e-9);
      EXPECT_NEAR(at(r, k, "v"), speed, 1e-6);
    }
    EXPECT_GT(most, 0.9 * force * std::pow(beam_length, 3) / (48.0 * young_I));
    EXPECT_LT(worst, 1e-3 * most);
    std::printf("[ figure ] moving_load_%s %.1e\n", name_of(c).c_str(), worst / most);
  }
}

/// A trolley that rolls freely from x = 0.5.
std::string rolling(const std::string& modes, double step) {
  const std::string cart =
      "  cart: {type: free, child: cart, at: [0.5, 0, 0], velocity: [1, 0, 0, 0, 0, 0]}\n";
  return beam_with(clamped_ends + modes) + trolley_at(0.5, 20.0, welded + cart, "") +
         fmt::format("simulation: {{step: {:.15g}, duration: 0.8, output_interval: 0.02}}\n", step);
}

TEST(SlideAlong, ATrolleyThatRollsKeepsItsEnergyInBothFormulations) {
  const std::string text = rolling("      normal_modes: 6\n", 2e-4);
  const RunResult a = ran(text, Coordinates::absolute), b = ran(text, Coordinates::relative);
  ASSERT_EQ(a.table.rows(), b.table.rows());
  const auto energy = [](const RunResult& r, std::size_t k) {
    return at(r, k, "T") + at(r, k, "U") + at(r, k, "W");
  };
  for (std::size_t k = 0; k < a.table.rows(); ++k) {
    for (const RunResult* r : {&a, &b})
      EXPECT_NEAR(energy(*r, k), energy(*r, 0), 2e-3 * (1.0 + at(*r, k, "W")));
    for (const char* column : {"cart.x", "cart.z", "s", "mid"})
      EXPECT_NEAR(at(a, k, column), at(b, k, column), 1e-7) << column << k;
    EXPECT_NEAR(at(a, k, "s"), at(a, k, "cart.x"), 1e-4);
  }
  EXPECT_GT(at(a, a.table.rows() - 1, "s"), 1.2);
}

// The curvature of the path is continuous: crossing nodes does not break the order.
TEST(SlideAlong, IsOfSecondOrder) {
  const auto end = [](double step) {
    const RunResult r = ran(rolling("      normal_modes: 4\n", step), Coordinates::relative);
    return Vec3(at(r, r.table.rows() - 1, "cart.x"), at(r, r.table.rows() - 1, "cart.z"),
                at(r, r.table.rows() - 1, "mid"));
  };
  const Vec3 coarse = end(1e-4), middle = end(5e-5), fine = end(2.5e-5);
  const double ratio = (coarse - middle).norm() / (middle - fine).norm();
  EXPECT_NEAR(ratio, 4.0, 0.6);
}

TEST(SlideAlong, StepsDoNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const Model model = model_of(rolling("      normal_modes: 4\n", 1e-3));
  for (const Coordinates c : both_coordinates) {
    SimulationDescription s = model.simulation;
    s.coordinates = c;
    Stepper steps(model, s);
    EXPECT_TRUE(steps.advance());
    const AllocationScope scope;
    for (int k = 0; k < 20; ++k) steps.advance();
    EXPECT_EQ(scope.count(), 0u);
  }
}

// On a rigid body it is a point on a curve through points; a motion along a quarter of a circle of
// 91 points has the force m v^2 / R.
TEST(SlideAlong, OfARigidBodyIsAPathThroughPoints) {
  std::string points;
  for (int k = 0; k <= 90; ++k) {
    const double u = k * std::numbers::pi / 180.0;
    points +=
        fmt::format("{}[{:.15g}, {:.15g}, 0]", k > 0 ? ", " : "", std::sin(u), 1.0 - std::cos(u));
  }
  for (const Coordinates c : both_coordinates) {
    const RunResult r = ran(R"(
gravity: [0, 0, 0]
bodies: {bead: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.01, 0.01, 0.01]}}}
constraints:
  bend:
    type: slide_along
    from: {body: ground, at: [0, 0, 0]}
    to: {body: bead}
    motion: {velocity: 1.5}
    points: [)" + points + R"(]
outputs:
  p: {position: bead}
  F: {joint_force: {constraint: bend}}
  s: {travel: bend}
simulation: {step: 1.0e-3, duration: 1}
)",
                            c);
    for (std::size_t k = 0; k < r.table.rows(); k += 50) {
      const double u = 1.5 * r.table.at(k, 0);
      EXPECT_NEAR(at(r, k, "s"), u, 1e-9);
      EXPECT_NEAR(at(r, k, "p.x"), std::sin(u), 1e-4);
      EXPECT_NEAR(at(r, k, "p.y"), 1.0 - std::cos(u), 1e-4);
      EXPECT_NEAR(std::hypot(at(r, k, "F.x"), at(r, k, "F.y")), 2.0 * 1.5 * 1.5, 0.02) << k;
    }
  }
}

}  // namespace
}  // namespace floatframe::test
