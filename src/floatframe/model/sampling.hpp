#pragma once
// Sampled elements. At the instants t_k = first + k period their values are computed from the
// motion there; they act as constants from t_k + delay on until the next ones do. Kept numbers: the
// values that act, those that wait, the oldest first, and what the kind keeps from sample to
// sample. The keys: sampling_keys.hpp.
#include <span>
#include <string>
#include <vector>

#include "floatframe/model/element_evaluation.hpp"

namespace floatframe {

/// The instants first + k period, k = 0, 1, ... [s], without drift.
struct SampleTicks {
  double first = 0.0, period = 0.0;
  /// The first one later than t.
  double after(double t) const noexcept;
  /// One is within `width` of t.
  bool at(double t, double width) const noexcept { return !(after(t - width) > t + width); }
};
/// At which some element of the model computes a value or begins to act with one, each once.
std::vector<SampleTicks> ticks_of(const Model& model);

/// With `own` kept numbers of its kind. Does nothing without a period.
void take_clock(Element& element, const Sampling& sampling, int own = 0);
/// Instants within `width` of in.t, where the ports are: what begins to act, what is computed.
void begin_to_act(const Ports& in, double width, double* kept) noexcept;
bool is_sampled_at(const Element& element, double t, double width) noexcept;
void take_sample(const Ports& in, double* kept) noexcept;
inline double* own_numbers(const Element& element, double* kept) noexcept {
  return kept + (1 + element.clock.waiting) * (1 + element.further());
}
/// The law of a sampled element; false: it is not sampled.
template <class S>
bool holds_value(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  if (!in.element.clock.ticks()) return false;
  out.force = in.state(0);
  for (int k = 0; k < in.element.further(); ++k) out.further[k] = in.state(1 + k);
  return true;
}

/// The sentence about the elements whose values linear systems and statics hold; empty: none.
std::string held_samples_note(const Model& model);
/// A part of a step that is made as a step; what is shorter is bridged.
inline constexpr double shortest_part = 0.02;
/// Throws InputError, naming an element, if a step of this size has parts between its instants that
/// are shorter.
void require_samples_of_steps(const Model& model, double step);
/// Throws InputError, naming an element, if steps of this size from `begin` on do not end at the
/// instants of all of them.
void require_ticks_at_steps(const Model& model, double begin, double step);

}  // namespace floatframe
