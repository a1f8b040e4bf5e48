// Load time of the tangent of the absolute formulation: memory of the factors.
#include <algorithm>

#include "floatframe/formulation/absolute_tangent.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

/// True if some motion z of the undeformed body has almost no mass: rotations compared with the
/// largest inertia, since the principal axes are arbitrary relative to the world axes; modes
/// compared with the mass of the body at the displacement of its markers.
bool AbsoluteTangent::lacks_mass(int body) const {
  const AbsoluteBody& b = bodies_[body];
  MatX M = MatX::Zero(6 + b.nm, 6 + b.nm);
  add_mass(body, 1.0, Mat3::Zero(), M);
  VecX scale = M.diagonal();
  scale.segment<3>(3).setConstant(scale.segment<3>(3).maxCoeff());
  constexpr double enough = 1e-8;
  for (int k = 0; k < b.nm; ++k) {
    double reach = 0.0;
    for (const AbsoluteMarker& m : markers_)
      if (m.body == body)
        reach = std::max({reach, m.X.col(k).squaredNorm(),
                          b.length * b.length * m.X_theta.col(k).squaredNorm()});
    if (!(scale[6 + k] > enough * terms_[body].M(0, 0) * reach)) return true;
  }
  if (!(scale.minCoeff() > 0.0)) return true;
  scale = scale.cwiseSqrt().cwiseInverse().eval();
  M = (scale.asDiagonal() * M * scale.asDiagonal()).eval();
  return !(symmetric_eigenvalues(M).minCoeff() > enough);
}

/// A block per body, coupled by parts or forces between two.
AbsoluteTangent::AbsoluteTangent(const AbsoluteKinematics& kinematics,
                                 const ConstraintSet& constraints, const ElementSet& forces,
                                 const std::vector<BodyTerms>& terms)
    : model_(kinematics.model()),
      kinematics_(kinematics),
      bodies_(kinematics.bodies()),
      markers_(kinematics.markers()),
      constraints_(constraints),
      forces_(forces),
      terms_(terms) {
  std::vector<BlockLdlt::Block> blocks;
  std::vector<int> rank(bodies_.size(), 0);
  int widest = 6;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const int size = 6 + bodies_[i].nm;
    blocks.push_back({.size = size,
                      .chooses = lacks_mass(static_cast<int>(i)),
                      .mass = model_.bodies[i].data->invariants.m});
    widest = std::max(widest, size);
    const bool bends_twice = terms_[i].inertia.second_order() != nullptr;
    K_G_.push_back(bends_twice ? MatX::Zero(bodies_[i].nm, bodies_[i].nm) : MatX());
    second_order_ = second_order_ || bends_twice;
  }
  std::vector<std::pair<int, int>> edges;
  const auto body_of = [&](int marker) { return marker < 0 ? -1 : markers_[marker].body; };
  const auto couple = [&](int a, int b) {
    if (body_of(a) >= 0 && body_of(b) >= 0) edges.emplace_back(body_of(a), body_of(b));
  };
  std::size_t most_markers = 2;
  for (const Element& e : model_.elements) {
    most_markers = std::max(most_markers, e.markers.size());
    for (std::size_t i = 0; !e.reads && i < e.markers.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) couple(e.markers[j], e.markers[i]);
  }
  std::vector<int> rows(bodies_.size(), 0), on_ground = rows;
  for (const ConstraintPart& p : constraints_.parts()) {
    couple(p.a, p.b);
    const int a = body_of(p.a), b = body_of(p.b);
    for (const int body : {a, b}) {
      if (body < 0 || p.apart) continue;
      rows[body] += p.rows();
      if (a < 0 || b < 0) on_ground[body] += p.rows();
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    blocks[i].held = rows[i] >= 6 && on_ground[i] > 0;
  const std::vector<int> order = BlockLdlt::elimination_order(blocks, edges);
  for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = static_cast<int>(k);
  for (std::size_t k = 0; k < constraints_.parts().size(); ++k) {
    const ConstraintPart& p = constraints_.parts()[k];
    PartPlace& place = places_.emplace_back();
    for (const int body : {body_of(p.a), body_of(p.b)})
      if (body >= 0 && blocks[body].chooses)
        place.turns = constraint_kind(p.type).gradients == PartGradients::general;
    if (p.continues) continue;
    place.markers = constraints_.markers(k);
    most_markers = std::max(most_markers, place.markers.size());
    for (const int marker : place.markers) {
      const int body = body_of(marker);
      if (body >= 0 && (place.home < 0 || rank[body] < rank[place.home])) place.home = body;
    }
    if (place.home < 0) continue;
    BlockLdlt::Block& home = blocks[place.home];
    place.at = home.size + home.inner;
    home.inner += p.rows();
  }
  row_.resize(most_markers);
  factors_[0] = factors_[1] = BlockLdlt(blocks, edges);
  gradients_.assign(most_markers, {-1, VecX::Zero(widest)});
  motions_[0] = motions_[1] = product_ = MatX::Zero(widest, 6);
  unknowns_ = VecX::Zero(factors_[0].unknowns());
  correction_ = VecX::Zero(kinematics_.size());
  across_ = VecX::Zero(constraints_.count());
}

}  // namespace floatframe
