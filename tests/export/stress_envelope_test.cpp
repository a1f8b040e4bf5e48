// Envelopes of stress: against all instants one by one, hot spots on a surface, and a turning rod.
#include "floatframe/export/stress_envelope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/export/hot_spots.hpp"
#include "floatframe/export/stress_field.hpp"
#include "floatframe/history/recorded_motion.hpp"
#include "floatframe/model/gauge.hpp"
#include "history/recorded_run.hpp"

namespace floatframe::test {
namespace {

BodyStress random_stress(std::mt19937& generator, int places, int sections, int modes) {
  std::normal_distribution<double> normal;
  BodyStress out;
  out.places.resize(static_cast<std::size_t>(places));
  out.sections.resize(static_cast<std::size_t>(sections));
  out.modes.resize(6 * places, modes);
  out.loads.resize(6 * places, body_load_cases + modes);
  out.section_modes.resize(6 * sections, modes);
  out.section_loads.resize(6 * sections, body_load_cases + modes);
  for (MatX* m : {&out.modes, &out.loads, &out.section_modes, &out.section_loads})
    for (double& x : m->reshaped()) x = normal(generator);
  return out;
}

/// More places and instants than are done at once, and not a multiple of them.
TEST(StressEnvelopeOf, IsTheLargestOfAllInstants) {
  std::mt19937 generator(3);
  constexpr int places = 150, sections = 70, modes = 4, instants = 141;
  for (const bool loads : {true, false}) {
    BodyStress stress = random_stress(generator, places, sections, modes);
    if (!loads) stress.loads.resize(0, 0), stress.section_loads.resize(0, 0);
    StressEnvelopeOf envelope(stress, modes);
    VecX largest = VecX::Constant(places, -1.0), when(places);
    MatX then(6, places);
    VecX least = VecX::Constant(6 * sections, 1e300), most = -least, least_at = least,
         most_at = least;
    for (int k = 0; k < instants; ++k) {
      const VecX y = VecX::Random(modes), c = VecX::Random(body_load_cases + modes);
      envelope.add(0.1 * k, y, c);
      if (k == 77) envelope.result();  // an answer in between changes nothing
      VecX s = stress.modes * y, f = stress.section_modes * y;
      if (loads) s += stress.loads * c, f += stress.section_loads * c;
      for (int p = 0; p < places; ++p) {
        const Vec6 here = s.segment<6>(6 * p);
        if (von_mises(here) <= largest(p)) continue;
        largest(p) = von_mises(here);
        when(p) = 0.1 * k;
        then.col(p) = here;
      }
      for (int i = 0; i < 6 * sections; ++i) {
        if (f(i) < least(i)) least(i) = f(i), least_at(i) = 0.1 * k;
        if (f(i) > most(i)) most(i) = f(i), most_at(i) = 0.1 * k;
      }
    }
    const StressEnvelope& found = envelope.result();
    EXPECT_LT((found.von_mises - largest).cwiseAbs().maxCoeff(), 1e-12 * largest.maxCoeff());
    EXPECT_EQ(found.time, when);
    EXPECT_LT((found.stress - then).cwiseAbs().maxCoeff(), 1e-12 * largest.maxCoeff());
    EXPECT_LT((found.least.reshaped() - least).cwiseAbs().maxCoeff(), 1e-12 * most.maxCoeff());
    EXPECT_LT((found.largest.reshaped() - most).cwiseAbs().maxCoeff(), 1e-12 * most.maxCoeff());
    EXPECT_EQ(VecX(found.least_time.reshaped()), least_at);
    EXPECT_EQ(VecX(found.largest_time.reshaped()), most_at);
  }
}

/// A square grid of 9 x 9 nodes with two places each, the second of which is colder.
FlexibleBody sheet(const std::vector<int>& doubtful) {
  auto stress = std::make_shared<BodyStress>();
  auto shape = std::make_shared<BodyShape>();
  for (int side = 0; side < 2; ++side)
    for (int n = 0; n < 81; ++n) {
      StressPlace place;
      place.layer = side == 0 ? StressPlace::Layer::top : StressPlace::Layer::bottom;
      place.point = n;
      place.node = n;
      place.doubtful = std::find(doubtful.begin(), doubtful.end(), n) != doubtful.end();
      stress->places.push_back(place);
    }
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const int a = 9 * i + j;
      shape->triangles.push_back({a, a + 1, a + 10});
      shape->triangles.push_back({a, a + 10, a + 9});
    }
  FlexibleBody body;
  body.stress = stress;
  body.shape = shape;
  return body;
}

/// Two hills over the sheet, the higher one around node 20, the lower one around node 60.
StressEnvelope hills() {
  StressEnvelope out;
  out.von_mises.resize(162);
  out.time = VecX::Zero(162);
  out.stress = Mat6X::Zero(6, 162);
  for (int n = 0; n < 162; ++n) {
    const Vec2 p(n % 81 / 9, n % 9);
    const Vec2 high(20 / 9, 20 % 9), low(60 / 9, 60 % 9);
    const double value = std::max(100.0 - (p - high).norm(), 98.0 - (p - low).norm());
    out.von_mises(n) = n < 81 ? value : 0.5 * value;
    out.stress(0, n) = -out.von_mises(n);
  }
  return out;
}

std::vector<int> places_of(const std::vector<HotSpot>& spots) {
  std::vector<int> out;
  for (const HotSpot& s : spots) out.push_back(s.place);
  return out;
}

TEST(HotSpots, AreTheTopsOfHills) {
  const std::vector<HotSpot> spots = hot_spots(sheet({}), hills(), 10);
  EXPECT_EQ(places_of(spots), (std::vector<int>{20, 60}));
  EXPECT_EQ(spots[0].von_mises, 100.0);
  EXPECT_LT((spots[0].principal - Vec3(0, 0, -100.0)).norm(), 1e-5);
  EXPECT_EQ(places_of(hot_spots(sheet({}), hills(), 1)), std::vector<int>{20});
  EXPECT_TRUE(hot_spots(sheet({}), hills(), 0).empty());
}

/// Beside a doubtful top the hottest of the trusted nodes stand as well.
TEST(HotSpots, DoubtfulOnesHideNone) {
  const std::vector<HotSpot> spots = hot_spots(sheet({20}), hills(), 10);
  ASSERT_GE(spots.size(), 3u);
  EXPECT_EQ(spots.front().place, 20);
  EXPECT_TRUE(spots.front().doubtful);
  EXPECT_EQ(spots.back().place, 60);
  for (std::size_t k = 1; k + 1 < spots.size(); ++k) {
    EXPECT_FALSE(spots[k].doubtful);
    EXPECT_EQ(spots[k].von_mises, 99.0);
  }
  // One that is to be trusted, and the doubtful ones above it.
  const std::vector<HotSpot> one = hot_spots(sheet({20}), hills(), 1);
  ASSERT_EQ(one.size(), 2u);
  EXPECT_TRUE(one[0].doubtful);
  EXPECT_FALSE(one[1].doubtful);
}

/// A motor turns a rod faster and faster: the hottest place is the root, at the end, with
/// rho w^2 L^2 / 2 from turning, while speeding up bends it.
TEST(StressEnvelopeOf, OfARodThatIsSpunUp) {
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    const TemporaryFolder folder;
    const Model model = model_of(R"(
gravity: [0, 0, 0]
points: {p: [1, 2, 3], tip: [1.6, 2, 3]}
bodies:
  rod:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: tip, elements: 6, section: {rectangle: [0.02, 0.01]}}}
      clamped: [p]
      static_modes: [{point: tip, dofs: [y, z]}]
joints:
  drive: {type: revolute, child: rod, at: p, axis: z, motion: {polynomial: [0.3, 0, 100]}}
simulation: {step: 1.0e-3, duration: 0.1}
)");
    SimulationDescription o = model.simulation;
    o.coordinates = coordinates;
    recorded_run(model, o, folder.file("states.ffr"));
    const StateHistory history(folder.file("states.ffr"));
    RecordedMotion motion(history, model, o);
    const FlexibleBody& body = *model.bodies[0].data;
    StressEnvelopeOf envelope(*body.stress, body.modes());
    for (std::size_t k = 0; k < motion.instants(); ++k) {
      const SystemMotion& view = motion.at(k);
      envelope.add(view.t, body_motion(view, 0).y, stress_loads(view, 0));
    }
    const StressEnvelope& found = envelope.result();
    const std::vector<SectionPeak> peaks = section_peaks(*body.stress, found);
    ASSERT_EQ(peaks.size(), 6u);
    const double pull = 0.5 * 2700 * 400 * 0.36;  // at w = 20
    EXPECT_NEAR(peaks[0].value, 2e-4 * pull, 2e-4 * 2e-4 * pull);
    EXPECT_NEAR(peaks[0].time, 0.1, 1e-9);
    const BeamSectionPlace& root =
        body.stress->sections[static_cast<std::size_t>(peaks[0].section)];
    EXPECT_EQ(stress_node_text(body, root.node, root.number), "p");
    // All other sections at the same time: rho A w^2 (L^2 - x^2) / 2.
    for (std::size_t s = 0; s < body.stress->sections.size(); ++s) {
      const double x = body.stress->sections[s].p.x() - root.p.x();
      EXPECT_NEAR(found.largest(0, static_cast<Eigen::Index>(s)),
                  2e-4 * 0.5 * 2700 * 400 * (0.36 - x * x), 2e-4 * 2e-4 * pull);
    }
    const std::vector<HotSpot> spots = hot_spots(body, found, 1);
    ASSERT_EQ(spots.size(), 1u);
    const StressPlace& place = body.stress->places[static_cast<std::size_t>(spots[0].place)];
    EXPECT_EQ(stress_node_text(body, place.node, place.number), "p");
    EXPECT_GT(spots[0].von_mises, pull);
    EXPECT_NEAR(spots[0].principal(0), spots[0].von_mises, 1e-6 * spots[0].von_mises);
  }
}

}  // namespace
}  // namespace floatframe::test
