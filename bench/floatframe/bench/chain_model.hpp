#pragma once
// The chain used to compare flexible multibody programs: beams connected to the ground and to each
// other by parallel revolute joints, released from the horizontal.
//
// Each link is a steel beam (E 2.0e11 Pa, nu 0.3, 7500 kg/m3) 1 m long along x with a square
// section of 20 mm, gravity is 9.81 m/s2 along -z, the hinge axes are y. Both ends are interfaces
// of the Craig-Bampton reduction: the twelve interface degrees of freedom less the six rigid
// motions, which the body frame at the first end takes, are six static modes; the other modes are
// fixed-interface normal modes. At the start the links are undeformed and at rest, the last end at
// (links, 0, 0).
#include <string>

#include "floatframe/description/description.hpp"

namespace floatframe {

/// `modes` per link: up to six static ones, in the order tip z, ry, y, rz, x, rx (bending first),
/// and normal modes beyond. `elements` per link. Outputs: tip.x, tip.y, tip.z, the last end of the
/// last link [m]. Does not throw; `build_model` reports too many modes.
ModelDescription chain_model(int links, int modes, int elements);

/// The same chain with links given as a reduced body. It must have named nodes "start" and "end" at
/// x = 0 and x = 1 m and its frame at "start".
ModelDescription chain_model(int links, const FlexibleBody& link);

/// Spectral radius of the benchmarks. The trapezoidal rule (1) is exact in energy but unstable in
/// absolute coordinates: the multipliers of stiff links oscillate without damping.
inline constexpr double chain_spectral_radius = 0.9;

/// Number of modes of `elements` beams that certainly have inertia: in the plane of motion the free
/// nodes have one translation each, less the rotation about the hinge, for two static and half of
/// the normal modes; torsion has no inertia but is harmless.
int largest_chain_modes(int elements) noexcept;

/// Position of the tip of four links at t = 1 s, computed with links of solid elements and another
/// program at a step of 0.1 ms [m].
inline const Vec3 published_tip_of_four{-1.000973, 0.0, -3.608138};

}  // namespace floatframe
