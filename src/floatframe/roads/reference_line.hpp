#pragma once
// The reference line of a curved regular grid (OpenCRG): a polygon of equal steps du, from the node
// P_0 at u_0 on. A place lies u along and v to the left of it. With the chords t_i = P_{i+1} -
// P_{i-1} (at an end that of the only step there), interval i reaches from the normal of t_i
// through P_i to that of t_{i+1} through P_{i+1}; in it, with e = P_{i+1} - P_i and the place P,
//   a = t_i.(P - P_i) / t_i.e,   b = t_{i+1}.(P_{i+1} - P) / t_{i+1}.e
//   u = u_0 + (i + a / (a + b)) du,   v = e x (P - P_i) / |e|                               (1)
// Before and behind the ends it goes on straight; a closed line has the chord P_1 - P_{n-1} there.
// This is the definition of OpenCRG 1.2, not the foot of a perpendicular; u is continuous
// everywhere, its slope has a small jump at the normals. The place is looked for from the nearest
// node, which a tree of boxes finds: what was asked before does not matter.
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace floatframe {

/// Along and beside a line [m], with derivatives by x and y [-], [1/m].
struct LinePlace {
  double u = 0.0, v = 0.0;
  double ux = 0.0, uy = 0.0, vx = 0.0, vy = 0.0;
  double uxx = 0.0, uxy = 0.0, uyy = 0.0;
};

class ReferenceLine {
 public:
  struct Node {
    double x = 0.0, y = 0.0;  ///< [m]
  };

  ReferenceLine() = default;
  /// Straight from a node on, `steps` of length `du`, heading in rad.
  ReferenceLine(double u0, double du, std::size_t steps, Node start, double heading);
  /// At least two nodes. Headings of the first and the last step.
  ReferenceLine(double u0, double du, std::vector<Node> nodes, double first, double last);

  /// All that it is made from.
  struct Numbers {
    double u0 = 0.0, du = 1.0;
    std::size_t steps = 1;
    std::vector<Node> nodes;  ///< none: straight
    Node start;
    std::array<double, 2> heading{0.0, 0.0};  ///< of the first and the last step
  };
  explicit ReferenceLine(Numbers x)
      : ReferenceLine(x.nodes.empty() ? ReferenceLine(x.u0, x.du, x.steps, x.start, x.heading[0])
                                      : ReferenceLine(x.u0, x.du, std::move(x.nodes), x.heading[0],
                                                      x.heading[1])) {}
  Numbers numbers() const { return {u0_, du_, steps_, nodes_, start_, heading_}; }

  double first() const noexcept { return u0_; }
  double last() const noexcept { return u0_ + du_ * steps_; }
  double step() const noexcept { return du_; }
  /// Turned and moved so that it begins at the origin along x.
  void begin_at_origin();
  /// Both ends are the same place, within a hundredth of a step.
  bool closed() const noexcept { return closed_; }
  Node node(std::size_t k) const noexcept;

  /// Step time.
  LinePlace at(double x, double y) const noexcept;
  Node place(double u, double v) const noexcept;

  /// Heading of the step that ends at the node before or at u, from the first one on; left turns
  /// increase it [rad].
  double heading(double u) const noexcept;
  /// Of three nodes about 0.5 m apart, taken to the distance v; zero near the ends [1/m].
  double curvature(double u, double v) const noexcept;

 private:
  struct Box {
    double x0, x1, y0, y1;
  };
  void build_tree();
  double squared_distance(const Box& box, double x, double y) const noexcept;
  std::size_t nearest(double x, double y) const noexcept;
  std::size_t interval(std::size_t near, double x, double y) const noexcept;
  Node chord(std::size_t k) const noexcept;
  LinePlace in_interval(std::size_t k, double x, double y) const noexcept;
  LinePlace straight(bool behind, double x, double y) const noexcept;
  std::size_t index_of(double u) const noexcept;

  static constexpr std::size_t leaf = 16;  ///< nodes of a box
  double u0_ = 0.0, du_ = 1.0;
  std::size_t steps_ = 1;
  std::vector<Node> nodes_;  ///< none: straight
  Node start_, end_;
  std::array<double, 2> cosine_{1.0, 1.0}, sine_{0.0, 0.0}, heading_{0.0, 0.0};
  bool closed_ = false;
  std::size_t leaves_ = 0;  ///< a power of two
  std::vector<Box> tree_;   ///< a heap: the children of k are 2 k + 1 and 2 k + 2
};

}  // namespace floatframe
