#pragma once
// Beams along shells and beside them: stiffeners. A shell that is twisted moves the centroid of
// such a beam sideways, and the beam's section turns about the normal of the shell as that line
// does. Shells have a stiffness of their own against turns about their normal, so tied in these
// too the beam bends sideways at once, far too stiffly: 77 Hz in place of 58 Hz
// (docs/finite-elements.md). So its turn about the normal is its own; what the shell's place and
// slope do to its end stays.
#include <optional>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// The shells at some nodes of a model.
class ShellsAtNodes {
 public:
  /// `wanted`: of each node.
  ShellsAtNodes(const FeModel& model, const std::vector<char>& wanted);
  /// The normal of the shells at a node, if they are smooth there and each of the `others`, the
  /// nodes that beams go to from there, is a node of one of them.
  std::optional<Vec3> normal_along(int node, const std::vector<int>& others) const;

 private:
  const FeModel& model_;
  std::vector<std::vector<int>> of_node_;  ///< shells; of nodes that are not wanted empty
};

/// One note that counts the ends which turn by themselves.
void note_stiffeners(FeModel& model, int ends);

}  // namespace floatframe
