#pragma once
// Constraints as small parts between two markers a and b; every joint type is a list of parts
// (paper section 6, theory section 10). d = r_b - r_a; e, n unit vectors fixed in the markers; l a
// body length that scales direction rows to metres. Each row has its value phi, its gradient (a
// wrench row) and quad = Phi_q-dot q-dot without the markers' own bias accelerations:
//   coincident     r_b - r_a = 0                              3 rows
//   in_line        n1.d = 0, n2.d = 0       (n in a)          2 rows
//   in_plane       z_a.d = 0                                  1 row
//   perpendicular  l (e_a.n_b - c) = 0                        1 row
//   distance       (d.d - L^2)/(2L) = 0                       1 row
//   drive_position z_a.d - f(t) = 0                           1 row
//   drive_angle    l (angle of x_b about z_a - f(t)) = 0      1 row
// A new kind is two functions and one entry in the list of constraint_part.cpp; the generic tests
// run over the list.
#include <array>
#include <span>
#include <string>
#include <vector>

#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct ConstraintPart {
  enum class Kind {
    coincident,
    in_line,
    in_plane,
    perpendicular,
    distance,
    drive_position,
    drive_angle
  };
  Kind kind = Kind::coincident;
  int a = -1, b = -1;  ///< markers
  Vec3 e_a = Vec3::UnitZ(), n_b = Vec3::UnitX();
  double c = 0.0;      ///< perpendicular: value of e_a.n_b to keep
  double scale = 1.0;  ///< l, or L of a distance
  const TimeFunction* motion = nullptr;
  ConstraintOwner owner;
  int rows() const noexcept { return kind == Kind::coincident ? 3 : kind == Kind::in_line ? 2 : 1; }
};

struct ConstraintRow {
  WrenchRow gradient;
  double phi = 0.0;
  double quad = 0.0;
  double phi_t = 0.0, phi_tt = 0.0;
};

/// Value of a function of time with its first two derivatives.
PiecewisePolynomial::Value evaluate(const TimeFunction& f, double t) noexcept;

/// Fills `rows[0 .. part.rows())`.
void evaluate_constraint(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                         double t, ConstraintRow* rows) noexcept;

/// K += d(sum lambda_r gradient_r)/d(motion): the exact geometric stiffness of multipliers (or
/// penalty forces) on the rows. Not symmetric where rotations meet, because increments of a
/// rotation multiply from the left.
void add_constraint_curvature(const ConstraintPart& part, const MarkerState& a,
                              const MarkerState& b, const double* lambda, Mat12& K) noexcept;

/// What a kind of part must supply: step-time functions, noexcept and free of allocation.
struct ConstraintKind {
  ConstraintPart::Kind kind;
  const char* name;
  bool on_axis;  ///< the gradient is that of phi only where both markers share the z axis
  void (*evaluate)(const ConstraintPart&, const MarkerState& a, const MarkerState& b, double t,
                   ConstraintRow* rows) noexcept;
  void (*curvature)(const ConstraintPart&, const MarkerState& a, const MarkerState& b,
                    const double* lambda, Mat12& K) noexcept;
};
/// In the order of ConstraintPart::Kind.
std::span<const ConstraintKind> constraint_kinds() noexcept;

/// Parts that hold joint `index` of the model closed (without its motion).
void append_joint_parts(const Model& model, int index, std::vector<ConstraintPart>& parts);
/// The prescribed motion of joint `index`, if it has one.
void append_motion_parts(const Model& model, int index, std::vector<ConstraintPart>& parts);
void append_rod_parts(const Model& model, int index, std::vector<ConstraintPart>& parts);

/// "joint 'hinge'" or "rod 'link'".
std::string owner_name(const Model& model, const ConstraintOwner& owner);

}  // namespace floatframe
