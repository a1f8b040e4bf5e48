// Load time of the absolute formulation: outer points, numbers of coordinates, start values.
#include "floatframe/formulation/absolute.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "floatframe/formulation/equations_of_motion.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

static_assert(EquationsOfMotion<AbsoluteFormulation>);

namespace {

std::vector<int> all_joints(const Model& model) {
  std::vector<int> joints(model.joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  return joints;
}

}  // namespace

AbsoluteFormulation::AbsoluteFormulation(const Model& model, InertiaMethod method)
    : Formulation(model, all_joints(model)) {
  for (const Marker& m : model_.markers) {
    MarkerData d;
    static_cast<LocalMarker&>(d) = LocalMarker(model_, m);
    markers_.push_back(std::move(d));
  }
  place_outer_points();
  number_coordinates(method);
  make_factors();
  for (const BodyData& b : bodies_) show_body(b.A, b.w_WB, b.y, b.yd, a_.data() + b.offset + 12);
  for (const MarkerData& m : markers_) show_marker(m.s, m);
}

/// Outer points: where a constraint uses the position of a deforming node. Joints at one node share
/// the point. `MarkerData::point` is its number on the body.
void AbsoluteFormulation::place_outer_points() {
  bodies_.resize(model_.bodies.size());
  for (const ConstraintPart& p : constraint_set_.parts()) {
    if (!constraint_kind(p.type).points) continue;
    for (const int marker : {p.a, p.b}) {
      MarkerData& m = markers_[marker];
      if (m.body < 0 || !m.local || m.point >= 0) continue;
      BodyData& b = bodies_[m.body];
      int local = -1;
      for (std::size_t k = 0; k < b.point_marker.size(); ++k) {
        const MarkerData& other = markers_[b.point_marker[k]];
        if ((other.node_p - m.node_p).isZero(0.0) && (other.X - m.X).isZero(0.0) &&
            other.X_NM.p.isZero(0.0) && m.X_NM.p.isZero(0.0))
          local = static_cast<int>(k);
      }
      if (local < 0) {
        local = static_cast<int>(b.point_marker.size());
        b.point_marker.push_back(marker);
      }
      m.point = local;
    }
  }
}

/// Coordinates and constraint rows body by body, then the rows of the parts.
void AbsoluteFormulation::number_coordinates(InertiaMethod method) {
  int rows = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyData& b = bodies_[i];
    const Body& m = model_.bodies[i];
    b.nm = m.modes();
    b.points = static_cast<int>(b.point_marker.size());
    b.length = m.length;
    b.offset = nq_;
    nq_ += b.size();
    b.row = rows;
    rows += b.rows();
    b.y = b.yd = VecX::Zero(b.nm);
    b.inertia = BodyInertia(m, method);
    if (b.inertia.second_order()) b.K_G = MatX::Zero(b.nm, b.nm);
    second_order_ = second_order_ || b.inertia.second_order();
    stiffens_ = stiffens_ || m.stiffens();
    b.M = MatX::Zero(12 + b.nm, 12 + b.nm);
    b.Qv = b.work = VecX::Zero(12 + b.nm);
  }
  for (MarkerData& m : markers_)
    if (m.point >= 0) m.point = bodies_[m.body].offset + 12 + bodies_[m.body].nm + 3 * m.point;
  constraint_set_.number_rows(rows);
  a_ = omega2_ = VecX::Zero(nq_);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    omega2_.segment(bodies_[i].offset + 12, bodies_[i].nm) =
        bodies_[i].inertia.own_frequencies_squared(model_.bodies[i].data->K);
}

/// True if some motion z of the undeformed body has almost no mass: rotations compared with the
/// largest inertia, since the principal axes are arbitrary relative to the world axes; modes
/// compared with the mass of the body at the displacement of its markers.
bool AbsoluteFormulation::lacks_mass(int i) {
  BodyData& b = bodies_[i];
  b.A.setIdentity();
  b.Adot.setZero();
  b.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), b.M, b.Qv);
  MatX M = MatX::Zero(6 + b.nm, 6 + b.nm);
  add_mass(b, 1.0, Mat3::Zero(), M);
  VecX scale = M.diagonal();
  scale.segment<3>(3).setConstant(scale.segment<3>(3).maxCoeff());
  constexpr double enough = 1e-8;
  for (int k = 0; k < b.nm; ++k) {
    double reach = 0.0;
    for (const MarkerData& m : markers_)
      if (m.body == i)
        reach = std::max({reach, m.X.col(k).squaredNorm(),
                          b.length * b.length * m.X_theta.col(k).squaredNorm()});
    if (!(scale[6 + k] > enough * b.M(0, 0) * reach)) return true;
  }
  if (!(scale.minCoeff() > 0.0)) return true;
  scale = scale.cwiseSqrt().cwiseInverse().eval();
  M = (scale.asDiagonal() * M * scale.asDiagonal()).eval();
  return !(symmetric_eigenvalues(M).minCoeff() > enough);
}

