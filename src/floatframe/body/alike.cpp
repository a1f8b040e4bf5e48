#include "floatframe/body/alike.hpp"

#include <algorithm>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/body_stress.hpp"

namespace floatframe {
namespace {

template <class Matrix>
bool same_matrix(const Matrix& a, const Matrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}

bool same_node(const ModalNode& a, const ModalNode& b) {
  return a.name == b.name && a.p == b.p && same_matrix(a.X, b.X) &&
         same_matrix(a.X_theta, b.X_theta);
}

bool same_bar(const BodyShape::Bar& a, const BodyShape::Bar& b) {
  return a.from == b.from && a.to == b.to && a.y == b.y && a.round == b.round &&
         a.width == b.width && a.height == b.height && a.inner == b.inner;
}

bool same_paint(const BodyShape::Paint& a, const BodyShape::Paint& b) {
  return a.first == b.first && a.color == b.color;
}

bool same_shape(const BodyShape& a, const BodyShape& b) {
  return a.color == b.color && a.triangles == b.triangles && a.lines == b.lines &&
         a.nodes == b.nodes && same_matrix(a.positions, b.positions) &&
         same_matrix(a.modes, b.modes) &&
         std::equal(a.bars.begin(), a.bars.end(), b.bars.begin(), b.bars.end(), same_bar) &&
         std::equal(a.paints.begin(), a.paints.end(), b.paints.begin(), b.paints.end(), same_paint);
}

}  // namespace

bool look_alike(const FlexibleBody& a, const FlexibleBody& b) {
  if (&a == &b) return true;
  if (a.modes() != b.modes() || (a.shape == nullptr) != (b.shape == nullptr)) return false;
  if (a.shape && a.shape != b.shape && !same_shape(*a.shape, *b.shape)) return false;
  if ((a.stress == nullptr) != (b.stress == nullptr)) return false;
  if (a.stress && a.stress != b.stress && !same_matrix(a.stress->modes, b.stress->modes))
    return false;
  return std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same_node);
}

}  // namespace floatframe
