#include "floatframe/formulation/load_readers.hpp"

namespace floatframe {

LoadReaders::LoadReaders(const Model& model, const ConstraintSet& constraints) {
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const LoadPort& port = model.elements[k].load;
    if (port.joint < 0) continue;
    Reader reader{k, port, model.joints[port.joint].frame_F, {}};
    for (std::size_t p = 0; p < constraints.parts().size(); ++p)
      if (constraints.parts()[p].counted_by() == port.joint) reader.parts.push_back(p);
    readers_.push_back(std::move(reader));
  }
}

Wrench LoadReaders::wrench(int i, const ConstraintSet& constraints,
                           const VecX& lambda) const noexcept {
  Wrench sum{Vec3::Zero(), Vec3::Zero()};
  for (const std::size_t part : at(i).parts) {
    const WrenchRow w = constraints.wrench(part, lambda);
    sum.F -= w.b.F;
    sum.T -= w.b.T;
  }
  return sum;
}

}  // namespace floatframe
