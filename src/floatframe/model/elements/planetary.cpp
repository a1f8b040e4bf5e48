// Planetary gear: sun, ring and carrier on one axis. Seen from the carrier the planets are an
// internal gear between sun and ring (Willis):
//   z_s (q_s - q_c) + z_r (q_r - q_c) = 0,                                                     (1)
// divided by z_s: one row (coupled_coordinates.hpp) with the factors 1, z_r / z_s and
// -(1 + z_r / z_s), and the senses of the axes. One of the three that is not given does not turn.
// The torques on them are in the ratio of the factors; planets are without mass.
#include <cmath>
#include <numbers>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(planetary)

namespace {

constexpr const char* planetary_wheels[] = {"sun", "ring"};
constexpr ElementKey planetary_keys[] = {
    coordinate_key("sun", "of the sun; without it the sun is fixed",
                   described_by<&PlanetaryGear::sun>, ElementAxis::about, false),
    coordinate_key("ring", "of the ring; without it the ring is fixed",
                   described_by<&PlanetaryGear::ring>, ElementAxis::about, false),
    coordinate_key("carrier", "of the carrier of the planets; without it the carrier is fixed",
                   described_by<&PlanetaryGear::carrier>, ElementAxis::about, false),
    numbers_key("teeth", "of the sun and of the ring, which has more", number_of_teeth,
                planetary_wheels, described_by<&PlanetaryGear::teeth>, true)};

void planetary_validate(const ElementCheck& check) {
  validate_coordinates(check);
  validate_teeth(check);
  const int given = check.has("sun") + check.has("ring") + check.has("carrier");
  if (given < 2 && check.wrong.empty())
    check.error(ErrorCode::incomplete, "",
                "found " + std::to_string(given) +
                    " of sun, ring and carrier, expected two or three; what is left out is fixed");
  const MatX teeth = check.matrix("teeth");
  if (!check.wrong.contains("teeth") && teeth.size() == 2 && !(teeth(0) < teeth(1)))
    check.error(ErrorCode::out_of_range, "teeth",
                "found " + number_text(teeth(0)) + " of the sun and " + number_text(teeth(1)) +
                    " of the ring, expected more of the ring");
}

bool planetary_build(ElementBuild& build) {
  CoupledSum sum;
  const MatX teeth = build.matrix("teeth");
  const double ratio = teeth(1) / teeth(0);
  for (const auto& [key, factor] :
       {std::pair("sun", 1.0), std::pair("ring", ratio), std::pair("carrier", -1.0 - ratio)}) {
    if (!connect_coupled(build, key)) return false;
    if (build.has(key)) sum.factors.push_back(factor);
  }
  const std::vector<double> senses = senses_of_axes(build, parallel_wheels);
  if (senses.empty()) return false;
  for (std::size_t i = 0; i < senses.size(); ++i) sum.factors[i] *= senses[i];
  build.element.data = std::make_shared<CoupledSum>(std::move(sum));
  return true;
}

ElementExample planetary_example(std::size_t, ExampleNumbers& numbers) {
  PlanetaryGear gear;
  gear.sun = CoordinateTerm{"a"};
  gear.carrier = CoordinateTerm{"b"};
  gear.teeth = MatX{{20.0, 60.0}};
  return coupled_example(std::move(gear), 2, numbers);
}

/// Sun, ring, and three planets on the carrier; of what is fixed there is none.
std::vector<Stroke> planetary_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  const PlanetaryGear& keys = std::get<PlanetaryGear>(*element.keys);
  double ring = 0.0;
  for (std::size_t i = 0; i < element.coordinates.size(); ++i)
    ring = std::max(ring, out.size(out.child(i)));
  const double sun = ring * keys.teeth(0) / keys.teeth(1), planet = 0.5 * (ring - sun);
  constexpr double per_ring = 72.0;  // teeth
  std::size_t i = 0;
  if (keys.sun) out.wheel(out.child(i), out.axis(i), sun, per_ring * sun / ring), ++i;
  if (keys.ring) out.wheel(out.child(i), out.axis(i), ring, per_ring), ++i;
  if (!keys.carrier) return out.take();
  const Mat3 R = frame_with_z(out.axis(i));
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 3.0;
    const Vec3 centre = R * Vec3(std::cos(angle), std::sin(angle), 0.0) * (sun + planet);
    out.wheel(out.child(i), out.axis(i), planet, per_ring * planet / ring);
    out.shift_last(centre);
    out.line(out.child(i), Vec3::Zero(), centre);
  }
  return out.take();
}

}  // namespace

constinit const ElementKind planetary_element = {
    .about =
        "sun, ring and carrier of a planetary gear on one axis: sun and ring turn, seen from "
        "the carrier, in opposite senses. Pure torques about the axis; planets are without "
        "mass",
    .keys = planetary_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(PlanetaryGear()); },
    .validate = planetary_validate,
    .build = planetary_build,
    .rows = coupled_rows,
    .picture = picture_of_coupling,
    .strokes = planetary_strokes,
    .regimes = holding_regimes};

constinit const ExampleMaker planetary_examples = planetary_example;

}  // namespace floatframe
