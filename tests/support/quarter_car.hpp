#pragma once
// A wheel under a body that rolls down stairs at a constant speed, as a model and as two masses
// that a rule of fourth order integrates from edge to edge.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "support/model_text.hpp"

namespace floatframe::test {

/// The stairs begin `begin` [m] ahead of the wheel. The strut has a stop and a damper with a
/// corner, the tyre a damper: force and slope jump at touch, at edges and at corners.
inline std::string quarter_car(double begin, const char* options = "") {
  const std::string x = std::to_string(begin);
  const auto edge = [&](double at, double z) {
    return ", [" + std::to_string(begin + at) + ", " + std::to_string(z) + "]";
  };
  return R"(
bodies:
  cart: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
  load: {rigid: {mass: 300, centre_of_mass: [0, 0, 0.8], inertia: [1, 1, 1]}}
  wheel: {rigid: {mass: 40, centre_of_mass: [0, 0, 0.3], inertia: [1, 1, 1]}}
joints:
  drive: {type: prismatic, child: cart, at: [0, 0, 0], axis: x, motion: {polynomial: [0, 5]}}
  load: {type: prismatic, parent: cart, child: load, at: [0, 0, 0], axis: z}
  wheel: {type: prismatic, parent: cart, child: wheel, at: [0, 0, 0], axis: z}
forces:
  strut:
    type: spring_damper
    from: {body: load, at: [0, 0, 0.8]}
    to: {body: wheel, at: [0, 0, 0.3]}
    spring:
      piecewise:
        - {below: 0.4, polynomial: [-4000, 2.0e+5], about: 0.4}
        - {polynomial: [0, 20000], about: 0.6}
    damper:
      piecewise:
        - {below: 0, polynomial: [0, 800]}
        - {polynomial: [0, 2500]}
  tyre:
    type: tyre
    body: wheel
    at: [0, 0, 0.3]
    radius: 0.32
    stiffness: 2.0e+5
    damping: 300
    road: stairs
roads:
  stairs: {profile: [[)" +
         x + ", 0]" + edge(0, -0.1) + edge(0.5, -0.1) + edge(0.5, -0.25) + edge(1.0, -0.2) +
         edge(1.5, -0.2) + R"(]}
outputs:
  load: {joint_position: load}
  wheel: {joint_position: wheel}
simulation: {tolerance: 1.0e-11, )" +
         options + "}\n";
}

class QuarterCarReference {
 public:
  explicit QuarterCarReference(double begin) : begin_(begin) {}

  /// Positions of load and wheel at multiples of `interval`.
  std::vector<std::array<double, 2>> positions(double interval, int count) {
    std::vector<std::array<double, 2>> all{{y_[0], y_[2]}};
    side_ = side(0.0, y_);
    for (int k = 1; k <= count; ++k) {
      advance_to(k * interval);
      all.push_back({y_[0], y_[2]});
    }
    return all;
  }

 private:
  using Y = std::array<double, 4>;  ///< displacement and velocity of the load, then of the wheel
  /// Which piece of each law holds.
  struct Side {
    int road = 0;
    bool touches = false, stop = false, rebound = false;
    bool operator==(const Side&) const = default;
  };
  static constexpr double speed = 5.0, g = 9.81, R = 0.32;

  double height(int road, double x) const {
    static constexpr double z[] = {0.0, -0.1, 0.0, -0.2};
    return road == 2 ? -0.25 + 0.1 * (x - begin_ - 0.5) : z[road];
  }
  double push(int road, double t, const Y& y) const {
    const double slope = road == 2 ? 0.1 : 0.0;
    const double h = 0.3 + y[2] - height(road, speed * t);
    return 2e5 * (R - h) - 300.0 * (y[3] - slope * speed);
  }
  Side side(double t, const Y& y) const {
    const double x = speed * t - begin_;
    Side s;
    s.road = x < 0.0 ? 0 : x < 0.5 ? 1 : x < 1.0 ? 2 : 3;
    const double h = 0.3 + y[2] - height(s.road, speed * t);
    s.touches = h < R && push(s.road, t, y) > 0.0;
    s.stop = 0.5 + y[0] - y[2] < 0.4;
    s.rebound = y[1] - y[3] >= 0.0;
    return s;
  }
  Y rate(double t, const Y& y) const {
    const double s = 0.5 + y[0] - y[2], v = y[1] - y[3];
    const double f = (side_.stop ? -4000.0 + 2e5 * (s - 0.4) : 2e4 * (s - 0.6)) +
                     (side_.rebound ? 2500.0 : 800.0) * v;
    const double tyre = side_.touches ? push(side_.road, t, y) : 0.0;
    return {y[1], -g - f / 300.0, y[3], -g + (f + tyre) / 40.0};
  }
  Y step(double h) const {
    const auto add = [](const Y& a, double k, const Y& b) {
      Y c;
      for (int i = 0; i < 4; ++i) c[i] = a[i] + k * b[i];
      return c;
    };
    const Y k1 = rate(t_, y_), k2 = rate(t_ + 0.5 * h, add(y_, 0.5 * h, k1));
    const Y k3 = rate(t_ + 0.5 * h, add(y_, 0.5 * h, k2)), k4 = rate(t_ + h, add(y_, h, k3));
    Y y = y_;
    for (int i = 0; i < 4; ++i) y[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    return y;
  }
  void advance_to(double end) {
    while (t_ < end) {
      double h = std::min(1e-4, end - t_);
      Y y = step(h);
      if (!(side(t_ + h, y) == side_)) {
        // To just beyond the first edge; it is passed within 1e-14 s.
        double low = 0.0, high = h;
        while (high - low > 1e-14) {
          const double middle = 0.5 * (low + high);
          (side(t_ + middle, step(middle)) == side_ ? low : high) = middle;
        }
        h = high;
        y = step(h);
        side_ = side(t_ + h, y);
      }
      t_ = end - t_ - h < 1e-13 ? end : t_ + h;
      y_ = y;
    }
  }

  double begin_, t_ = 0.0;
  Y y_{};
  Side side_;
};

}  // namespace floatframe::test
