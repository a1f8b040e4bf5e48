#pragma once
// From a finite-element part of any size to a flexible body, with a report on its health. The part
// is in SI units and in its own coordinates, which become the body frame.
//
// Load time: allocates and throws InputError with the node, element, dof or interface.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/body/modal_damping.hpp"
#include "floatframe/fe/integration.hpp"
#include "floatframe/fe/interface_selection.hpp"
#include "floatframe/fe/surface.hpp"
#include "floatframe/math/sparse_solver.hpp"
#include "floatframe/reduction/health_report.hpp"

namespace floatframe {

enum class ModeMethod {
  craig_bampton,  ///< constraint modes of the interfaces + fixed-interface normal modes
  free_free,      ///< free normal modes (+ attachment modes of `residual` markers)
  craig_chang     ///< free normal modes + residual-flexibility modes of all interfaces
};

/// Definition of the body frame; decides which rigid-body content is removed from the modes.
struct BodyReference {
  enum class Kind {
    mean_axis,  ///< Tisserand: int X dm = 0, int r_u x X dm = 0
    /// Least mean square of the displacements over the volume (for uniform density and without
    /// point masses the same as mean_axis).
    buckens,
    node  ///< tangent frame: the interface `node` has no displacement and no rotation
  };
  Kind kind = Kind::mean_axis;
  std::string node;
};

/// A point that can carry loads, sensors and outputs without being an interface.
struct MarkerDescription {
  std::string name;
  NodeChoice choice;  ///< several nodes: the marker follows their mean motion (RBE3)
  std::optional<Vec3> at;
  bool residual = false;  ///< loads act here: attachment (residual) modes, one per translation
};

/// Normal modes if the options set no limit at all.
inline constexpr int default_modes = 20;

struct PartOptions {
  std::vector<InterfaceDescription> interfaces;
  std::vector<MarkerDescription> markers;
  ModeMethod method = ModeMethod::craig_bampton;
  /// Selection of normal modes: by number; all below a frequency [Hz]; until the kept modes reach
  /// this fraction of the effective mass in every direction. Several together: whichever ends
  /// first. None of them: 20.
  std::optional<int> modes;
  double max_frequency = 0.0;
  double effective_mass = 0.0;
  BodyReference reference;
  Integration integration = Integration::exact;
  ModalDamping damping;  ///< in addition to that of a given damping matrix
  /// Free modes of the full model for the report (a second factorisation).
  bool check_free_modes = true;
  bool stresses = true;          ///< FlexibleBody::stress
  bool keep_projection = false;  ///< ProjectionData for the projection method
  SparseSolver solver = SparseSolver::automatic;
  std::function<void(const std::string& stage, double seconds)> progress;  ///< after each stage
};

struct ReducedPart {
  FlexibleBody body;  ///< `nodes`: interfaces, then markers, by name
  HealthReport health;
  Surface surface;
  Mat3X surface_positions;  ///< 3 x surface nodes [m]
  MatX surface_modes;       ///< 3 surface nodes x nm
};

/// `model` must be in SI units. Validates it.
ReducedPart reduce_part(FeModel model, const PartOptions& options);

}  // namespace floatframe
