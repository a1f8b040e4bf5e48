// Mimic: a coordinate follows another one,
//   q = factor p + offset:                                                                     (1)
// one row (coupled_coordinates.hpp).
#include "floatframe/model/coupled_coordinates.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(mimic)

namespace {

constexpr ElementKey mimic_keys[] = {
    coordinate_key("joint", "the coordinate that follows", described_by<&Mimic::joint>,
                   ElementAxis::coordinate),
    coordinate_key("follows", "the other one", described_by<&Mimic::follows>,
                   ElementAxis::coordinate),
    {.name = "factor",
     .kind = KeyKind::number,
     .about = "times the other one, not 0",
     .rule = any_number(""),
     .fallback = 1.0,
     .member = described_by<&Mimic::factor>},
    {.name = "offset",
     .kind = KeyKind::number,
     .about = "added to it",
     .rule = any_number("m or rad"),
     .member = described_by<&Mimic::offset>}};

void mimic_validate(const ElementCheck& check) {
  validate_coordinates(check);
  if (check.good("factor") && check.number("factor") == 0.0)
    check.error(ErrorCode::out_of_range, "factor", "found 0, expected a number other than 0");
}

bool mimic_build(ElementBuild& build) {
  if (!connect_coupled(build, "joint") || !connect_coupled(build, "follows")) return false;
  const Mimic& keys = build.keys<Mimic>();
  CoupledSum sum{{mirrored_sense(build, "joint"), -mirrored_sense(build, "follows") * keys.factor}};
  sum.value.pieces = PiecewisePolynomial::polynomial({keys.offset});
  build.element.data = std::make_shared<CoupledSum>(std::move(sum));
  return true;
}

ElementExample mimic_example(std::size_t, ExampleNumbers& numbers) {
  return coupled_example(
      Mimic{.joint = {"a"}, .follows = {"b"}, .factor = numbers(0.5, 2.0), .offset = 0.1}, 2,
      numbers);
}

}  // namespace

constinit const ElementKind mimic_element = {
    .about = "a coordinate of a joint follows another one: factor x the other + offset",
    .keys = mimic_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(Mimic()); },
    .validate = mimic_validate,
    .build = mimic_build,
    .rows = coupled_rows,
    .picture = picture_of_coupling,
    .regimes = holding_regimes};

constinit const ExampleMaker mimic_examples = mimic_example;

}  // namespace floatframe
