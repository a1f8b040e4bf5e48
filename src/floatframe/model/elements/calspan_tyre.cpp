// Calspan tyre (tyres/calspan.hpp) in the contact of rolling_tyre.hpp, without a longitudinal
// force: a wheel that turns keeps its spin; ISO-W.
//   load        k (R - z), z = (R - d) cos(gamma) the distance of the wheel centre from the plane
//               of the road
//   slip        that of the wheel centre: alpha = atan(V_y/|V_x|)
//   lengths     of `relaxation_y`: sigma; stiffness at rest Ca/sigma, L = 3 mu F_z sigma/Ca, where
//               the force has become the largest; without it there are no states. The deflection
//               along has no force: its stiffness is a number next to nothing
#include "floatframe/model/rolling_tyre_kind.hpp"
#include "floatframe/tyres/calspan.hpp"

namespace floatframe {

namespace {

struct CalspanTyreLaw {
  using Keys = CalspanTyre;
  using Data = Calspan;
  static constexpr bool falls = false, slip_of_centre = true;

  static double radius(const Keys& keys, const Data&) noexcept { return keys.radius; }
  static bool mirrored(const Keys&, const Data&) noexcept { return false; }
  template <class S>
  static S load(const Keys& keys, const Data&, const S& d, const S& camber, const S&) noexcept {
    using std::cos;
    return keys.stiffness * (keys.radius - (keys.radius - d) * cos(camber));
  }
  template <class S>
  static S effective_radius(const Keys& keys, const Data&, const S&, const S& d,
                            const S&) noexcept {
    return keys.radius - d;
  }
  template <class S>
  static TyreLengths<S> lengths(const Keys& keys, const Data& data, const S& load, const S&,
                                double friction) noexcept {
    constexpr double next_to_nothing = 1e-6;  // [N/m]
    constexpr double far = 1e3;               // [m]
    const S slope = calspan_cornering_stiffness(data, load);
    const S most = friction * load * calspan_friction(data, load);
    TyreLengths<S> l;
    l.sigma_x = l.sigma_y = keys.relaxation_y.value_or(1.0);
    l.stiffness_x = next_to_nothing;
    l.stiffness_y = slope / l.sigma_y;
    l.limit_x = far;
    l.limit_y = 3.0 * most / l.stiffness_y;
    return l;
  }
  template <class S, class B>
  static TyreForces<S, B> forces(const Keys&, const Data& data, const TyreInput<S, B>& x) noexcept {
    using std::atan2;
    const CalspanForces<S> of =
        calspan_forces(data, x.load, x.friction, S(atan2(x.tan_alpha, S(1.0))), x.camber);
    TyreForces<S, B> f;
    f.F_y = of.Fy;
    f.M_z = in_scalar<B>(of.Mz);
    f.friction_use = in_scalar<B>(of.friction_use);
    return f;
  }
};

template <class S>
void calspan_tyre_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  rolling_tyre_law<CalspanTyreLaw>(in, out);
}

}  // namespace

FLOATFRAME_LAW(calspan_tyre)

