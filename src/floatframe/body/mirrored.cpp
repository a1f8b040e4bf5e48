#include "floatframe/body/mirrored.hpp"

#include <cmath>
#include <utility>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/body_stress.hpp"
#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

namespace {

BodyShape mirrored_shape(const BodyShape& shape, const Vec3& s) {
  BodyShape out = shape;
  out.positions = s.asDiagonal() * out.positions;
  for (Eigen::Index r = 0; r < out.modes.rows(); ++r) out.modes.row(r) *= s(r % 3);
  if (s.prod() < 0.0)  // normals stay outward
    for (auto& t : out.triangles) std::swap(t[1], t[2]);
  for (BodyShape::Bar& b : out.bars) b.y = s.cwiseProduct(b.y);
  return out;
}

Vec3 signs_of(const Mat3& P) {
  const Vec3 s = P.diagonal();
  if (P != Mat3(s.asDiagonal()) || s.cwiseAbs() != Vec3::Ones()) {
    throw InputError(ErrorCode::wrong_value, "a mirror must be a diagonal matrix of +1 and -1");
  }
  return s;
}

}  // namespace

BodyShape mirrored(const BodyShape& shape, const Mat3& P) {
  return mirrored_shape(shape, signs_of(P));
}

FlexibleBody mirrored(const FlexibleBody& body, const Mat3& P) {
  const Vec3 s = signs_of(P);
  const Vec3 axial = s.prod() * s;
  FlexibleBody out = body;
  InertiaInvariants& v = out.invariants;
  v.m_u = s.cwiseProduct(v.m_u);
  v.P_u = s.asDiagonal() * v.P_u * s.asDiagonal();
  v.S = s.asDiagonal() * v.S;
  for (int i = 0; i < 3; ++i) {
    v.Si[i] = s(i) * (s.asDiagonal() * v.Si[i]);
    for (int j = 0; j < 3; ++j) v.Sij[i][j] *= s(i) * s(j);
  }
  for (ModalNode& node : out.nodes) {
    node.p = s.cwiseProduct(node.p);
    node.X = s.asDiagonal() * node.X;
    node.X_theta = axial.asDiagonal() * node.X_theta;
  }
  if (body.shape) out.shape = std::make_shared<const BodyShape>(mirrored_shape(*body.shape, s));
  if (body.stress) out.stress = std::make_shared<const BodyStress>(mirrored(*body.stress, s));
  if (body.turning) out.turning = std::make_shared<const SecondOrder>(mirrored(*body.turning, s));
  if (body.second_order)
    out.second_order = std::make_shared<const SecondOrder>(mirrored(*body.second_order, s));
  if (body.projection) {
    auto data = std::make_shared<ProjectionData>(*body.projection);
    data->p = s.asDiagonal() * data->p;
    for (Eigen::Index r = 0; r < data->X.rows(); ++r) data->X.row(r) *= s(r % 3);
    for (Eigen::Index r = 0; r < data->X_theta.rows(); ++r) data->X_theta.row(r) *= axial(r % 3);
    if (data->twist) data->twist = std::make_shared<const SecondOrder>(mirrored(*data->twist, s));
    for (ProjectionData::TurningPoint& t : data->turning) t.arm = s.cwiseProduct(t.arm);
    for (Eigen::Index r = 0; r < data->rotations.rows(); ++r)
      data->rotations.row(r) *= axial(r % 3);
    if (data->h.size() > 0)  // blocks h_1, h_2, h_3 of each node
      for (Eigen::Index b = 0; b < data->h.rows() / data->h.cols(); ++b)
        data->h.middleRows(b * data->h.cols(), data->h.cols()) *= s(b % 3);
    const auto sign = [&](Eigen::Index dof) {
      const Eigen::Index k = dof % 6;
      return k < 3 ? s(k) : axial(k - 3);
    };
    for (Eigen::Index r = 0; r < data->M_6.outerSize(); ++r) {
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(data->M_6, r); it; ++it) {
        it.valueRef() *= sign(it.row()) * sign(it.col());
      }
    }
    out.projection = data;
  }
  return out;
}

}  // namespace floatframe
