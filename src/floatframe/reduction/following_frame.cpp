#include "floatframe/reduction/following_frame.hpp"

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/rigid_motion.hpp"

namespace floatframe {
namespace {

/// gamma of the pairs, by the slopes of the chord and those of the ends; per plane
///   1/(30 L) [36 3L -36 3L; 3L 4L^2 -3L -L^2; -36 -3L 36 -3L; 3L -L^2 -3L 4L^2].
void add_shortening(const BentBeam& beam, const BeamSection& section, const ModePair* pairs,
                    Eigen::Index count, Eigen::Ref<VecX> out) {
  const auto& q = beam.q;
  for (const auto& [u, r, sign] : {std::tuple{1, 5, 1.0}, {2, 4, -1.0}}) {
    const VecX s = (q.row(u + 6) - q.row(u)).transpose() / beam.L;
    const VecX f = sign * q.row(r).transpose(), g = sign * q.row(r + 6).transpose();
    const VecX t = f + g;
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto [a, b] = pairs[k];
      out[k] += beam.L / 30.0 *
                (36.0 * s[a] * s[b] - 3.0 * (s[a] * t[b] + t[a] * s[b]) +
                 4.0 * (f[a] * f[b] + g[a] * g[b]) - (f[a] * g[b] + g[a] * f[b]));
    }
  }
  const double polar = (section.Iy + section.Iz) / (section.A * beam.L);
  const VecX twist = (q.row(9) - q.row(3)).transpose();
  for (Eigen::Index k = 0; k < count; ++k) out[k] += polar * twist[pairs[k].a] * twist[pairs[k].b];
}

/// tau of the pairs: int v' w'' - w' v'' dx = 2 v_c (w'_1 - w'_0) - 2 w_c (v'_1 - v'_0)
/// - (v'_0 w'_1 - v'_1 w'_0), slopes of the chord v_c, w_c and of the ends 0, 1.
void add_twist(const BentBeam& beam, const ModePair* pairs, Eigen::Index count,
               Eigen::Ref<VecX> out) {
  const auto& q = beam.q;
  const VecX v = (q.row(7) - q.row(1)).transpose() / beam.L, v0 = q.row(5).transpose(),
             v1 = q.row(11).transpose(), w = (q.row(8) - q.row(2)).transpose() / beam.L,
             w0 = -q.row(4).transpose(), w1 = -q.row(10).transpose();
  const auto of = [&](Eigen::Index a, Eigen::Index b) {
    return 2.0 * v[a] * (w1[b] - w0[b]) - 2.0 * w[b] * (v1[a] - v0[a]) -
           (v0[a] * w1[b] - v1[a] * w0[b]);
  };
  for (Eigen::Index k = 0; k < count; ++k)
    out[k] += 0.5 * (of(pairs[k].a, pairs[k].b) + of(pairs[k].b, pairs[k].a));
}

}  // namespace

BentBeam::BentBeam(const ElementInput& in, const FeElement& e, const MatX& X)
    : L((in.p[1] - in.p[0]).norm()), T(beam_axes(in)), q(12, X.cols()) {
  for (int a = 0; a < 4; ++a)
    q.middleRows<3>(3 * a) = T.transpose() * X.middleRows<3>(6 * e.nodes[a / 2] + 3 * (a % 2));
}

Mat3X BentBeam::rotation(double s) const {
  const double s2 = s * s;
  const double d[4] = {(-6 * s + 6 * s2) / L, 1 - 4 * s + 3 * s2, (6 * s - 6 * s2) / L,
                       3 * s2 - 2 * s};
  Mat3X r(3, q.cols());
  r.row(0) = (1 - s) * q.row(3) + s * q.row(9);
  r.row(1) = -d[0] * q.row(2) + d[1] * q.row(4) - d[2] * q.row(8) + d[3] * q.row(10);
  r.row(2) = d[0] * q.row(1) + d[1] * q.row(5) + d[2] * q.row(7) + d[3] * q.row(11);
  return r;
}

Eigen::Matrix<double, 2, Eigen::Dynamic> BentBeam::curvature(double s) const {
  const double d[4] = {(-6 + 12 * s) / (L * L), (-4 + 6 * s) / L, (6 - 12 * s) / (L * L),
                       (6 * s - 2) / L};
  Eigen::Matrix<double, 2, Eigen::Dynamic> k(2, q.cols());
  k.row(0) = -d[0] * q.row(2) + d[1] * q.row(4) - d[2] * q.row(8) + d[3] * q.row(10);
  k.row(1) = d[0] * q.row(1) + d[1] * q.row(5) + d[2] * q.row(7) + d[3] * q.row(11);
  return k;
}

std::vector<ModePair> mode_pairs(Eigen::Index modes) {
  std::vector<ModePair> pairs;
  for (Eigen::Index a = 0; a < modes; ++a)
    for (Eigen::Index b = 0; b <= a; ++b) pairs.push_back({a, b});
  return pairs;
}

