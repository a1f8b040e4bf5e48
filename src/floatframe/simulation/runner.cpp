#include "floatframe/simulation/runner.hpp"

namespace floatframe {

template class AugmentedLagrangian<RelativeFormulation>;
template class AugmentedLagrangian<AbsoluteFormulation>;
template class Runner<RelativeFormulation>;
template class Runner<AbsoluteFormulation>;

}  // namespace floatframe
