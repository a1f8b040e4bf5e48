#include "floatframe/fe/springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/union_find.hpp"

namespace floatframe {
namespace {

/// Dofs that a group of condensed ones may couple: their stiffness is full.
constexpr std::size_t most_tied = 1200;

/// For each node: whether only springs use it, and the axes of dofs held only by springs.
struct SpringOnlyNodes {
  std::vector<char> alone;
  std::vector<unsigned> mask;
  bool has(const Dof& dof) const { return (mask[dof.node] >> dof.axis & 1u) != 0; }
};

bool is_named(const FeModel& model, int node) {
  const std::size_t k = node;
  return k < model.node_names.size() && !model.node_names[k].empty();
}

SpringOnlyNodes spring_only_nodes(const FeModel& model) {
  const std::vector<int> others = dofs_without_springs(model);
  const std::size_t n = model.positions.size();
  SpringOnlyNodes loose{std::vector<char>(n, 0), std::vector<unsigned>(n, 0)};
  for (int k = 0; k < model.nodes(); ++k) {
    const int count = others[k + 1];
    loose.alone[k] = count == 0;
    if (count < 6 && !(count == 0 && is_named(model, k))) loose.mask[k] = count == 0 ? 63u : 56u;
  }
  for (const Spider& s : model.spiders)
    if (s.kind == Spider::Kind::rigid)
      for (const int node : s.nodes) loose.mask[node] &= ~(s.mask & 56u);
  for (const LinearEquation& e : model.equations)
    for (const LinearEquation::Term& t : e.terms) loose.mask[t.node] &= ~(1u << t.axis);
  return loose;
}

/// Axes that a spring has at an end.
unsigned axes_of(const Spring& s, int end) {
  unsigned mask = 0;
  for (int axis = 0; axis < 6; ++axis)
    if (s.directions[end](axis) != 0.0) mask |= 1u << axis;
  return mask;
}

struct DofOrder {
  bool operator()(const Dof& a, const Dof& b) const {
    return a.node != b.node ? a.node < b.node : a.axis < b.axis;
  }
};

/// Springs that share condensed dofs, as one stiffness.
class CondensedSprings {
 public:
  CondensedSprings(const FeModel& model, const SpringOnlyNodes& loose)
      : model_(model), loose_(loose) {}

  void add(const Spring& s) { springs_.push_back(&s); }

  void finish(SpringSystem& out) {
    for (const Spring* s : springs_)
      each(*s, [&](const Dof& dof, double) { (condensed(dof) ? inner_ : outer_)[dof] = 0; });
    if (inner_.size() + outer_.size() > most_tied) {
      const Dof& at = (inner_.empty() ? outer_ : inner_).begin()->first;
      throw InputError(std::vector<ErrorEntry>{
          {model_.mark(springs_.front()->source), ErrorCode::too_large,
           fmt::format(
               "springs tie {} degrees of freedom together through {} and others that nothing else "
               "holds, at most {} can be; give it a mass, or tie it to the part",
               inner_.size() + outer_.size(), model_.node_label(at.node), most_tied)}});
    }
    number(inner_, 0);
    number(outer_, static_cast<int>(inner_.size()));
    const auto ni = static_cast<Eigen::Index>(inner_.size());
    const auto n = ni + static_cast<Eigen::Index>(outer_.size());
    MatX K = MatX::Zero(n, n);
    for (const Spring* s : springs_) {
      VecX d = VecX::Zero(n);
      each(*s, [&](const Dof& dof, double value) {
        d((condensed(dof) ? inner_ : outer_).at(dof)) += value;
      });
      K += s->stiffness * d * d.transpose();
    }
    for (const auto& [dof, place] : inner_) out.condensed.push_back(dof);
    if (outer_.empty()) return;
    SpringBlock block;
    for (const auto& [dof, place] : outer_) block.dofs.push_back(dof);
    block.K = without(K, ni);
    if (!block.K.isZero(0.0)) out.blocks.push_back(std::move(block));
  }

 private:
  using Places = std::map<Dof, int, DofOrder>;

