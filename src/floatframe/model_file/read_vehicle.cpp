// vehicle: the roles of bodies, tyres and inputs.
#include "floatframe/description/sentences.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

/// {wheel: body, tyre: force, spin: joint}
bool read_wheel(const ModelInstance& self, const YamlValue& value, VehicleWheel& out) {
  auto s = value.section("a map with wheel, tyre and perhaps spin");
  if (!s) return false;
  out.origin = s->origin();
  const auto wheel = s->require("wheel"), tyre = s->require("tyre");
  bool good = wheel && put(read_moving_body(self, *wheel), out.wheel);
  good = tyre && put(self.reference(EntityKind::force, *tyre), out.tyre) && good;
  if (const auto spin = s->get("spin"))
    good = put(self.reference(EntityKind::joint, *spin), out.spin) && good;
  s->finish();
  return good;
}

/// The name of an input, or {input: name, ratio: 16}.
std::optional<VehicleInput> read_vehicle_input(const ModelInstance& self,
                                               const std::optional<YamlValue>& value) {
  if (!value) return std::nullopt;
  VehicleInput out;
  out.origin.mark = value->mark();
  if (!value->is_map())
    return put(self.reference(EntityKind::input, *value), out.input) ? std::optional(out)
                                                                     : std::nullopt;
  auto s = value->section();
  out.origin = s->origin();
  const auto input = s->require("input");
  const bool good = input && put(self.reference(EntityKind::input, *input), out.input);
  out.ratio = s->number("ratio", any_number(""), out.ratio);
  if (out.ratio == 0.0) {
    s->get("ratio")->error(ErrorCode::out_of_range, sentences::ratio_of_zero());
    out.ratio = 1.0;
  }
  s->finish();
  return good ? std::optional(out) : std::nullopt;
}

void read_axles(const ModelInstance& self, const YamlValue& value, VehicleDescription& v) {
  for (const auto& [name, item] : value.named("a map of axles, from the front to the rear")) {
    auto s = item.section("a map with left and right");
    if (!s) continue;
    VehicleAxle axle;
    axle.name = name;
    axle.origin = s->origin();
    const auto left = s->require("left"), right = s->require("right");
    const bool good = left && read_wheel(self, *left, axle.left);
    if (right && read_wheel(self, *right, axle.right) && good) v.axles.push_back(axle);
    s->finish();
  }
}

}  // namespace

void read_vehicle(const ModelInstance& self, ReadModel& model) {
  if (self.outer || !self.root) return;
  YamlSection root = *self.root;
  const auto value = root.get("vehicle");
  auto s = value ? value->section() : std::nullopt;
  if (!s) return;
  const std::size_t before = self.context.errors->size();
  VehicleDescription v;
  v.origin = s->origin();
  if (const auto chassis = s->require("chassis")) put(read_moving_body(self, *chassis), v.chassis);
  if (const auto driver = s->get("driver")) {
    const auto point = self.read_point(*driver);
    if (point) v.driver = self.world.P * *point + self.world.t;
  }
  if (const auto axles = s->require("axles")) read_axles(self, *axles, v);
  v.steering = read_vehicle_input(self, s->get("steering"));
  v.drive = read_vehicle_input(self, s->get("drive"));
  v.brake = read_vehicle_input(self, s->get("brake"));
  v.width = s->number("width", non_negative_number("m"), v.width);
  v.front = s->number("front", non_negative_number("m"), v.front);
  v.rear = s->number("rear", non_negative_number("m"), v.rear);
  s->finish();
  if (self.context.errors->size() == before) model.description.vehicle = std::move(v);
}

}  // namespace floatframe
