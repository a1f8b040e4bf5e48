// Drag, side force and lift of the air on a body. With the axes e1 forwards, e3 up, e2 = e3 x e1
// that turn with the body, the point P, the air u = wind - v_P and b = density area/2:
//   F = b |u| (C_drag u_1 e1 + C_side u_2 e2 + C_lift |u| e3)                                   (1)
//   force       the drag -F.e1, towards the rear; and F.e2, F.e3
//   rows        b C (|u| + u_i^2/|u|) along e1 and e2: they leave out what one direction has of
//               the others, the lift, and the turning of the axes with the body
// F is differentiable where there is no wind, with the derivative 0.
#include <cmath>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

namespace {

template <class S>
void aerodynamic_load_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  using std::sqrt;
  const AerodynamicLoad& keys = in.template keys<AerodynamicLoad>();
  const auto& body = in.marker(0);
  const V air = in.signal(0).f * keys.wind_direction.template cast<S>() - body.v;
  const V u = body.R.transpose() * air;
  const S speed = sqrt(S(u.squaredNorm()));
  const double b = 0.5 * keys.density * keys.area;
  const V F(b * keys.drag * speed * u.x(), b * keys.side * speed * u.y(),
            b * keys.lift * speed * speed);  // (1)
  out.wrench[0].F = body.R * F;
  out.force = -F.x();
  out.further[0] = F.y();
  out.further[1] = F.z();
  if constexpr (std::is_same_v<S, double>) {
    if (!(speed > 0.0)) return;
    for (int i = 0; i < 2; ++i) {
      const double c = b * (i == 0 ? keys.drag : keys.side);
      *out.add_row(0.0, c * (speed + u[i] * u[i] / speed)) = {body.R.col(i), Vec3::Zero()};
    }
  }
}

}  // namespace

FLOATFRAME_LAW(aerodynamic_load)

namespace {

constexpr NumberRule most_coefficient = non_negative_number("");

constexpr ElementKey coefficient_of_air(const char* name, const char* about, NumberRule rule,
                                        KeyMember member) {
  return {.name = name, .kind = KeyKind::number, .about = about, .rule = rule, .member = member};
}

constexpr ElementKey aerodynamic_load_keys[] = {
    {.name = "body",
     .kind = KeyKind::own_place,
     .about = "where it acts: the centre of pressure",
     .required = true,
     .member = described_by<&AerodynamicLoad::at>},
    {.name = "axis",
     .kind = KeyKind::direction,
     .about = "up, e₃, turns with the body",
     .member = described_by<&AerodynamicLoad::axis>},
    {.name = "axis_2",
     .kind = KeyKind::direction,
     .about = "forwards, e₁, without its part along `axis`; e₂ = e₃ x e₁",
     .vector = {1.0, 0.0, 0.0},
     .member = described_by<&AerodynamicLoad::axis_2>},
    {.name = "area",
     .kind = KeyKind::number,
     .about = "reference area of the coefficients",
     .required = true,
     .rule = positive_number("m²"),
     .fallback = 1.0,
     .member = described_by<&AerodynamicLoad::area>},
    coefficient_of_air("drag", "coefficient along e₁", most_coefficient,
                       described_by<&AerodynamicLoad::drag>),
    coefficient_of_air("side", "coefficient along e₂", most_coefficient,
                       described_by<&AerodynamicLoad::side>),
    coefficient_of_air("lift", "coefficient along e₃; negative: downforce", any_number(""),
                       described_by<&AerodynamicLoad::lift>),
    {.name = "density",
     .kind = KeyKind::number,
     .about = "of the air",
     .rule = positive_number("kg/m³"),
     .fallback = 1.2,
     .member = described_by<&AerodynamicLoad::density>},
    {.name = "wind",
     .kind = KeyKind::target_rate,
     .about = "speed of the air along `wind_direction`",
     .member = described_by<&AerodynamicLoad::wind>},
    {.name = "wind_direction",
     .kind = KeyKind::direction,
     .about = "where the wind blows to, fixed in the world",
     .vector = {1.0, 0.0, 0.0},
     .member = described_by<&AerodynamicLoad::wind_direction>}};

void validate_aerodynamic_load(const ElementCheck& check) {
  if (!check.wrong.contains("axis") && !check.wrong.contains("axis_2"))
    if (const auto complaint =
            sentences::second_axis(check.direction("axis"), check.direction("axis_2")))
      check.error(ErrorCode::geometry, "axis_2", *complaint);
  for (const char* key : {"drag", "side", "lift"})
    if (check.wrong.contains(key) || check.number(key) != 0.0) return;
  check.error(ErrorCode::incomplete, "", sentences::none_given({"drag", "side", "lift"}));
}

bool build_aerodynamic_load(ElementBuild& build) {
  AerodynamicLoad& keys = build.keys<AerodynamicLoad>();
  keys.wind_direction = keys.wind_direction.stableNormalized();
  return build.connect("body", true, element_axes(build));
}

Picture picture_of_aerodynamic_load(const Element& element) {
  const int at = element.markers[0];
  return {.symbol = Picture::Symbol::force, .a = at, .axis = -Vec3::UnitX(), .axis_of = at};
}

constexpr const char* aerodynamic_load_leaves_out = "the lift, and what a direction has of another";
constexpr ElementRegime aerodynamic_load_regimes[] = {
    {.name = "moving", .rows_leave_out = aerodynamic_load_leaves_out, .conservative = false},
    {.name = "wind", .rows_leave_out = aerodynamic_load_leaves_out, .conservative = false}};

ElementExample aerodynamic_load_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  AerodynamicLoad load;
  load.area = numbers(1.0, 3.0);
  load.drag = numbers(0.2, 0.6);
  load.side = numbers(0.5, 1.5);
  load.lift = numbers(-2.0, 0.5);
  load.density = numbers(1.0, 1.3);
  if (regime == 1) {
    load.wind = x.linked_signal(numbers);
    load.wind_direction = numbers.direction();
  }
  x.t = numbers(0.0, 1.0);
  x.keys(load);
  MarkerState b = numbers.marker();
  b.v += 3.0 * numbers.direction();
  x.markers = {b};
  return x;
}

}  // namespace

constinit const ElementKind aerodynamic_load_element = {
    .about =
        "drag, side force and lift of the air on a point of a body, by the square of its "
        "speed relative to the wind; the results `side_force` and `lift` are along e₂, e₃",
    .keys = aerodynamic_load_keys,
    .energy = EnergyCategory::loads,
    .measured = false,
    .blank = [] { return ElementKeys(AerodynamicLoad()); },
    .validate = validate_aerodynamic_load,
    .build = build_aerodynamic_load,
    .values =
        [](const ElementKeys&) {
          return std::vector<ElementValue>{{"drag", "N"}, {"side_force", "N"}, {"lift", "N"}};
        },
    .dual = aerodynamic_load_law<Dual>,
    .picture = picture_of_aerodynamic_load,
    .regimes = aerodynamic_load_regimes};

constinit const ExampleMaker aerodynamic_load_examples = aerodynamic_load_example;

}  // namespace floatframe
