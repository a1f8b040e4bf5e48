#pragma once
// Path from the drawn configuration, in which all joints are closed, to the start values of joints
// in loops: in increments of at most 0.05 rad or 1 % of the size of the loops, so that the assembly
// branch is that of the drawing. First rods whose lengths differ from the drawing, then values and
// prescribed motions together, all in proportion. Each increment is predicted along the tangent, or
// along the last one where the tangent is not unique (a change point, a dead centre), and corrected
// by `LoopEquations`; if the correction exceeds half of it, a smaller one is tried. Load time.
#include "floatframe/loops/loop_equations.hpp"

namespace floatframe {

class LoopPath {
 public:
  LoopPath(RelativeFormulation& f, double t);

  bool any_loops() const noexcept { return members_.any; }
  /// The start values in loops are those of the drawn configuration.
  bool starts_as_drawn() const;
  /// Constraints are met at `q`.
  bool closes(const VecX& q);
  /// The given values determine all joints in loops.
  bool all_given() const;
  /// The configuration as drawn, but with the start values of joints outside of loops.
  VecX drawn() const;
  /// Moves `q`, as drawn, to the start values; false if the path cannot be continued.
  bool follow(VecX& q, LoopMoves moves, bool keeps);
  /// The same from a state with all given values: closes gaps, then moves to unmet values.
  bool correct(VecX& q, LoopMoves moves, bool keeps);
  /// Fraction of the path to the start values that the last call reached.
  double reached() const noexcept { return reached_; }
  /// At `q` there are more start values than degrees of freedom: in general they contradict.
  bool contradictory(const VecX& q);
  /// True if the last `follow` could close the drawn configuration.
  bool drawn_closes() const noexcept { return drawn_closes_; }
  /// Constraints and start values are met at `q`.
  bool closed(const VecX& q);
  /// Residual of the constraints with the start values satisfied nevertheless; starts from `q`.
  VecX gap(VecX& q);
  /// True if `to` is no farther from `from` than one increment.
  bool near(const VecX& from, const VecX& to);
  /// True if the axes of joints outside of the tree point at `q` as in the drawn configuration.
  bool upright(const VecX& q);

 private:
  struct Stage;
  Stage begin(const VecX& q, std::vector<LoopValue> values, bool motions, LoopMoves moves,
              bool keeps);
  void measure_size();
  bool lead(Stage& stage, VecX& q);
  bool lead_in_increments(Stage& stage, VecX& q);
  bool increment(Stage& stage, const VecX& q, double from, double to, VecX& q_new);

  RelativeFormulation& f_;
  double t_;
  std::vector<double> angles_;  ///< from which turns are counted at the beginning of a path
  LoopMembers members_;
  double size_ = 0.0;  ///< of the loops [m], set when first needed
  double reached_ = 0.0;
  bool drawn_closes_ = true;
};

}  // namespace floatframe
