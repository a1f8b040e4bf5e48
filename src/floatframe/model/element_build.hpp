#pragma once
// Builds an element of the model from its description. Load time only.
#include "floatframe/model/element_keys.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct ModelBuilder;
class SpaceCurve;

class ElementBuild : public ElementView {
 public:
  /// The element has its name, its keys, and their laws and signals.
  ElementBuild(ModelBuilder& builder, const ElementDescription& description);
  Element element;

  /// The next port of the element: a marker at a place, with the design orientation R; false after
  /// an error, which is reported. `oriented`: its orientation matters.
  bool connect(const std::string& key, bool oriented, const Mat3& R = Mat3::Identity());
  /// Its next two ports: the markers of a joint with the coordinate `component`; nullptr if the
  /// joint has an error. The unit of its results is that of the first one.
  const Joint* connect_coordinate(const std::string& joint, int component = 0);
  /// Its first port, of a body that bends, slides along the nodes on the lines between these
  /// points, at the foot of its second one; false after an error. `points`: n x 3 from the first
  /// port, along the axes of the world as drawn.
  bool slide(const MatX& points);
  /// As drawn, from the place of a port that slides; else null.
  std::shared_ptr<const SpaceCurve> path_of(std::size_t port) const;
  int road(const std::string& key) const;
  /// World position of a port in the design configuration.
  Vec3 design_point(std::size_t port) const;
  /// The axes of its marker there.
  Mat3 design_axes(std::size_t port) const;
  /// z of them.
  Vec3 design_axis(std::size_t port) const { return design_axes(port).col(2); }
  /// nullptr if it has an error.
  const Joint* joint(const std::string& name) const;
  /// Of the simulation that the model describes [s].
  double step() const;
  /// Reports an error of the element.
  void error(ErrorCode code, const std::string& sentence);
  /// A change of the keys of the built element.
  template <class Keys>
  Keys& keys() {
    return *std::get_if<Keys>(keys_.get());
  }

 private:
  std::string path() const;  ///< "forces.spring"

  ModelBuilder& builder_;
  std::shared_ptr<ElementKeys> keys_;
};

}  // namespace floatframe
