// Newton iteration for the states of an element.
#include "floatframe/formulation/element_states.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/model/element_kind.hpp"

namespace floatframe {

ElementStates::ElementStates(const Model& model) : model_(model) {
  int count = 0;
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    offsets_.push_back(count);
    count += e.states + e.kept;
    if (e.states + e.kept > 0) elements_.push_back(k);
    newton_.emplace_back(e.states);
  }
  z_ = rates_ = drift_ = zero_ = rest_slopes_ = places_ = VecX::Zero(count);
  held_.assign(z_.size(), 0);
  deflects_ = held_;
}

/// w z + z_hat - zdot at the present states; zero for those that are held.
void ElementStates::find_gap(std::size_t element, const Efforts& out, double* gap,
                             double* size) noexcept {
  const int first = offsets_[element];
  for (int i = 0; i < std::ssize(out.state_rates); ++i) {
    const int at = first + i;
    const double z = z_[at], rest = (*z_hat_)[at];
    const double left = weight_ * z + rest - out.state_rates[i];
    gap[i] = held_[at] ? 0.0 : left;
    drift_[at] = held_[at] ? -left : 0.0;
    size[i] = std::max(size[i], std::abs(z));
    if (weight_ > 0.0) size[i] = std::max(size[i], std::abs(rest) / weight_);
  }
}

void ElementStates::release(std::size_t element) noexcept {
  for (int i = 0; i < model_.elements[element].states; ++i) held_[offsets_[element] + i] = false;
}

void ElementStates::begin_deflection(std::size_t element, const Ports& in) noexcept {
  const auto deflection = element_kind(model_.elements[element].type).deflection;
  if (!deflection) return;
  for (int i = 0; i < model_.elements[element].states; ++i) {
    const int at = offsets_[element] + i;
    places_[at] = deflection(in, i).place;
    deflects_[at] = z_[at] == 0.0;
    rest_slopes_[at] = 0.0;
  }
}

ElementStates::Deflected ElementStates::deflected(std::size_t element, int state,
                                                  const Ports& in) const noexcept {
  const Deflection now = element_kind(model_.elements[element].type).deflection(in, state);
  double moved = now.place - places_[offsets_[element] + state];
  if (now.period > 0.0) moved -= now.period * std::round(moved / now.period);
  return {std::clamp(moved, -now.largest, now.largest), std::abs(moved) < now.largest ? 1.0 : 0.0};
}

void ElementStates::deflect(std::size_t element, const Ports& in) noexcept {
  if (!follow_ || weight_ > 0.0) return;
  for (int i = 0; i < model_.elements[element].states; ++i) {
    const int at = offsets_[element] + i;
    if (!deflects_[at]) continue;
    const Deflected now = deflected(element, i, in);
    z_[at] = now.z;  // (2)
    rest_slopes_[at] = now.slope;
  }
}

void ElementStates::hold_drifting(std::size_t element, Eigen::Index row,
                                  LocalNewton& newton) noexcept {
  if (weight_ > 0.0) return;
  const int first = offsets_[element];
  for (int i = 0; i < model_.elements[element].states; ++i, ++row) {
    const bool was_held = held_[first + i];
    held_[first + i] = newton.slopes.row(row).isZero(0.0);
    if (!held_[first + i]) continue;
    newton.slopes(row, row) = 1.0;
    if (was_held) continue;
    drift_[first + i] = -newton.gap[row];
    newton.gap[row] = 0.0;
  }
}

void ElementStates::solve(std::size_t element, const Ports& in, Efforts& out) noexcept {
  const Eigen::Index n = model_.elements[element].states;
  if (n == 0) return evaluate_element(in, out);
  LocalNewton& newton = newton_[element];
  Eigen::Map<VecX> z(z_.data() + offsets_[element], n);
  release(element);
  deflect(element, in);
  Ports asked = in;
  asked.rates_alone = model_.elements[element].rates_first;
  const bool solved = newton.solve(
      z,
      [&] {
        evaluate_element(asked, out);
        find_gap(element, out, newton.gap.data(), newton.size.data());
      },
      [&] {
        for (Eigen::Index i = 0; i < n; ++i)
          for (Eigen::Index j = 0; j < n; ++j)
            newton.slopes(i, j) = (i == j ? weight_ : 0.0) - out.state_slopes[i * n + j];
        hold_drifting(element, 0, newton);
      });
  if (asked.rates_alone) evaluate_element(in, out);
  if (!solved) fail(element);
}

void ElementStates::start(std::size_t element, const Ports& in, bool found) noexcept {
  const Element& e = model_.elements[element];
  Eigen::Map<VecX> z(z_.data() + offsets_[element], e.states + e.kept);
  if (found) {
    if (const auto settle = element_kind(e.type).settle) settle(in, z.data());
    return;
  }
  z.setZero();
  if (e.start_states.size() == z.size())
    z = e.start_states;
  else if (const auto start = element_kind(e.type).start)
    start(in, z.data());
}

void ElementStates::after_step(std::size_t element, const Ports& in) noexcept {
  if (const auto change = element_kind(model_.elements[element].type).after_step)
    change(in, z_.data() + offsets_[element]);
}

void ElementStates::clear_kept_rates(VecX& rates) const noexcept {
  assert(rates.size() == z_.size());
  for (const std::size_t k : elements_) {
    const Element& e = model_.elements[k];
    rates.segment(offsets_[k] + e.states, e.kept).setZero();
  }
}

void ElementStates::take_rates(const std::vector<Efforts>& efforts) noexcept {
  for (const std::size_t k : elements_)
    for (Eigen::Index i = 0; i < std::ssize(efforts[k].state_rates); ++i)
      rates_[offsets_[k] + i] = efforts[k].state_rates[i];
}

}  // namespace floatframe
