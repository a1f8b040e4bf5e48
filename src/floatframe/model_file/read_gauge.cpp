// Places of stress, strain and section forces.
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

bool direction_of(const std::optional<YamlValue>& value, Vec3& out) {
  return !value || put(read_direction(*value), out);
}

/// A whole number is a node number in the finite-element file.
bool node_of_gauge(const YamlValue& value, OutputDescription& o) {
  if (value.looks_like_number())
    return put(value.integer(1, 2147483647, "the number of a node"), o.gauge.node);
  return put(value.text("the number or the name of a node"), o.at.node);
}

bool place_of_gauge(const ModelInstance& self, const YamlValue& what, OutputDescription& o) {
  auto place = what.section("a place, for example {body: arm, node: 1204}");
  if (!place) return false;
  const auto body = place->require("body");
  const auto node = place->get("node"), at = place->get("at"), layer = place->get("layer"),
             toward = place->get("toward"), along = place->get("along"),
             material = place->get("material");
  place->finish();
  bool good = body && put(read_moving_body(self, *body), o.at.body);
  if (node.has_value() == at.has_value()) {
    place->error(node ? ErrorCode::exclusive : ErrorCode::missing,
                 node ? "'node' and 'at' exclude each other; remove one of them"
                      : "missing key 'node' or 'at'");
    good = false;
  } else {
    good = (at ? put(self.read_point(*at), o.at.point) : node_of_gauge(*node, o)) && good;
  }
  if (layer) {
    const auto word = layer->word(rules::shell_layers);
    good = word && good;
    if (word) o.gauge.layer = static_cast<GaugeDescription::Layer>(*word + 1);
  }
  if (material) good = put(material->text("the name of a material"), o.gauge.material) && good;
  good = direction_of(along, o.gauge.along) && good;
  return direction_of(toward, o.gauge.toward) && good;
}

}  // namespace

std::optional<std::string> read_moving_body(const ModelInstance& self, const YamlValue& value) {
  const auto body = self.reference(EntityKind::body, value);
  if (body && *body == ground_name) {
    value.error(ErrorCode::wrong_value, sentences::ground_is_no_body());
    return std::nullopt;
  }
  return body;
}

bool read_gauge(const ModelInstance& self, YamlSection& s, const YamlValue& what,
                OutputDescription& o) {
  const bool strain = o.type == OutputType::strain;
  const auto direction = strain ? s.require("direction") : std::nullopt;
  const auto loads = s.get("inertia_loads");
  bool good = place_of_gauge(self, what, o);
  good = direction_of(direction, o.gauge.direction) && good && (direction || !strain);
  return (!loads || put(loads->boolean(), o.gauge.inertia_loads)) && good;
}

}  // namespace floatframe
