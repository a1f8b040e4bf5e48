#include "floatframe/formulation/signal_tangent.hpp"

#include <cmath>

#include "floatframe/formulation/formulation.hpp"

namespace floatframe {

SignalTangent::SignalTangent(const Model& model) : model_(model) {
  std::vector<char> linked(model.elements.size(), 0);
  for (const SignalLink& link : model.links) linked[link.from] = linked[link.to] = 1;
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    if (!linked[k]) continue;
    const Element& e = model.elements[k];
    members_.push_back({.element = k,
                        .first = first_link_,
                        .states = e.states,
                        .columns = {},
                        .results = {},
                        .finder = TangentFinder(model, e),
                        .own = {},
                        .slopes = MatX::Identity(e.states, e.states),
                        .lu = Eigen::PartialPivLU<MatX>(e.states),
                        .wrenches = std::vector<Wrench>(e.markers.size())});
    first_link_ += e.states;
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& m = members_[i];
    const Element& e = model.elements[m.element];
    for (int z = 0; z < m.states; ++z) m.columns.push_back(m.first + z);
    int port = 0;
    for (const Signal& signal : e.signals) {
      if (signal.link < 0) continue;
      m.columns.push_back(first_link_ + signal.link);
      if (e.exerts()) acting_.push_back({signal.link, i, port});
      ++port;
    }
    for (int l = 0; l < std::ssize(model.links); ++l) {
      const std::size_t from = model.links[l].from;
      if (from == m.element) m.results.push_back(l);
    }
    m.own = MatX::Zero(std::ssize(m.columns), port);
  }
  const Eigen::Index n = first_link_ + std::ssize(model.links);
  transposed_ = MatX::Identity(n, n);
  if (n > 0) lu_.compute(transposed_);
  unit_ = gains_ = VecX::Zero(n);
}

/// The transposed matrix of (1).
void SignalTangent::find_system(const Formulation& f) noexcept {
  const double weight = f.element_states().weight();
  transposed_.setIdentity();
  for (Member& m : members_) {
    const bool moves = m.states > 0 || !m.results.empty();  // what (1) depends on
    m.tangent = moves ? &m.finder.find_results(f.ports(m.element))
                      : &m.finder.find_inner(f.ports(m.element));
    const MatX& slopes = m.tangent->slopes;
    for (int z = 0; z < m.states && std::isfinite(weight); ++z) {
      transposed_(m.first + z, m.first + z) = weight;
      for (Eigen::Index j = 0; j < std::ssize(m.columns); ++j)
        transposed_(m.columns[j], m.first + z) -= slopes(z, j);
    }
    for (const int l : m.results) {
      const Eigen::Index row = m.states + model_.links[l].result();
      for (Eigen::Index j = 0; j < std::ssize(m.columns); ++j)
        transposed_(m.columns[j], first_link_ + l) -= model_.links[l].factor * slopes(row, j);
    }
    follow(m, weight);
  }
}

/// `own`: (w - zdot_z)^-1 zdot_u, and the signals themselves.
void SignalTangent::follow(Member& m, double weight) noexcept {
  const Eigen::Index n = m.states, links = m.own.cols();
  m.own.setZero();
  m.own.bottomRows(links).setIdentity();
  if (n == 0 || links == 0 || !std::isfinite(weight)) return;
  m.slopes.setIdentity();
  m.slopes *= weight;
  m.slopes -= m.tangent->slopes.topLeftCorner(n, n);
  m.lu.compute(m.slopes);
  m.own.topRows(n) = m.lu.solve(m.tangent->slopes.block(0, n, n, links));
}

/// V of (2), a the row of the inverse of (1) that belongs to the signal.
void SignalTangent::add_gains(Formulation& f, double damping, double s, const VecX& a,
                              VecX& out) noexcept {
  const bool follow = f.element_states().follow();
  for (Member& m : members_) {
    bool enters = false;
    for (int z = 0; z < m.states && follow; ++z) enters = enters || a[m.first + z] != 0.0;
    for (const int l : m.results) enters = enters || a[first_link_ + l] != 0.0;
    if (!enters) continue;
    const MatX &motion = m.tangent->motion, &rates = m.tangent->rates;
    for (Eigen::Index i = 0; i < std::ssize(m.wrenches); ++i) {
      Vec6 sum = Vec6::Zero();
      const auto add = [&](Eigen::Index row, double part) {
        sum += (part * s) * motion.row(row).segment<6>(6 * i).transpose();
        sum += (part * damping) * rates.row(row).segment<6>(6 * i).transpose();
      };
      for (int z = 0; z < m.states && follow; ++z) add(z, a[m.first + z]);
      for (const int l : m.results)
        add(m.states + model_.links[l].result(), model_.links[l].factor * a[first_link_ + l]);
      m.wrenches[i] = {sum.head<3>(), sum.tail<3>()};
    }
    f.add_wrenches(model_.elements[m.element].markers, m.wrenches, out);
  }
}

void SignalTangent::find(Formulation& f, double damping, double s, MatX& B, MatX& V) noexcept {
  assert(B.cols() == rank() && V.cols() == rank() && B.rows() == f.velocities());
  find_system(f);
  lu_.compute(transposed_);
  for (Eigen::Index j = 0; j < rank(); ++j) {
    const Acting& acting = acting_[j];
    Member& m = members_[acting.member];
    for (Eigen::Index i = 0; i < std::ssize(m.wrenches); ++i) {
      const Vec6 w = m.tangent->of_inner.middleRows<6>(6 * i) * m.own.col(acting.port);
      m.wrenches[i] = {w.head<3>(), w.tail<3>()};
    }
    forces_.setZero(f.velocities());
    f.add_wrenches(model_.elements[m.element].markers, m.wrenches, forces_);
    B.col(j) = forces_;
    unit_.setZero();
    unit_[first_link_ + acting.link] = 1.0;
    gains_ = lu_.solve(unit_);
    forces_.setZero();
    add_gains(f, damping, s, gains_, forces_);
    V.col(j) = forces_;
  }
}

}  // namespace floatframe
