// Belt: two pulleys on parallel axes with a belt or chain that does not slip. With the sense s = 1
// of axes that point in the same direction, else -1,
//   q_1 - s (r_2 / r_1) q_2 = 0,  crossed q_1 + s (r_2 / r_1) q_2 = 0:                          (1)
// one row (coupled_coordinates.hpp), whose force is the torque on the driver. With a stiffness k it
// is a spring k r_1^2 of the same sum (coupled_spring.hpp).
#include <cmath>

#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/coupled_spring.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/port_measures.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

namespace {

struct BeltData {
  CoupledSum sum;
  CoupledSpring spring = {};
};

template <class S>
void belt_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  if (in.element.acts) pull_coupled(in, in.template data<BeltData>().spring, out);
}

}  // namespace

FLOATFRAME_LAW(belt)

namespace {

constexpr const char* belt_pulleys[] = {"driver", "driven"};
constexpr ElementKey belt_keys[] = {
    coordinate_key("driver", "of the first pulley, the child of the joint",
                   described_by<&BeltDrive::driver>),
    coordinate_key("driven", "of the second pulley", described_by<&BeltDrive::driven>),
    numbers_key("radii", "of the pulleys", positive_number("m"), belt_pulleys,
                described_by<&BeltDrive::radii>, true),
    {.name = "crossed",
     .kind = KeyKind::flag,
     .about = "the belt crosses itself: the pulleys turn in opposite senses",
     .member = described_by<&BeltDrive::crossed>},
    {.name = "stiffness",
     .kind = KeyKind::number,
     .about = "force along the belt, the difference of its strands, per length by which one pulley "
              "runs ahead; the belt is then a spring",
     .rule = positive_number("N/m"),
     .fallback = no_number,
     .member = described_by<&BeltDrive::stiffness>},
    {.name = "damping",
     .kind = KeyKind::number,
     .about = "the same per speed",
     .rule = non_negative_number("N s/m"),
     .member = described_by<&BeltDrive::damping>}};

void belt_validate(const ElementCheck& check) {
  validate_coordinates(check);
  if (check.good("damping") && check.number("damping") != 0.0 && !check.has("stiffness") &&
      !check.wrong.contains("stiffness"))
    check.error(ErrorCode::incomplete, "damping", "needs 'stiffness'");
}

bool belt_build(ElementBuild& build) {
  if (!connect_coupled(build, "driver") || !connect_coupled(build, "driven")) return false;
  const std::vector<double> senses = senses_of_axes(build, parallel_wheels);
  if (senses.empty()) return false;
  const BeltDrive& keys = build.keys<BeltDrive>();
  const double sense = keys.crossed ? senses[1] : -senses[1];
  const double r_1 = keys.radii(0), factor = sense * keys.radii(1) / r_1;
  BeltData belt{.sum = {{1.0, factor}}};
  if (keys.stiffness)
    belt.spring = {spring_with_play(*keys.stiffness * r_1 * r_1, 0.0), keys.damping * r_1 * r_1,
                   factor};
  build.element.data = std::make_shared<BeltData>(std::move(belt));
  return true;
}

void belt_rows(const Model& model, const Element& element, ConstraintPart part,
               std::vector<ConstraintPart>& parts) {
  const CoupledSum& sum = data_of<BeltData>(element).sum;
  append_sum(model, element, sum.factors, &sum.value, part, parts);
}

ElementExample belt_example(std::size_t regime, ExampleNumbers& numbers) {
  BeltDrive belt;
  belt.radii = MatX{{numbers(0.1, 0.3), numbers(0.1, 0.3)}};
  if (regime > 0) belt.stiffness = 100.0;
  ElementExample x = coupled_example(std::move(belt), 2, numbers);
  if (regime == 0) return x;
  BeltData data;
  data.spring = coupled_spring_example(regime, x, numbers);
  x.element.data = std::make_shared<BeltData>(std::move(data));
  return x;
}

/// Pulleys, and strands on the housing that touch them: along u from both centres, with
/// u.e = (r_1 - r_2) / a of the distance a along e, crossed (r_1 + r_2) / a.
std::vector<Stroke> belt_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  const BeltDrive& keys = std::get<BeltDrive>(*element.keys);
  const double r_1 = keys.radii(0), r_2 = keys.crossed ? -keys.radii(1) : keys.radii(1);
  out.wheel(out.child(0), out.axis(0), r_1);
  out.wheel(out.child(1), out.axis(1), std::abs(r_2));
  const Vec3 between = out.across(0, 1);
  const double cosine = (r_1 - r_2) / between.norm();
  if (!(std::abs(cosine) < 1.0)) return out.take();
  const Vec3 e = between.normalized(), n = out.world_axis(0).cross(e);
  const int housing = out.frame(0);
  for (const double side : {1.0, -1.0}) {
    const Vec3 u = cosine * e + side * std::sqrt(1.0 - cosine * cosine) * n;
    out.line(housing, out.in(housing, r_1 * u), out.in(housing, between + r_2 * u));
  }
  return out.take();
}

}  // namespace

constinit const ElementKind belt_element = {
    .about =
        "a belt or chain on two pulleys with parallel axes, which does not slip. A pure "
        "torque on each pulley about its axis, and on the housing; the tension of the "
        "strands is not in it",
    .keys = belt_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(BeltDrive()); },
    .validate = belt_validate,
    .build = belt_build,
    .rows = belt_rows,
    .gives_way = [](const ElementKeys& k) { return std::get<BeltDrive>(k).stiffness.has_value(); },
    .dual = belt_law<Dual>,
    .picture = picture_of_coupling,
    .strokes = belt_strokes,
    .regimes = std::span(coupled_spring_regimes).first(2)};

constinit const ExampleMaker belt_examples = belt_example;

}  // namespace floatframe
