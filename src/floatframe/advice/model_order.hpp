#pragma once
// Model order: the number of modes that each flexible body needs for accurate vibrations of the
// assembled system below a frequency.
//
// Estimate. Without amplitude k of a body, a vibration of the system, (K - w^2 M) x = 0, has the
// Rayleigh quotient of x with x_k = 0, so that its frequency increases by at most about
//   dw / w = (K_kk - w^2 M_kk) |x_k|^2 / (4 T)                                                  (1)
// with T = 1/2 w^2 x^T M x the kinetic energy, K_kk and M_kk of the body. For each amplitude the
// largest estimate over all vibrations of the range is taken; those with the smallest are removed
// first, those with equal estimates (left and right) together.
//
// Verification. The linear system without them is computed and its frequencies are compared one by
// one; bisection finds the largest number for which all stay within the tolerance. Then the model
// is run without them, and its outputs are compared as in `advise`.
//
// Modes that the bodies do not contain cannot be assessed in this way: a warning names the bodies
// whose highest frequency is within the range or not far above it.
#include <string>
#include <vector>

#include "floatframe/advice/mode_advice.hpp"

namespace floatframe {

struct ModelOrderOptions {
  double below = 0.0;       ///< end of the range [Hz]
  double tolerance = 0.01;  ///< change of a frequency
};

struct BodyOrder {
  int body = 0;
  std::string name;
  std::vector<int> needed;        ///< modes from 0, ascending
  std::vector<double> estimates;  ///< (1) of each mode, the largest over the range
  double own = 0.0;               ///< highest frequency of its normal modes [Hz]; 0: it has none
};

struct ModelOrder {
  std::vector<BodyOrder> bodies;  ///< the flexible ones
  int modes = 0, needed = 0;
  int trials = 0;                             ///< linear systems of reduced models
  std::vector<double> full, reduced;          ///< undamped frequencies of the range [Hz]
  double change = 0.0;                        ///< the largest, in parts
  bool ran = false;                           ///< both models did
  std::vector<OutputDifference> differences;  ///< of the runs, the largest first
  std::vector<std::string> warnings;
};

/// At the start state given by the model. Throws InputError for invalid options, RunError as
/// `linear_system`.
ModelOrder model_order(const Model& model, const ModelOrderOptions& options);

}  // namespace floatframe
