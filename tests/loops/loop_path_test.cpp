// Loops close in the assembly mode that is drawn, whatever the tree, the order of joints and the
// joint that is cut.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "floatframe/start/initial_state.hpp"
#include "support/error_of.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"
#include "support/random_count.hpp"

namespace floatframe::test {
namespace {

/// Positions, orientations and velocities of all bodies at the start, one number after the other.
std::vector<double> closed_start_of(const Model& model) {
  RelativeFormulation f(model, model.simulation.inertia);
  const State s = relative_start(f, Start::given);
  f.positions(0.0, s.q);
  f.velocities(s.v);
  std::vector<double> all;
  for (const BodyKinematics& b : f.motion().bodies) {
    const auto add = [&](const auto& x) { all.insert(all.end(), x.data(), x.data() + x.size()); };
    add(b.p_WB);
    add(b.R_WB);
    add(b.v_WB);
    add(b.w_WB);
  }
  return all;
}

double most_apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = a.size() == b.size() ? 0.0 : 1e300;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// A crank whose pin drives a yoke through a block in a slot.
Model scotch_yoke(double angle, const std::array<int, 4>& order, int cut) {
  const std::array<std::string, 4> joints = {
      fmt::format(
          "crank: {{type: revolute, child: crank, at: [0,0,0], axis: -y, position: {:.17g}, "
          "velocity: 1",
          angle),
      "pin: {type: revolute, parent: crank, child: block, at: [0.1,0,0], axis: -y",
      "slot: {type: prismatic, parent: yoke, child: block, at: [0.1,0,0], axis: z",
      "guide: {type: prismatic, child: yoke, at: [0.3,0,0], axis: x"};
  std::string text = R"(
bodies:
  crank: {rigid: {mass: 1, centre_of_mass: [0,0,0], inertia: [0.1,0.1,0.1]}}
  block: {rigid: {mass: 1, centre_of_mass: [0.1,0,0.05], inertia: [0.1,0.1,0.1]}}
  yoke: {rigid: {mass: 1, centre_of_mass: [0.3,0,0], inertia: [0.1,0.1,0.1]}}
joints:
)";
  for (const int j : order) text += "  " + joints[j] + (j == cut ? ", cut: true}\n" : "}\n");
  return model_of(text);
}

TEST(LoopPath, OfAScotchYokeInAllOrdersOfItsJoints) {
  double worst = 0.0;
  for (int k = -6; k <= 6; ++k) {
    const double angle = 0.5 * k;
    std::array<int, 4> order = {0, 1, 2, 3};
    do {
      for (int cut = -1; cut < 4; ++cut) {
        const std::vector<double> x = closed_start_of(scotch_yoke(angle, order, cut));
        // The block and the yoke do not turn; axis -y: the pin goes up where the crank turns on.
        const Vec3 pin(0.1 * std::cos(angle), 0.0, 0.1 * std::sin(angle));
        const Mat3 level = Mat3::Identity();
        for (int c = 0; c < 3; ++c) {
          worst = std::max(worst, std::abs(x[18 + c] - (pin + Vec3(0, 0, 0.05))[c]));
          worst = std::max(worst, std::abs(x[36 + c] - (pin + Vec3(0.2, 0, 0))[c] * (c != 2)));
        }
        for (int c = 0; c < 9; ++c)
          worst = std::max({worst, std::abs(x[21 + c] - level(c % 3, c / 3)),
                            std::abs(x[39 + c] - level(c % 3, c / 3))});
        worst = std::max(worst, std::abs(x[30] + 0.1 * std::sin(angle)));
      }
    } while (std::next_permutation(order.begin(), order.end()));
  }
  std::printf("[ figure ] Scotch yoke, 24 orders, 13 angles, 5 cuts: largest error %.2g\n", worst);
  EXPECT_LT(worst, 1e-9);
}

/// One spatial loop of one to three freedoms, with start values and velocities on some joints; the
/// joints in `order`, `cut` is one of them or -1.
class RandomLoop {
 public:
  explicit RandomLoop(unsigned seed) : random_(seed) {
    struct Type {
      const char* name;
      int freedoms;
      const char* axes;
    };
    constexpr std::array<Type, 6> types = {{{"revolute", 1, "axis"},
                                            {"prismatic", 1, "axis"},
                                            {"cylindrical", 2, "axis"},
                                            {"universal", 2, "both"},
                                            {"spherical", 3, ""},
                                            {"planar", 3, "both"}}};
    int free = integer(1, 3);
    std::vector<const Type*> chain;
    int sum = 0;
    do {
      chain.clear();
      for (int n = integer(3, 7); n > 0; --n) chain.push_back(&types[integer(0, 5)]);
      sum = std::accumulate(chain.begin(), chain.end(), 0,
                            [](int s, const Type* t) { return s + t->freedoms; });
    } while (sum != 6 + free);
    const int links = static_cast<int>(chain.size()) - 1;
    bodies_ = "bodies:\n";
    for (int i = 0; i < links; ++i)
      bodies_ += fmt::format(
          "  b{}: {{rigid: {{mass: {:.3f}, centre_of_mass: {}, inertia: [{:.3f}, {:.3f}, "
          "{:.3f}]}}}}\n",
          i, number(0.2, 3.0), vector(), number(0.05, 0.07), number(0.05, 0.07),
          number(0.05, 0.07));
    for (int i = 0; i <= links; ++i) {
      const Type& t = *chain[i];
      const std::string parent = i == 0 || i == links ? "ground" : fmt::format("b{}", i - 1);
      std::string joint = fmt::format("j{}: {{type: {}, parent: {}, child: b{}, at: {}", i, t.name,
                                      parent, std::min(i, links - 1), vector());
      if (*t.axes) joint += ", axis: " + vector();
      if (std::string(t.axes) == "both") joint += ", axis_2: " + vector();
      if (t.freedoms <= free && integer(0, 2) > 0) {
        free -= t.freedoms;
        joint += ", position: " + values(t.freedoms, 0.3) + ", velocity: " + values(t.freedoms, 1);
      }
      joints_.push_back(joint);
    }
  }

