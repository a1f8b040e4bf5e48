#include "floatframe/reactions/part_wrenches.hpp"

#include <cassert>

#include "floatframe/math/contracts.hpp"

namespace floatframe {

void add_part_wrenches(const ConstraintSet& set, const VecX& lambda,
                       Reactions& reactions) noexcept {
  for (std::size_t k = 0; k < set.parts().size(); ++k) {
    const ConstraintPart& p = set.parts()[k];
    const WrenchRow w = set.wrench(k, lambda);
    if (p.owner.element >= 0) {
      assert(is_index(p.owner.element, reactions.elements));
      const bool first = k == 0 || set.parts()[k - 1].owner.element != p.owner.element;
      Reactions::Wrench& of = reactions.elements[p.owner.element];
      if (first) of = {};
      of.force -= w.b.F;
      of.torque -= w.b.T;
      if (first) reactions.forces[p.owner.element] = set.force_of(k, lambda.data() + set.offset(k));
    }
    if (p.counted_by() < 0) continue;
    assert(is_index(p.owner.joint, reactions.joints));
    Reactions::Wrench& joint = reactions.joints[p.owner.joint];
    joint.force -= w.b.F;
    joint.torque -= w.b.T;
  }
}

}  // namespace floatframe
