// TMeasy tyre (tyres/tmeasy.hpp) in the contact and with the states of rolling_slips.hpp; ISO-W.
//   load        a1 d + a2 d^2, a1 d in the air, whose slopes at pn and 2 pn are c1, c2:
//               a2 = (c2^2 - c1^2)/(4 pn), a1 = sqrt(2 c1^2 - c2^2)
//   radius      r_e = R - (1 - q) d, q = rolling_radius
//   slips       with s = V_cx/sqrt(V_cx^2 + v_r^2), the sense of rolling, and the speed of the
//               tread over that of the wheel |r_e Omega|/|V_cx| = |1 + s kappa| = D:
//               sx = kappa/D, sy = -tan(alpha)/D; below D = 0.1, where the wheel hardly turns and
//               all slides, D is the parabola 0.05 + 5 (1 + s kappa)^2
//   moments     M_z of the trail, M_y = -f_r F_z (R - d)
//   lengths     sigma = dF0/c of the carcass, at least 1 cm; stiffness at rest dF0/sigma;
//               L = mu sM sigma
//   energy      a1 d^2/2 + a2 d^3/3
// Camber has no part in it but by the place of the contact point.
#include <fmt/format.h>

#include "floatframe/model/rolling_tyre_kind.hpp"
#include "floatframe/tyres/tmeasy.hpp"

namespace floatframe {

namespace {

/// D of x = 1 + s kappa
template <class S>
S tmeasy_tread_speed(const S& x) noexcept {
  constexpr double hardly = 0.1;
  const S size = magnitude(x);
  return size < hardly ? S(0.5 * hardly + x * x / (2.0 * hardly)) : size;
}

struct TmeasyTyreLaw {
  using Keys = TmeasyTyre;
  struct Data {
    Tmeasy tyre;
    double a1 = 0.0, a2 = 0.0;
  };
  static constexpr bool falls = true, slip_of_centre = false;

  static double radius(const Keys& keys, const Data&) noexcept { return keys.radius; }
  static bool mirrored(const Keys&, const Data&) noexcept { return false; }
  template <class S>
  static S load(const Keys&, const Data& data, const S& d, const S&, const S&) noexcept {
    return value_of(d) > 0.0 ? S(d * (data.a1 + data.a2 * d)) : S(data.a1 * d);
  }
  template <class S>
  static S effective_radius(const Keys& keys, const Data&, const S&, const S& d,
                            const S&) noexcept {
    return keys.radius - (1.0 - keys.rolling_radius) * d;
  }
  template <class S>
  static S relaxation_length(const S& slope, double carcass) noexcept {
    constexpr double least = 0.01;  // [m]
    const S length = slope / carcass;
    return length < least ? S(least) : length;
  }
  template <class S>
  static TyreLengths<S> lengths(const Keys& keys, const Data& data, const S& load, const S&,
                                double friction) noexcept {
    const Tmeasy& t = data.tyre;
    const S held = tmeasy_held_load(t, load);
    const S slope_x = tmeasy_slope(t, t.x, load), slope_y = tmeasy_slope(t, t.y, load);
    const double mu = friction * keys.friction;
    TyreLengths<S> l;
    l.sigma_x = relaxation_length(slope_x, keys.longitudinal_stiffness);
    l.sigma_y = relaxation_length(slope_y, keys.lateral_stiffness);
    l.stiffness_x = slope_x / l.sigma_x;
    l.stiffness_y = slope_y / l.sigma_y;
    l.limit_x = mu * tmeasy_linear(t.x.maximum_slip, t.nominal_load, held) * l.sigma_x;
    l.limit_y = mu * tmeasy_linear(t.y.maximum_slip, t.nominal_load, held) * l.sigma_y;
    return l;
  }
  template <class S, class B>
  static TyreForces<S, B> forces(const Keys& keys, const Data& data,
                                 const TyreInput<S, B>& x) noexcept {
    const S tread = tmeasy_tread_speed(S(1.0 + sense_of_rolling(x.v_cx) * x.kappa));
    const TmeasyForces<S> of = tmeasy_forces(data.tyre, x.load, B(x.friction * keys.friction),
                                             S(x.kappa / tread), S(-x.tan_alpha / tread));
    TyreForces<S, B> f;
    f.F_x = of.Fx;
    f.F_y = of.Fy;
    f.M_z = in_scalar<B>(of.Mz);
    f.M_y = -keys.rolling_resistance * x.load * B(keys.radius - x.deflection);
    f.friction_use = in_scalar<B>(of.friction_use);
    return f;
  }
  template <class S>
  static S energy(const Keys&, const Data& data, const S& d) noexcept {
    return d * d * (0.5 * data.a1 + data.a2 / 3.0 * d);
  }
};

template <class S>
void tmeasy_tyre_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  rolling_tyre_law<TmeasyTyreLaw>(in, out);
}

}  // namespace

