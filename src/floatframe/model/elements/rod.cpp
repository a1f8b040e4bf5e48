// Rod: without mass, keeps the distance L between two points: one row `distance`, whose multiplier
// is the force in the rod, tension positive. With a motion the distance is a function of time: one
// row `drive_distance`.
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(rod)

namespace {

constexpr ElementKey rod_keys[] = {place_key("from", "one end", described_by<&Rod::a>),
                                   place_key("to", "the other end", described_by<&Rod::b>),
                                   {.name = "length",
                                    .kind = KeyKind::number,
                                    .about = "the distance as drawn without it",
                                    .rule = rules::rod_length,
                                    .member = described_by<&Rod::length>},
                                   {.name = "motion",
                                    .kind = KeyKind::motion,
                                    .about = "instead of it the distance as a function of time",
                                    .member = described_by<&Rod::motion>}};

void rod_validate(const ElementCheck& check) {
  if (check.has("length") && check.has("motion"))
    check.error(ErrorCode::exclusive, "length", sentences::length_of_driven_rod());
  if (!check.two_bodies("from", "to") || check.has("length")) return;
  const AttachmentDescription a = check.place("from"), b = check.place("to");
  if (!check.from_file && (a.node || b.node)) return;
  if (const auto complaint = sentences::rod_ends(a.point, b.point))
    check.error(ErrorCode::geometry, "", *complaint);
}

bool rod_build(ElementBuild& build) {
  const bool from = build.connect("from", false), to = build.connect("to", false);
  if (!from || !to) return false;
  Rod& rod = build.keys<Rod>();
  const double at_start = rod.motion ? evaluate(*rod.motion, 0.0).f : 1.0;
  if (!(at_start > 0.0)) build.error(ErrorCode::out_of_range, sentences::rod_motion(at_start));
  if (rod.length || rod.motion) return at_start > 0.0;
  const Vec3 a = build.design_point(0), b = build.design_point(1);
  rod.length = (b - a).norm();
  const auto complaint = sentences::rod_ends(a, b);  // of two nodes, known only now
  if (complaint) build.error(ErrorCode::geometry, *complaint);
  return !complaint;
}

void rod_rows(const Model&, const Element& element, ConstraintPart part,
              std::vector<ConstraintPart>& parts) {
  const Rod& rod = std::get<Rod>(*element.keys);
  part.type = rod.motion ? ConstraintType::drive_distance : ConstraintType::distance;
  part.a = element.markers[0];
  part.b = element.markers[1];
  if (rod.motion) part.motion = &element.signals[0].function;
  if (rod.length) part.scale = *rod.length;
  parts.push_back(part);
}

Picture rod_picture(const Element& element) {
  return {.symbol = Picture::Symbol::bar, .a = element.markers[0], .b = element.markers[1]};
}

constexpr ElementRegime rod_regimes[] = {{.name = "anywhere", .acts = false}};

ElementExample rod_example(std::size_t, ExampleNumbers& numbers) {
  ElementExample x;
  Rod rod;
  rod.length = numbers(0.5, 2.0);
  x.keys(rod);
  x.markers = {numbers.marker(), numbers.marker()};
  return x;
}

}  // namespace

constinit const ElementKind rod_element = {.about = "keeps the distance between two points",
                                           .keys = rod_keys,
                                           .list = ElementList::rods,
                                           .blank = [] { return ElementKeys(Rod()); },
                                           .validate = rod_validate,
                                           .build = rod_build,
                                           .rows = rod_rows,
                                           .picture = rod_picture,
                                           .regimes = rod_regimes};

constinit const ExampleMaker rod_examples = rod_example;

}  // namespace floatframe
