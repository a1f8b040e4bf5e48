#pragma once
// The part of the second order that enters the inertia terms of a body.
#include <memory>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// `FlexibleBody::turning`, and with `stiffens` `FlexibleBody::second_order` with its nodes; null:
/// neither.
std::shared_ptr<const SecondOrder> second_order_on_masses(const FlexibleBody& body, bool stiffens);

}  // namespace floatframe
