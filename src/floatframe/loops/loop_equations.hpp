#pragma once
// The equations of closed loops in the coordinates of the joints that belong to them. Their
// solutions depend neither on the tree nor on the order of joints nor on which joint is cut: start
// values are measured at all joints in the same way, and the remaining freedom is used to move the
// bodies of the loops as little as possible, in the metric of their masses,
//   D = 1/2 |d|^2 = 1/2 sum over the bodies of  int |x - x_0|^2 dm                            (1)
// from a reference configuration 0. A body is its mass at the centre and three vectors from there,
// int rho rho^T dm = sum lambda_k u_k u_k^T. With A = dd/dx, A^T A is the mass matrix, and a Newton
// step is
//   x = argmin |A x + d|^2   with   J x = -r                                                  (2)
// for the constraints and the start values that are enforced. Load time.
#include <iterator>
#include <vector>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

/// The joints and bodies on closed paths of joints and rods, and those of coupled coordinates.
struct LoopMembers {
  std::vector<char> joint, body;
  bool any = false;
  void add(const Model& model, int index) {
    joint[index] = 1;
    for (const int b : {model.joints[index].parent, model.joints[index].child})
      if (b >= 0) body[b] = 1;
  }
};
LoopMembers loop_members(const RelativeFormulation& f);

/// Coordinates that may change to close loops.
enum class LoopMoves {
  joints,  ///< coordinates of joints in loops; start values are fixed
  modes,   ///< amplitudes of the bodies in loops, too
  values   ///< start values, too, as little as possible, except those marked `keep`
};

/// A start value of a joint in a loop, one coordinate or the three of a rotation vector, or an
/// amplitude of a body in a loop.
struct LoopValue {
  int joint = -1, body = -1;  ///< one of them
  int component = 0, count = 1;
  Vec3 given = Vec3::Zero();
  bool kept = false;
  bool angle = false;
};

/// Start values of positions or (`rates`) of rates.
std::vector<LoopValue> loop_values(const RelativeFormulation& f, const LoopMembers& members,
                                   bool rates);

/// Present value of a start value with one component, angles within half a turn of `reference`, and
/// its rate.
double measured(const RelativeFormulation& f, const LoopValue& v, double reference);
double measured_rate(const RelativeFormulation& f, const LoopValue& v, int k = 0);

class LoopEquations {
 public:
  /// Without `keeps`, values marked `keep` are as others. (1) is relative to the state of `f`.
  LoopEquations(RelativeFormulation& f, const LoopMembers& members, std::vector<LoopValue> values,
                LoopMoves moves, bool keeps);

  const std::vector<LoopValue>& values() const noexcept { return values_; }
  Eigen::Index unknowns() const noexcept { return std::ssize(mobile_); }
  /// Makes the present positions the reference of (1).
  void begin_here();
  /// At the present positions.
  VecX displacement() const;
  /// (2) at the present positions. `open`: residual of the constraints, those with `counts` zero
  /// are omitted; `off`: residual of the values, entry by entry. Sets the velocities to v.
  void evaluate(const VecX& open, const std::vector<char>& counts, const VecX& off, const VecX& v);
  /// Largest residual of the enforced equations.
  double violation() const noexcept { return largest(r_); }
  /// Norm of d if all bodies move by their characteristic length.
  double scale() const noexcept { return scale_; }
  /// d due to a change of all coordinates.
  VecX moved(const VecX& x) const;

  struct Step {
    VecX x;                 ///< of all coordinates
    Eigen::Index rank = 0;  ///< of J
    Eigen::Index free = 0;  ///< motions left free by J x = -r
  };
  /// The x nearest to `along` in the metric; with `d`, that of (2).
  Step step(const VecX& along, const VecX* d) const;
  /// The x closest to (2) that satisfies the values instead of the constraints.
  VecX nearest() const;

 private:
  struct BodyShape {
    int body;
    Eigen::Index row;  ///< in d
    double root_mass;
    Vec3 c_B;
    Mat3 U_B;  ///< columns sqrt(lambda_k) u_k
    VecX mode_costs;
  };
  void add_body(int body, double least_mass, double least_inertia);
  void fill_column(Eigen::Index column, int coordinate);
  VecX shape() const;

  RelativeFormulation& f_;
  std::vector<LoopValue> values_;
  std::vector<char> value_holds_;    ///< entry by entry
  std::vector<double> value_scale_;  ///< to lengths [m]
  std::vector<int> mobile_;
  std::vector<BodyShape> bodies_;
  Eigen::Index rows_ = 0;
  double scale_ = 1.0;
  MatX A_, J_, G_, wishes_;
  VecX r_, missed_, shape_0_;
};

}  // namespace floatframe
