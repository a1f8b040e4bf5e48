// Gear: two wheels on parallel axes mesh. With the ratio i = z_2 / z_1 (turns of the driver per
// turn of the driven wheel) and the sense s = 1 of axes that point in the same direction, else -1,
//   external     q_1 + s i q_2 = 0
//   internal     q_1 - s i q_2 = 0,                                                            (1)
// one row (coupled_coordinates.hpp), which exerts torques about the axes.
//
// With a pressure angle it is the row of the force of the teeth. Let M_1, M_2 be the points of the
// joints, e the unit vector from axis 1 to axis 2, z the axis of the driver, a the distance of the
// axes, and P the pitch point:
//   P - M_1 = w (M_2 - M_1),  w = 1 / (1 + i), internal 1 / (1 - i),  r_1 = |w| a,
//   u = sign(w) e,  t = z x u                                                                  (2)
// A force on the driver along the normal n of its flanks, -n on the driven wheel; with the pressure
// angle alpha, the helix angle beta and rho = -u, of a ring u, towards the centre of the pinion:
//   n = (t - tan(beta) z -+ tan(alpha) / cos(beta) rho) / r_1,  forward -, backward +          (3)
// has the torques T_1 = (P - M_1) x n and T_2 = -(P - M_2) x n about the joints, z.T_1 = 1. The
// row
//   q_1 + (z_2.T_2) q_2 + sum of tilts + sum_j w_j n_j.(r_M1 - r_M2) - n.(M_1 - M_2) = 0       (4)
// with w_1 = w, w_2 = 1 - w, n_j fixed in the housing at joint j, and for the parts of T_i across
// the axes rows of their tilts, which the joints keep zero, has exactly these wrenches as its
// gradient: n at P on the driver, -n on the driven wheel and nothing on the housing, which feels
// the reactions of the joints. So they are not counted as wrenches of the joints.
//
// With a stiffness of the mesh there is no row but a spring of q_1 + s i q_2 with a play
// (coupled_spring.hpp).
#include <fmt/format.h>

#include <cmath>

#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/coupled_spring.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/loop_mobility.hpp"
#include "floatframe/model/port_measures.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

namespace {

/// What (4) is made of, in world axes of the design configuration; or the spring.
struct GearTeeth {
  CoupledSum sum;
  bool at_pitch_point = false;
  double w = 0.0;
  Vec3 n = Vec3::Zero(), torques[2] = {Vec3::Zero(), Vec3::Zero()};
  CoupledSpring spring = {};
};

template <class S>
void gear_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  if (in.element.acts) pull_coupled(in, in.template data<GearTeeth>().spring, out);
}

}  // namespace

FLOATFRAME_LAW(gear)

