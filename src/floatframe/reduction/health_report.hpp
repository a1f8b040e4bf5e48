#pragma once
// Data for judging the quality of a reduced body. Plain data, SI units.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/body/modal_damping.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

struct MassProperties {
  double mass = 0.0;             ///< [kg]
  Vec3 centre = Vec3::Zero();    ///< [m]
  Mat3 J_origin = Mat3::Zero();  ///< inertia tensor about the origin of the body frame [kg m2]
};

struct InterfaceHealth {
  std::string name;
  int nodes = 0;
  Vec3 p = Vec3::Zero();   ///< reference point [m]
  std::string kind;        ///< "rigid", "mean", "node"
  double condition = 0.0;  ///< of the nodes' geometry: largest over smallest singular value of
                           ///< their rigid motions, scaled by the size of the interface
  /// Largest displacement error of this interface under its own six unit loads, relative to the
  /// largest displacement; the other interfaces as in `static_support`.
  double static_error = 0.0;
};

struct ModeHealth {
  std::string name;
  double frequency = 0.0;              ///< [Hz] of fixed-interface (or free) normal modes
  Vec6 effective_mass = Vec6::Zero();  ///< fraction of mass and inertia in x y z rx ry rz
  bool kept = true;
};

struct FrequencyPair {
  double full = 0.0, reduced = 0.0;  ///< [Hz]
  double relative_error() const noexcept { return full > 0.0 ? reduced / full - 1.0 : 0.0; }
};

struct HealthReport {
  int nodes = 0, elements = 0, dofs = 0, modes = 0;
  MassProperties from_elements;       ///< from the assembled mass matrix and rigid motions
  MassProperties from_invariants;     ///< from the invariants of the reduced body
  double volume = 0.0;                ///< [m3]; 0 if there are no elements
  double volume_times_density = 0.0;  ///< [kg], plus point masses
  /// Six lowest eigenvalues of the free body relative to the first elastic one; largest |K R| /
  /// |K|.
  std::optional<Vec6> rigid_eigenvalues;
  double rigid_residual = 0.0;
  /// Condition of M_ff of the raw basis without rigid motions, each direction scaled to one.
  double modal_mass_condition = 1.0;
  /// Do rotations of nodes carry mass (beams, shells, point masses with inertia)? Not given in
  /// files of earlier programs.
  std::optional<bool> rotary_inertia;
  std::vector<ModeHealth> normal_modes;
  std::vector<FrequencyPair> free_frequencies;  ///< elastic, full against reduced
  OwnDamping damping;  ///< fractions of critical damping of the reduced body's own modes
  std::vector<InterfaceHealth> interfaces;
  std::string static_support;  ///< support used in the static check
  std::string solver;
  std::vector<std::pair<std::string, double>> seconds;  ///< of each stage
  std::vector<std::string> notes;                       ///< ignored items of the file
  std::vector<std::string> warnings;                    ///< one sentence each: anything suspicious
};

}  // namespace floatframe
