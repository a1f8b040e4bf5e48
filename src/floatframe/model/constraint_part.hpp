#pragma once
// Constraints as small parts between two markers a and b; every joint type is a list of parts
// (paper section 6, theory section 10). Each row has its value phi, its gradient (a wrench row) and
// quad = Phi_q-dot q-dot without the markers' own bias accelerations; rows of directions are scaled
// to metres by a body length, so all multipliers are in N. Directions in the formulas have world
// axes. A multiplier lambda acts on the markers with the wrench -lambda gradient. A kind of part is
// one file model/constraints/<name>.cpp, which begins with its formulas, and one entry in
// constraint_list.hpp: both formulations, messages and the generic tests run over the list.
#include <cassert>
#include <string>
#include <vector>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/model/constraint_list.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct CamProfile;
class SpaceCurve;
class CurveContact;

struct ConstraintPart {
  ConstraintType type = ConstraintType::coincident;
  int a = -1, b = -1;  ///< markers
  /// Perpendicular, and an angle about one of two axes: the two directions, in axes of a and of b.
  /// Of a coordinate: its direction e_a.
  Vec3 e_a = Vec3::UnitZ(), n_b = Vec3::UnitX();
  double c = 0.0;      ///< perpendicular: value of e_a.n_b to keep; of a coordinate: its factor
  double scale = 1.0;  ///< l, or L of a distance
  /// Its only row is added to that of the part before: a sum over several pairs of markers.
  bool continues = false;
  bool apart = false;   ///< its wrench is not one of the joint that owns it: that of teeth
  int coordinate = -1;  ///< of its element, which the part adds to a sum
  const double* angle = nullptr;  ///< selects the turn of the coordinate; null: the first
  double force = 1.0;  ///< of an element: its force per multiplier, tension, along a coordinate, or
                       ///< a torque
  const TimeFunction* motion = nullptr;
  const CamProfile* lift = nullptr;      ///< of a cam
  const SpaceCurve* curve = nullptr;     ///< that b stays on
  const CurveContact* curves = nullptr;  ///< that touch
  ConstraintOwner owner;
  int rows() const noexcept;
  /// The joint whose wrench includes that of the part; -1: none.
  int counted_by() const noexcept { return apart ? -1 : owner.joint; }
  /// It prescribes the coordinate of its joint.
  bool is_motion() const noexcept {
    return motion != nullptr && coordinate < 0 && owner.joint >= 0;
  }
};

struct ConstraintRow {
  WrenchRow gradient;
  double phi = 0.0;
  double quad = 0.0;
  double phi_t = 0.0, phi_tt = 0.0;
};

// ----------------------------------------------------------------------------------------------
// interface of a kind of part
//
// A function of step time, noexcept and free of allocation, that is called by name, its derivative,
// and the facts of its ConstraintKind.

/// Fills the rows of the part.
template <ConstraintType type>
void constraint_rows_of(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                        double t, ConstraintRow* rows) noexcept;

/// K += d(sum lambda_r gradient_r)/d(motion): the exact geometric stiffness of multipliers on the
/// rows. Not symmetric for combined rotations, because increments of a rotation multiply from the
/// left. It is defined next to the rows that it is derived from. Formulations use it where a
/// massless body is held; else a faster form (PartGradients), which the tests compare with it.
template <ConstraintType type>
void constraint_curvature_of(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                             const double* lambda, Mat12& K) noexcept;

/// Gradients for which formulations have a faster form. With d = r_b - r_a:
enum class PartGradients {
  general,
  unit,  ///< three rows, those of d itself: unit vectors on the points
  line   ///< one row d / scale on the points, which rotates with the line between them
};

struct ConstraintKind {
  int rows = 1;
  /// The positions of the markers enter, not only their directions. In the absolute formulation
  /// such a point on a deforming node has separate coordinates.
  bool points = true;
  bool angle = false;    ///< phi is an angle times `scale`
  bool on_axis = false;  ///< the gradient is that of phi only where both markers share the z axis
  PartGradients gradients = PartGradients::general;
  /// The constrained direction of a row, in messages. Null: derived from its gradient, "translation
  /// along z" if points enter, else "rotation about x".
  const char* holds = nullptr;
};

#define FLOATFRAME_KIND(name) extern const ConstraintKind name##_constraint;
FLOATFRAME_CONSTRAINTS(FLOATFRAME_KIND)
#undef FLOATFRAME_KIND

#define FLOATFRAME_KIND(name) &name##_constraint,
inline constexpr const ConstraintKind* constraint_kinds[] = {
    FLOATFRAME_CONSTRAINTS(FLOATFRAME_KIND)};
#undef FLOATFRAME_KIND

inline const ConstraintKind& constraint_kind(ConstraintType type) noexcept {
  assert(index_of(type) < std::size(constraint_kinds));
  return *constraint_kinds[index_of(type)];
}

inline int ConstraintPart::rows() const noexcept { return constraint_kind(type).rows; }

// ----------------------------------------------------------------------------------------------
// functions called by formulations

/// Value of a function of time with its first two derivatives.
PiecewisePolynomial::Value evaluate(const TimeFunction& f, double t) noexcept;
/// True if its value varies with time up to `duration`.
bool changes(const TimeFunction& f, double duration) noexcept;

/// Fills `rows[0 .. part.rows())`.
void evaluate_constraint(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                         double t, ConstraintRow* rows) noexcept;

/// K += `constraint_curvature_of` for the type of the part.
void add_constraint_curvature(const ConstraintPart& part, const MarkerState& a,
                              const MarkerState& b, const double* lambda, Mat12& K) noexcept;

/// Parts that constrain joint `index` of the model (without its motion).
void append_joint_parts(const Model& model, int index, std::vector<ConstraintPart>& parts);
/// The constraints of an element, if it has any.
void append_element_parts(const Model& model, int index, std::vector<ConstraintPart>& parts);

/// "rod 'link'"
std::string element_name(const Element& element);
/// "joint 'hinge'" or "rod 'link'".
std::string owner_name(const Model& model, const ConstraintOwner& owner);

}  // namespace floatframe
