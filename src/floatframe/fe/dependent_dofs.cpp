#include "floatframe/fe/dependent_dofs.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/fe/springs.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

using Terms = DependentDofs::Terms;

std::vector<int> dofs_of_nodes(const FeModel& model);

/// Resolves one dependence after the other; its terms are expressed immediately in the dofs that
/// are independent so far.
class Resolver {
 public:
  Resolver(const FeModel& model, const DofTable& table, ErrorList& errors)
      : model_(model), table_(table), errors_(errors) {
    out_.dependent.assign(table.size(), 0);
    out_.terms.resize(table.size());
    owner_.assign(table.size(), -1);
  }

  int begin_owner(std::string name, const FeSource& source) {
    owners_.emplace_back(std::move(name));
    mark_ = model_.mark(source);
    return static_cast<int>(owners_.size()) - 1;
  }

  /// Terms in dofs that are independent now. Terms resolved earlier may contain dofs that have
  /// become dependent since.
  Terms reduce(const Terms& terms) const {
    std::map<int, double> sum;
    for (const auto& [dof, factor] : terms) {
      if (!dependent(dof)) {
        sum[dof] += factor;
        continue;
      }
      for (const auto& [inner, f] : reduce(out_.terms[dof])) sum[inner] += factor * f;
    }
    return {sum.begin(), sum.end()};
  }

  bool dependent(int dof) const { return out_.dependent[dof] != 0; }

  /// dof = sum of terms.
  void add(int owner, int node, int axis, const Terms& terms) {
    const std::size_t dof = table_.index(node, axis);
    if (out_.dependent[dof] != 0) {
      return refuse(ErrorCode::dependent, owner, node, axis,
                    " depends already on " + owners_[owner_[dof]] +
                        "; a degree of freedom can depend only once");
    }
    Terms reduced = reduce(terms);
    const auto self = std::find_if(reduced.begin(), reduced.end(),
                                   [&](const auto& t) { return t.first == static_cast<int>(dof); });
    if (self != reduced.end()) {
      return refuse(ErrorCode::cycle, owner, node, axis,
                    " would depend on itself, by a chain of spiders or equations");
    }
    out_.dependent[dof] = 1;
    out_.terms[dof] = std::move(reduced);
    out_.any = true;
    owner_[dof] = owner;
  }

  /// sum of terms = 0, solved for `first` if it is still free (and, unless `for_first`, its factor
  /// not small), else for the dof with the largest factor. Redundant equations leave nothing to
  /// solve.
  void add_equation(int owner, int first, bool for_first, const Terms& terms) {
    double scale = 0.0;
    for (const auto& [dof, factor] : terms) scale = std::max(scale, std::abs(factor));
    Terms reduced = reduce(terms);
    std::erase_if(reduced, [&](const auto& t) { return std::abs(t.second) <= 1e-12 * scale; });
    if (reduced.empty()) return;
    const auto smaller = [](const auto& a, const auto& b) {
      return std::abs(a.second) < std::abs(b.second);
    };
    auto pivot = std::find_if(reduced.begin(), reduced.end(),
                              [&](const auto& t) { return t.first == first; });
    const auto largest = std::max_element(reduced.begin(), reduced.end(), smaller);
    const double least = for_first ? 0.0 : 1e-3 * std::abs(largest->second);
    if (pivot == reduced.end() || std::abs(pivot->second) < least) pivot = largest;
    const auto [dof, factor] = *pivot;
    reduced.erase(pivot);
    for (auto& [other, f] : reduced) f /= -factor;
    out_.dependent[dof] = 1;
    out_.terms[dof] = std::move(reduced);
    out_.any = true;
    owner_[dof] = owner;
  }

  /// Dofs that the matrices of another program do not contain.
  void fix_missing(const std::vector<Dof>& present) {
    std::vector<char> there(out_.dependent.size(), 0);
    const auto place = [&](const Dof& d) { return table_.begin[d.node] + d.axis; };
    for (const Dof& d : present) there[place(d)] = 1;
    for (const Spider& s : model_.spiders)
      for (int k = 0; k < 6; ++k) there[place({s.reference, k})] = 1;
    const int owner = begin_owner("the matrices, which have no row for it", {});
    for (std::size_t i = 0; i < there.size(); ++i) {
      if (there[i] != 0) continue;
      out_.dependent[i] = 1;
      out_.any = true;
      owner_[i] = owner;
    }
  }

