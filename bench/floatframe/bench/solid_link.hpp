#pragma once
// A link of the chain made of bricks instead of beams, to measure the cost of many interface nodes:
// all nodes of an end face are tied to one node at its centre, where the joint is.
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// A steel bar of 1 m x 20 mm x 20 mm along x as `along` x `across` x `across` bricks (hex8), with
/// a star of stiff massless beams from a node "start" at the centre of the face x = 0, and "end" at
/// x = 1 m, to the (across + 1)^2 nodes of the face. `across` must be odd, so that there is no
/// brick node at the centre.
FeModel solid_link(int across, int along);

}  // namespace floatframe
