#include "floatframe/tangents/element_tangents.hpp"

#include <algorithm>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model/element_keys.hpp"
#include "floatframe/tangents/linearization.hpp"
#include "floatframe/tangents/small_motions.hpp"

namespace floatframe {
namespace {

/// Products of numbers in (1) that take a second or two.
constexpr double most_products = 4e9;

/// Of an element without branches: a law or a table with corners.
bool has_corners(const Element& e) {
  for (const PiecewisePolynomial& law : e.laws)
    if (!law.edges().empty()) return true;
  const ElementDescription described{e.name, *e.keys, {}};
  for (const ElementKey& key : element_keys(e.type))
    if (key.kind == KeyKind::speed_table && ElementView(described).matrix(key.name).size() > 0)
      return true;
  return false;
}

/// The law is smooth wherever the differences go.
class Smooth {
 public:
  Smooth(Formulation& f, const State& s) : f_(f), s_(s) {
    const std::vector<Element>& elements = f.model().elements;
    kinematics_at(f, s);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (has_branches(elements[k])) {
        watched_.push_back(k);
        branches_.push_back(branch(k));
      } else {
        unknown_ = unknown_ || has_corners(elements[k]);
      }
    }
  }
  bool operator()(const VecX& reach) {
    if (unknown_) return false;
    if (watched_.empty()) return true;
    VecX q = s_.q;
    for (Eigen::Index j = 0; j < reach.size(); ++j)
      for (const double h : {reach[j], -reach[j]}) {
        const VecX x = h * VecX::Unit(reach.size(), j);
        f_.retract(s_.q, x, q);
        kinematics_at(f_, s_.t, q, s_.v);
        if (!stays()) return false;
        kinematics_at(f_, s_.t, s_.q, VecX(s_.v + 10.0 * x));
        if (!stays()) return false;
      }
    return true;
  }

 private:
  /// The branch of the present motion. A law that is held to one is smooth.
  std::int64_t branch(std::size_t k) const {
    return f_.ports(k).branch == free_branch ? f_.branch_side(k).next : free_branch;
  }
  bool stays() const {
    for (std::size_t i = 0; i < watched_.size(); ++i)
      if (branch(watched_[i]) != branches_[i]) return false;
    return true;
  }

  Formulation& f_;
  const State& s_;
  std::vector<std::size_t> watched_;
  std::vector<std::int64_t> branches_;
  bool unknown_ = false;
};

/// Velocities of these markers: v, w of each.
VecX rates_of(const Formulation& f, const std::vector<int>& markers) {
  VecX out(6 * std::ssize(markers));
  for (std::size_t i = 0; i < markers.size(); ++i) {
    const MarkerState& m = f.marker(markers[i]);
    out.segment<6>(6 * static_cast<Eigen::Index>(i)) << m.v, m.w;
  }
  return out;
}

/// (1), (2) and, behind them, the equations of signals: u - factor h = 0.
struct Borders {
  MatX K, C;
};
Borders borders(Formulation& f, const MatX& J, const MatX& V) {
  const Model& model = f.model();
  const Eigen::Index nv = J.cols(), first_link = nv + state_count(model),
                     n = first_link + std::ssize(model.links);
  MatX K = MatX::Zero(n, n), C = K;
  for (Eigen::Index l = first_link; l < n; ++l) K(l, l) = 1.0;
  Eigen::Index row = 0, at = nv;
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    if (!e.acts) continue;
    const Eigen::Index rows = 6 * std::ssize(e.markers), ns = e.states;
    const EffortTangent t = exact_tangent(f.ports(k));
    const auto motion = J.middleRows(row, rows), moved = V.middleRows(row, rows);
    K.topLeftCorner(nv, nv) += motion.transpose() * (t.K * motion + t.C * moved);
    C.topLeftCorner(nv, nv) += motion.transpose() * (t.C * motion);
    std::vector<Eigen::Index> inner;  // unknowns
    for (Eigen::Index i = 0; i < ns; ++i) inner.push_back(at + i);
    for (const Signal& signal : e.signals)
      if (signal.link >= 0) inner.push_back(first_link + signal.link);
    for (std::size_t j = 0; j < inner.size(); ++j)
      K.col(inner[j]).head(nv) += motion.transpose() * t.of_inner.col(j);
    const auto add = [&](Eigen::Index to, Eigen::Index of, double factor) {
      K.row(to).head(nv) -= factor * (t.motion.row(of) * motion + t.rates.row(of) * moved);
      C.row(to).head(nv) -= factor * (t.rates.row(of) * motion);
      for (std::size_t j = 0; j < inner.size(); ++j) K(to, inner[j]) -= factor * t.slopes(of, j);
    };
    for (Eigen::Index i = 0; i < ns; ++i) add(at + i, i, 1.0);
    for (Eigen::Index l = 0; l < std::ssize(model.links); ++l) {
      const SignalLink& link = model.links[l];
      const std::size_t from = link.from;
      if (from == k) add(first_link + l, ns + link.result(), link.factor);
    }
    row += rows;
    at += ns;
  }
  return {K, C};
}

