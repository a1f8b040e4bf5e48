#pragma once
// Stress of a finite-element model from displacement fields: solids and shells at the nodes of the
// surface, beams at the outer points of both ends of every element.
//
// Solids: strains at the optimal points, extrapolated to the nodes (ElementKernel::nodal_strains).
// Shells: both sides at the corners (layer_stresses). Both are averaged over the elements at a node
// that are of one material (of plies, the ply at the node; shells: of one section too, and whose
// normals differ by less than 20 degrees; at a node the normals identify the sides, for any
// orientation of its elements).
// Beams: section forces of the ends, f_e = K_e u_e - M_e a_e with a_e the field that loads the
// element inside: exact for the loads of fe/body_loads.hpp, not those of the middle of the element.
// Body frame, SI units. Load time.
#include "floatframe/body/body_stress.hpp"
#include "floatframe/fe/body_loads.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/stress_stiffness.hpp"

namespace floatframe {

/// Displacement fields, a column each, and the mass times accelerations that are their loads
/// within the elements: of the first `linear` columns the fields of fe/body_loads.hpp, of the
/// others `density`; columns without density have no loads inside.
struct StressFields {
  NodalShapes displacements;
  int linear = 0;  ///< 0 or 12
  NodalShapes density;
};

class StressRecovery {
 public:
  /// `surface`: nodes whose solids and shells are included; a place's `point` is an index there.
  StressRecovery(const FeModel& model, const std::vector<int>& surface,
                 ElementMass mass = ElementMass::section_inertia);

  /// Groups, places and sections; no matrices.
  const BodyStress& layout() const noexcept { return layout_; }
  /// Rows 6 places, then 6 sections.
  struct Recovered {
    MatX places, sections;
  };
  Recovered recover(const StressFields& fields) const;

 private:
  /// A node of an element, and the places to which it contributes.
  struct Share {
    int local, place, other;  ///< other: of a shell the bottom, else -1
  };
  int number_of(int node) const;
  /// `ply`: of a solid's layup; -1: it has none.
  int group_of(const FeElement& element, int ply = -1);
  void add_shell(int e, const std::vector<int>& point_of);
  void add_solid(int e, const std::vector<int>& point_of);
  void add_beam(int e);
  void recover_surface(int e, const StressFields& fields, MatX& sum) const;
  void recover_beam(int e, const StressFields& fields, Recovered& out) const;

  const FeModel& model_;
  ElementMass mass_;
  BodyStress layout_;
  std::vector<int> elements_at_;            ///< of each place
  std::vector<std::vector<Share>> shares_;  ///< of each element
  std::vector<int> first_section_;          ///< of each element; -1: no beam
  /// Material, shell or beam or none, section or layup, ply.
  std::vector<std::array<int, 4>> group_keys_;

  struct ShellSide {
    int place;  ///< top; the next one is the bottom
    Vec3 normal;
  };
  std::vector<std::vector<std::pair<int, ShellSide>>> sides_;  ///< of each point: group, side
  std::vector<std::vector<int>> solids_;                       ///< of each point: its places
};

}  // namespace floatframe
