#include "floatframe/integrator/augmented_lagrangian.hpp"

namespace floatframe {

template class AugmentedLagrangian<RelativeFormulation>;
template class AugmentedLagrangian<AbsoluteFormulation>;

std::unique_ptr<Integrator> make_integrator(Formulation& f, const StepOptions& options) {
  if (f.coordinates() == Coordinates::relative)
    return std::make_unique<AugmentedLagrangian<RelativeFormulation>>(
        static_cast<RelativeFormulation&>(f), options);
  return std::make_unique<AugmentedLagrangian<AbsoluteFormulation>>(
      static_cast<AbsoluteFormulation&>(f), options);
}

}  // namespace floatframe
