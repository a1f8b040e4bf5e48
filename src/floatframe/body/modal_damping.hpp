#pragma once
// Damping of a body: user input, the matrix D with this damping, and the fractions of a matrix.
//
// D acts on the modal amplitudes y: rigid motions are always undamped. A damping is given
// for modes (w_k, y_k), y_k^T K y_k = 1, with the supports selected by `reference`:
//   frame    its frame:       K y = w^2 M_ff y
//   free     nothing:         K y = w^2 (M_ff - M_fr M_rr^+ M_rf) y, the vibrations of the free
//            body, for any frame; with mean axes M_fr = 0 and they are those of `frame`
//   mounted  its interfaces:  motions z = (q_r, y) of M(0) z'' + diag(0, K) z = 0 with B z = 0, B
//            the displacements and rotations of all degrees of freedom of the interfaces. They omit
//            deformations w by motions of the interfaces alone, Y^T K w = 0 (constraint modes
//            of a Craig-Bampton set), which take their modes from the free body: K w = w^2 (M_ff -
//            M_fr M_rr^+ M_rf) w among them.
// With these, which are orthogonal in K,
//   D = sum_k c_k (K y_k)(K y_k)^T,   c_k = 2 zeta_k/w_k   or   c_k = alpha/w_k^2 + beta
// is positive semidefinite, and y_k^T D y_k = 2 zeta_k w_k for y_k^T M y_k = 1: each mode has its
// fraction of critical damping. Massless modes (1/w = 0) have only beta.
//
// Load time: allocates and throws InputError.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// Supports in the modes whose damping is given.
enum class DampingReference { frame, free, mounted };
/// "frame", "free", "mounted"
const char* word(DampingReference reference) noexcept;

/// Modes below a frequency.
struct DampingBand {
  double below = std::numeric_limits<double>::infinity();  ///< [Hz]; of the last band: infinite
  double fraction = 0.0;
};

/// At most one of fractions, bands and Rayleigh's factors; none of them: no damping.
struct ModalDamping {
  ModalDamping() = default;
  ModalDamping(double fraction) : fractions{fraction} {}  // NOLINT: damping = 0.02

  /// Of critical damping, of the modes by ascending frequency; the last one of all that follow.
  /// `mounted`: those of the held body first, then those of its interfaces.
  std::vector<double> fractions;
  std::vector<DampingBand> bands;  ///< ascending
  double alpha = 0.0;              ///< D = alpha M + beta K: of the mass [1/s]
  double beta = 0.0;               ///< of the stiffness [s]
  DampingReference reference = DampingReference::frame;
  /// `mounted`: the frequency at which deformations by motions of the interfaces have their
  /// fraction, since they depend on the mass of other bodies; 0: their own [Hz].
  double interface_frequency = 0.0;

  bool none() const noexcept;
};

/// 1 % below 100 Hz, 10 % below 1 kHz, 100 % above.
std::vector<DampingBand> usual_damping_bands();

/// Error in it: numbers out of range, two kinds at once; nullopt if it is valid.
std::optional<std::string> damping_complaint(const ModalDamping& damping);

/// D of a body with given K, integrals, nodes and interfaces. Throws InputError: more
/// fractions than modes, `mounted` without interfaces, K not positive definite.
MatX damping_matrix(const FlexibleBody& body, const ModalDamping& damping);

/// Modes of a body with the supports of `reference`, in ascending order, y^T K y = 1.
struct ReferenceModes {
  MatX Y;   ///< nm x n
  VecX mu;  ///< 1/w^2 [s2/rad2]; 0: without mass
  /// The first ones are those held by `reference`; the others, of `mounted` only, those of
  /// deformations by motions of the interfaces.
  Eigen::Index held = 0;
};
ReferenceModes reference_modes(const FlexibleBody& body, DampingReference reference);

/// A mode and its fraction of critical damping from D, y^T D y/(2 w).
struct DampedMode {
  double frequency = 0.0;  ///< [Hz]
  double fraction = 0.0;
};
/// Modes with mass; `mounted`: those with the interfaces held. Empty if there are none.
std::vector<DampedMode> damped_modes(const FlexibleBody& body, DampingReference reference);

/// Damping of a body in the modes of each reference.
struct OwnDamping {
  std::vector<DampedMode> frame;  ///< empty if they are the free ones
  std::vector<DampedMode> free, mounted;
  bool interfaces = false;  ///< are the interfaces of the body known?
};
/// Empty without damping, or where a combination of modes has no stiffness.
OwnDamping own_damping(const FlexibleBody& body);

}  // namespace floatframe
