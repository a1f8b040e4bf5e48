#pragma once
// Ends of beams offset from their nodes. Such an end is a separate node, tied rigidly to that of
// the file: u' = u + theta x d, theta' = theta.
//
// Beams along shells and offset from them: stiffeners. A twisted shell moves the centroid of
// such a beam sideways, and the axis of the beam turns about the normal of the shell. Tied rigidly
// to the shell the beam rotates its nodes likewise, which shells here resist and those of most
// programs hardly do: a rib on a plate was 34 % too stiff in twist (docs/finite-elements.md). So
// there the rotation of the shells about their normal is independent; the node follows the beam.
#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// A beam as in the file.
struct BeamOnNodes {
  std::array<int, 3> nodes{-1, -1, -1};  ///< of the file
  bool beside = false;                   ///< its axis is not at them
  bool holds = false;  ///< it is tied to them in all rotations, and bends about any axis across it
};

/// Gives shells an independent rotation at nodes where a rigidly tied stiffener runs along them, if
/// the shells are smooth and every beam runs along them; one note with the number of nodes.
void free_drilling_at_stiffeners(FeModel& model, std::span<const BeamOnNodes> beams);

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
