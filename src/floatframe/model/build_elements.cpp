// Elements of the description: their markers, laws and parameters.
#include "floatframe/model/element_kind.hpp"
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

const Joint* ElementBuild::connect_joint(const std::string& key) {
  const auto k = builder_.joint_names.find(text(key));
  if (!k) return nullptr;
  const Joint& joint = builder_.model.joints[*k];
  element.markers = {joint.frame_F, joint.frame_M};
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

void ModelBuilder::elements(ElementList list, std::vector<Element>& out) {
  for (const ElementDescription& e : d.elements(list)) {
    ElementBuild b(*this, e);
    if (!element_kind(e.type()).build(b)) continue;
    element_names[index_of(list)].add(e.name);
    out.push_back(std::move(b.element));
  }
}

}  // namespace floatframe
