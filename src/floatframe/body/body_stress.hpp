#pragma once
// Stress data of a body. Linear in the modal amplitudes y and in the effect of its own inertia and
// weight beyond the modes (mode acceleration: the static response to a load, of which the
// modes represent only a part),
//   stress = modes y + loads c
// with the load coefficients c of an instant, the density of force that acts on the undeformed
// body and on its modes as they move:
//   c[j]          = -(a_B - g)_j
//   c[3 + 3i + j] = -A_ji,  A = skew(alpha) + skew(w)^2: force -rho A_ji r_i along axis j
//   c[12 + k]     = -d2 y_k / dt2
// all in body axes: a_B acceleration of the origin of the body frame, w and alpha its angular
// velocity and acceleration, g gravity. Neglected: Coriolis forces of the modes, 2 w x X dy/dt, and
// the deformation of the lever arms. Source: Dietz, Vibration and Fatigue Analysis of Vehicle
// Systems using Component Modes (1999); Craig, Structural Dynamics (1981), mode acceleration.
// Body frame, SI units.
#include <string>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// Load coefficients of the body itself: columns of `loads` before those of its modes.
inline constexpr int body_load_cases = 12;

/// A stress point: at a node of the surface, of a layer of a shell or of an outer point of a
/// beam's section. A node between two materials or between sections has a point for each.
struct StressPlace {
  enum class Layer {
    solid,
    top,     ///< of a shell, on the side of its normal
    bottom,  ///< of a shell
    section  ///< an outer point of a beam's section
  };
  Layer layer = Layer::solid;
  int point = -1;  ///< of BodyShape::positions; -1: bars, which have none
  int node = -1;   ///< of the finite-element file, of bars of `FlexibleBody::nodes`; from 0
  int number = 0;  ///< the node's in the finite-element file; 0: bars, whose nodes have none
  int group = 0;   ///< of BodyStress::groups
  /// Unreliable: held by a rigid spider, an edge of one, or a support (peak of the mesh).
  bool doubtful = false;
  Vec3 p = Vec3::Zero();  ///< [m]
};

/// End of a beam element: section forces of its positive face, N, Vy, Vz [N], T, My, Mz [Nm], in
/// the local axes of the beam.
struct BeamSectionPlace {
  int element = -1;       ///< of the finite-element model, of bars in the order of the model file
  int node = -1;          ///< as in StressPlace
  int number = 0;         ///< as in StressPlace
  int end = 0;            ///< 0: first node, 1: last; the sections of an element follow each other
  Vec3 p = Vec3::Zero();  ///< [m]
  std::string name;       ///< of the element, for tables
};

/// Elements of one material, and of one section, within which stress is averaged at a node.
struct StressGroup {
  std::string name;                   ///< of the material, if it has one
  double young = 0.0, poisson = 0.0;  ///< 0: not isotropic, strain is unknown
};

struct BodyStress {
  std::vector<StressGroup> groups;
  std::vector<StressPlace> places;
  MatX modes;  ///< 6 places x nm: xx yy zz xy yz zx [Pa per amplitude]
  MatX loads;  ///< 6 places x (12 + nm) [Pa per coefficient]; empty: unknown

  std::vector<BeamSectionPlace> sections;
  MatX section_modes;  ///< 6 sections x nm
  MatX section_loads;  ///< 6 sections x (12 + nm); empty as `loads`

  /// First place of each section; its others follow. Empty without beams.
  std::vector<int> first_place;
};

struct FlexibleBody;

/// For the mirrored body: s holds the signs of the coordinates.
BodyStress mirrored(const BodyStress& stress, const Vec3& s);
/// For the body with the modes `keep` of `body`: the static responses of the others join the loads.
BodyStress with_kept_modes(const BodyStress& stress, const FlexibleBody& body,
                           const std::vector<int>& keep);

}  // namespace floatframe
