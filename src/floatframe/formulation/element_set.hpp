#pragma once
// The elements of a model in a formulation: their inputs, their states at the last
// evaluation, and the turns counted by the angles of joints that elements act on or hold. An angle
// is known up to whole turns; the value nearest to the angle of the last evaluation is used, so the
// angles are a part of the state that q does not contain. States of elements
// (element_evaluation.hpp) are given, or follow the motion at each evaluation (element_states.hpp).
// Signals between elements are found at each evaluation, elements in an order in which these are
// known (model/signal_order.hpp), rings of them together (signal_ring.hpp).
// Step time: no heap, noexcept.
#include <algorithm>
#include <cassert>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "floatframe/formulation/element_states.hpp"
#include "floatframe/formulation/input_changes.hpp"
#include "floatframe/formulation/signal_ring.hpp"
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model/sampling.hpp"

namespace floatframe {

/// The first element whose function has thrown, and what; -1: none.
struct ThrownByElement {
  int element = -1;
  std::exception_ptr exception;
};

class ElementSet {
 public:
  /// All angles start at zero (`count_turns_from`). Allocates.
  explicit ElementSet(const Model& model);
  ElementSet(const ElementSet&) = delete;
  ElementSet& operator=(const ElementSet&) = delete;

  /// Values of `model.inputs`, constant until they are set again; at first their initial values.
  void set_inputs(std::span<const double> values) noexcept {
    assert(values.size() == inputs_.size());
    std::copy(values.begin(), values.end(), inputs_.begin());
  }
  std::span<const double> inputs() const noexcept { return inputs_; }
  /// Inputs moved by these numbers, linearly (input_changes.hpp). Load time only: allocates.
  void change_inputs(const VecX& by) {
    if (!changes_) changes_ = std::make_unique<InputChanges>(model_);
    changes_->set(by);
  }

  /// Angles at the last evaluation, of the coordinates whose turns are counted [rad].
  std::span<const double> angles() const noexcept { return angles_; }
  void set_angles(std::span<const double> angles) noexcept {
    assert(angles.size() == angles_.size());
    std::copy(angles.begin(), angles.end(), angles_.begin());
  }
  /// The place in `angles` of coordinate i of element k; -1: its turns are not counted.
  int slot(std::size_t k, std::size_t i) const noexcept {
    return i < slots_[k].size() ? slots_[k][i] : -1;
  }
  void set_angle(int slot, double angle) noexcept {
    if (slot >= 0) angles_[slot] = angle;
  }
  /// Where an angle is: its address does not change.
  const double* angle(int slot) const noexcept { return slot < 0 ? nullptr : &angles_[slot]; }
  /// The angles that elements hold at the present orientations, continued from the last ones.
  void count_held_turns() noexcept {
    for (const HeldAngle& h : held_angles_)
      angles_[h.slot] = angle_about_z<double>(*h.a, *h.b, angles_[h.slot]);
  }
  /// Turns are counted starting at the start values of these joints, or their motions at time t.
  void count_turns_from(const Model& values, double t) noexcept;

  /// Held branches of the laws (`branch_side`), a number for each force; `free_branch` if none is
  /// held.
  std::span<const std::int64_t> branches() const noexcept { return branches_; }
  void hold_branches(std::span<const std::int64_t> branches) noexcept {
    assert(branches.size() == branches_.size());
    std::copy(branches.begin(), branches.end(), branches_.begin());
  }
  void hold_branch(std::size_t force, std::int64_t branch) noexcept { branches_[force] = branch; }
  /// Where the markers of the model are: their addresses do not change. Allocates.
  void connect(const std::vector<const MarkerState*>& markers);
  /// What element k acts on, with positions from `p_WO`.
  Ports ports(std::size_t k, const Vec3& p_WO, double t) const noexcept {
    const int at = first_slot_[k];
    const double angle = at < 0 ? 0.0 : angles_[at];
    return {model_,
            model_.elements[k],
            markers_[k].data(),
            p_WO,
            t,
            angle,
            inputs_,
            branches_[k],
            z_.of(k),
            z_.weight(),
            links_.data(),
            at < 0 ? nullptr : &angles_[at],
            z_.of(k) + model_.elements[k].states,
            nullptr,
            z_.rest_slopes(k)};
  }
  ElementStates& element_states() noexcept { return z_; }
  const ElementStates& element_states() const noexcept { return z_; }

