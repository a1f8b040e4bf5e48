#include "floatframe/formulation/input_changes.hpp"

#include <algorithm>

#include "floatframe/math/dense.hpp"

namespace floatframe {

InputChanges::InputChanges(const Model& model)
    : model_(model), du_(VecX::Zero(std::ssize(model.inputs))) {
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    const bool enters =
        std::ranges::any_of(
            e.signals, [](const Signal& s) { return s.input >= 0 || s.link >= 0 || s.local; }) ||
        std::ranges::any_of(e.operands, [](const FormulaOperand& x) {
          return x.kind == FormulaOperand::Kind::input;
        });
    if (e.acts && enters) members_.push_back({k, TangentFinder(model, e)});
  }
}

void InputChanges::begin() {
  const auto links = std::ssize(model_.links);
  slopes_ = MatX::Identity(links, links);
  ds_ = VecX::Zero(links);
}

/// The rows of (1) of the links from an element.
void InputChanges::add_equations(Member& m, const Ports& in) {
  std::vector<int> from, to;
  for (int l = 0; l < std::ssize(model_.links); ++l)
    if (const std::size_t owner = model_.links[l].from; owner == m.element) from.push_back(l);
  if (from.empty()) return;
  const VecX still = VecX::Zero(std::ssize(model_.links));
  const EffortsOf<Dual>& by_inputs = m.finder.along_signals(in, du_, still);
  for (const int l : from) {
    const SignalLink& link = model_.links[l];
    ds_[l] = link.factor * by_inputs.result(link.result()).d[0];
  }
  for (const Signal& signal : in.element.signals)
    if (signal.link >= 0) to.push_back(signal.link);
  const int states = in.element.states;
  const MatX& slopes = m.finder.find_inner(in).slopes;
  for (const int l : from)
    for (int j = 0; j < std::ssize(to); ++j)
      slopes_(l, to[j]) -=
          model_.links[l].factor * slopes(states + model_.links[l].result(), states + j);
}

void InputChanges::solve() {
  if (ds_.size() > 0) ds_ = lu_solve(slopes_, MatX(ds_)).col(0);
}

void InputChanges::add_efforts(Member& m, const Ports& in, Efforts& out) {
  const EffortsOf<Dual>& change = m.finder.along_signals(in, du_, ds_);
  const auto add = [](double& value, const Dual& x) { value += x.d[0]; };
  for (std::size_t i = 0; i < out.wrench.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      add(out.wrench[i].F[c], change.wrench[i].F[c]);
      add(out.wrench[i].T[c], change.wrench[i].T[c]);
    }
  for (std::size_t i = 0; i < out.further.size(); ++i) add(out.further[i], change.further[i]);
  for (std::size_t i = 0; i < out.state_rates.size(); ++i)
    add(out.state_rates[i], change.state_rates[i]);
  add(out.force, change.force);
  add(out.length, change.length);
  add(out.rate, change.rate);
  add(out.energy, change.energy);
  add(out.energy_rate, change.energy_rate);
  add(out.damping, change.damping);
}

}  // namespace floatframe