  bool condensed(const Dof& dof) const { return loose_.has(dof); }

  template <class Use>
  void each(const Spring& s, Use&& use) const {
    for (int end = 0; end < 2; ++end)
      for (int axis = 0; axis < 6 && s.nodes[end] >= 0; ++axis)
        if (s.directions[end](axis) != 0.0) use(Dof{s.nodes[end], axis}, s.directions[end](axis));
  }

  static void number(Places& places, int first) {
    for (auto& [dof, place] : places) place = first++;
  }

  /// K_CC - K_CL K_LL^+ K_LC; the first `inner` are L. Scaled by the diagonal, so that lengths and
  /// angles are comparable.
  static MatX without(const MatX& K, Eigen::Index inner) {
    const Eigen::Index outer = K.rows() - inner;
    MatX out = K.bottomRightCorner(outer, outer);
    if (inner == 0) return out;
    VecX scale(inner);
    for (Eigen::Index i = 0; i < inner; ++i)
      scale(i) = K(i, i) > 0.0 ? 1.0 / std::sqrt(K(i, i)) : 0.0;
    const SymmetricEigen e = symmetric_eigen(
        MatX(scale.asDiagonal() * K.topLeftCorner(inner, inner) * scale.asDiagonal()));
    const MatX B = e.vectors.transpose() * (scale.asDiagonal() * K.topRightCorner(inner, outer));
    for (Eigen::Index i = 0; i < inner; ++i)
      if (e.values(i) > 1e-12 * e.values(inner - 1))
        out -= B.row(i).transpose() * B.row(i) / e.values(i);
    // The remainder of springs with a free end is round-off.
    const double size = K.bottomRightCorner(outer, outer).cwiseAbs().maxCoeff();
    return out.unaryExpr([&](double x) { return std::abs(x) > 1e-13 * size ? x : 0.0; });
  }

