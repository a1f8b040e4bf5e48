#include "floatframe/model/loop_mobility.hpp"

#include <algorithm>
#include <functional>

#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {
namespace {

struct Edge {
  int a = 0, b = 0;  ///< vertices: bodies, the last one the ground
  bool element = false;
  int index = -1;
};

/// Joints that constrain something, then elements that hold two bodies and are not driven.
std::vector<Edge> edges_of(const Model& model) {
  const int ground = std::ssize(model.bodies);
  const auto vertex = [&](int body) { return body < 0 ? ground : body; };
  std::vector<Edge> edges;
  for (int j = 0; j < std::ssize(model.joints); ++j) {
    const Joint& joint = model.joints[j];
    if (joint_velocities(joint.type) < 6)
      edges.push_back({vertex(joint.parent), vertex(joint.child), false, j});
  }
  for (int k = 0; k < std::ssize(model.elements); ++k)
    if (const Element& e = model.elements[k]; e.links() && !e.driven)
      for (std::size_t i = 1; i < e.markers.size(); ++i)
        edges.push_back({vertex(model.markers[e.markers[0]].body),
                         vertex(model.markers[e.markers[i]].body), true, k});
  return edges;
}

/// The edges of each block (biconnected component) of the graph, by depth-first search without
/// recursion.
std::vector<std::vector<int>> blocks_of(const std::vector<Edge>& edges, int vertices) {
  std::vector<std::vector<int>> at(vertices), blocks;
  for (int e = 0; e < std::ssize(edges); ++e) {
    if (edges[e].a == edges[e].b) continue;
    at[edges[e].a].push_back(e);
    at[edges[e].b].push_back(e);
  }
  std::vector<int> depth(vertices, -1), low(vertices, 0), next(vertices, 0), stack,
      by(vertices, -1);
  std::vector<char> used(edges.size(), 0);
  for (int root = 0; root < vertices; ++root) {
    if (depth[root] >= 0) continue;
    std::vector<int> way{root};
    depth[root] = low[root] = 0;
    while (!way.empty()) {
      const int v = way.back();
      if (next[v] < std::ssize(at[v])) {
        const int e = at[v][next[v]++];
        if (used[e]) continue;
        used[e] = 1;
        stack.push_back(e);
        const int w = edges[e].a == v ? edges[e].b : edges[e].a;
        if (depth[w] >= 0) {
          low[v] = std::min(low[v], depth[w]);
          continue;
        }
        depth[w] = low[w] = depth[v] + 1;
        by[w] = e;
        way.push_back(w);
        continue;
      }
      way.pop_back();
      if (way.empty()) break;
      const int parent = way.back();
      low[parent] = std::min(low[parent], low[v]);
      if (low[v] < depth[parent]) continue;
      std::vector<int>& block = blocks.emplace_back();
      do {
        block.push_back(stack.back());
        stack.pop_back();
      } while (block.back() != by[v]);
    }
  }
  return blocks;
}

}  // namespace

std::vector<LoopBlock> loop_blocks(const Model& model) {
  const std::vector<Edge> edges = edges_of(model);
  const int ground = std::ssize(model.bodies);
  std::vector<std::vector<int>> found = blocks_of(edges, ground + 1);
  std::erase_if(found, [](const std::vector<int>& block) { return block.size() < 2; });
  for (std::vector<int>& block : found) std::sort(block.begin(), block.end());
  std::sort(found.begin(), found.end());
  std::vector<LoopBlock> blocks;
  for (const std::vector<int>& of : found) {
    LoopBlock& block = blocks.emplace_back();
    for (const int e : of) {
      (edges[e].element ? block.elements : block.joints).push_back(edges[e].index);
      for (const int v : {edges[e].a, edges[e].b}) {
        block.grounded = block.grounded || v == ground;
        if (v != ground) block.bodies.push_back(v);
      }
    }
    std::sort(block.bodies.begin(), block.bodies.end());
    block.bodies.erase(std::unique(block.bodies.begin(), block.bodies.end()), block.bodies.end());
  }
  return blocks;
}

