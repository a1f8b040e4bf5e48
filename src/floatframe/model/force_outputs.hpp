#pragma once
// Result quantities of a force element, their units, and the category of its energy.
#include "floatframe/model/model.hpp"

namespace floatframe {

/// The scalar force or torque, its measure (length, deflection, angle) and the rate of that.
enum class ForceQuantity { force, length, rate };

/// "N", "rad/s", ...; empty if elements of its type have no such quantity.
const char* force_output_unit(const Force& force, ForceQuantity quantity) noexcept;
/// Prescribed loads have no length and no rate.
bool force_has(ForceType type, ForceQuantity quantity) noexcept;

/// Category of the energy that an element exchanges (simulation/energy_balance.hpp).
enum class EnergyCategory {
  springs,  ///< it keeps ForceState::energy (zero if it only damps); ForceState::damping is of
            ///< dampers, the rest of actuators and targets
  tyres,    ///< the same, but its energy may jump
  loads     ///< it stores no energy
};
EnergyCategory energy_category(ForceType type) noexcept;

/// A law of the element is one of a rotation vector, which jumps at half a turn.
bool ends_at_half_turn(const Force& force) noexcept;

}  // namespace floatframe
