#pragma once
// The elements that read the reaction of a joint, and the wrench of that in a formulation: of the
// constraint parts that belong to the joint, its couplings and motions included; tree joints of the
// relative formulation add theirs. On the child, about M, as in model/reactions.hpp.
// Step time: no heap, noexcept.
#include <cassert>
#include <vector>

#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/joint_load.hpp"

namespace floatframe {

class LoadReaders {
 public:
  /// Allocates.
  LoadReaders(const Model& model, const ConstraintSet& constraints);

  int count() const noexcept { return std::ssize(readers_); }
  std::size_t element(int i) const noexcept { return at(i).element; }
  int joint(int i) const noexcept { return at(i).port.joint; }
  /// Of the constraint parts with the multipliers lambda.
  Wrench wrench(int i, const ConstraintSet& constraints, const VecX& lambda) const noexcept;
  /// Of the whole wrench, `state(marker)` a MarkerState.
  template <class StateOf>
  double load(int i, const Wrench& w, const StateOf& state) const noexcept {
    const Reader& r = at(i);
    return joint_load(r.port, state(r.frame).R.col(2), w.F, w.T);
  }

 private:
  struct Reader {
    std::size_t element = 0;
    LoadPort port;
    int frame = -1;                  ///< F of the joint, whose z is the axis
    std::vector<std::size_t> parts;  ///< constraints of the joint
  };
  const Reader& at(int i) const noexcept {
    assert(is_index(i, readers_));
    return readers_[i];
  }
  std::vector<Reader> readers_;
};

}  // namespace floatframe
