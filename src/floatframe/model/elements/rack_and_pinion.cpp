// Rack and pinion: the displacement of the rack is the radius of the pitch circle times the angle
// of the pinion,
//   x - r q = 0,  reversed x + r q = 0:                                                        (1)
// one row (coupled_coordinates.hpp), whose force is that of the teeth along the rack.
#include <cmath>
#include <numbers>

#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(rack_and_pinion)

namespace {

constexpr ElementKey rack_and_pinion_keys[] = {
    coordinate_key("rack", "of the rack, the child of the joint",
                   described_by<&RackAndPinion::rack>, ElementAxis::along),
    coordinate_key("pinion", "of the pinion", described_by<&RackAndPinion::pinion>),
    {.name = "radius",
     .kind = KeyKind::number,
     .about = "of the pitch circle: displacement per radian",
     .required = true,
     .rule = positive_number("m"),
     .member = described_by<&RackAndPinion::radius>},
    {.name = "reversed",
     .kind = KeyKind::flag,
     .about = "the rack moves back while the angle grows",
     .member = described_by<&RackAndPinion::reversed>}};

bool rack_and_pinion_build(ElementBuild& build) {
  if (!connect_coupled(build, "rack") || !connect_coupled(build, "pinion")) return false;
  const RackAndPinion& keys = build.keys<RackAndPinion>();
  const double radius = keys.reversed ? -keys.radius : keys.radius;
  build.element.data = std::make_shared<CoupledSum>(
      CoupledSum{{mirrored_sense(build, "rack"), -mirrored_sense(build, "pinion") * radius}});
  return true;
}

ElementExample rack_and_pinion_example(std::size_t, ExampleNumbers& numbers) {
  return coupled_example(RackAndPinion{.pinion = {"a"}, .rack = {"b"}, .radius = numbers(0.1, 0.3)},
                         2, numbers);
}

/// The pitch circle and the rack that it rolls on: with x = r q the point of the pinion that goes
/// along s is r s x z from its axis z.
std::vector<Stroke> rack_and_pinion_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  const std::vector<double>& factors = data_of<CoupledSum>(element).factors;
  const double r = -factors[1] / factors[0];
  const Vec3 along = out.world_axis(0), to_rack = r * along.cross(out.world_axis(1));
  const Vec3 middle = out.place(1) + to_rack - out.place(0);
  const int rack = out.child(0);
  constexpr double teeth = 20.0;
  out.wheel(out.child(1), out.axis(1), std::abs(r), teeth);
  out.rack(rack, out.in(rack, middle - along.dot(middle) * along), out.axis(0),
           out.in(rack, to_rack.normalized()), 2.0 * std::numbers::pi * std::abs(r) / teeth);
  return out.take();
}

}  // namespace

constinit const ElementKind rack_and_pinion_element = {
    .about =
        "the displacement of a rack is the radius times the angle of the pinion. A pure "
        "torque on the pinion and a force along the rack; what teeth push apart is not in it",
    .keys = rack_and_pinion_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(RackAndPinion()); },
    .validate = [](const ElementCheck& check) { validate_coordinates(check); },
    .build = rack_and_pinion_build,
    .rows = coupled_rows,
    .picture = picture_of_coupling,
    .strokes = rack_and_pinion_strokes,
    .regimes = holding_regimes};

constinit const ExampleMaker rack_and_pinion_examples = rack_and_pinion_example;

}  // namespace floatframe