  const FeModel& model_;
  const SpringOnlyNodes& loose_;
  std::vector<const Spring*> springs_;
  Places inner_, outer_;
};

}  // namespace

void add_bushing(FeModel& model, int a, int b, const Vec3& at, const Mat3& axes, const Vec6& k,
                 const std::string& name, const FeSource& source) {
  const auto arm = [&](int node) {
    const Vec3& p = model.positions[node];
    const Vec3 r = at - p;
    return r.norm() > 1e-9 * (at.norm() + p.norm()) ? r : Vec3(Vec3::Zero());
  };
  for (int i = 0; i < 6; ++i) {
    if (k(i) == 0.0) continue;
    const Vec3 t = axes.col(i % 3);
    Spring s;
    s.nodes = {a, b};
    s.stiffness = k(i);
    s.name = name;
    s.source = source;
    for (int end = 0; end < 2; ++end) {
      if (s.nodes[end] < 0) continue;
      Vec6& d = s.directions[end];
      if (i < 3) {
        d << t, arm(s.nodes[end]).cross(t);  // t . (u + theta x r)
      } else {
        d.tail<3>() = t;
      }
      if (end == 0) d = -d;
    }
    model.springs.push_back(std::move(s));
  }
}

SpringSystem spring_system(const FeModel& model, const DofTable& table) {
  SpringSystem out;
  if (model.springs.empty()) return out;
  const SpringOnlyNodes loose = spring_only_nodes(model);
  UnionFind joins(model.nodes());
  const auto is_loose = [&](const Spring& s, int end) {
    const int node = s.nodes[end];
    return node >= 0 && (loose.mask[node] & axes_of(s, end)) != 0;
  };
  for (const Spring& s : model.springs)
    if (is_loose(s, 0) && is_loose(s, 1)) joins.join(s.nodes[0], s.nodes[1]);
  std::map<int, CondensedSprings> groups;
  for (const Spring& s : model.springs) {
    const int end = is_loose(s, 0) ? 0 : 1;
    if (!is_loose(s, end)) {
      CondensedSprings alone(model, loose);
      alone.add(s);
      alone.finish(out);
      continue;
    }
    groups.try_emplace(joins.root(s.nodes[end]), model, loose).first->second.add(s);
  }
  for (auto& [root, group] : groups) group.finish(out);
  // Directions without a spring are not held either.
  out.condensed.clear();
  std::vector<char> on_spring(model.positions.size(), 0);
  for (const Spring& s : model.springs)
    for (const int node : s.nodes)
      if (node >= 0) on_spring[node] = 1;
  for (int k = 0; k < model.nodes(); ++k)
    for (int axis = 0; axis < table.count(k); ++axis)
      if (loose.has({k, axis}) && on_spring[k] != 0) out.condensed.push_back({k, axis});
  return out;
}

void add_spring_dofs(const FeModel& model, std::vector<int>& count) {
  const SpringOnlyNodes loose = spring_only_nodes(model);
  for (const Spring& s : model.springs) {
    for (int end = 0; end < 2; ++end) {
      const int node = s.nodes[end];
      if (node < 0) continue;
      const bool turns = (axes_of(s, end) & 56u) != 0;
      const bool six = turns && (loose.alone[node] != 0 || (loose.mask[node] & 56u) != 56u);
      count[node + 1] = std::max(count[node + 1], six ? 6 : 3);
    }
  }
}

std::vector<SpringError> spring_errors(const FeModel& model) {
  std::vector<SpringError> out;
  const auto known = [&](int node) { return node >= 0 && node < model.nodes(); };
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const Spring& s = model.springs[i];
    const auto add = [&](ErrorCode code, const char* kind, const std::string& text) {
      out.push_back({code, kind, s.source, model.spring_label(static_cast<int>(i)) + text});
    };
    if (!known(s.nodes[0]) || !(known(s.nodes[1]) || s.nodes[1] == -1)) {
      add(ErrorCode::out_of_range, "springs",
          fmt::format(": node index {} or {} is out of range", s.nodes[0], s.nodes[1]));
    } else if (s.nodes[1] < 0) {
      add(ErrorCode::unsupported, "springs to the ground",
          fmt::format(" ties {} to the ground, which a part that floats cannot be tied to: take it "
                      "out, end it at a node that becomes an interface, or leave all such springs "
                      "out (--grounded-springs ignore, key `grounded_springs`)",
                      model.node_label(s.nodes[0])));
    }
    if (!(s.stiffness >= 0.0) || !std::isfinite(s.stiffness))
      add(ErrorCode::out_of_range, "springs",
          fmt::format(": found the stiffness {:g}, expected no negative number", s.stiffness));
    if (!s.directions[0].allFinite() || !s.directions[1].allFinite())
      add(ErrorCode::not_finite, "springs", " has a direction that is not finite");
  }
  return out;
}

std::vector<int> nodes_on_springs(const FeModel& model) {
  std::vector<int> out;
  if (model.springs.empty()) return out;
  const SpringOnlyNodes loose = spring_only_nodes(model);
  for (const Spring& s : model.springs)
    for (const int node : s.nodes)
      if (node >= 0 && loose.alone[node] != 0 && loose.mask[node] == 63u) out.push_back(node);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

int remove_grounded_springs(FeModel& model) {
  return static_cast<int>(
      std::erase_if(model.springs, [](const Spring& s) { return s.nodes[1] < 0; }));
}

MatX spring_energy(const FeModel& model, const MatX& U, const MatX& Theta) {
  MatX K = MatX::Zero(U.cols(), U.cols());
  for (const SpringBlock& block : spring_system(model, dof_table(model)).blocks) {
    MatX q(static_cast<Eigen::Index>(block.dofs.size()), U.cols());
    for (std::size_t i = 0; i < block.dofs.size(); ++i) {
      const auto [node, axis] = block.dofs[i];
      const Eigen::Index row = 3 * static_cast<Eigen::Index>(node);
      q.row(static_cast<Eigen::Index>(i)) =
          axis < 3 ? U.row(row + axis) : Theta.row(row + axis - 3);
    }
    K.noalias() += q.transpose() * (block.K * q);
  }
  return K;
}

}  // namespace floatframe