FollowingFrame::FollowingFrame(const FeModel& model, const MatX& X, std::vector<int> held)
    : model_(model), X_(X), held_(std::move(held)) {
  if (held_.size() == 6) find_tree();
  if (tree_) return;
  const SparseMatrix K = assemble_stiffness(model_);
  const SparseMatrix no_mass(K.rows(), K.cols());
  try {
    fixed_ = std::make_unique<FixedInterface>(K, no_mass, std::vector<int>{}, held_,
                                              [](int) { return std::string(); });
  } catch (const InputError&) {
    fixed_ = nullptr;  // very many elements: the modes went another way (bar_chains.hpp)
  }
}

/// From the first node to all others; if it is not a tree, the frame has loops or pieces.
void FollowingFrame::find_tree() {
  const std::size_t nodes = model_.positions.size();
  if (model_.elements.size() + 1 != nodes) return;
  std::vector<std::vector<int>> at(nodes);
  for (std::size_t e = 0; e < model_.elements.size(); ++e)
    for (int k = 0; k < 2; ++k) at[model_.elements[e].nodes[k]].push_back(static_cast<int>(e));
  std::vector<char> seen(nodes, 0);
  std::vector<int> next = {0};
  seen[0] = 1;
  for (std::size_t i = 0; i < next.size(); ++i) {
    const int from = next[i];
    for (const int e : at[from]) {
      const auto& ends = model_.elements[e].nodes;
      const bool outward = ends[0] == from;
      const int to = ends[outward ? 1 : 0];
      if (seen[to] != 0) continue;
      seen[to] = 1;
      next.push_back(to);
      steps_.push_back({e, from, to, outward ? 1.0 : -1.0});
    }
  }
  tree_ = next.size() == nodes;
}

/// A row for each element.
MatX FollowingFrame::strains(Strain strain, const std::vector<ModePair>& pairs, std::size_t first,
                             std::size_t count) const {
  const auto n = static_cast<Eigen::Index>(count);
  MatX out = MatX::Zero(n, static_cast<Eigen::Index>(model_.elements.size()));
  for (std::size_t e = 0; e < model_.elements.size(); ++e) {
    const ElementInput in = gather(model_, model_.elements[e]);
    const BentBeam beam(in, model_.elements[e], X_);
    const auto column = static_cast<Eigen::Index>(e);
    if (strain == Strain::twist)
      add_twist(beam, &pairs[first], n, out.col(column));
    else
      add_shortening(beam, in.section, &pairs[first], n, out.col(column));
  }
  return out;
}

/// Moves the strain-free frame as a rigid body so that six dofs are at rest.
void FollowingFrame::hold(MatX& h) const {
  Mat6 A;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const int dof = held_[i];
    A.row(i) = rigid_motion_at(model_.positions[dof / 6]).row(dof % 6);
  }
  const MatX q = lu_solve(A, MatX(-h(held_, Eigen::all)));
  for (int k = 0; k < model_.nodes(); ++k)
    h.middleRows<6>(6 * k) += rigid_motion_at(model_.positions[k]) * q;
}

MatX FollowingFrame::follow(Strain strain, const std::vector<ModePair>& pairs, std::size_t first,
                            std::size_t count) const {
  const bool twist = strain == Strain::twist;
  const MatX of_element = strains(strain, pairs, first, count);
  MatX out = MatX::Zero(6 * model_.nodes(), static_cast<Eigen::Index>(count));
  if (of_element.isZero(0.0)) return out;
  if (tree_) {
    for (const Step& s : steps_) {
      const Vec3 x = s.sign * beam_axes(gather(model_, model_.elements[s.element])).col(0);
      const Vec3 arm = model_.positions[s.to] - model_.positions[s.from];
      const MatX theta = out.middleRows<3>(6 * s.from + 3);
      out.middleRows<3>(6 * s.to) = out.middleRows<3>(6 * s.from) - skew(arm) * theta;
      out.middleRows<3>(6 * s.to + 3) = theta;
      const auto strain_row = of_element.col(s.element).transpose();
      if (twist)
        out.middleRows<3>(6 * s.to + 3) += x * strain_row;
      else
        out.middleRows<3>(6 * s.to) -= x * strain_row;
    }
    hold(out);
    return out;
  }
  for (std::size_t e = 0; e < model_.elements.size(); ++e) {
    const FeElement& element = model_.elements[e];
    const ElementInput in = gather(model_, element);
    const double L = (in.p[1] - in.p[0]).norm();
    const Material& m = in.material;
    const double stiffness = (twist ? -m.shear() * in.section.J : m.young * in.section.A) / L;
    const Vec3 force = stiffness * beam_axes(in).col(0);
    const auto strain_row = of_element.col(static_cast<Eigen::Index>(e)).transpose();
    const int row = twist ? 3 : 0;
    out.middleRows<3>(6 * element.nodes[0] + row) += force * strain_row;
    out.middleRows<3>(6 * element.nodes[1] + row) -= force * strain_row;
  }
  return fixed_->inner_response(out);
}

}  // namespace floatframe
