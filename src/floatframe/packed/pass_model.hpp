#pragma once
// What a user says of a system as bytes, and elements by the tables of their keys.
#include "floatframe/description/system_state.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/packed/pass_body.hpp"
#include "floatframe/packed/pass_formula.hpp"

namespace floatframe {

template <class S>
void pass(S& s, CoordinateTerm& t) {
  auto& [joint, coordinate, factor] = t;
  all(s, joint, coordinate, factor);
}

// -------------------------------------------------------------------------------------------
// elements

template <class S, std::size_t... k>
void pass_alternative(S& s, KeyValue& value, std::size_t which, std::index_sequence<k...>) {
  const auto one = [&](auto index) {
    if (which != index()) return;
    if constexpr (S::reads) value.template emplace<index()>();
    pass(s, std::get<index()>(value));
  };
  (one(std::integral_constant<std::size_t, k>()), ...);
}
/// A null formula stands nowhere but in a function of time.
template <class S>
void pass(S& s, KeyValue& value) {
  constexpr std::size_t count = std::variant_size_v<KeyValue>;
  const std::size_t which = s.whole(value.index());
  s.require(which < count, "a value of no kind");
  pass_alternative(s, value, which, std::make_index_sequence<count>());
  if constexpr (S::reads)
    if (const auto* formula = std::get_if<SharedFormula>(&value))
      s.require(*formula != nullptr, "a formula that is missing");
}

/// The value of one key, or of the text of a file.
template <class S>
void pass_key(S& s, ElementDescription& e, const KeyMember& member, std::size_t words) {
  std::optional<KeyValue> value;
  if constexpr (!S::reads) value = member.read(e);
  pass(s, value);
  if constexpr (S::reads) {
    if (!value) return;
    if (const int* n = std::get_if<int>(&*value); n && words > 0)
      s.require(*n >= 0 && *n < std::ptrdiff_t(words), "a word that does not exist");
    try {
      member.write(e, *value);
    } catch (const std::bad_variant_access&) {
      s.damaged("a value of another kind than its key");
    }
  }
}
template <class S>
void pass(S& s, ElementDescription& e) {
  auto& [name, kind, origin] = e;
  const std::size_t type = s.whole(kind.index());
  s.require(type < std::size(element_types), "an element of no type");
  if constexpr (S::reads) kind = element_kind(element_types[type]).blank();
  all(s, name, origin);
  for (const ElementKey& key : element_keys(e.type())) {
    if (key.member.read) pass_key(s, e, key.member, key.words.size());
    if (key.content) pass_key(s, e, key.content->member, 0);
  }
}

// -------------------------------------------------------------------------------------------
// bodies: what a reduction changes stands behind everything else

template <class S>
void pass(S& s, SolidRound& x) {
  pass(s, x.diameter);
}
template <class S>
void pass(S& s, HollowRound& x) {
  all(s, x.outer, x.inner);
}
template <class S>
void pass(S& s, Rectangle& x) {
  all(s, x.width, x.height);
}
template <class S>
void pass(S& s, SectionConstants& x) {
  all(s, x.A, x.Iy, x.Iz, x.J);
}
template <class S>
void pass(S& s, BarDescription& x) {
  auto& [name, from, to, from_bar, from_fraction, elements, section, reference, origin] = x;
  all(s, name, from, to, from_bar, from_fraction, elements);
  s.whole(section.index());
  std::visit([&](auto& one) { pass(s, one); }, section);
  all(s, reference, origin);
}
template <class S>
void pass(S& s, NodeMass& x) {
  auto& [node, mass, origin] = x;
  all(s, node, mass, origin);
}
template <class S>
void pass(S& s, NodeDofs& x) {
  auto& [node, mask, index, origin] = x;
  all(s, node, mask, index, origin);
}
template <class S>
void pass(S& s, DampingBand& x) {
  auto& [below, fraction] = x;
  all(s, below, fraction);
}
template <class S>
void pass(S& s, ModalDamping& x) {
  auto& [fractions, bands, alpha, beta, reference, interface_frequency] = x;
  all(s, fractions, bands, alpha, beta);
  pass_word(s, reference, DampingReference::mounted);
  pass(s, interface_frequency);
}
/// To be compared only.
template <class S>
void pass(S& s, FlexibleDescription& x) {
  static_assert(!S::reads);
  auto& [young, poisson, density, points, bars, masses] = static_cast<FrameDescription&>(x);
  all(s, young, poisson, density, points, bars, masses);
  auto& [clamped, interfaces, path, normal_modes, max_frequency, analytic, basis, orthonormalise,
         mass_model, eigen_mass, section_inertia, damping] = static_cast<ReductionOptions&>(x);
  all(s, clamped, interfaces, path, normal_modes, max_frequency);
  bool there = analytic.has_value();
  pass(s, there);
  if (there) pass(s, analytic->dynamic_per_plane);
  all(s, basis, orthonormalise);
  pass_word(s, mass_model, MassModel::hermite);
  there = eigen_mass.has_value();
  pass(s, there);
  if (there) pass_word(s, *eigen_mass, MassModel::hermite);
  all(s, section_inertia, damping);
}

template <class S>
void pass(S& s, BodyDescription& b) {
  auto& [name, X_WB, mirror, X_WT, rigid, stiffening, largest_angle, kind, origin] = b;
  all(s, name, X_WB, rigid, stiffening, largest_angle, origin);
  bool flexible = !std::holds_alternative<RigidDescription>(kind);
  pass(s, flexible);
  if constexpr (S::reads) {
    if (flexible)
      kind.template emplace<FlexibleBody>();
    else
      kind.template emplace<RigidDescription>();
  }
  if (flexible) return;
  auto& [mass, p_BC, J_C, shape] = std::get<RigidDescription>(kind);  // the shape: `pass_data`
  all(s, mass, p_BC, J_C);
}

template <class S>
void pass(S& s, InputDescription& x) {
  auto& [name, unit, initial, low, high, clamp, origin] = x;
  all(s, name, unit, initial, low, high, clamp, origin);
}
template <class S>
void pass(S& s, CoordinateMotion& x) {
  auto& [coordinate, motion] = x;
  all(s, coordinate, motion);
}
template <class S>
void pass(S& s, JointDescription& j) {
  auto& [name, type, parent, child, axis, axis_2, position, velocity, keep, motion, motions, cut,
         origin] = j;
  pass(s, name);
  pass_word(s, type, *std::rbegin(joint_types));
  all(s, parent, child, axis, axis_2, position, velocity, keep, motion, motions, cut, origin);
}
template <class S>
void pass(S& s, CosineBump& b) {
  auto& [start, length, height] = b;
  all(s, start, length, height);
}
template <class S>
void pass(S& s, RoadDescription& r) {
  auto& [name, pieces, bumps, origin, surface] = r;
  all(s, name, pieces, bumps, origin, surface);
}

// -------------------------------------------------------------------------------------------
// outputs, simulation

template <class S>
void pass(S& s, GaugeDescription& g) {
  auto& [node, layer, material, toward, along, direction, inertia_loads] = g;
  pass(s, node);
  pass_word(s, layer, GaugeDescription::Layer::bottom);
  all(s, material, toward, along, direction, inertia_loads);
}
template <class S>
void pass(S& s, ReferenceDescription& r) {
  pass(s, static_cast<AttachmentDescription&>(r));
  pass(s, r.place);
}
template <class S>
void pass(S& s, OutputDescription& o) {
  auto& [name, type, at, to, entity, value, rod, constraint, about, in, whole, relative, axes, unit,
         component, gauge, formula, origin] = o;
  pass(s, name);
  pass_word(s, type, output_types[std::size(output_types) - 1]);
  all(s, at, to, entity, value, rod, constraint, about);
  pass_word(s, in, OutputAxes::place);
  all(s, whole, relative, axes, unit, component, gauge, formula, origin);
}
template <class S>
void pass(S& s, StartOffset& x) {
  auto& [translation, rotation] = x;
  all(s, translation, rotation);
}
template <class S>
void pass(S& s, RecordDescription& r) {
  auto& [states, every, bodies, accelerations] = r;
  pass_word(s, states, RecordDescription::States::states);
  all(s, every, bodies, accelerations);
}
template <class S>
void pass(S& s, SystemState::Joint& j) {
  auto& [name, type, position, velocity] = j;
  pass(s, name);
  pass_word(s, type, *std::rbegin(joint_types));
  all(s, position, velocity);
}
template <class S>
void pass(S& s, SystemState::Body& b) {
  auto& [name, position, orientation, velocity, angular_velocity, amplitudes, rates] = b;
  all(s, name, position, orientation, velocity, angular_velocity, amplitudes, rates);
}
template <class S>
void pass(S& s, SystemState::Element& e) {
  auto& [name, states] = e;
  all(s, name, states);
}
template <class S>
void pass(S& s, SystemState& x) {
  auto& [file, model, time, joints, bodies, elements] = x;
  all(s, file, model, time, joints, bodies, elements);
}
template <class S>
void pass(S& s, SimulationDescription& x) {
  auto& [coordinates, inertia, stiffening, step, duration, output_interval, until, start, state,
         offset, velocity, spectral_radius, tolerance, max_iterations, min_step, penalty,
         position_tolerance, velocity_tolerance, locate_edges, input, record, origin] = x;
  pass_word(s, coordinates, Coordinates::absolute);
  pass_word(s, inertia, InertiaMethod::projection);
  all(s, stiffening, step, duration, output_interval, until);
  pass_word(s, start, Start::state);
  all(s, state, offset, velocity, spectral_radius, tolerance, max_iterations, min_step, penalty,
      position_tolerance, velocity_tolerance, locate_edges);
  pass_word(s, input, InputUse::ramp);
  all(s, record, origin);
}
template <class S>
void pass(S& s, SnapDescription& x) {
  auto& [on, angle, distance] = x;
  all(s, on, angle, distance);
}
template <class S>
void pass(S& s, VehicleWheel& x) {
  auto& [wheel, tyre, spin, origin] = x;
  all(s, wheel, tyre, spin, origin);
}
template <class S>
void pass(S& s, VehicleAxle& x) {
  auto& [name, left, right, origin] = x;
  all(s, name, left, right, origin);
}
template <class S>
void pass(S& s, VehicleInput& x) {
  auto& [input, ratio, origin] = x;
  all(s, input, ratio, origin);
}
template <class S>
void pass(S& s, VehicleDescription& x) {
  auto& [chassis, driver, axles, steering, drive, brake, width, front, rear, origin] = x;
  all(s, chassis, driver, axles, steering, drive, brake, width, front, rear, origin);
}
/// Without the data of bodies, which follow, and hints, which have a section of their own.
template <class S>
void pass(S& s, ModelDescription& d) {
  auto& [name, gravity, snap, bodies, joints, rods, constraints, couplings, controllers, forces,
         roads, inputs, outputs, measures, amplitudes, amplitude_rates, vehicle, simulation,
         hints] = d;
  all(s, name, gravity, snap, bodies, joints, rods, constraints, couplings, controllers, forces,
      roads, inputs, outputs, measures, amplitudes, amplitude_rates, vehicle, simulation);
}

}  // namespace floatframe
