#pragma once
// Linear analyses count geometric stiffening in where it acts: of each body for which the model
// does not say (`geometric_stiffening` is not given), whose displacements of second order are
// known, and which spins or carries load at the operating point. Loads and spin have there the
// stiffness K_G in the modes of the body; it counts where
//   max |mu| > 1e-6,  K_G x = mu K x
// Runs leave it out unless the model asks for it.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

struct CountedStiffening {
  Model model;                      ///< with geometric stiffening of these bodies
  std::vector<std::string> bodies;  ///< that have it without being asked for
  std::string sentence;             ///< which, and that `run` leaves it out; empty: none
  /// What is left out, a sentence each without its point: bodies that are asked to do without and
  /// spin or carry load beyond the limits of the range, or whose stiffening is not known.
  std::vector<std::string> notes;
};

/// Where the options of the model start it. A model with bodies of this kind already, as this
/// function gives it, keeps them. Throws RunError if the start cannot be.
CountedStiffening counted_stiffening(const Model& model);
/// Of these bodies, whatever they do there: for an analysis that makes them spin.
CountedStiffening counted_stiffening(const Model& model, const std::vector<int>& bodies);

}  // namespace floatframe
