#pragma once
// What must hold of every mechanism, judged by runs of 0.2 s in both formulations.
//
// First step: at most 1 ms and at most a tenth of the shortest time constant at the start
// (fastest_rate), such that the kinks of functions of time lie between steps where they can
// (steps_on_kinks); the same rule for all. Difference d(h): the largest over all positions of
// points, joint coordinates and modal amplitudes at the instants of the first step.
// An equilibrium may be one of many: a body that hangs on a ball is in balance at each angle about
// the vertical, and rounding chooses, by up to 1e-6 after a long search. What two inertia methods
// find apart is judged with one, that of relative coordinates: then both begin at the same place.
//   equal          d < 1e-8 at some step
//   second_order   d(h)/d(h/2) is 3 to 5 at the first step, and d(h/2) below 0.1 m or rad ...
//   finer          ... or at one of the next two halvings: the first step was not small enough
//   kinked         a run passed a kink of a law (a stop, a table of straight lines, a tyre that
//                  lifts off or meets an edge): the error of that one step depends on where in the
//                  step it lies, so d need only fall, by 2 a halving in the mean, to the last step
//   refused        both refuse the model, with a sentence; or one, because something moves without
//                  mass, and the other stops in its first step for the same, or moves it almost
//                  without mass: the spin of a bar bent by 4e-6 m. What the inertia of its
//                  spin is compared with depends on the coordinates, where rounding is near
//   stopped        both run and stop before the end at all steps, with a sentence; at all but the
//                  largest if it says that a singular position is next: large steps may leap it,
//                  and one may where the other does not, if d < 1e-6 at the steps where both do,
//                  or if there are none and d falls by 3 to 5 in the first half of what both run
//   weightless     a run stops with the sentence that a body can move almost without mass where it
//                  has come to: its speed is unbounded there, or its place jumps. Until half of
//                  that time d falls by 3 to 5 at some halving, or is below 1e-8. Or all run, and
//                  the same holds to the end of all but bodies without any mass, which forces that
//                  vanish leave where they are
//   unbalanced     a damped freedom without mass begins at a speed that its forces do not balance,
//                  which steps without damping never forget: d halves with the step, while
//                  accelerations of the first instants double, in both formulations
//   out_of_range   a run says that a body deforms or bends too far for linear modes, which soon
//                  grow without bound: the same until then; or that it turns too far in one step:
//                  the same until half of that time. What a run does after it, it may also stop at
// Everything else is a violation.
#include <string>
#include <vector>

#include "floatframe/run/results.hpp"
#include "support/random_mechanism.hpp"

namespace floatframe::test {

enum class Verdict {
  equal,
  second_order,
  finer,
  kinked,
  refused,
  stopped,
  weightless,
  unbalanced,
  out_of_range,
  split,           ///< runs in one formulation, is refused or stops in the other
  no_reason,       ///< refused without a sentence, or by an exception of another kind
  not_finite,      ///< an output that is no number
  wrong_order,     ///< the difference of the formulations does not fall as it must
  energy,          ///< a conservative model whose energy error does not fall with the step
  not_repeatable,  ///< the same run twice, other bits
};
constexpr bool is_violation(Verdict v) { return v >= Verdict::split; }
const char* word(Verdict v);

struct Judgement {
  Verdict verdict = Verdict::equal;
  std::string reason;               ///< sentences of the refusal or figures of the violation
  double step = 0.0;                ///< the first one [s]
  std::vector<double> differences;  ///< at h, h/2, ...
  bool kinked = false;
  bool conservative = false;
};

Judgement judge(const Mechanism& mechanism);

/// The number of steps, of `steps` and the next twenty, that puts most kinks of the accelerations
/// that are known beforehand between two steps: where tables of motions (twice differentiable) and
/// of loads (some with corners) go from piece to piece. A kink within a step leaves an error of
/// h^2 x (1 - x) with its place x in the step, and x changes from halving to halving: 1/5, 2/5,
/// 4/5. The difference of the formulations is then of second order with a factor that jumps.
double steps_on_kinks(const Model& model, double steps);

/// Whether a run passed from one smooth piece of a law to another.
bool passes_kinks(const Model& model, const ResultTable& table);

/// The same violation with as little as possible: what is not needed for it is taken away.
Mechanism shrunk(const Mechanism& mechanism, Verdict verdict);

}  // namespace floatframe::test
