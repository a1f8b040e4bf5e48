// MATRIX27: a mass of rigid points at its nodes, or a stiffness between them, as springs. With
// pivot k and column c of it,
//   K = c c^T/k + rest,
// so a spring of stiffness k along c/k is a part of it, and the rest has one pivot less. The
// displacements come first: the remainder involves rotations only.
#include <algorithm>
#include <cmath>

#include "floatframe/decks/ansys/ansys_build.hpp"

namespace floatframe {
namespace {

using Mat12 = Eigen::Matrix<double, 12, 12>;
using Vec12 = Eigen::Matrix<double, 12, 1>;

constexpr int matrix_constants = 78;      ///< of the upper triangle
constexpr double matrix_rounding = 1e-7;  ///< of constants as they are written

bool of_displacement(int dof) { return dof % 6 < 3; }

class AnsysMatrix {
 public:
  AnsysMatrix(AnsysBuild& build, const AnsysElement& e) : b_(build), e_(e) {}

  bool add(const AnsysType& type, const std::vector<int>& nodes) {
    const AnsysReal* real = b_.needed_real(e_);
    if (real == nullptr) return false;
    if (std::all_of(real->values.begin(), real->values.end(), [](double x) { return x == 0.0; }))
      return true;
    if (type.keyopt[3] == 5) {
      b_.note(e_.at, "{}: its damping is ignored, the part has modal damping (--damping)",
              b_.label(e_));
      return true;
    }
    const bool mass = type.keyopt[3] == 2;
    if (type.keyopt[2] != 0 || (type.keyopt[3] != 4 && !mass))
      return b_.shared_error(
          ErrorCode::unsupported, e_,
          "KEYOPT(2) = {}, KEYOPT(3) = {}: expected a symmetric stiffness (0, 4) or mass (0, 2)",
          type.keyopt[2], type.keyopt[3]);
    for (std::size_t k = matrix_constants; k < real->values.size(); ++k)
      if (real->values[k] != 0.0)
        return b_.error_once(
            ErrorCode::wrong_count, real->at,
            "real constants {}: constant {} is {:g}, expected 78 of a symmetric matrix", e_.real,
            k + 1, real->values[k]);
    // The remainder of the matrix consists of products of its constants.
    for (std::size_t k = 0; k < real->values.size(); ++k)
      if (const double x = real->values[k]; !std::isfinite(1e3 * x * x))
        return b_.error_once(ErrorCode::not_finite, real->at,
                             "real constants {}: constant {} is {:g}, expected a number whose "
                             "square does not overflow",
                             e_.real, k + 1, x);
    if (nodes.size() < 2 || nodes[0] < 0 || nodes[1] < 0 || nodes[0] == nodes[1])
      return b_.error(ErrorCode::missing, e_, "it has no two different nodes");
    nodes_ = {nodes[0], nodes[1]};
    fill(*real);
    return mass ? masses() : split();
  }

 private:
  void fill(const AnsysReal& real) {
    std::size_t k = 0;
    for (int i = 0; i < 12; ++i)
      for (int j = i; j < 12; ++j) K_(i, j) = K_(j, i) = real.value(k++);
    Mat12 T = Mat12::Zero();
    for (int block = 0; block < 4; ++block)
      T.block<3, 3>(3 * block, 3 * block) = b_.nodal_axes(nodes_[block / 2]);
    K_ = (T * K_ * T.transpose()).eval();
    for (int i = 0; i < 12; ++i) {
      double& s = scale_[of_displacement(i) ? 0 : 1];
      s = std::max(s, std::abs(K_(i, i)));
    }
  }

  /// For each node the mass of a rigid point, m I and J; a part may have no other mass.
  bool masses() {
    std::array<PointMass, 2> points;
    Mat12 rest = K_;
    for (int k = 0; k < 2; ++k) {
      PointMass& point = points[k];
      point.node = nodes_[k];
      point.mass = K_.diagonal().segment<3>(6 * k).mean();
      point.J = K_.block<3, 3>(6 * k + 3, 6 * k + 3);
      rest.block<3, 3>(6 * k, 6 * k) -= point.mass * Mat3::Identity();
      rest.block<3, 3>(6 * k + 3, 6 * k + 3).setZero();
    }
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
        if (std::abs(rest(i, j)) > matrix_rounding * std::sqrt(size_of(i) * size_of(j)) &&
            rest(i, j) != 0.0)
          return b_.error(ErrorCode::unsupported, e_,
                          "its mass is not that of a rigid point at each node: expected equal "
                          "masses in three directions, moments of inertia and nothing between the "
                          "nodes, or between displacements and rotations");
    for (const PointMass& point : points)
      if (point.mass < 0.0 || Vec3(point.J.diagonal()).minCoeff() < 0.0)
        return b_.error(ErrorCode::out_of_range, e_,
                        "its mass has a negative term on its diagonal, expected none below 0");
    for (PointMass& point : points) add_ansys_mass(b_, e_, point);
    return true;
  }

  double size_of(int i) const { return scale_[of_displacement(i) ? 0 : 1]; }

  bool split() {
    for (int axis = 0; axis < 3; ++axis) {  // forces of a translation
      const Vec12 f = K_.col(axis) + K_.col(6 + axis);
      for (int i = 0; i < 12; ++i)
        if (std::abs(f(i)) > matrix_rounding * std::sqrt(size_of(i) * scale_[0]))
          return b_.error(ErrorCode::unsupported, e_,
                          "it holds its nodes to the ground: a translation of both has a force in "
                          "it; only stiffness between its nodes is read");
    }
    std::vector<Spring> springs;
    for (const bool displacements : {true, false}) {
      for (;;) {
        int pivot = -1;
        for (int i = 0; i < 12; ++i)
          if (of_displacement(i) == displacements && (pivot < 0 || K_(i, i) > K_(pivot, pivot)))
            pivot = i;
        const double k = K_(pivot, pivot);
        if (!(k > matrix_rounding * size_of(pivot))) break;
        springs.push_back(spring(K_.col(pivot) / k, k));
        const Vec12 c = K_.col(pivot);
        K_ -= c * c.transpose() / k;
        K_.row(pivot).setZero();
        K_.col(pivot).setZero();
      }
      for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j)
          if (of_displacement(i) == displacements &&
              std::abs(K_(i, j)) > std::sqrt(matrix_rounding) * std::sqrt(size_of(i) * size_of(j)))
            return b_.error(ErrorCode::out_of_range, e_,
                            "its stiffness has negative eigenvalues, expected none below 0");
    }
    for (Spring& s : springs) b_.model.springs.push_back(std::move(s));
    return true;
  }

  Spring spring(const Vec12& along, double stiffness) const {
    Spring s;
    s.stiffness = stiffness;
    s.nodes = nodes_;
    s.name = b_.label(e_);
    s.source = e_.at;
    for (int i = 0; i < 12; ++i)
      if (std::abs(along(i)) * std::sqrt(stiffness) > 1e-12 * std::sqrt(size_of(i)))
        s.directions[i / 6](i % 6) = along(i);
    return s;
  }

  AnsysBuild& b_;
  const AnsysElement& e_;
  std::array<int, 2> nodes_{};
  Mat12 K_ = Mat12::Zero();
  std::array<double, 2> scale_{};  ///< largest diagonal entry of displacements, of rotations
};

}  // namespace

bool build_ansys_matrix(AnsysBuild& b, const AnsysElement& e, const AnsysType& type,
                        const std::vector<int>& nodes) {
  return AnsysMatrix(b, e).add(type, nodes);
}

}  // namespace floatframe
