// Elements of the description: their markers, laws and parameters.
#include <algorithm>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

ElementBuild::ElementBuild(ModelBuilder& builder, const ElementDescription& description)
    : ElementView(description),
      builder_(builder),
      keys_(std::make_shared<ElementKeys>(description.kind)) {
  element.name = description.name;
  element.keys = keys_;
  take_keys(element, builder.model);
}

bool ElementBuild::connect(const std::string& key, bool oriented, const Mat3& R) {
  const AttachmentDescription at = place(key);
  const Origin& origin = description().origin;
  const std::string who = path();
  const int marker =
      this->key(key).kind == KeyKind::own_place
          ? builder_.add_marker(at, R, oriented, origin.of(at.node ? "node" : "at"), who)
          : builder_.add_marker(at, R, oriented, origin.of(key), who + "." + key);
  element.markers.push_back(marker);
  return marker >= 0;
}

const Joint* ElementBuild::connect_coordinate(const std::string& name, int component) {
  const auto k = builder_.joint_names.find(name);
  if (!k) return nullptr;
  const Joint& joint = builder_.model.joints[*k];
  const int port = std::ssize(element.markers);
  const bool rotational = joint_unit(joint.type, component) == JointUnit::rad;
  if (element.coordinates.empty()) element.rotational = rotational;
  element.coordinates.push_back({static_cast<int>(*k), component, port, rotational});
  element.markers.insert(element.markers.end(), {joint.frame_F, joint.frame_M});
  return &joint;
}

Vec3 ElementBuild::design_point(std::size_t port) const {
  return builder_.design_point(element.markers[port]);
}

void ElementBuild::error(ErrorCode code, const std::string& sentence) {
  builder_.errors.add(code, description().origin.mark, path() + ": " + sentence);
}

std::string ElementBuild::path() const {
  return std::string(element_list_name(element_kind(element.type).list)) + "." + element.name;
}

int ElementBuild::road(const std::string& key) const {
  return builder_.road_names.index(text(key));
}

bool ModelBuilder::add_element(const ElementDescription& e) {
  ElementBuild b(*this, e);
  const ElementKind& kind = element_kind(e.type());
  if (!kind.build(b)) return false;
  element_names[index_of(kind.list)].add(e.name);
  model.elements.push_back(std::move(b.element));
  return true;
}

void ModelBuilder::holding_elements() {
  for (const auto* list : {&d.rods, &d.couplings})
    for (const ElementDescription& e : *list) add_element(e);
  for (const JointDescription& j : d.joints) {
    if (!j.motion) continue;
    const PrescribedMotion keys{j.name, {*j.motion, {}}};
    if (add_element({j.name, keys, j.origin}))
      model.joints[model.elements.back().coordinates[0].joint].motion =
          std::ssize(model.elements) - 1;
  }
}

void ModelBuilder::forces() {
  const auto holding = std::ssize(model.elements);
  for (const ElementDescription& e : d.forces) add_element(e);
  const int acting = static_cast<int>(std::ssize(model.elements) - holding);
  std::rotate(model.elements.begin(), model.elements.begin() + holding, model.elements.end());
  for (Joint& joint : model.joints)
    if (joint.motion >= 0) joint.motion += acting;
}

}  // namespace floatframe
