#pragma once
// Random mechanisms: whole models made from a seed, for tests that ask what must hold of any model.
//   tree        1 to 8 bodies on joints of every type
//   closed      a tree with further joints and rods between its bodies: many are locked or have
//               redundant constraints
//   planar      four- and five-bar linkages, parallel cranks and sliders: parallel axes, so that
//   the
//               spatial constraints are redundant, or a ball and a sliding hinge that make them not
//   spatial     single loops with seven to nine joint coordinates: mobility one to three
// Rigid bodies (also without mass, without inertia, without inertia about one axis), bars of all
// mass models and kinds of modes, bodies with given modal data, mirror images, bodies held rigid;
// joints reversed, cut and driven; all force kinds with all laws. What is drawn need not be a valid
// model: it may have freedoms without mass or loops that cannot close, and must then be refused.
#include <optional>
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe::test {

struct Mechanism {
  ModelDescription description;
  const char* family = "";
  /// Inertia terms of the two formulations; not always the same where the mass models allow both.
  InertiaMethod relative = InertiaMethod::preprocessing;
  InertiaMethod absolute = InertiaMethod::preprocessing;
};

/// The same seed gives the same mechanism. One that changes faster than `most_rate` is drawn again:
/// its steps would be too small for a test.
Mechanism random_mechanism(unsigned seed);
inline constexpr double most_rate = 2500.0;  ///< [1/s]

/// With joints of `type` in place of those that have as many coordinates.
Mechanism with_joints(Mechanism mechanism, JointType type);

/// With one more force element, smooth and soft, between two of the places that joints use. For
/// types that are not drawn. nullopt: there are no two such bodies.
std::optional<Mechanism> with_force(Mechanism mechanism, ElementType type, unsigned seed);

/// With a coupling, a sum or one by name, of coordinates of joints of bodies with mass: one without
/// begins with a speed that no force balances, and a coupling hands the error of that on, of first
/// order, to bodies with mass. nullopt: there are no two.
std::optional<Mechanism> with_coupling(Mechanism mechanism, unsigned seed);

/// With a constraint of this type between two places that joints use, satisfied as drawn. nullopt:
/// there are no two on bodies with mass.
std::optional<Mechanism> with_constraint(Mechanism mechanism, ElementType type, unsigned seed);

/// With a circle on the parent of a planar joint, taken in place of a ball, and a line on its child
/// that touch. nullopt: there is none.
std::optional<Mechanism> with_touching_curves(Mechanism mechanism, unsigned seed);

/// With a cam, by segments, points or a formula, of two coordinates as those of a coupling.
std::optional<Mechanism> with_cam(Mechanism mechanism, unsigned seed);

/// With a stop or friction on any coordinate of a joint that is no rotation vector, as the keys of
/// joints give it. nullopt: there is none.
std::optional<Mechanism> with_joint_element(Mechanism mechanism, ElementType type, unsigned seed);

/// With a controller that measures the length of one element and pulls with another one, between
/// other places. nullopt: there are none.
std::optional<Mechanism> with_controller(Mechanism mechanism, unsigned seed);

/// Largest rate at which a model can change at its start [1/s]: square root of the eigenvalues of
/// (K, M) and norm of M^-1/2 C M^-1/2 on the motions that the constraints leave free and that have
/// mass, twice the largest speed. Zero if it cannot start.
double fastest_rate(const Model& model, InertiaMethod method);

/// One line about what it holds, and many lines with all numbers.
std::string summary_of(const ModelDescription& d);
std::string text_of(const ModelDescription& d);

/// Nothing but springs, gravity and modal stiffness does work: no damping, load, drive or tyre.
bool is_conservative(const ModelDescription& d);

}  // namespace floatframe::test