  /// The beginning of a step, and its end: changes of the angles in a rejected step are
  /// discarded.
  void stepping(bool on, bool accepted) noexcept {
    if (on) thrown_ = {};
    if (on)
      std::copy(angles_.begin(), angles_.end(), kept_angles_.begin());
    else if (!accepted)
      std::copy(kept_angles_.begin(), kept_angles_.end(), angles_.begin());
  }

  /// Efforts stay those of the last evaluation.
  void hold(bool on) noexcept { held_ = on; }
  const Efforts& state(std::size_t k) const noexcept { return states_[k]; }
  std::span<const Efforts> states() const noexcept { return states_; }

  /// All efforts at time t.
  void evaluate(const Vec3& p_WO, double t) noexcept {
    if (held_) return;
    if (links_.empty())
      for (const std::size_t k : acting_) evaluate_one(k, ports(k, p_WO, t));
    else
      evaluate_linked([&](std::size_t k) { return ports(k, p_WO, t); });
    if (changes_) changes_->add([&](std::size_t k) { return ports(k, p_WO, t); }, states_, links_);
    z_.take_rates(states_);
  }
  /// Of the elements with states only, with `ports_at(k)` of element k; of all, if there are
  /// signals between them.
  template <class PortsAt>
  void solve_states(const PortsAt& ports_at) noexcept {
    if (links_.empty())
      for (const std::size_t k : z_.elements()) z_.solve(k, ports_at(k), states_[k]);
    else
      evaluate_linked(ports_at);
    z_.take_rates(states_);
  }
  /// The states at a start that gives none: of each element when the signals to it are known. Those
  /// of sampled elements may depend on those of others, and the other way round.
  template <class PortsAt>
  void start_states(const PortsAt& ports_at, StateStart of) noexcept {
    const auto others = [&] {
      of == StateStart::sampled ? find_links(ports_at)
                                : start_others(ports_at, of == StateStart::found);
    };
    for (const std::size_t k : order_.sampled) {
      if (of == StateStart::found) break;
      others();
      z_.start(k, ports_at(k), false);
      const Element& e = model_.elements[k];
      if (e.start_states.size() == 0) sample_one(k, ports_at, 1e-6 * e.clock.period);
    }
    others();
  }
  /// The search for an equilibrium begins: deflections are zero here.
  template <class PortsAt>
  void begin_deflections(const PortsAt& ports_at) noexcept {
    for (const std::size_t k : z_.elements()) z_.begin_deflection(k, ports_at(k));
  }
  /// Sampled elements at an instant: what begins to act, then what is computed, in the order of
  /// their signals.
  template <class PortsAt>
  void sample(const PortsAt& ports_at, double width) noexcept {
    for (const std::size_t k : order_.sampled) begin_to_act(ports_at(k), width, z_.of(k));
    for (const std::size_t k : order_.sampled) sample_one(k, ports_at, width);
  }
  /// Signals between elements at other ports.
  template <class PortsAt>
  void find_links(const PortsAt& ports_at) noexcept {
    if (!links_.empty()) evaluate_linked(ports_at);
  }
  /// The first controller at the last evaluation, at time t, that has no value or reads a function
  /// of time without one: no force shows it if nothing reads the controller now. -1: none.
  int undefined(double t) const noexcept;
  /// Since the beginning of the last step.
  const ThrownByElement& thrown() const noexcept { return thrown_; }

  /// The load of element k, that of its joint (model/joint_load.hpp).
  double load(std::size_t k) const noexcept {
    assert(model_.elements[k].load.joint >= 0);
    return z_.of(k)[load_place(k)];
  }
  /// Its efforts with another load, at the ports of the last evaluation.
  void set_load(std::size_t k, double value, const Ports& in) noexcept {
    assert(model_.elements[k].load.joint >= 0);
    z_.of(k)[load_place(k)] = value;
    if (!held_) evaluate_element(in, states_[k]);
  }

  /// Left-hand side of the elements, -Q: calls add(marker, force, torque) for each marker of each.
  template <class Add>
  void add_wrenches(const Add& add) const noexcept {
    for (const auto& [marker, w] : wrenches_) add(marker, -w->F, -w->T);
  }

