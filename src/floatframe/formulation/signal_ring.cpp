#include "floatframe/formulation/signal_ring.hpp"

#include <algorithm>
#include <cmath>

namespace floatframe {

SignalRing::SignalRing(const Model& model, const SignalGroup& group) : newton_(0) {
  int count = 0;
  for (const std::size_t k : group.elements) {
    const Element& e = model.elements[k];
    members_.push_back({k, count, e.states, {}, {}, TangentFinder(model, e)});
    count += e.states;
  }
  std::vector<int> unknown_of(model.links.size(), -1);
  for (const std::size_t l : group.links) unknown_of[l] = count++;
  for (Member& m : members_) {
    for (int i = 0; i < m.states; ++i) m.columns.push_back(m.first + i);
    for (const Signal& signal : model.elements[m.element].signals)
      if (signal.link >= 0) m.columns.push_back(unknown_of[signal.link]);
    for (const std::size_t l : group.links) {
      const std::size_t from = model.links[l].from;
      const int link = l;
      if (from == m.element)
        m.results.push_back({unknown_of[l], link, model.links[l].result(), model.links[l].factor});
    }
  }
  y_ = VecX::Zero(count);
  newton_ = LocalNewton(count);
}

/// The signals begin at zero: what an evaluation gives does not depend on the one before.
void SignalRing::take(ElementStates& z) noexcept {
  for (const Member& m : members_) {
    z.release(m.element);
    for (int i = 0; i < m.states; ++i) y_[m.first + i] = z.of(m.element)[i];
    for (const Result& r : m.results) y_[r.row] = 0.0;
  }
}

void SignalRing::give(ElementStates& z, std::vector<double>& links) const noexcept {
  for (const Member& m : members_) {
    for (int i = 0; i < m.states; ++i) z.of(m.element)[i] = y_[m.first + i];
    for (const Result& r : m.results) links[r.link] = y_[r.row];
  }
}

void SignalRing::find_gap(ElementStates& z, const std::vector<Efforts>& efforts) noexcept {
  for (const Member& m : members_) {
    if (z.follow())
      z.find_gap(m.element, efforts[m.element], newton_.gap.data() + m.first,
                 newton_.size.data() + m.first);
    else
      newton_.gap.segment(m.first, m.states).setZero();
    for (const Result& r : m.results) {
      newton_.gap[r.row] = y_[r.row] - r.factor * efforts[m.element].result(r.result);
      newton_.size[r.row] = std::max(newton_.size[r.row], std::abs(y_[r.row]));
    }
  }
}

void SignalRing::add_slopes(const Member& m, const EffortTangent& t,
                            const ElementStates& z) noexcept {
  const auto inner = std::ssize(m.columns);
  const auto add = [&](Eigen::Index row, Eigen::Index of, double factor) {
    for (Eigen::Index j = 0; j < inner; ++j)
      if (m.columns[j] >= 0) newton_.slopes(row, m.columns[j]) -= factor * t.slopes(of, j);
  };
  for (int i = 0; i < m.states; ++i) {
    if (z.follow()) add(m.first + i, i, 1.0);
    newton_.slopes(m.first + i, m.first + i) += z.follow() ? z.weight() : 1.0;
  }
  for (const Result& r : m.results) {
    add(r.row, m.states + r.result, r.factor);
    newton_.slopes(r.row, r.row) += 1.0;
  }
}

void SignalRing::hold(const Member& m, ElementStates& z) noexcept {
  if (z.follow()) z.hold_drifting(m.element, m.first, newton_);
}

}  // namespace floatframe