FLOATFRAME_LAW(tmeasy_tyre)

namespace {

enum TmeasyColumn { slope_column, maximum_column, slip_column, sliding_column, end_column };
constexpr const char* tmeasy_axis_words[] = {"slope [N]", "maximum [N]", "slip of it",
                                             "sliding [N]", "slip from which"};
constexpr const char* tmeasy_trail_words[] = {"trail", "slip of its zero", "slip of its end"};
constexpr const char* tmeasy_loads[] = {"at the nominal load", "at twice"};
constexpr NumberRule tmeasy_share = {"a number from 0 to 1", "", 0.0, 1.0};
constexpr double tmeasy_most_loads = 3.5;  ///< `max_load` over the nominal one, without it

constexpr ElementKey tmeasy_table(const char* name, const char* about,
                                  std::span<const char* const> words, KeyMember member) {
  return {.name = name,
          .kind = KeyKind::table,
          .about = about,
          .required = true,
          .rule = positive_number(""),
          .words = words,
          .member = member};
}

constexpr ElementKey tmeasy_own[] = {
    required_rolling_number("radius", "unloaded", rules::tyre_radius,
                            described_by<&TmeasyTyre::radius>),
    required_rolling_number("nominal_load", "of the tables", positive_number("N"),
                            described_by<&TmeasyTyre::nominal_load>),
    rolling_number("max_load", "above which they are held; without it 3.5 times the nominal one",
                   positive_number("N"), described_by<&TmeasyTyre::max_load>),
    {.name = "stiffness",
     .kind = KeyKind::numbers,
     .about = "vertical",
     .required = true,
     .rule = rules::tyre_stiffness,
     .words = tmeasy_loads,
     .member = described_by<&TmeasyTyre::stiffness>},
    tmeasy_table("longitudinal", "force over slip: two rows, at the nominal load and at twice",
                 tmeasy_axis_words, described_by<&TmeasyTyre::longitudinal>),
    tmeasy_table("lateral", "the same across", tmeasy_axis_words,
                 described_by<&TmeasyTyre::lateral>),
    tmeasy_table("trail", "pneumatic, over the contact length: two rows likewise",
                 tmeasy_trail_words, described_by<&TmeasyTyre::trail>),
    required_rolling_number(
        "longitudinal_stiffness", "of the carcass: the relaxation length is the slope over it",
        positive_number("N/m"), described_by<&TmeasyTyre::longitudinal_stiffness>),
    required_rolling_number("lateral_stiffness", "the same across", positive_number("N/m"),
                            described_by<&TmeasyTyre::lateral_stiffness>),
    rolling_number("rolling_radius",
                   "share of the unloaded radius in the effective one; the rest is the loaded one",
                   tmeasy_share, described_by<&TmeasyTyre::rolling_radius>, 0.67),
    rolling_number("friction", "of the road over that of the tables", positive_number(""),
                   described_by<&TmeasyTyre::friction>, 1.0),
    {.name = "normalised",
     .kind = KeyKind::flag,
     .about = "the combined slip has Rill's normalising factors; `false`: slips as they are",
     .fallback = 1.0,
     .member = described_by<&TmeasyTyre::normalised>},
    rolling_number("rolling_resistance", "its torque over load and loaded radius",
                   non_negative_number(""), described_by<&TmeasyTyre::rolling_resistance>, 0.0)};
constexpr auto tmeasy_tyre_keys = rolling_keys<TmeasyTyre>(tmeasy_own);

TwoLoads tmeasy_column(const MatX& table, Eigen::Index column) {
  return {table(0, column), table(1, column)};
}
TmeasyAxis tmeasy_axis(const MatX& table) {
  return {.slope = tmeasy_column(table, slope_column),
          .maximum = tmeasy_column(table, maximum_column),
          .sliding = tmeasy_column(table, sliding_column),
          .maximum_slip = tmeasy_column(table, slip_column),
          .sliding_slip = tmeasy_column(table, end_column)};
}

TmeasyTyreLaw::Data tmeasy_data(const TmeasyTyre& keys) {
  TmeasyTyreLaw::Data data;
  Tmeasy& t = data.tyre;
  t.nominal_load = keys.nominal_load;
  t.max_load = keys.max_load.value_or(tmeasy_most_loads * keys.nominal_load);
  t.x = tmeasy_axis(keys.longitudinal);
  t.y = tmeasy_axis(keys.lateral);
  t.trail = {tmeasy_column(keys.trail, 0), tmeasy_column(keys.trail, 1),
             tmeasy_column(keys.trail, 2)};
  const double c1 = keys.stiffness(0), c2 = keys.stiffness(1);
  t.radius = keys.radius;
  t.stiffness = c1;
  t.normalised = keys.normalised;
  data.a1 = std::sqrt(2.0 * c1 * c1 - c2 * c2);
  data.a2 = (c2 * c2 - c1 * c1) / (4.0 * keys.nominal_load);
  return data;
}

/// What a column of a table becomes at the loads 0 and max_load, over the load if it is a force.
void validate_tmeasy_column(const ElementCheck& check, const char* key, const char* word,
                            const TwoLoads& values, bool force) {
  const double pn = check.number("nominal_load");
  const double most = check.good("max_load") ? check.number("max_load") : tmeasy_most_loads * pn;
  for (const double load : {0.0, most}) {
    const double value =
        force ? tmeasy_per_load(values, pn, load) : tmeasy_linear(values, pn, load);
    if (value > 0.0) continue;
    check.error(
        ErrorCode::wrong_value, key,
        fmt::format("found a column '{}' of which {} {:.4g} at a load of {:.4g} N, "
                    "expected positive values up to 'max_load'",
                    word, force ? "the share of the load is" : "the value is", value, load));
    return;
  }
}

void validate_tmeasy_axis(const ElementCheck& check, const char* key) {
  const MatX table = check.matrix(key);
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    const double slope = table(row, slope_column), maximum = table(row, maximum_column),
                 slip = table(row, slip_column), sliding = table(row, sliding_column),
                 end = table(row, end_column);
    if (sliding > maximum)
      check.error(ErrorCode::wrong_value, key,
                  fmt::format("found a sliding force {:.6g} above the maximum {:.6g}, expected it "
                              "to be at most that",
                              sliding, maximum));
    else if (!(end > slip))
      check.error(ErrorCode::wrong_value, key,
                  fmt::format("found sliding from a slip of {:.6g}, expected more than the slip "
                              "{:.6g} of the maximum",
                              end, slip));
    else if (slope * slip < maximum)
      check.error(ErrorCode::wrong_value, key,
                  fmt::format("found a slope {:.6g} with a maximum {:.6g} at a slip of {:.6g}, "
                              "expected a slope of at least maximum over slip",
                              slope, maximum, slip));
  }
}

