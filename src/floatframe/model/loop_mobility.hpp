#pragma once
// Number of degrees of freedom of the loops of a model, in the drawn configuration and along a path
// from there. Bodies are rigid except, on request, for the modes of flexible ones, which then
// absorb misalignment. Load time only: dense linear algebra with six columns per body.
#include <vector>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// Bodies, joints and rods that share a loop pairwise: a block of the graph whose vertices are
/// bodies and the ground.
struct LoopBlock {
  std::vector<int> bodies;  ///< without the ground
  std::vector<int> joints, elements;
  bool grounded = false;  ///< it contains the ground
};

/// The blocks of the model that have loops, in the order of their first joint.
std::vector<LoopBlock> loop_blocks(const Model& model);

/// Position of a marker in the design configuration.
Pose design_pose(const Model& model, int marker);

/// Positions of both frames of a joint in the design configuration, in world axes.
struct JointPlace {
  Vec3 p = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  Vec3 axis_2 = Vec3::UnitX();  ///< in the joint frame
};

class LoopMobility {
 public:
  /// `places`: positions of the joints of the block, in its order. `size`: of the block [m].
  /// Without ground its first body is fixed.
  LoopMobility(const Model& model, const LoopBlock& block, const std::vector<JointPlace>& places,
               double size, bool bends);

  /// Velocities that satisfy the joints and rods as drawn, orthonormal columns.
  MatX motions() const { return motions(1e-11); }
  /// Moves the bodies of the block, in its order, from the drawn positions to these.
  void start_at(std::vector<Pose> poses);
  int columns() const noexcept { return columns_; }
  /// Largest gap of joints and rods, relative to the size.
  double misfit();
  /// Motions that are free up to a residual `nearly`.
  int free(double nearly) const;
  /// The largest number of degrees of freedom that remains along a path of 0.1 rad (or a tenth of
  /// the size), over the paths that begin with motions other than `others`. `onward`: a path that
  /// closes only by reversing has none.
  int lasting(const MatX& others, double nearly = 1e-8, bool onward = false);

 private:
  struct Socket {
    int place = -1;  ///< in the block, -1: held
    Pose X_BM;
    Eigen::Matrix<double, 3, Eigen::Dynamic> X, X_theta;  ///< of the modes, in the body
  };
  void evaluate();
  MatX motions(double threshold) const;
  void move(const VecX& x);
  bool close(VecX& way);
  double farthest(const VecX& x) const;

  double size_;
  int columns_ = 0, rows_ = 0;
  std::vector<int> first_;  ///< column of each body of the block; -1: held
  std::vector<Pose> start_, pose_;
  std::vector<Socket> sockets_;
  std::vector<ConstraintPart> parts_;
  std::vector<MarkerState> states_;
  MatX J_;
  VecX phi_;
};

}  // namespace floatframe