 private:
  int load_place(std::size_t k) const noexcept {
    return model_.elements[k].states + model_.elements[k].kept - 1;
  }
  void evaluate_one(std::size_t k, const Ports& in) noexcept {
    if (z_.follow())
      z_.solve(k, in, states_[k]);
    else
      evaluate_element(in, states_[k]);
    took(k);
  }
  /// Of the elements that are not sampled.
  template <class PortsAt>
  void start_others(const PortsAt& ports_at, bool found) noexcept {
    const auto start = [&](std::size_t k) {
      if (!model_.elements[k].clock.ticks()) z_.start(k, ports_at(k), found);
    };
    if (links_.empty()) return std::ranges::for_each(z_.elements(), start), void();
    measure(ports_at);
    std::size_t ring = 0;
    for (const SignalGroup& group : order_.groups) {
      // In a ring a start may depend on the signals of the others.
      constexpr int rounds = 50;
      for (int round = 0; round < (group.links.empty() ? 1 : rounds); ++round) {
        std::ranges::for_each(group.elements, start);
        evaluate_group(group, ring, ports_at);
      }
      ring += !group.links.empty();
    }
  }
  template <class PortsAt>
  void sample_one(std::size_t k, const PortsAt& ports_at, double width) noexcept {
    const Ports in = ports_at(k);
    if (!is_sampled_at(model_.elements[k], in.t, width)) return;
    find_links(ports_at);
    take_sample(in, z_.of(k));
  }
  /// The angles of the element are continued from the present ones.
  void take_angles(std::size_t k) noexcept {
    if (!model_.elements[k].reads && slots_[k].size() < 2)
      return set_angle(first_slot_[k], states_[k].length);
    for (std::size_t i = 0; i < slots_[k].size(); ++i) {
      if (slots_[k][i] < 0) continue;
      const int port = model_.elements[k].coordinates[i].port;
      double& angle = angles_[slots_[k][i]];
      angle = angle_about_z<double>(*markers_[k][port], *markers_[k][port + 1], angle);
    }
  }
  void took(std::size_t k) noexcept {
    take_angles(k);
    if (states_[k].thrown && thrown_.element < 0)
      thrown_ = {static_cast<int>(k), states_[k].thrown};
  }
  /// Lengths and rates that are signals; what else an element gives may still depend on signals.
  template <class PortsAt>
  void measure(const PortsAt& ports_at) noexcept {
    for (const std::size_t k : order_.measured) {
      evaluate_element(ports_at(k), states_[k]);
      take_angles(k);
      publish(k);
    }
  }
  template <class PortsAt>
  void evaluate_linked(const PortsAt& ports_at) noexcept {
    measure(ports_at);
    std::size_t ring = 0;
    for (const SignalGroup& group : order_.groups) {
      evaluate_group(group, ring, ports_at);
      ring += !group.links.empty();
    }
  }
  /// `ring`: its place among the rings, if it is one.
  template <class PortsAt>
  void evaluate_group(const SignalGroup& group, std::size_t ring,
                      const PortsAt& ports_at) noexcept {
    if (group.links.empty())
      evaluate_one(group.elements[0], ports_at(group.elements[0]));
    else
      rings_[ring].solve(ports_at, z_, links_, states_);
    for (const std::size_t k : group.elements) {
      if (!group.links.empty()) took(k);
      publish(k);
    }
  }
  /// The links from an element.
  void publish(std::size_t k) noexcept {
    for (const std::size_t l : links_from_[k]) {
      const SignalLink& link = model_.links[l];
      links_[l] = link.factor * states_[k].result(link.result());
    }
  }

  struct HeldAngle {
    int slot;
    const MarkerState *a, *b;
  };

  const Model& model_;
  std::vector<Efforts> states_;
  std::vector<std::vector<int>> slots_;  ///< of the coordinates of each element in `angles_`
  std::vector<int> first_slot_;          ///< of each element: of its first angle; -1: none
  std::vector<HeldAngle> held_angles_;
  std::vector<double> angles_;       ///< select the turn of the next evaluation [rad]
  std::vector<double> kept_angles_;  ///< those at the beginning of the step
  std::vector<double> inputs_;
  std::vector<std::int64_t> branches_;
  SignalOrder order_;
  std::vector<SignalRing> rings_;
  std::vector<double> links_;  ///< values of model.links, times their factors
  std::vector<std::vector<std::size_t>> links_from_;  ///< each element
  ElementStates z_;
  std::unique_ptr<InputChanges> changes_;  ///< null: none
  bool held_ = false;
  ThrownByElement thrown_;
  std::vector<std::vector<const MarkerState*>> markers_;  ///< of each element
  std::vector<std::size_t> acting_;                       ///< elements with a law
  std::vector<std::pair<int, const Wrench*>> wrenches_;   ///< on markers, of all elements
};

}  // namespace floatframe