void tmeasy_validate(const ElementCheck& check) {
  validate_rolling_tyre(check);
  if (check.good("stiffness")) {
    const MatX c = check.matrix("stiffness");
    if (c(1) < c(0) || c(1) * c(1) >= 2.0 * c(0) * c(0))
      check.error(ErrorCode::wrong_value, "stiffness",
                  fmt::format("found {:.6g} and {:.6g}, expected the second between the first "
                              "and 1.41 times that",
                              c(0), c(1)));
  }
  bool of_loads = check.good("nominal_load") && !check.wrong.contains("max_load");
  if (of_loads && check.good("max_load") &&
      check.number("max_load") < check.number("nominal_load")) {
    check.error(ErrorCode::wrong_value, "max_load",
                fmt::format("found {:.6g}, expected at least the nominal load {:.6g} N",
                            check.number("max_load"), check.number("nominal_load")));
    of_loads = false;
  }
  for (const char* key : {"longitudinal", "lateral", "trail"}) {
    if (!check.good(key)) continue;
    const MatX table = check.matrix(key);
    if (table.rows() != 2) {
      check.error(ErrorCode::wrong_count, key,
                  fmt::format("found {} row{}, expected two: at the nominal load and at twice",
                              table.rows(), table.rows() == 1 ? "" : "s"));
      continue;
    }
    const bool axis = table.cols() > 3;
    if (axis) validate_tmeasy_axis(check, key);
    if (!of_loads) continue;
    for (Eigen::Index c = 0; c < table.cols(); ++c)
      validate_tmeasy_column(check, key, axis ? tmeasy_axis_words[c] : tmeasy_trail_words[c],
                             tmeasy_column(table, c), axis && c != slip_column && c != end_column);
  }
}

