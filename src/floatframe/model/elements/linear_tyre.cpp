// Tyre with a vertical spring and slip stiffnesses, in the contact and with the states of
// rolling_tyre.hpp; ISO-W. With the load F_z, and q = F_z/nominal_load, 1 without one:
//   load        k d
//   forces      F_x = q C_x kappa, F_y = -q (C_y tan(alpha) + C_g gamma), both times
//               f = min(1, mu F_z/|(F_x, F_y)|)
//   moments     M_z = f q trail C_y tan(alpha), M_y = -f_r F_z r_l
//   lengths     sigma_x, sigma_y; stiffness at rest q C/sigma; L = mu F_z sigma/(q C)
//   radius      r_e = r_l: without slip the tread moves as the rim does at the contact
//   energy      k d^2/2
// mu is that of the tyre times the factor of the road.
#include "floatframe/model/rolling_tyre_kind.hpp"

namespace floatframe {

namespace {

struct LinearTyreLaw {
  using Keys = LinearTyre;
  struct Data {};
  static constexpr bool falls = false, slip_of_centre = false;

  static double radius(const Keys& keys, const Data&) noexcept { return keys.radius; }
  static bool mirrored(const Keys&, const Data&) noexcept { return false; }
  template <class S>
  static S load(const Keys& keys, const Data&, const S& deflection, const S&, const S&) noexcept {
    return keys.stiffness * deflection;
  }
  template <class S>
  static S effective_radius(const Keys& keys, const Data&, const S&, const S& deflection,
                            const S&) noexcept {
    return keys.radius - deflection;
  }
  /// q
  template <class S>
  static S part(const Keys& keys, const S& load) noexcept {
    return keys.nominal_load ? S(load / *keys.nominal_load) : S(1.0);
  }
  template <class S>
  static TyreLengths<S> lengths(const Keys& keys, const Data&, const S& load, const S&,
                                double friction) noexcept {
    const S q = part(keys, load), most = friction * keys.friction * load;
    TyreLengths<S> l;
    l.sigma_x = keys.relaxation_x;
    l.sigma_y = keys.relaxation_y;
    l.stiffness_x = q * (keys.slip_stiffness / keys.relaxation_x);
    l.stiffness_y = q * (keys.cornering_stiffness / keys.relaxation_y);
    l.limit_x = most / l.stiffness_x;
    l.limit_y = most / l.stiffness_y;
    return l;
  }
  template <class S, class B>
  static TyreForces<S, B> forces(const Keys& keys, const Data&, const TyreInput<S, B>& x) noexcept {
    using std::sqrt;
    const B q = part(keys, x.load), most = x.friction * keys.friction * x.load;
    TyreForces<S, B> f;
    f.F_x = q * keys.slip_stiffness * x.kappa;
    S side = -(q * keys.cornering_stiffness * x.tan_alpha);
    f.F_y = side - q * keys.camber_stiffness * x.camber;
    f.M_y = -keys.rolling_resistance * x.load * B(keys.radius - x.deflection);
    const S square = f.F_x * f.F_x + f.F_y * f.F_y;
    if (value_of(square) > value_of(most) * value_of(most)) {
      const S part = most / S(sqrt(square));
      f.F_x *= part;
      f.F_y *= part;
      side *= part;
      f.friction_use = 1.0;
    } else if (value_of(square) > 0.0) {
      f.friction_use = in_scalar<B>(S(sqrt(square))) / most;
    }
    f.M_z = in_scalar<B>(S(-keys.trail * side));
    return f;
  }
  template <class S>
  static S energy(const Keys& keys, const Data&, const S& deflection) noexcept {
    return 0.5 * keys.stiffness * deflection * deflection;
  }
};

template <class S>
void linear_tyre_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  rolling_tyre_law<LinearTyreLaw>(in, out);
}

}  // namespace

FLOATFRAME_LAW(linear_tyre)

namespace {

constexpr ElementKey linear_tyre_own[] = {
    required_rolling_number("radius", "unloaded", rules::tyre_radius,
                            described_by<&LinearTyre::radius>),
    required_rolling_number("stiffness", "vertical", rules::tyre_stiffness,
                            described_by<&LinearTyre::stiffness>),
    required_rolling_number("slip_stiffness", "longitudinal force over the slip κ",
                            positive_number("N"), described_by<&LinearTyre::slip_stiffness>),
    required_rolling_number("cornering_stiffness", "lateral force over the tangent of α",
                            positive_number("N"), described_by<&LinearTyre::cornering_stiffness>),
    rolling_number("camber_stiffness", "lateral force over the camber γ",
                   non_negative_number("N/rad"), described_by<&LinearTyre::camber_stiffness>, 0.0),
    rolling_number("nominal_load",
                   "these three are of it and proportional to the load; without it independent",
                   positive_number("N"), described_by<&LinearTyre::nominal_load>),
    rolling_number("trail", "pneumatic: the lateral force acts behind the contact point",
                   non_negative_number("m"), described_by<&LinearTyre::trail>, 0.0),
    rolling_number("friction", "limit of the force in the road over the load", positive_number(""),
                   described_by<&LinearTyre::friction>, 1.0),
    required_rolling_number("relaxation_x", "relaxation length along", positive_number("m"),
                            described_by<&LinearTyre::relaxation_x>),
    required_rolling_number("relaxation_y", "relaxation length across", positive_number("m"),
                            described_by<&LinearTyre::relaxation_y>),
    rolling_number("rolling_resistance", "its torque over load and loaded radius",
                   non_negative_number(""), described_by<&LinearTyre::rolling_resistance>, 0.0)};
constexpr auto linear_tyre_keys = rolling_keys<LinearTyre>(linear_tyre_own);

bool linear_tyre_build(ElementBuild& build) {
  build.element.data = std::make_shared<const LinearTyreLaw::Data>();
  return build_rolling_tyre(build, build.keys<LinearTyre>());
}

ElementExample linear_tyre_example(std::size_t regime, ExampleNumbers& numbers) {
  LinearTyre f;
  f.radius = numbers(0.3, 0.5);
  f.stiffness = numbers(800.0, 2000.0);
  f.damping = numbers(1.0, 5.0);
  f.slip_stiffness = numbers(100.0, 200.0);
  f.cornering_stiffness = numbers(100.0, 200.0);
  f.camber_stiffness = numbers(10.0, 20.0);
  if (numbers(0.0, 1.0) < 0.5) f.nominal_load = numbers(80.0, 120.0);
  if (numbers(0.0, 1.0) < 0.5) f.rest_damping = numbers(5.0, 10.0);
  f.trail = numbers(0.02, 0.05);
  f.friction = numbers(0.8, 1.0);
  f.relaxation_x = numbers(0.3, 0.6);
  f.relaxation_y = numbers(0.3, 0.6);
  f.rolling_resistance = numbers(0.01, 0.02);
  return rolling_example<LinearTyreLaw>(regime, numbers, f, {}, numbers(0.05, 0.12));
}

constexpr ElementKind linear_tyre_kind() {
  ElementKind kind = rolling_tyre_kind<LinearTyreLaw>();
  kind.about =
      "tyre with a vertical spring, slip stiffnesses, a limit of friction and relaxation lengths";
  kind.keys = linear_tyre_keys;
  kind.build = linear_tyre_build;
  return kind;
}

}  // namespace

constinit const ElementKind linear_tyre_element = linear_tyre_kind();

constinit const ExampleMaker linear_tyre_examples = linear_tyre_example;

}  // namespace floatframe