namespace {

BranchSide gear_side(const Ports& in) noexcept {
  return coupled_side(in, in.data<GearTeeth>().spring);
}

constexpr const char* gear_wheels[] = {"driver", "driven"};
constexpr const char* gear_flanks[] = {"forward", "backward"};
constexpr NumberRule gear_pressure_angles = {"an angle from 0 to 0.8", "rad", 0.0, 0.8};
constexpr NumberRule gear_helix_angles = {"an angle from -1.2 to 1.2", "rad", -1.2, 1.2};
constexpr ElementKey gear_keys[] = {
    coordinate_key("driver", "of the first wheel, the child of the joint",
                   described_by<&Gear::driver>),
    coordinate_key("driven", "of the second wheel", described_by<&Gear::driven>),
    {.name = "ratio",
     .kind = KeyKind::number,
     .about = "turns of the driver per turn of the driven wheel",
     .rule = positive_number(""),
     .fallback = no_number,
     .member = described_by<&Gear::ratio>},
    numbers_key("teeth", "instead of `ratio`, which is driven / driver", number_of_teeth,
                gear_wheels, described_by<&Gear::teeth>),
    {.name = "internal",
     .kind = KeyKind::flag,
     .about = "one wheel is a ring around the other: both turn in the same sense",
     .member = described_by<&Gear::internal>},
    {.name = "pressure_angle",
     .kind = KeyKind::number,
     .about = "of the teeth, in the section normal to them: the force of the teeth acts at the "
              "pitch point",
     .rule = gear_pressure_angles,
     .fallback = no_number,
     .member = described_by<&Gear::pressure_angle>},
    {.name = "helix_angle",
     .kind = KeyKind::number,
     .about = "of the teeth of the driver on its pitch circle; positive: right-hand",
     .rule = gear_helix_angles,
     .member = described_by<&Gear::helix_angle>},
    {.name = "flank",
     .kind = KeyKind::word,
     .about = "the flanks that carry: those of a driver that drives in the sense of its joint, or "
              "against it. The force of the others would push apart, too",
     .words = gear_flanks,
     .member = described_by<&Gear::flank>},
    {.name = "mesh_stiffness",
     .kind = KeyKind::number,
     .about = "torque on the driver per angle of it while the driven wheel is held; the gear is "
              "then a spring",
     .rule = positive_number("N m/rad"),
     .fallback = no_number,
     .member = described_by<&Gear::mesh_stiffness>},
    {.name = "mesh_damping",
     .kind = KeyKind::number,
     .about = "the same per speed, while teeth touch; it does not hold them together",
     .rule = non_negative_number("N m s/rad"),
     .member = described_by<&Gear::mesh_damping>},
    {.name = "backlash",
     .kind = KeyKind::number,
     .about = "play of the driver, from flank to flank",
     .rule = non_negative_number("rad"),
     .member = described_by<&Gear::backlash>}};

void gear_validate(const ElementCheck& check) {
  validate_coordinates(check);
  validate_ratio(check);
  if (check.good("mesh_stiffness") && check.has("pressure_angle"))
    check.error(ErrorCode::exclusive, "mesh_stiffness",
                "excludes 'pressure_angle'; remove one of them");
  for (const char* key : {"mesh_damping", "backlash"})
    if (check.good(key) && check.number(key) != 0.0 && !check.has("mesh_stiffness") &&
        !check.wrong.contains("mesh_stiffness"))
      check.error(ErrorCode::incomplete, key, "needs 'mesh_stiffness'");
  if (check.has("pressure_angle") || check.wrong.contains("pressure_angle")) return;
  if (check.good("helix_angle") && check.number("helix_angle") != 0.0)
    check.error(ErrorCode::incomplete, "helix_angle", "needs 'pressure_angle'");
  if (check.good("flank") && std::get<Gear>(check.description().kind).flank == GearFlank::backward)
    check.error(ErrorCode::incomplete, "flank", "needs 'pressure_angle'");
}

/// (2), (3). False after an error.
bool find_gear_teeth(ElementBuild& build, GearTeeth& teeth) {
  const Gear& keys = build.keys<Gear>();
  const double ratio = ratio_of(build);
  const auto joint = [&](std::size_t k) {
    return build.joint(k == 0 ? keys.driver.joint : keys.driven.joint);
  };
  const auto error = [&](ErrorCode code, const std::string& sentence) {
    build.error(code, sentence);
    return false;
  };
  if (joint(0)->parent != joint(1)->parent)
    return error(ErrorCode::geometry,
                 "found the wheels on two housings, expected the same parent of both joints: "
                 "'pressure_angle' needs their distance");
  const Vec3 z = build.design_axis(1), between = build.design_point(3) - build.design_point(1);
  const Vec3 across = between - z.dot(between) * z;
  const double distance = across.norm();
  if (!(distance > 1e-9 * (1.0 + between.norm())))
    return error(ErrorCode::geometry, "found both wheels on one axis, expected axes apart");
  if (keys.internal && ratio == 1.0)
    return error(ErrorCode::out_of_range,
                 "found the ratio 1 of an internal gear, expected another with 'pressure_angle'");
  teeth.w = 1.0 / (keys.internal ? 1.0 - ratio : 1.0 + ratio);
  const bool ring = keys.internal && ratio < 1.0;
  const Vec3 u = std::copysign(1.0, teeth.w) / distance * across;
  const bool forward =
      (keys.flank == GearFlank::forward) == (mirrored_sense(build, "driver") > 0.0);
  const double radial =
      std::tan(*keys.pressure_angle) / std::cos(keys.helix_angle) * (forward == ring ? -1.0 : 1.0);
  teeth.n =
      (z.cross(u) - std::tan(keys.helix_angle) * z + radial * u) / (std::abs(teeth.w) * distance);
  teeth.torques[0] = teeth.w * between.cross(teeth.n);
  teeth.torques[1] = (1.0 - teeth.w) * between.cross(teeth.n);
  teeth.sum.value.pieces = PiecewisePolynomial::polynomial({-teeth.n.dot(between)});
  teeth.at_pitch_point = true;
  return true;
}

bool gear_build(ElementBuild& build) {
  if (!connect_coupled(build, "driver") || !connect_coupled(build, "driven")) return false;
  const std::vector<double> senses = senses_of_axes(build, parallel_wheels);
  if (senses.empty()) return false;
  const Gear& keys = build.keys<Gear>();
  GearTeeth teeth;
  const double sense = keys.internal ? -senses[1] : senses[1];
  teeth.sum.factors = {1.0, sense * ratio_of(build)};
  if (keys.pressure_angle && !find_gear_teeth(build, teeth)) return false;
  if (keys.mesh_stiffness)
    teeth.spring = {spring_with_play(*keys.mesh_stiffness, keys.backlash), keys.mesh_damping,
                    teeth.sum.factors[1]};
  build.element.data = std::make_shared<GearTeeth>(std::move(teeth));
  return true;
}

/// (4)
void gear_rows(const Model& model, const Element& element, ConstraintPart part,
               std::vector<ConstraintPart>& parts) {
  const GearTeeth& teeth = data_of<GearTeeth>(element);
  const std::size_t first = parts.size();
  append_sum(model, element, teeth.sum.factors, &teeth.sum.value, part, parts);
  if (!teeth.at_pitch_point) return;
  const double scale = parts[first].scale;
  for (std::size_t k = first; k < parts.size(); ++k) parts[k].apart = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const CoordinatePort& port = element.coordinates[i];
    const int F = element.markers[port.port];
    const Mat3 R = design_pose(model, F).R;
    const Vec3 z = R.col(2), tilt = teeth.torques[i] - z.dot(teeth.torques[i]) * z;
    ConstraintPart more = parts[first + i];
    more.continues = true;
    more.motion = nullptr;
    more.coordinate = -1;
    if (const double size = tilt.norm(); size > 1e-12 * teeth.torques[i].norm()) {
      more.type = ConstraintType::perpendicular;  // its gradient on M is -scale e x z
      more.e_a = (R.transpose() * tilt.cross(z)).normalized();
      more.n_b = Vec3::UnitZ();
      more.c = 0.0;
      more.scale = scale * size;
      parts.push_back(more);
    }
    more.type = ConstraintType::coordinate_displacement;
    more.e_a = R.transpose() * teeth.n;
    more.scale = scale;
    const double w = i == 0 ? teeth.w : 1.0 - teeth.w;
    for (std::size_t j = 0; j < 2; ++j) {
      more.b = element.markers[element.coordinates[j].port + 1];
      more.c = j == 0 ? w : -w;
      parts.push_back(more);
    }
  }
}