Pose design_pose(const Model& model, int marker) {
  const Marker& m = model.markers[marker];
  if (m.body < 0) return m.X_NM;
  const Body& body = model.bodies[m.body];
  Pose X_BM = m.X_NM;
  if (m.node >= 0) X_BM.p += body.data->nodes[m.node].p;
  return body.X_WB * X_BM;
}

LoopMobility::LoopMobility(const Model& model, const LoopBlock& block,
                           const std::vector<JointPlace>& places, double size, bool bends)
    : size_(size) {
  std::vector<int> place_of(model.bodies.size(), -1);
  for (int i = 0; i < std::ssize(block.bodies); ++i) {
    const Body& body = model.bodies[block.bodies[i]];
    place_of[block.bodies[i]] = i;
    start_.push_back(body.X_WB);
    const bool held = i == 0 && !block.grounded;
    first_.push_back(held ? -1 : columns_);
    if (!held) columns_ += 6 + (bends ? body.modes() : 0);
  }
  const auto socket = [&](int marker, const Pose& X_WM) {
    const Marker& m = model.markers[marker];
    Socket& s = sockets_.emplace_back();
    s.X_BM = X_WM;
    if (m.body < 0) return;
    const Body& body = model.bodies[m.body];
    s.place = place_of[m.body];
    s.X_BM = body.X_WB.inverse() * X_WM;
    if (!bends || m.node < 0) return;
    const ModalNode& node = body.data->nodes[m.node];
    s.X_theta = node.X_theta;
    s.X = node.X - skew(s.X_BM.p - node.p) * s.X_theta;
  };
  const auto renumbered = [&](std::vector<ConstraintPart> parts) {
    const int b = std::ssize(sockets_) - 1;
    for (ConstraintPart& p : parts) {
      p.a = b - 1;
      p.b = b;
      if (!constraint_kind(p.type).points) p.scale = size;
      rows_ += p.rows();
      parts_.push_back(p);
    }
  };
  for (std::size_t k = 0; k < block.joints.size(); ++k) {
    Joint joint = model.joints[block.joints[k]];
    joint.axis_2 = places[k].axis_2;
    std::vector<ConstraintPart> parts;
    JointParts collected(joint, block.joints[k], size, parts);
    joint_kind(joint.type).parts(collected);
    socket(joint.frame_F, {places[k].p, places[k].R});
    socket(joint.frame_M, {places[k].p, places[k].R});
    renumbered(parts);
  }
  for (const int k : block.elements) {
    std::vector<ConstraintPart> parts;
    append_element_parts(model, k, parts);
    // A rod of another length than drawn is fitted before: what it leaves free is as if it fitted.
    for (ConstraintPart& p : parts)
      if (constraint_kind(p.type).gradients == PartGradients::line)
        p.scale = std::max((design_pose(model, p.b).p - design_pose(model, p.a).p).norm(), 1e-9);
    for (const int marker : model.elements[k].markers) socket(marker, design_pose(model, marker));
    renumbered(parts);
  }
  pose_ = start_;
  states_.resize(sockets_.size());
  for (MarkerState& s : states_)
    for (Vec3* v : {&s.v, &s.w, &s.a_bias, &s.alpha_bias}) v->setZero();
  evaluate();
}