/// A state that follows a deflection at rest. `number`: its place among the states of the system.
struct DeflectedState {
  std::size_t element;
  int state;
  Eigen::Index number;
};
std::vector<DeflectedState> deflected_states(const Formulation& f) {
  std::vector<DeflectedState> out;
  Eigen::Index number = 0;
  for (std::size_t k = 0; k < f.model().elements.size(); ++k)
    for (int i = 0; i < f.model().elements[k].states; ++i, ++number)
      if (f.element_states().deflects(k, i)) out.push_back({k, i, number});
  return out;
}
VecX places_of(const Formulation& f, const std::vector<DeflectedState>& states) {
  VecX out(std::ssize(states));
  for (std::size_t i = 0; i < states.size(); ++i)
    out[i] = f.element_states()
                 .deflected(states[i].element, states[i].state, f.ports(states[i].element))
                 .z;
  return out;
}

}  // namespace

ElementTangents::ElementTangents(Formulation& f, const State& s, const VecX& reach) : f_(f) {
  const Eigen::Index nv = f.velocities();
  const std::vector<Element>& elements = f.model().elements;
  const Eigen::Index n = nv + state_count(f.model());
  K = C = MatX::Zero(n, n);
  std::vector<int> markers;
  for (const Element& e : elements)
    if (e.acts) markers.insert(markers.end(), e.markers.begin(), e.markers.end());
  const double products = 24.0 * std::ssize(markers) * nv * nv;
  if (markers.empty() || products > most_products || !Smooth(f, s)(reach)) return;
  MatX J(6 * std::ssize(markers), nv), V = MatX::Zero(J.rows(), nv);
  kinematics_at(f, s);
  for (Eigen::Index j = 0; j < nv; ++j) {  // increments move markers in the same way as velocities
    f.velocities(VecX(VecX::Unit(nv, j)));
    J.col(j) = rates_of(f, markers);
  }
  if (!s.v.isZero(0.0)) {
    VecX q = s.q;
    V = precise_differences(reach, 0, [&](const VecX& x) {
          f.retract(s.q, x, q);
          kinematics_at(f, s.t, q, s.v);
          return rates_of(f, markers);
        }).columns;
  }
  dynamics_at(f, s);
  const Eigen::Index links = std::ssize(f.model().links);
  const Borders all = borders(f, J, V);
  const auto of = [&](const MatX& X) { return X.topRows(n); };
  K = of(all.K).leftCols(n);
  C = of(all.C).leftCols(n);
  if (links > 0) {  // (3)
    const MatX from = all.K.bottomRightCorner(links, links), to = all.K.topRightCorner(n, links);
    K -= to * lu_solve(from, MatX(all.K.bottomLeftCorner(links, n)));
    C -= to * lu_solve(from, MatX(all.C.bottomLeftCorner(links, n)));
  }
  C.bottomRightCorner(n - nv, n - nv).setIdentity();
  f.hold_efforts(true);
  exact = true;
}

MatX ElementTangents::at_rest(const State& s, double step) const {
  const Eigen::Index nv = f_.velocities(), ns = K.rows() - nv;
  if (ns == 0 || !exact) return K.topLeftCorner(nv, nv);
  MatX slopes = K.bottomRightCorner(ns, ns), follow = K.bottomLeftCorner(ns, nv);
  for (Eigen::Index i = 0; i < ns; ++i) {
    if (!slopes.row(i).isZero(0.0)) continue;
    slopes(i, i) = 1.0;
    follow.row(i).setZero();
  }
  const std::vector<DeflectedState> deflected = deflected_states(f_);
  if (!deflected.empty()) {
    // What they follow need not be the integral of a rate: r_e of a tyre changes with its load.
    VecX q = s.q;
    const MatX moved = central_differences(nv, step, [&](const VecX& x) {
      f_.retract(s.q, x, q);
      kinematics_at(f_, s.t, q, s.v);
      return places_of(f_, deflected);
    });
    for (std::size_t i = 0; i < deflected.size(); ++i)
      follow.row(deflected[i].number) = -moved.row(i);
  }
  return K.topLeftCorner(nv, nv) - K.topRightCorner(nv, ns) * lu_solve(slopes, follow);
}

}  // namespace floatframe
