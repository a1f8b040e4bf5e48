#pragma once
// Closes the loops of a model: q and v with
//   Phi(q) = 0,  Phi_q v + Phi_t = 0                                                        (1)
// and the start values, along a path from the drawn configuration; where they contradict, those
// that are kept never change. Load time (allocates, throws; theory section 12).
#include "floatframe/formulation/relative.hpp"

namespace floatframe {

/// At time t. Throws RunError naming the joint or rod that has a gap, or the joints that keep their
/// values if these are the reason. Without `as_given` the positions differ from those of the model,
/// so no joint is held at its given value.
void close_loops(RelativeFormulation& f, VecX& q, VecX& v, bool positions, double t = 0.0,
                 bool as_given = true);

}  // namespace floatframe
