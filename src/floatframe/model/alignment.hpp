#pragma once
// Approximate relations between axes and points of the joints of loops: parallel, perpendicular,
// coplanar, on one line, through one point. Each relation can be made exact. Load time.
#include <vector>

#include "floatframe/model/loop_mobility.hpp"

namespace floatframe {

/// An axis of a joint, or its point if it has no axis.
struct LoopAxis {
  int joint = -1;  ///< in the block
  bool second = false;
  Vec3 e = Vec3::Zero();  ///< unit vector, world axes, as drawn; zero: a point only
  bool located = false;   ///< rotates about the line through the point of the joint
  bool slides = false;    ///< and nothing but slides along it
};

struct Relation {
  enum class Kind { parallel, perpendicular, coplanar, one_line, one_point };
  Kind kind = Kind::parallel;
  std::vector<int> axes;    ///< axes moved by it
  std::vector<int> normal;  ///< perpendicular: to the first of each of these clusters
};

class Alignment {
 public:
  Alignment(const Model& model, const LoopBlock& block);

  double size() const noexcept { return size_; }
  const std::vector<JointPlace>& drawn() const noexcept { return drawn_; }
  const std::vector<LoopAxis>& axes() const noexcept { return axes_; }
  /// Relations that hold within tolerance [rad; m], but not to rounding.
  std::vector<Relation> relations(double angle, double distance) const;
  /// The positions with the relations made exact, in their order.
  std::vector<JointPlace> aligned(const std::vector<Relation>& relations) const;
  /// Deviation of an axis from its corrected one in `places`: an angle [rad] or, for lines and
  /// points, a distance [m].
  double moved(const std::vector<JointPlace>& places, int axis, bool distance) const;
  /// Deviation of an axis from the common value of the others in the relation [rad; m].
  double miss(const Relation& relation, int axis, const std::vector<int>& others) const;

 private:
  std::vector<std::vector<int>> clusters(double angle) const;
  void add_lines(const std::vector<std::vector<int>>& clusters, double distance,
                 std::vector<Relation>& found) const;
  void add_points(double distance, std::vector<Relation>& found) const;
  Vec3 mean_direction(const std::vector<int>& axes) const;
  Vec3 line_direction(const std::vector<int>& line) const;
  const Vec3& place(int axis) const { return drawn_[axes_[axis].joint].p; }

  double size_ = 0.0;
  std::vector<JointPlace> drawn_;
  std::vector<LoopAxis> axes_;
  std::vector<std::pair<int, int>> between_;  ///< rigid groups that each joint is between
};

}  // namespace floatframe
