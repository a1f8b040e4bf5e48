#pragma once
// Ends of beams beside their nodes. Such an end is a node of its own, tied rigidly to the node of
// the file: u' = u + theta x d, theta' = theta.
#include <array>
#include <map>
#include <vector>

#include "floatframe/decks/stiffeners.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// A node that no line of the file gives, with a number above all others. `largest`: that of the
/// last one which this caller added, 0 before the first.
int add_own_node(FeModel& model, TextSource& source, const Vec3& p, const FeSource& at,
                 int& largest);

class RigidArms {
 public:
  /// The node at `arm` [as the positions] from a node of the model; one for each node and arm.
  int end(FeModel& model, TextSource& source, int node, const Vec3& arm, const FeSource& at);
  /// Ties them, once elements, masses and spiders are there: by equations to nodes that have
  /// rotations, and by a spider, which gives it rotations, to any other.
  void tie(FeModel& model) const;

 private:
  struct Arm {
    int end = -1, node = -1;
    FeSource at;
  };
  std::vector<BeamOnNodes> beams(const FeModel& model) const;
  std::vector<Arm> arms_;
  std::map<std::array<double, 4>, int> end_of_;  // of node and arm
  int largest_id_ = 0;
};

}  // namespace floatframe
