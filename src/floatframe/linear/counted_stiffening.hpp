#pragma once
// Linear analyses include geometric stiffening where it matters: for each body for which
// `geometric_stiffening` is not given, whose second-order displacements are known, and which spins
// or carries load at the operating point. Loads and spin have the stiffness K_G in the modes of the
// body there; it is included if
//   max |mu| > 1e-6,  K_G x = mu K x
// Runs omit it unless the model requests it.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

struct CountedStiffening {
  Model model;                      ///< with geometric stiffening of these bodies
  std::vector<std::string> bodies;  ///< with stiffening, without an explicit option
  std::string sentence;             ///< names them and notes that `run` omits it; empty: none
  /// Omissions, one sentence each without its full stop: bodies for which the model switches it off
  /// that spin or carry load beyond the limits of the range, or whose stiffening is not known.
  std::vector<std::string> notes;
};

/// At the start state given by the options of the model. A model that already has stiffened bodies,
/// as returned by this function, keeps them. Throws RunError if there is no start state.
CountedStiffening counted_stiffening(const Model& model);
/// For these bodies, whatever their state there: for an analysis that makes them spin.
CountedStiffening counted_stiffening(const Model& model, const std::vector<int>& bodies);

}  // namespace floatframe