  std::size_t joints() const { return joints_.size(); }
  Model model(const std::vector<int>& order, int cut) const {
    std::string text = bodies_ + "joints:\n";
    for (const int j : order) text += "  " + joints_[j] + (j == cut ? ", cut: true}\n" : "}\n");
    return model_of(text);
  }
  int integer(int from, int to) { return from + static_cast<int>(random_() % (to - from + 1)); }

 private:
  double number(double from, double to) { return from + (to - from) * (random_() % 4096) / 4096.0; }
  std::string vector() {
    return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", number(-1, 1), number(-1, 1), number(-1, 1));
  }
  std::string values(int n, double most) {
    std::string text;
    for (int k = 0; k < n; ++k)
      text += fmt::format("{}{:.3f}", k > 0 ? ", " : "", number(-most, most));
    return n > 1 ? "[" + text + "]" : text;
  }

  std::mt19937 random_;
  std::string bodies_;
  std::vector<std::string> joints_;
};

TEST(LoopPath, OfRandomLoopsDoesNotDependOnTheTree) {
  int closed = 0, refused = 0;
  double worst = 0.0;
  const int count = random_count();
  for (int seed = 0; seed < count; ++seed) {
    RandomLoop loop(static_cast<unsigned>(seed));
    std::vector<int> order(loop.joints());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> first;
    std::string error;
    for (int k = 0; k < 3; ++k) {
      const int cut = k == 0 ? -1 : loop.integer(0, static_cast<int>(order.size()) - 1);
      std::vector<double> x;
      std::string refusal;
      try {
        x = closed_start_of(loop.model(order, cut));
      } catch (const RunError& e) {
        refusal = e.what();
      }
      if (k == 0) {
        first = x;
        error = refusal;
      } else {
        EXPECT_EQ(error.empty(), refusal.empty()) << seed << ' ' << error << ' ' << refusal;
        const double difference = most_apart(first, x);
        EXPECT_LT(difference, 1e-9) << seed;
        worst = std::max(worst, difference);
      }
      for (std::size_t i = order.size(); i-- > 1;)
        std::swap(order[i], order[loop.integer(0, static_cast<int>(i))]);
    }
    ++(error.empty() ? closed : refused);
    if (!error.empty()) expect_in(error, "the drawn configuration");
  }
  std::printf("[ figure ] random loops: %d closed, %d out of reach, largest difference %.2g\n",
              closed, refused, worst);
  EXPECT_GT(closed, 3 * count / 4);
}

/// A parallelogram that is drawn upright; the coupler is `coupler` long.
Model parallelogram(double angle, const char* coupler = "1") {
  return model_of(fmt::format(R"(
bodies:
  left: {{rigid: {{mass: 1, centre_of_mass: [0,0,0.5], inertia: [0.1,0.1,0.1]}}}}
  coupler: {{rigid: {{mass: 1, centre_of_mass: [0.5,0,1], inertia: [0.1,0.1,0.1]}}}}
  right: {{rigid: {{mass: 1, centre_of_mass: [1,0,0.5], inertia: [0.1,0.1,0.1]}}}}
joints:
  A: {{type: revolute, child: left, at: [0,0,0], axis: y, position: {:.17g}}}
  B: {{type: revolute, parent: left, child: coupler, at: [0,0,1], axis: y}}
  D: {{type: revolute, child: right, at: [1,0,0], axis: y}}
  C: {{type: revolute, parent: right, child: coupler, at: [{},0,1], axis: y}}
)",
                              angle, coupler));
}

// It lies flat at pi/2: there the crossed linkage branches off.
TEST(LoopPath, CrossesAChangePointStraightOn) {
  for (const double angle : {0.3, 1.7, 3.0, 1.5707963267948966, -2.0, 4.0, 9.0}) {
    const std::vector<double> x = closed_start_of(parallelogram(angle));
    for (int c = 0; c < 9; ++c)  // the coupler stays level
      EXPECT_NEAR(x[18 + 3 + c], c % 4 == 0 ? 1.0 : 0.0, 1e-7) << angle;
  }
}

TEST(LoopPath, OutOfReachReportsTheGap) {
  // A crank of 1 m, a coupler of 0.5 m and a rocker of 1.12 m: the crank cannot turn far.
  const std::string said = sentences_of([] { closed_start_of(parallelogram(2.0, "0.5")); });
  expect_in(said, "the model cannot be assembled: joint 'C' has a gap of 0.");
  expect_in(said, "the drawn configuration");
}

}  // namespace
}  // namespace floatframe::test