bool tmeasy_build(ElementBuild& build) {
  build.element.data =
      std::make_shared<const TmeasyTyreLaw::Data>(tmeasy_data(build.keys<TmeasyTyre>()));
  return build_rolling_tyre(build, build.keys<TmeasyTyre>());
}

ElementExample tmeasy_example(std::size_t regime, ExampleNumbers& numbers) {
  TmeasyTyre f;
  f.radius = numbers(0.3, 0.5);
  f.nominal_load = numbers(90.0, 110.0);
  const double c = numbers(800.0, 1600.0);
  f.stiffness = MatX{{c, numbers(1.0, 1.3) * c}};
  f.damping = numbers(1.0, 5.0);
  f.longitudinal = MatX{{1500.0, 110.0, 0.12, 90.0, 0.6}, {2600.0, 200.0, 0.13, 170.0, 0.7}};
  f.lateral = MatX{{1000.0, 100.0, 0.2, 85.0, 0.9}, {1700.0, 180.0, 0.22, 150.0, 1.0}};
  f.trail = MatX{{0.17, 0.18, 0.9}, {0.19, 0.2, 1.0}};
  f.longitudinal_stiffness = numbers(3000.0, 5000.0);
  f.lateral_stiffness = numbers(2000.0, 4000.0);
  f.rolling_radius = numbers(0.4, 0.8);
  f.friction = numbers(0.8, 1.0);
  f.normalised = numbers(0.0, 1.0) < 0.7;
  f.rolling_resistance = numbers(0.01, 0.02);
  if (numbers(0.0, 1.0) < 0.5) f.rest_damping = numbers(5.0, 10.0);
  return rolling_example<TmeasyTyreLaw>(regime, numbers, f, tmeasy_data(f), numbers(0.04, 0.09));
}

constexpr ElementKind tmeasy_kind() {
  ElementKind kind = rolling_tyre_kind<TmeasyTyreLaw>();
  kind.about =
      "TMeasy tyre: forces from slopes, maxima and sliding values at two loads, with trail and "
      "relaxation";
  kind.keys = tmeasy_tyre_keys;
  kind.validate = tmeasy_validate;
  kind.build = tmeasy_build;
  return kind;
}

}  // namespace

constinit const ElementKind tmeasy_tyre_element = tmeasy_kind();

constinit const ExampleMaker tmeasy_tyre_examples = tmeasy_example;

}  // namespace floatframe
