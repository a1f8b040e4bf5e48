#pragma once
// Places of a part: its interfaces, as rows of the system, and its markers, as linear functions of
// the dofs.
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/reduction/part.hpp"

namespace floatframe {

/// Before assembly.
struct InterfacePlace {
  std::string name;
  int node = -1;  ///< reference
  unsigned mask = 63u;
  InterfaceHealth health;
  // After assembly:
  std::vector<int> rows;  ///< of the system, in the order of the axes
  std::vector<int> axes;
  int first = 0;  ///< place of rows[0] among the boundary rows of all interfaces
  bool holds() const noexcept { return axes.size() == 6; }  ///< holds the part alone
};

struct MarkerPlace {
  std::string name;
  std::vector<int> nodes;
  Vec3 p = Vec3::Zero();
  bool residual = false;
  // After assembly, 3 x n: u = translation q, theta = rotation q.
  SparseRows translation, rotation;
  /// The coefficients of the displacements of nodes in both, 3 x 3 nodes.
  SparseRows by_translations, turn_by_translations;
};

/// A part with its interfaces, markers and equations, the basis of all further computations.
struct PlacedPart {
  const FeModel& model;
  const FeSystem& system;
  const MatX& R;  ///< n x 6: rigid motions about the origin
  const std::vector<InterfacePlace>& interfaces;
  const std::vector<MarkerPlace>& markers;
  const PartOptions& options;
};

/// Adds the interfaces to the model and ties the rotations without stiffness (`free_turns`). Throws
/// InputError with the errors of all of them, and if an interface or residual marker would
/// hold such a rotation.
std::vector<InterfacePlace> place_interfaces(FeModel& model, const PartOptions& options,
                                             const std::vector<MarkerPlace>& markers = {});
/// Throws InputError with the errors of all markers.
std::vector<MarkerPlace> place_markers(const FeModel& model, const PartOptions& options);

/// Completes the interfaces. Throws InputError if a dof does not exist or is given twice.
void find_rows(const FeModel& model, const FeSystem& system,
               std::vector<InterfacePlace>& interfaces);
/// Completes the markers: the mean motion of their nodes, rotations by least squares; for a single
/// node its own rotation if it has one, else none.
void find_motions(const FeModel& model, const FeSystem& system, std::vector<MarkerPlace>& markers);

}  // namespace floatframe