  /// Directions of carried nodes that no equation contains: they are fixed.
  void fix_idle() {
    const std::vector<int> count = dofs_of_nodes(model_);
    std::vector<char> named(out_.dependent.size(), 0);
    for (const LinearEquation& e : model_.equations)
      for (const LinearEquation::Term& t : e.terms)
        if (const int dof = table_.index(t.node, t.axis); dof >= 0) named[dof] = 1;
    for (int node = 0; node < model_.nodes(); ++node) {
      if (count[node + 1] > 0) continue;
      for (int dof = table_.begin[node]; dof < table_.begin[node + 1]; ++dof)
        if (named[dof] == 0) out_.dependent[dof] = 1, out_.any = true;
    }
  }

  DependentDofs finish() {
    for (Terms& terms : out_.terms)
      if (!terms.empty()) terms = reduce(terms);
    return std::move(out_);
  }

  const SourceMark& mark() const { return mark_; }

 private:
  /// Once per node, not for each of its dofs.
  void refuse(ErrorCode code, int owner, int node, int axis, const std::string& what) {
    if (refused_ != node || refused_owner_ != owner)
      errors_.add(
          code, mark_,
          owners_[owner] + ": " + node_dof_names[axis] + " of " + model_.node_label(node) + what);
    refused_ = node;
    refused_owner_ = owner;
  }

  const FeModel& model_;
  const DofTable& table_;
  ErrorList& errors_;
  DependentDofs out_;
  std::vector<int> owner_;  ///< of each dependent dof, index into owners_
  std::vector<std::string> owners_;
  SourceMark mark_;
  int refused_ = -1, refused_owner_ = -1;
};

std::string spider_label(const FeModel& model, const Spider& s) {
  if (!s.name.empty()) return "spider '" + s.name + "'";
  return "spider of " + model.node_label(s.reference);
}

const Vec3& position(const FeModel& model, int node) { return model.positions[node]; }

/// u_i = u_r + theta_r x (x_i - x_r), theta_i = theta_r
void add_rigid(const FeModel& model, const DofTable& table, const Spider& s, Resolver& resolver) {
  const int owner = resolver.begin_owner(spider_label(model, s), s.source);
  for (const int node : s.nodes) {
    if (node == s.reference) continue;
    const Mat3 S = -skew(position(model, node) - position(model, s.reference));
    for (int axis = 0; axis < table.count(node); ++axis) {
      if (((s.mask >> axis) & 1u) == 0) continue;
      Terms terms;
      if (axis >= 3) {
        terms = {{table.index(s.reference, axis), 1.0}};
      } else {
        terms = {{table.index(s.reference, axis), 1.0}};
        for (int k = 0; k < 3; ++k)
          if (S(axis, k) != 0.0) terms.emplace_back(table.index(s.reference, 3 + k), S(axis, k));
      }
      resolver.add(owner, node, axis, terms);
    }
  }
}

/// sum_i w_i A_i^T A_i, and sum_i w_i A_i^T u_i in independent dofs: its columns.
Mat6 mean_sums(const FeModel& model, const DofTable& table, const Spider& s, double size,
               const Resolver& resolver, std::map<int, Vec6>& columns) {
  Mat6 normal = Mat6::Zero();
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    const double w = s.weights.empty() ? 1.0 : s.weights[i];
    Eigen::Matrix<double, 3, 6> A;
    A << Mat3::Identity(), -skew(position(model, s.nodes[i]) - position(model, s.reference)) / size;
    normal += w * A.transpose() * A;
    for (int axis = 0; axis < 3; ++axis)
      for (const auto& [dof, f] : resolver.reduce({{table.index(s.nodes[i], axis), 1.0}}))
        columns.try_emplace(dof, Vec6::Zero()).first->second += w * f * A.row(axis).transpose();
  }
  return normal;
}

/// Displacements of the nodes of a mean spider that are not dependent yet.
std::vector<Dof> free_dofs(const DofTable& table, const Spider& s, const Resolver& resolver) {
  std::vector<Dof> out;
  for (const int node : s.nodes)
    for (int axis = 0; axis < 3; ++axis)
      if (node != s.reference && !resolver.dependent(table.index(node, axis)))
        out.push_back({node, axis});
  return out;
}

