#include "floatframe/body/with_modes.hpp"

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/body_stress.hpp"

namespace floatframe {
namespace {

/// A fixed-size or dynamic matrix with some of its columns.
template <class M>
M columns(const M& x, const std::vector<int>& keep) {
  return x(Eigen::all, keep);
}

MatX block(const MatX& x, const std::vector<int>& keep) { return x(keep, keep); }

/// Of the blocks h of the nodes, one below the other.
MatX blocks(const MatX& h, const std::vector<int>& keep) {
  const Eigen::Index old = h.cols(), nm = static_cast<Eigen::Index>(keep.size());
  MatX out(h.rows() / old * nm, nm);
  for (Eigen::Index b = 0; b < h.rows() / old; ++b)
    out.middleRows(b * nm, nm) = block(h.middleRows(b * old, old), keep);
  return out;
}

std::shared_ptr<const SecondOrder> kept(const SecondOrder& all, const std::vector<int>& keep) {
  auto out = std::make_shared<SecondOrder>(all);
  for (std::size_t j = 0; j < 3; ++j) {
    out->S2[j] = block(all.S2[j], keep);
    for (std::size_t i = 0; i < 3; ++i) out->S2i[i][j] = block(all.S2i[i][j], keep);
    for (SecondOrderNode& node : out->nodes) {
      node.h[j] = block(node.h[j], keep);
      node.theta[j] = block(node.theta[j], keep);
    }
  }
  return out;
}

}  // namespace

FlexibleBody with_modes(const FlexibleBody& body, const std::vector<int>& keep) {
  FlexibleBody out = body;
  InertiaInvariants& v = out.invariants;
  v.S = columns(v.S, keep);
  for (std::size_t i = 0; i < 3; ++i) {
    v.Si[i] = columns(v.Si[i], keep);
    for (std::size_t j = 0; j < 3; ++j) v.Sij[i][j] = block(v.Sij[i][j], keep);
  }
  out.K = block(body.K, keep);
  out.D = body.D.size() > 0 ? block(body.D, keep) : body.D;
  for (ModalNode& node : out.nodes) {
    node.X = columns(node.X, keep);
    node.X_theta = columns(node.X_theta, keep);
  }
  // The dynamic modes are the last ones, in the order of their frequencies.
  const auto dynamic = static_cast<int>(body.fixed_interface_frequencies.size());
  std::vector<double> frequencies;
  for (const int k : keep)
    if (k >= body.modes() - dynamic)
      frequencies.push_back(body.fixed_interface_frequencies[k - (body.modes() - dynamic)]);
  out.fixed_interface_frequencies =
      Eigen::Map<VecX>(frequencies.data(), static_cast<Eigen::Index>(frequencies.size()));
  out.mode_names.clear();
  for (const int k : keep)
    if (static_cast<std::size_t>(k) < body.mode_names.size())
      out.mode_names.push_back(body.mode_names[k]);
  if (body.shape && body.shape->modes.size() > 0) {
    auto shape = std::make_shared<BodyShape>(*body.shape);
    shape->modes = columns(shape->modes, keep);
    out.shape = shape;
  }
  if (body.stress)
    out.stress = std::make_shared<const BodyStress>(with_kept_modes(*body.stress, body, keep));
  if (keep.empty()) out.turning = out.second_order = nullptr;
  if (out.turning) out.turning = kept(*out.turning, keep);
  if (out.second_order) out.second_order = kept(*out.second_order, keep);
  if (keep.empty()) {
    out.projection = nullptr;
  } else if (body.projection) {
    auto data = std::make_shared<ProjectionData>(*body.projection);
    data->X = columns(data->X, keep);
    if (data->X_theta.size() > 0) data->X_theta = columns(data->X_theta, keep);
    if (data->rotations.size() > 0) data->rotations = columns(data->rotations, keep);
    if (data->twist) data->twist = kept(*data->twist, keep);
    if (data->h.size() > 0) data->h = blocks(data->h, keep);
    out.projection = data;
  }
  return out;
}

}  // namespace floatframe
