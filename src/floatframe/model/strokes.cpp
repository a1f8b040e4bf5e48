#include "floatframe/model/strokes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/loop_mobility.hpp"

namespace floatframe {

namespace {

constexpr double circle = 2.0 * std::numbers::pi;

}  // namespace

Vec3 Strokes::axis(std::size_t i) const {
  const Joint& joint = model_.joints[port(i).joint];
  const auto found = coordinate_axis(joint.type, joint.axis_2, port(i).component);
  return found ? found->direction : Vec3(Vec3::UnitZ());
}

Vec3 Strokes::world_axis(std::size_t i) const { return design_pose(model_, frame(i)).R * axis(i); }

Vec3 Strokes::place(std::size_t i) const { return design_pose(model_, frame(i)).p; }

Vec3 Strokes::across(std::size_t i, std::size_t j) const {
  const Vec3 z = world_axis(i), between = place(j) - place(i);
  return between - z.dot(between) * z;
}

Vec3 Strokes::in(int marker, const Vec3& v) const {
  return design_pose(model_, marker).R.transpose() * v;
}

double Strokes::size(int marker) const {
  const int body = model_.markers[marker].body;
  if (body >= 0) return 0.5 * model_.bodies[body].length;
  double largest = 0.0;
  for (const Body& b : model_.bodies) largest = std::max(largest, b.length);
  return 0.5 * largest;
}

void Strokes::add(int marker, std::vector<Vec3> points) {
  strokes_.push_back({marker, std::move(points)});
}

void Strokes::curve(int marker, const std::vector<Vec3>& samples) {
  const std::size_t last = samples.size() - 1, pieces = std::min<std::size_t>(last, 300);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k <= pieces; ++k) points.push_back(samples[k * last / pieces]);
  add(marker, std::move(points));
}

void Strokes::wheel(int marker, const Vec3& axis, double radius, double teeth) {
  const Mat3 R = frame_with_z(axis);
  const bool toothed = teeth >= 3.0 && teeth <= 150.0;
  const int count = toothed ? 2 * static_cast<int>(std::lround(teeth)) : 64;
  const double depth = toothed ? circle * radius / count : 0.0;
  std::vector<Vec3> points;
  for (int k = 0; k <= count; ++k) {
    const double angle = circle * k / count, r = radius + (k % 2 == 0 ? 0.5 : -0.5) * depth;
    points.push_back(R * Vec3(r * std::cos(angle), r * std::sin(angle), 0.0));
  }
  add(marker, std::move(points));
}

void Strokes::wheels(std::size_t i, double r_i, std::size_t j, double r_j) {
  constexpr double least = 18.0;  // teeth of the smaller wheel
  const double smaller = std::min(r_i, r_j);
  wheel(child(i), axis(i), r_i, least * r_i / smaller);
  wheel(child(j), axis(j), r_j, least * r_j / smaller);
}

void Strokes::shift_last(const Vec3& by) {
  for (Vec3& p : strokes_.back().points) p += by;
}

void Strokes::square(int marker, const Vec3& axis, double half) {
  const Mat3 R = half * frame_with_z(axis);
  std::vector<Vec3> points;
  for (const auto& [x, y] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}, {1, 1}})
    points.push_back(R * Vec3(x, y, 0.0));
  add(marker, std::move(points));
}

void Strokes::rack(int marker, const Vec3& middle, const Vec3& along, const Vec3& up,
                   double pitch) {
  constexpr int teeth = 14;
  std::vector<Vec3> points;
  for (int k = -teeth; k <= teeth; ++k)
    points.push_back(middle + 0.5 * pitch * (k * along + (k % 2 == 0 ? 0.5 : -0.5) * up));
  add(marker, std::move(points));
}

void Strokes::thread(int marker, const Vec3& axis, double radius, double length, bool left_hand) {
  constexpr int turns = 6, each = 24;
  const Mat3 R = frame_with_z(axis);
  std::vector<Vec3> points;
  for (int k = 0; k <= turns * each; ++k) {
    const double angle = circle * k / each, part = static_cast<double>(k) / (turns * each) - 0.5;
    points.push_back(R * Vec3(radius * std::cos(angle),
                              (left_hand ? -radius : radius) * std::sin(angle), part * length));
  }
  add(marker, std::move(points));
}

}  // namespace floatframe