void LoopMobility::evaluate() {
  J_ = MatX::Zero(rows_, columns_);
  phi_ = VecX::Zero(rows_);
  for (std::size_t k = 0; k < sockets_.size(); ++k) {
    const Socket& s = sockets_[k];
    const Pose X = s.place < 0 ? s.X_BM : pose_[s.place] * s.X_BM;
    states_[k].r = X.p;
    states_[k].R = X.R;
  }
  ConstraintRow found[3];
  int row = 0;
  for (const ConstraintPart& p : parts_) {
    evaluate_constraint(p, states_[p.a], states_[p.b], 0.0, found);
    for (int r = 0; r < p.rows(); ++r, ++row) {
      phi_[row] = found[r].phi;
      const WrenchRow& g = found[r].gradient;
      for (const auto& [k, F, T] : {std::tuple(p.a, g.a.F, g.a.T), std::tuple(p.b, g.b.F, g.b.T)}) {
        const Socket& s = sockets_[k];
        if (s.place < 0 || first_[s.place] < 0) continue;
        const int c = first_[s.place];
        const Pose& X_WB = pose_[s.place];
        J_.block<1, 3>(row, c) += F.transpose();
        J_.block<1, 3>(row, c + 3) += (T + (states_[k].r - X_WB.p).cross(F)).transpose() / size_;
        const Eigen::Index modes = s.X.cols();
        if (modes == 0) continue;
        J_.block(row, c + 6, 1, modes) +=
            F.transpose() * X_WB.R * s.X + T.transpose() * X_WB.R * s.X_theta;
      }
    }
  }
}

void LoopMobility::start_at(std::vector<Pose> poses) {
  pose_ = start_ = std::move(poses);
  evaluate();
}

double LoopMobility::misfit() {
  pose_ = start_;
  evaluate();
  return largest(phi_) / size_;
}

MatX LoopMobility::motions(double threshold) const {
  if (columns_ == 0) return MatX::Zero(0, 0);
  if (rows_ == 0) return MatX::Identity(columns_, columns_);
  const PivotedQr qr = pivoted_qr(J_.transpose(), threshold);
  return qr.Q.rightCols(columns_ - qr.rank);
}

void LoopMobility::move(const VecX& x) {
  for (std::size_t i = 0; i < pose_.size(); ++i) {
    if (first_[i] < 0) continue;
    pose_[i].p += x.segment<3>(first_[i]);
    pose_[i].R = rotation_exp(x.segment<3>(first_[i] + 3) / size_) * pose_[i].R;
  }
  evaluate();
}

/// Newton's method with the least motion, which is added to `way`.
bool LoopMobility::close(VecX& way) {
  for (int pass = 0; pass < 8; ++pass) {
    if (largest(phi_) < 1e-12 * size_) return true;
    const VecX x = -LeastNorm(J_, 1e-8).solve(phi_);
    way += x;
    move(x);
  }
  return largest(phi_) < 1e-10 * size_;
}

/// Displacement of the body that moves most.
double LoopMobility::farthest(const VecX& x) const {
  double most = 0.0;
  for (std::size_t b = 0; b < pose_.size(); ++b)
    if (first_[b] >= 0) most = std::max(most, x.segment<6>(first_[b]).norm());
  return most;
}

int LoopMobility::free(double nearly) const { return motions(nearly).cols(); }

int LoopMobility::lasting(const MatX& others, double nearly, bool onward) {
  constexpr int steps = 5;
  constexpr double step = 0.02, apart = 0.1, returned = 0.2;
  pose_ = start_;
  evaluate();
  const MatX N = motions(nearly);
  if (N.cols() == 0) return 0;
  const MatX more = N - others * (others.transpose() * N);
  const PivotedQr qr = pivoted_qr(more);
  int best = 0;
  for (Eigen::Index k = 0; k < qr.diagonal.size() && std::abs(qr.diagonal[k]) > apart; ++k) {
    pose_ = start_;
    evaluate();
    VecX d = N * (N.transpose() * qr.Q.col(k));
    int least = N.cols();
    for (int i = 0; i < steps; ++i) {
      const double most = farthest(d);
      if (!(most > 0.0)) break;
      VecX way = d * (step * size_ / most);
      move(way);
      if (!close(way) || (onward && farthest(way) < returned * step * size_)) {
        least = 0;
        break;
      }
      const MatX free = motions(nearly);
      least = std::min<int>(least, free.cols());
      d = free * (free.transpose() * d).eval();
    }
    best = std::max(best, least);
  }
  return best;
}

}  // namespace floatframe
