#pragma once
// What the lines are made of by which elements show what they hold: pitch circles, strands of
// belts, screws, guides (Stroke, element_outputs.hpp). Lines lie on bodies in the design
// configuration and go with them. Load time only.
#include <utility>
#include <vector>

#include "floatframe/model/element_outputs.hpp"

namespace floatframe {

class Strokes {
 public:
  Strokes(const Model& model, const Element& element) : model_(model), element_(element) {}

  // Of the coordinates of a coupling: markers of its joint, and its axis in the axes of both.
  int frame(std::size_t i) const { return element_.markers[port(i).port]; }
  int child(std::size_t i) const { return element_.markers[port(i).port + 1]; }
  Vec3 axis(std::size_t i) const;
  /// The same in world axes, and the point of the joint [m].
  Vec3 world_axis(std::size_t i) const;
  Vec3 place(std::size_t i) const;
  /// From axis i to axis j, across axis i, in world axes [m].
  Vec3 across(std::size_t i, std::size_t j) const;
  /// A vector of the world in the axes of a marker.
  Vec3 in(int marker, const Vec3& v) const;
  /// How large a symbol is that has no size of its own [m]: half that of the body of a marker, or
  /// of the largest one for the ground.
  double size(int marker) const;

  /// Points in the axes of a marker, from it [m].
  void add(int marker, std::vector<Vec3> points);
  /// Samples of a curve that begins at a marker, at most 300 of them.
  void curve(int marker, const std::vector<Vec3>& samples);
  /// A circle about an axis; with teeth, if there are some.
  void wheel(int marker, const Vec3& axis, double radius, double teeth = 0.0);
  /// Both wheels of a pair, with teeth of the same size.
  void wheels(std::size_t i, double r_i, std::size_t j, double r_j);
  /// Moves what was added last, in the axes of its marker.
  void shift_last(const Vec3& by);
  /// A square across an axis.
  void square(int marker, const Vec3& axis, double half);
  void line(int marker, const Vec3& from, const Vec3& to) { add(marker, {from, to}); }
  /// A rack: a line with teeth about its middle; `up` is the side of its teeth.
  void rack(int marker, const Vec3& middle, const Vec3& along, const Vec3& up, double pitch);
  /// Turns of a thread about an axis, left-hand if the lead is negative.
  void thread(int marker, const Vec3& axis, double radius, double length, bool left_hand);

  std::vector<Stroke> take() { return std::move(strokes_); }

 private:
  const CoordinatePort& port(std::size_t i) const { return element_.coordinates[i]; }

  const Model& model_;
  const Element& element_;
  std::vector<Stroke> strokes_;
};

}  // namespace floatframe