namespace {

constexpr const char* calspan_cornering_words[] = {"A0 [N/rad]", "A1 [1/rad]", "A2 [N]"};
constexpr const char* calspan_camber_words[] = {"A3 [1/rad]", "A4 [N]"};
constexpr const char* calspan_friction_words[] = {"B1 [1/N]", "B3", "B4 [1/N²]"};
constexpr const char* calspan_aligning_words[] = {"AF1 [m/N]", "AF2 [m/N]"};

constexpr ElementKey calspan_numbers(const char* name, const char* about,
                                     std::span<const char* const> words, bool required,
                                     KeyMember member) {
  return {.name = name,
          .kind = KeyKind::numbers,
          .about = about,
          .required = required,
          .words = words,
          .member = member};
}

constexpr ElementKey calspan_own[] = {
    required_rolling_number("radius", "unloaded", rules::tyre_radius,
                            described_by<&CalspanTyre::radius>),
    required_rolling_number("stiffness", "vertical", rules::tyre_stiffness,
                            described_by<&CalspanTyre::stiffness>),
    calspan_numbers("cornering", "coefficients of the cornering stiffness", calspan_cornering_words,
                    true, described_by<&CalspanTyre::cornering>),
    calspan_numbers("camber", "coefficients of the camber stiffness", calspan_camber_words, true,
                    described_by<&CalspanTyre::camber>),
    calspan_numbers("friction", "coefficients of the friction", calspan_friction_words, true,
                    described_by<&CalspanTyre::friction>),
    calspan_numbers("aligning", "coefficients of the aligning moment", calspan_aligning_words,
                    false, described_by<&CalspanTyre::aligning>),
    rolling_number("load_limit", "Ω_T: stiffnesses are held above a load of this times A2",
                   positive_number(""), described_by<&CalspanTyre::load_limit>, 1.0),
    rolling_number("skid_number", "a factor of the friction", positive_number(""),
                   described_by<&CalspanTyre::skid_number>, 1.0),
    rolling_number("relaxation_y", "relaxation length across; without it slips follow at once",
                   positive_number("m"), described_by<&CalspanTyre::relaxation_y>)};
constexpr auto calspan_tyre_keys = rolling_keys<CalspanTyre>(calspan_own);

Calspan calspan_data(const CalspanTyre& keys) {
  Calspan c;
  c.A0 = keys.cornering(0);
  c.A1 = keys.cornering(1);
  c.A2 = keys.cornering(2);
  c.A3 = keys.camber(0);
  c.A4 = keys.camber(1);
  c.B1 = keys.friction(0);
  c.B3 = keys.friction(1);
  c.B4 = keys.friction(2);
  c.load_limit = keys.load_limit;
  c.SN = keys.skid_number;
  if (keys.aligning.size() > 0) {
    c.AF1 = keys.aligning(0);
    c.AF2 = keys.aligning(1);
  }
  return c;
}

void calspan_validate(const ElementCheck& check) {
  validate_rolling_tyre(check);
  struct Load {
    const char* key;
    Eigen::Index column;
  };
  for (const auto& [key, column] : {Load{"cornering", 2}, Load{"camber", 1}}) {
    if (!check.good(key)) continue;
    const char* word = column == 2 ? "A2" : "A4";
    if (const auto complaint = positive_number("N").complaint(check.matrix(key)(column)))
      check.error(ErrorCode::wrong_value, key, std::string(word) + ": " + *complaint);
  }
  if (check.good("cornering") && check.matrix("cornering")(0) < 0.0)
    check.error(ErrorCode::wrong_value, "cornering",
                "A0: " + *non_negative_number("N/rad").complaint(check.matrix("cornering")(0)));
}

bool calspan_build(ElementBuild& build) {
  CalspanTyre& keys = build.keys<CalspanTyre>();
  build.element.data = std::make_shared<const Calspan>(calspan_data(keys));
  return build_rolling_tyre(build, keys);
}

ElementExample calspan_example(std::size_t regime, ExampleNumbers& numbers) {
  CalspanTyre f;
  f.radius = numbers(0.3, 0.5);
  f.stiffness = numbers(800.0, 1600.0);
  f.damping = numbers(1.0, 5.0);
  f.cornering = MatX{{numbers(200.0, 300.0), numbers(8.0, 10.0), 700.0}};
  f.camber = MatX{{numbers(1.0, 2.0), 900.0}};
  f.friction = MatX{{-5e-4, numbers(1.0, 1.2), 1e-7}};
  f.aligning = MatX{{-numbers(1e-4, 2e-4), numbers(1e-4, 2e-4)}};
  f.skid_number = numbers(0.9, 1.1);
  f.relaxation_y = numbers(0.3, 0.6);
  if (numbers(0.0, 1.0) < 0.5) f.rest_damping = numbers(5.0, 10.0);
  return rolling_example<CalspanTyreLaw>(regime, numbers, f, calspan_data(f), numbers(0.05, 0.12));
}

constexpr ElementKind calspan_kind() {
  ElementKind kind = rolling_tyre_kind<CalspanTyreLaw>();
  kind.about =
      "Calspan tyre: side force and aligning moment of slip angle and camber, a vertical spring, "
      "no "
      "longitudinal force";
  kind.keys = calspan_tyre_keys;
  kind.validate = calspan_validate;
  kind.build = calspan_build;
  kind.states = [](Element& element) {
    const CalspanTyre& keys = std::get<CalspanTyre>(*element.keys);
    if (!keys.relaxation || !keys.relaxation_y) return;
    element.states = rolling::states;
    element.kept = rolling::kept;
    element.rates_first = true;
  };
  return kind;
}

}  // namespace

constinit const ElementKind calspan_tyre_element = calspan_kind();

constinit const ExampleMaker calspan_tyre_examples = calspan_example;

}  // namespace floatframe
