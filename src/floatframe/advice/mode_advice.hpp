#pragma once
// Finds the modes of flexible bodies that a model does not need, from the bodies and from a run of
// the model, and verifies the result by a second run without them.
//
// For amplitude k of a body with stiffness K and mass M_ff (both modal), h the step:
//   frequency        sqrt(K_kk / M_kk) / 2 pi                     the body frame held
//   free frequency   the same with M_kk - M_kr M_rr^-1 M_rk       the body free to recoil (r: its
//                                                                 six rigid coordinates)
//   phase of a step  omega h with the free frequency: above pi the step has less than two points a
//                    period, and the integrator cannot show the mode's own vibration
//   static share     of the compliance under unit forces (and torques, divided by the length of the
//                    body) at the places where joints, rods and forces attach, the part that is
//                    lost with y_k = 0:
//                      (sum y_k^2 / (K^-1)_kk) / (sum y^T K y),  y = K^-1 g
//   dynamic share    the same quotient with the amplitudes y(t) of the run: strain energy that the
//                    body could not have taken up without the mode
//   kinetic ratio    sum M_kk ydot_k^2 over sum K_kk (y_k - mean)^2 in the run: about 1 for a mode
//                    that vibrates at its own frequency, far below 1 for one that follows its load
#include <string>
#include <vector>

#include "floatframe/run/run.hpp"

namespace floatframe {

enum class ModeAction {
  keep,
  /// Needed for its compliance only: its vibration is not resolved or not excited.
  quasi_static,
  drop
};

struct ModeAdvice {
  int mode = 0;  ///< from 0
  std::string name;
  double frequency = 0, free_frequency = 0;  ///< [Hz]
  double step_phase = 0;                     ///< omega h [rad]
  double static_share = 0, dynamic_share = 0;
  double kinetic_ratio = 0;
  double rms = 0, peak = 0;  ///< of the amplitude in the run
  ModeAction action = ModeAction::keep;
  bool retained = false;  ///< small enough to be dropped, but rejected by the verification
};

struct BodyAdvice {
  int body = 0;
  std::string name;
  std::vector<ModeAdvice> modes;
  VecX free_frequencies;  ///< of the reduced body, free in space [Hz], ascending
};

struct OutputDifference {
  std::string name, unit;
  double range = 0;  ///< largest minus smallest sample of the full model
  double rms = 0;    ///< root mean square of the difference between the two runs
  /// Largest difference; it is large for a sharp peak that is slightly delayed.
  double largest = 0;
  double peaks = 0;  ///< difference of the largest or of the smallest samples, the larger one
  double noise = 0;  ///< largest difference when the full model is run with ten times the tolerance
  /// The criterion: the larger of rms and peaks over the range. The range is taken as at least a
  /// millionth of the largest range of an output in the same unit. An output below a thousandth of
  /// that is not compared within ten times its noise (0): its variation is only round-off of the
  /// solver.
  double relative = 0;
};

struct AdviceOptions {
  double drop_share = 1e-3;    ///< both shares below this: may be dropped
  double static_ratio = 0.05;  ///< kinetic ratio below this: follows its load
  double tolerance = 0.01;     ///< of the range of every output: rms and peak differences allowed
  int repeat = 3;              ///< number of runs, of which the fastest counts
};

struct ModeAdviceReport {
  std::vector<BodyAdvice> bodies;
  int modes = 0, dropped = 0, quasi_static = 0, candidates = 0;
  int trials = 0;        ///< number of reduced models that were run
  double tolerance = 0;  ///< Newton tolerance of the compared runs, below that of the model
  /// Fastest of the repeated runs; with the warnings of the compared runs.
  RunSummary full, reduced;
  std::vector<OutputDifference> differences;  ///< the largest first
  /// The output with the largest change in the smallest rejected model, and the change as a
  /// fraction of its range; "" if the model did not run.
  std::string refused_by;
  double refused_difference = 0;
  /// Floating-point operations per step for the flexible bodies, counted and not measured: inertia
  /// terms of all iterations and elimination of the amplitudes in all factorisations of the full
  /// model.
  double flops_full = 0, flops_reduced = 0;
};

/// Runs the model (several times) with `simulation`. Throws InputError for invalid options,
/// RunError if the full model cannot run.
ModeAdviceReport advise(const Model& model, const SimulationDescription& simulation,
                        const AdviceOptions& options);

/// The model with some amplitudes of some bodies fixed at zero: `keep[i]` for body i. Outputs of
/// removed amplitudes are removed, too. Throws InputError for indices that are not those of modes.
Model with_modes(const Model& model, const std::vector<std::vector<int>>& keep);

/// "keep", "quasi-static", "drop"
const char* word(ModeAction action) noexcept;

}  // namespace floatframe
