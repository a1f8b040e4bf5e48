#pragma once
// Ends of beams offset from their nodes. Such an end is a separate node, tied rigidly to that of
// the file: u' = u + theta x d, theta' = theta.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "floatframe/decks/stiffeners.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// A node that is not in the file, with a number above all others. `largest`: that of the
/// last one added by this caller, 0 before the first.
int add_generated_node(FeModel& model, TextSource& source, const Vec3& p, const FeSource& at,
                       int& largest);

/// A rigid spider without nodes so far.
Spider& add_rigid_spider(FeModel& model, int reference, std::string name, const FeSource& at);

/// 1 for nodes of beams and shells, references of spiders and ends of springs that turn.
std::vector<char> nodes_with_rotations(const FeModel& model);

class RigidArms {
 public:
  /// The node at `arm` [as the positions] from a node of the model; one for each node and arm.
  int end(FeModel& model, TextSource& source, int node, const Vec3& arm, const FeSource& at);
  /// Ties them after elements, masses and spiders are built: by equations to nodes that have
  /// rotations, and to any other by a spider, which gives it rotations.
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
