// Elements of the description: their markers, laws and parameters.
#include <algorithm>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/model_builder.hpp"
#include "floatframe/model/signal_order.hpp"

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

double ElementBuild::step() const { return builder_.d.simulation.step; }

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
  if (b.element.clock.ticks()) b.element.clock.mark = e.origin.of("period");
  element_names[index_of(kind.list)].add(e.name);
  model.elements.push_back(std::move(b.element));
  return true;
}

void ModelBuilder::holding_elements() {
  for (const auto* list : {&d.rods, &d.couplings})
    for (const ElementDescription& e : *list) add_element(e);
  for (const JointDescription& j : d.joints) {
    if (j.motion &&
        add_element({j.name, PrescribedMotion{j.name, SignalDescription(*j.motion)}, j.origin}))
      model.joints[model.elements.back().coordinates[0].joint].motion =
          std::ssize(model.elements) - 1;
    for (const CoordinateMotion& m : j.motions) {
      const std::string name = j.name + "/" + joint_coordinate_key(j.type, m.coordinate);
      const PrescribedMotion keys{j.name, SignalDescription(m.motion), m.coordinate};
      if (!add_element({name, keys, j.origin})) continue;
      Joint& joint = model.joints[model.elements.back().coordinates[0].joint];
      joint.motions.resize(joint_velocities(j.type), -1);
      joint.motions[m.coordinate] = std::ssize(model.elements) - 1;
    }
  }
}

void ModelBuilder::forces() {
  const auto holding = std::ssize(model.elements);
  for (const ElementList list : {ElementList::forces, ElementList::controllers})
    for (const ElementDescription& e : d.elements(list)) add_element(with_formulas_apart(e, list));
  delays_apart();
  for (const InnerFormula& inner : formulas) add_element(inner.element);
  const int acting = static_cast<int>(std::ssize(model.elements) - holding);
  std::rotate(model.elements.begin(), model.elements.begin() + holding, model.elements.end());
  for (Joint& joint : model.joints) {
    if (joint.motion >= 0) joint.motion += acting;
    for (int& motion : joint.motions)
      if (motion >= 0) motion += acting;
  }
}

void ModelBuilder::link_signals() {
  const auto list_of = [](SignalSource source) {
    return source == SignalSource::controller ? ElementList::controllers : ElementList::forces;
  };
  for (int k = 0; k < std::ssize(model.elements); ++k) {
    Element& e = model.elements[k];
    const ElementDescription described{e.name, *e.keys, {}};
    int port = -1;
    for (const std::optional<SignalDescription>& s : signal_values(described)) {
      ++port;
      if (!s || s->source == SignalSource::none) continue;
      const int from = element(list_of(s->source), s->element);
      if (from < 0) continue;  // it has an error
      e.signals[port].link = std::ssize(model.links);
      const int value = value_index(model.elements[from].values, s->value);
      model.links.push_back({from, k, port, quantity_of(s->source), s->factor, value});
    }
  }
  const SignalOrder order(model);
  if (order.ring.empty() || !errors.empty()) return;
  std::vector<std::string> names;
  for (const std::size_t k : order.ring) names.push_back(element_name(model.elements[k]));
  const Element& first = model.elements[order.ring.front()];
  const ElementList list = element_kind(first.type).list;
  const auto report = [&](const ElementDescription& e, const std::string& path) {
    if (e.name == first.name)
      errors.add(ErrorCode::contradiction, e.origin.mark,
                 path + ": " + sentences::ring_of_signals(names));
  };
  for (const ElementDescription& e : d.elements(list))
    report(e, std::string(element_list_name(list)) + "." + e.name);
  for (const InnerFormula& inner : formulas) report(inner.element, inner.path);
}

}  // namespace floatframe