/// The reference moves as the rigid motion that fits the nodes best:
///   sum_i w_i A_i^T A_i q_r = sum_i w_i A_i^T u_i,  A_i = [1, -skew(x_i - x_r)].
/// Solved for six dofs (on a line five) of the nodes, chosen by pivoting.
void add_mean(const FeModel& model, const DofTable& table, const Spider& s, Resolver& resolver,
              ErrorList& errors) {
  const int owner = resolver.begin_owner(spider_label(model, s), s.source);
  double size = 0.0;
  for (const int node : s.nodes)
    size = std::max(size, (position(model, node) - position(model, s.reference)).norm());
  const auto refuse = [&](ErrorCode code, const std::string& what) {
    errors.add(code, resolver.mark(), spider_label(model, s) + ": " + what);
  };
  // Rotations times the size, so that all rows and columns are lengths.
  Vec6 scale;
  scale << 1, 1, 1, size, size, size;
  std::map<int, Vec6> columns;  // the averages in independent dofs
  const Mat6 normal = mean_sums(model, table, s, size, resolver, columns);
  const SymmetricEigen spread = symmetric_eigen(normal);
  const double zero = 1e-9 * spread.values(5);
  const bool line = (s.mask & 56u) != 56u && !(spread.values(0) > zero);
  if (s.nodes.size() < (line ? 2u : 3u) || !(size > 0.0) || !(spread.values(line ? 1 : 0) > zero)) {
    return refuse(ErrorCode::singular,
                  "its " + std::to_string(s.nodes.size()) +
                      " nodes lie on a line or in a point and cannot define a rotation");
  }
  if (line && spread.vectors.col(0).head<3>().norm() > 1e-6)
    return refuse(ErrorCode::singular,
                  "its reference is off the line of its nodes, about which it turns freely");
  // Constraint: sum_dof c_dof u_dof = 0, averages against q_r; on a line without rotation about it.
  const int m = line ? 5 : 6;
  const MatX chosen = line ? MatX(spread.vectors.rightCols(5)) : MatX(MatX::Identity(6, 6));
  const Mat6 inverse =
      line ? Mat6(chosen * spread.values.tail(5).cwiseInverse().asDiagonal() * chosen.transpose())
           : Mat6(normal.inverse());
  for (auto& [dof, c] : columns) c = (inverse * c).eval();
  for (int k = 0; k < 6; ++k) {
    for (const auto& [dof, f] : resolver.reduce({{table.index(s.reference, k), 1.0}})) {
      Vec6& c = columns.try_emplace(dof, Vec6::Zero()).first->second;
      c(k) -= f * scale(k);
    }
  }
  const std::vector<Dof> candidates = free_dofs(table, s, resolver);
  MatX C(m, static_cast<Eigen::Index>(candidates.size()));
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    C.col(static_cast<Eigen::Index>(i)) =
        chosen.transpose() * columns.at(table.index(candidates[i].node, candidates[i].axis));
  }
  const PivotedQr qr = pivoted_qr(C);
  if (C.cols() < m || !(std::abs(qr.diagonal(m - 1)) > 1e-9 * std::abs(qr.diagonal(0)))) {
    return refuse(ErrorCode::dependent,
                  "too many of its nodes depend on other spiders or equations already; a mean "
                  "spider needs at least three free nodes that do not lie on a line");
  }
  MatX pivots(m, m);
  std::vector<Dof> slaves(static_cast<std::size_t>(m));
  std::vector<int> slave_dofs(static_cast<std::size_t>(m));
  for (int k = 0; k < m; ++k) {
    const int column = static_cast<int>(qr.pivots(k));
    slaves[k] = candidates[column];
    slave_dofs[k] = table.index(slaves[k].node, slaves[k].axis);
    pivots.col(k) = C.col(column);
  }
  const MatX solve = -lu_solve(pivots, chosen.transpose());
  std::vector<Terms> terms(slaves.size());
  for (const auto& [dof, c] : columns) {
    if (std::find(slave_dofs.begin(), slave_dofs.end(), dof) != slave_dofs.end()) continue;
    const VecX f = solve * c;
    for (std::size_t k = 0; k < slaves.size(); ++k)
      if (std::abs(f(static_cast<int>(k))) > (line ? 1e-13 : 0.0))
        terms[k].emplace_back(dof, f(static_cast<int>(k)));
  }
  for (std::size_t k = 0; k < slaves.size(); ++k)
    resolver.add(owner, slaves[k].node, slaves[k].axis, terms[k]);
}