/// Memory of the factorised tangents: a block per body, coupled by parts or forces between two.
void AbsoluteFormulation::make_factors() {
  std::vector<BlockLdlt::Block> blocks;
  std::vector<int> rank(bodies_.size(), 0);
  int widest = 6;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const int size = 6 + bodies_[i].nm;
    blocks.push_back({.size = size,
                      .chooses = lacks_mass(static_cast<int>(i)),
                      .mass = model_.bodies[i].data->invariants.m});
    if (bodies_[i].M.isZero(0.0)) omega2_.segment<12>(bodies_[i].offset).setConstant(no_inertia);
    widest = std::max(widest, size);
  }
  std::vector<std::pair<int, int>> edges;
  const auto body_of = [&](int marker) { return marker < 0 ? -1 : markers_[marker].body; };
  const auto couple = [&](int a, int b) {
    if (body_of(a) >= 0 && body_of(b) >= 0) edges.emplace_back(body_of(a), body_of(b));
  };
  for (const ConstraintPart& p : constraint_set_.parts()) couple(p.a, p.b);
  for (const Force& f : model_.forces) couple(f.a, f.b);
  std::vector<int> rows(bodies_.size(), 0), on_ground = rows;
  for (const ConstraintPart& p : constraint_set_.parts()) {
    const int a = body_of(p.a), b = body_of(p.b);
    for (const int body : {a, b}) {
      if (body < 0) continue;
      rows[body] += p.rows();
      if (a < 0 || b < 0) on_ground[body] += p.rows();
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    blocks[i].held = rows[i] >= 6 && on_ground[i] > 0;
  const std::vector<int> order = BlockLdlt::elimination_order(blocks, edges);
  for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = static_cast<int>(k);
  for (const ConstraintPart& p : constraint_set_.parts()) {
    PartPlace place;
    const int a = body_of(p.a), b = body_of(p.b);
    place.home = a < 0 || (b >= 0 && rank[b] < rank[a]) ? b : a;
    if (place.home >= 0) {
      BlockLdlt::Block& home = blocks[place.home];
      place.at = home.size + home.inner;
      home.inner += p.rows();
    }
    for (const int body : {a, b})
      if (body >= 0 && blocks[body].chooses)
        place.turns = constraint_kind(p.type).gradients == PartGradients::general;
    places_.push_back(place);
  }
  for (Factors& f : factors_) f.matrix = BlockLdlt(blocks, edges);
  ga_.z = gb_.z = VecX::Zero(widest);
  motions_[0] = motions_[1] = product_ = MatX::Zero(widest, 6);
  unknowns_ = VecX::Zero(factors_[0].matrix.unknowns());
  assert(places_.size() == constraint_set_.parts().size());
  correction_ = VecX::Zero(nq_);
  across_ = VecX::Zero(constraints());
}

void AbsoluteFormulation::start_from(RelativeFormulation& tree, const VecX& tree_q,
                                     const VecX& tree_v, VecX& q, VecX& v) {
  q = v = VecX::Zero(nq_);
  assert(tree_q.size() == tree.configurations() && tree_v.size() == tree.velocities());
  tree.positions(0.0, tree_q);
  tree.velocities(tree_v);
  tree.forces();
  const SystemMotion& motion = tree.motion();
  for (std::size_t k = 0; k < model_.forces.size(); ++k)
    if (model_.forces[k].rotational) force_set_.set_angle(k, motion.forces[k].length);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyData& b = bodies_[i];
    const BodyKinematics& from = motion.bodies[i];
    const Mat3 Adot = skew(from.w_WB) * from.R_WB;
    q.segment<3>(b.offset) = from.p_WB;
    v.segment<3>(b.offset) = from.v_WB;
    for (int c = 0; c < 3; ++c) {
      q.segment<3>(b.offset + 3 + 3 * c) = from.R_WB.col(c);
      v.segment<3>(b.offset + 3 + 3 * c) = Adot.col(c);
    }
    q.segment(b.offset + 12, b.nm) = from.y;
    v.segment(b.offset + 12, b.nm) = from.yd;
    for (int p = 0; p < b.points; ++p) {
      const int marker = b.point_marker[p];
      q.segment<3>(b.offset + 12 + b.nm + 3 * p) = motion.place(marker);
      v.segment<3>(b.offset + 12 + b.nm + 3 * p) = motion.marker(marker).v;
    }
  }
}

}  // namespace floatframe
