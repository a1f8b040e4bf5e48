#include "floatframe/reactions/part_wrenches.hpp"

#include <cassert>

#include "floatframe/math/contracts.hpp"

namespace floatframe {

WrenchOf<double> wrench_on_b(const ConstraintSet& set, std::size_t part,
                             const VecX& lambda) noexcept {
  WrenchOf<double> sum{Vec3::Zero(), Vec3::Zero()};
  const int first = set.offset(part);
  if (constraint_kind(set.parts()[part].type).gradients == PartGradients::unit) {
    sum.F = lambda.segment<3>(first);
    return sum;
  }
  for (int r = 0; r < set.parts()[part].rows(); ++r) {
    const WrenchOf<double>& g = set.row(part, r).gradient.b;
    sum.F += lambda[first + r] * g.F;
    sum.T += lambda[first + r] * g.T;
  }
  return sum;
}

void add_part_wrenches(const ConstraintSet& set, const VecX& lambda,
                       Reactions& reactions) noexcept {
  for (std::size_t k = 0; k < set.parts().size(); ++k) {
    const ConstraintPart& p = set.parts()[k];
    const WrenchOf<double> on_b = wrench_on_b(set, k, lambda);
    if (p.owner.element >= 0) {
      assert(is_index(p.owner.element, reactions.elements));
      const bool first = k == 0 || set.parts()[k - 1].owner.element != p.owner.element;
      Reactions::Wrench& of = reactions.elements[p.owner.element];
      if (first) of = {};
      of.force -= on_b.F;
      of.torque -= on_b.T;
      if (first) reactions.forces[p.owner.element] = set.force_of(k, lambda.data() + set.offset(k));
    }
    if (p.counted_by() < 0) continue;
    assert(is_index(p.owner.joint, reactions.joints));
    Reactions::Wrench& joint = reactions.joints[p.owner.joint];
    joint.force -= on_b.F;
    joint.torque -= on_b.T;
  }
}

}  // namespace floatframe