void add_equation(const FeModel& model, const DofTable& table, const LinearEquation& equation,
                  Resolver& resolver, ErrorList& errors) {
  const LinearEquation::Term& first = equation.terms.front();
  const int owner =
      resolver.begin_owner("equation for " + model.node_label(first.node), equation.source);
  Terms terms;
  for (const LinearEquation::Term& t : equation.terms) {
    const int dof = table.index(t.node, t.axis);
    if (dof < 0) {
      errors.add(ErrorCode::wrong_value, resolver.mark(),
                 "equation for " + model.node_label(first.node) + ": " + model.node_label(t.node) +
                     " has no degree of freedom " + node_dof_names[t.axis]);
      return;
    }
    terms.emplace_back(dof, t.factor);
  }
  resolver.add_equation(owner, table.index(first.node, first.axis), equation.for_first, terms);
}

}  // namespace

std::vector<int> dofs_without_springs(const FeModel& model) {
  std::vector<int> count(model.positions.size() + 1, 0);
  const auto need = [&](int node, int dofs) {
    int& c = count[node + 1];
    c = std::max(c, dofs);
  };
  if (model.matrices)
    for (const Dof& d : model.matrices->dofs) need(d.node, d.axis < 3 ? 3 : 6);
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    for (int a = 0; a < kernel.nodes; ++a) need(e.nodes[a], kernel.dofs_per_node);
  }
  for (const PointMass& m : model.masses) need(m.node, m.J.isZero(0.0) ? 3 : 6);
  for (const Spider& s : model.spiders) {
    need(s.reference, 6);
    for (const int node : s.nodes) need(node, 3);
  }
  return count;
}

namespace {

/// Degrees of freedom of each node, after a leading 0, without those that only equations give.
std::vector<int> dofs_of_nodes(const FeModel& model) {
  std::vector<int> count = dofs_without_springs(model);
  if (!model.springs.empty()) add_spring_dofs(model, count);
  return count;
}

/// Equations also carry nodes without other elements (reference points of decks).
void add_carried(const FeModel& model, std::vector<int>& count) {
  for (bool more = true; more;) {
    more = false;
    for (const LinearEquation& e : model.equations) {
      const auto used = [&](const LinearEquation::Term& t) { return count[t.node + 1] > 0; };
      if (std::none_of(e.terms.begin(), e.terms.end(), used)) continue;
      for (const LinearEquation::Term& t : e.terms) {
        if (used(t) || t.axis >= 3) continue;
        count[t.node + 1] = 3;
        more = true;
      }
    }
  }
}

}  // namespace

DofTable dof_table(const FeModel& model) {
  DofTable table;
  table.begin = dofs_of_nodes(model);
  add_carried(model, table.begin);
  for (std::size_t i = 1; i < table.begin.size(); ++i) table.begin[i] += table.begin[i - 1];
  return table;
}

DependentDofs resolve_dependences(const FeModel& model, const DofTable& table) {
  ErrorList errors;
  Resolver resolver(model, table, errors);
  if (model.matrices) resolver.fix_missing(model.matrices->dofs);
  resolver.fix_idle();
  if (!model.springs.empty()) {
    const int owner = resolver.begin_owner("springs alone", {});
    for (const Dof& dof : spring_system(model, table).condensed)
      resolver.add(owner, dof.node, dof.axis, {});
  }
  for (const LinearEquation& e : model.equations) add_equation(model, table, e, resolver, errors);
  for (const Spider& s : model.spiders)
    if (s.kind == Spider::Kind::rigid) add_rigid(model, table, s, resolver);
  for (const Spider& s : model.spiders)
    if (s.kind == Spider::Kind::mean) add_mean(model, table, s, resolver, errors);
  errors.throw_if_any();
  return resolver.finish();
}

}  // namespace floatframe
