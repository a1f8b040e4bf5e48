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
    Scratch& s = scratch_.emplace_back();
    s.slopes = MatX::Identity(e.states, e.states);
    if (e.states > 0) s.lu.compute(s.slopes);
    s.z = s.gap = s.dz = s.next = s.size = VecX::Zero(e.states);
  }
  z_ = rates_ = zero_ = VecX::Zero(count);
}

namespace {

/// Largest part of x in sizes of the states.
double relative_size(const VecX& x, const VecX& size) noexcept {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double part = std::abs(x[i]);
    if (std::isnan(part)) return part;
    if (part > 0.0) largest = std::max(largest, part / std::max(size[i], 1e-300));
  }
  return largest;
}

}  // namespace

/// w z + z_hat - zdot at the present states.
void ElementStates::find_gap(std::size_t element, const Efforts& out, Scratch& s) noexcept {
  const int first = offsets_[element];
  for (Eigen::Index i = 0; i < s.gap.size(); ++i) {
    const double z = z_[first + i], rest = (*z_hat_)[first + i];
    s.gap[i] = weight_ * z + rest - out.state_rates[i];
    s.size[i] = std::max(s.size[i], std::abs(z));
    if (weight_ > 0.0) s.size[i] = std::max(s.size[i], std::abs(rest) / weight_);
  }
}

/// dz of a Newton step. False: at rest a state drifts whatever it is.
bool ElementStates::find_increment(const Efforts& out, Scratch& s) const noexcept {
  const Eigen::Index n = s.gap.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    double largest = 0.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double slope = out.state_slopes[i * n + j];
      s.slopes(i, j) = (i == j ? weight_ : 0.0) - slope;
      largest = std::max(largest, std::abs(s.slopes(i, j)));
    }
    if (largest > 0.0) continue;
    if (s.gap[i] != 0.0) return false;
    s.slopes(i, i) = 1.0;
  }
  s.lu.compute(s.slopes);
  s.dz = s.lu.solve(s.gap);
  return s.dz.allFinite();
}

/// z -= part dz, with a part for which the next increment, with the same slopes, is smaller.
bool ElementStates::damped_step(std::size_t element, const Ports& in, Efforts& out,
                                Scratch& s) noexcept {
  constexpr double least_part = 1e-4;
  Eigen::Map<VecX> z(z_.data() + offsets_[element], s.z.size());
  s.z = z;
  const double before = relative_size(s.dz, s.size);
  for (double part = 1.0; part > least_part; part *= 0.5) {
    z = s.z - part * s.dz;
    evaluate_element(in, out);
    find_gap(element, out, s);
    s.next = s.lu.solve(s.gap);
    if (relative_size(s.next, s.size) <= (1.0 - 0.25 * part) * before) return true;
  }
  return false;
}

void ElementStates::solve(std::size_t element, const Ports& in, Efforts& out) noexcept {
  constexpr int most_iterations = 50;
  constexpr double rounding = 1e-14, last = 1e-7;  // relative; the error after a step is its square
  Scratch& s = scratch_[element];
  Eigen::Map<VecX> z(z_.data() + offsets_[element], s.z.size());
  evaluate_element(in, out);
  if (z.size() == 0) return;
  s.size.setZero();
  find_gap(element, out, s);
  for (int k = 0; k < most_iterations; ++k) {
    if (!find_increment(out, s)) break;
    const double size = relative_size(s.dz, s.size);
    if (size <= rounding) return;
    if (size <= last) {
      z -= s.dz;
      evaluate_element(in, out);
      return;
    }
    if (!damped_step(element, in, out, s)) break;
  }
  if (unsolved_ < 0) unsolved_ = static_cast<int>(element);
}

void ElementStates::start(std::size_t element, const Ports& in) noexcept {
  const Element& e = model_.elements[element];
  Eigen::Map<VecX> z(z_.data() + offsets_[element], e.states + e.kept);
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

void ElementStates::take_rates(const std::vector<Efforts>& efforts) noexcept {
  for (const std::size_t k : elements_)
    for (Eigen::Index i = 0; i < std::ssize(efforts[k].state_rates); ++i)
      rates_[offsets_[k] + i] = efforts[k].state_rates[i];
}

}  // namespace floatframe