/// A right hand becomes a left one.
void gear_mirror(ElementDescription& element, const Placement& x) {
  if (x.det() < 0.0) std::get<Gear>(element.kind).helix_angle *= -1.0;
}

ElementExample gear_example(std::size_t regime, ExampleNumbers& numbers) {
  Gear gear{.driver = {"a"}, .driven = {"b"}, .ratio = numbers(0.5, 3.0)};
  if (regime > 0) gear.mesh_stiffness = 100.0;
  ElementExample x = coupled_example(std::move(gear), 2, numbers);
  if (regime == 0) return x;
  GearTeeth teeth;
  teeth.spring = coupled_spring_example(regime, x, numbers);
  x.element.data = std::make_shared<GearTeeth>(std::move(teeth));
  return x;
}

/// The pitch circles of (2), or of wheels on one axis two circles in the ratio.
std::vector<Stroke> gear_strokes(const Model& model, const Element& element) {
  const auto& teeth = data_of<GearTeeth>(element);
  const double ratio = std::abs(teeth.sum.factors[1]);
  const bool internal = std::get<Gear>(*element.keys).internal;
  Strokes out(model, element);
  const double distance = out.across(0, 1).norm();
  double r_1 = distance / std::abs(internal ? 1.0 - ratio : 1.0 + ratio);
  if (!(r_1 > 1e-9) || !std::isfinite(r_1)) r_1 = out.size(out.child(0)) / (1.0 + ratio);
  out.wheels(0, r_1, 1, ratio * r_1);
  return out.take();
}

}  // namespace

constinit const ElementKind gear_element = {
    .about =
        "two wheels on parallel axes that mesh: external gears turn in opposite senses. "
        "Without `pressure_angle` a pure torque on each wheel about its axis, and on the "
        "housing; with it the force of the teeth at the pitch point",
    .keys = gear_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(Gear()); },
    .validate = gear_validate,
    .build = gear_build,
    .rows = gear_rows,
    .gives_way = [](const ElementKeys& k) { return std::get<Gear>(k).mesh_stiffness.has_value(); },
    .mirror = gear_mirror,
    .dual = gear_law<Dual>,
    .side = gear_side,
    .picture = picture_of_coupling,
    .strokes = gear_strokes,
    .regimes = coupled_spring_regimes};

constinit const ExampleMaker gear_examples = gear_example;

}  // namespace floatframe
