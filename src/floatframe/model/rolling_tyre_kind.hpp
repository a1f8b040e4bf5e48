#pragma once
// What the kinds of rolling tyres share beside their law (rolling_tyre.hpp): keys, states, their
// start, branches, notes, picture, and examples for the tests. Load time, but for `side`.
//
// States and kept numbers: u, v; and behind them, of the search for an equilibrium, where the wheel
// began: its contact point, and its angle about the axis from e_z to e_x. At rest
//   u = -(P - P_0).e_x + r_e (angle - angle_0),  v = -(P - P_0).e_y
#include "floatframe/description/rules.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/rolling_tyre.hpp"

namespace floatframe {

namespace rolling {
inline constexpr const char* sides[] = {"left", "right"};
inline constexpr const char* contacts[] = {"point", "patch"};
}  // namespace rolling

/// The first keys of a rolling tyre with the struct L: where it is. They hold its only signal.
template <class L>
constexpr std::array<ElementKey, 4> rolling_places() {
  return {{{.name = "body",
            .kind = KeyKind::own_place,
            .about = "the wheel centre",
            .required = true,
            .member = member<L, &RollingTyre::centre>},
           {.name = "axis",
            .kind = KeyKind::direction,
            .about = "the wheel axis, to the left: forwards is `axis` x up",
            .vector = {0.0, 1.0, 0.0},
            .axial = true,
            .member = member<L, &RollingTyre::axis>},
           {.name = "road",
            .kind = KeyKind::road,
            .about = "what it rolls on",
            .required = true,
            .member = member<L, &RollingTyre::road>},
           {.name = "lift",
            .kind = KeyKind::target,
            .about = "height of a plate under this tyre, which lifts its road",
            .member = member<L, &RollingTyre::lift>}}};
}

constexpr ElementKey rolling_number(const char* name, const char* about, NumberRule rule,
                                    KeyMember member, double fallback = no_number) {
  return {.name = name,
          .kind = KeyKind::number,
          .about = about,
          .rule = rule,
          .fallback = fallback,
          .member = member};
}
constexpr ElementKey required_rolling_number(const char* name, const char* about, NumberRule rule,
                                             KeyMember member) {
  ElementKey key = rolling_number(name, about, rule, member, 1.0);
  key.required = true;
  return key;
}

/// Its last keys.
template <class L>
constexpr std::array<ElementKey, 9> rolling_options() {
  return {{{.name = "spinning",
            .kind = KeyKind::flag,
            .about = "the body turns with the wheel; `false`: it carries a wheel that rolls freely",
            .fallback = 1.0,
            .member = member<L, &RollingTyre::spinning>},
           {.name = "side",
            .kind = KeyKind::word,
            .about = "of the vehicle: data of the other side are mirrored",
            .words = rolling::sides,
            .member = member<L, &RollingTyre::side>},
           {.name = "contact",
            .kind = KeyKind::word,
            .about = "with the road at one point, or with the mean plane of four",
            .words = rolling::contacts,
            .member = member<L, &RollingTyre::contact>},
           rolling_number("patch_length", "distance of the points along; without it 0.2 radii",
                          positive_number("m"), member<L, &RollingTyre::patch_length>),
           rolling_number("patch_width", "distance of the points across; without it 0.3 radii",
                          positive_number("m"), member<L, &RollingTyre::patch_width>),
           rolling_number("damping", "vertical", rules::tyre_damping,
                          member<L, &RollingTyre::damping>, 0.0),
           {.name = "relaxation",
            .kind = KeyKind::flag,
            .about = "slips follow the motion along a length, and the tyre holds at rest; "
                     "`false`: at once, and it creeps",
            .fallback = 1.0,
            .member = member<L, &RollingTyre::relaxation>},
           rolling_number("rest_damping",
                          "of slip at rest; without it 3 ms times the stiffness at rest",
                          non_negative_number("N s/m"), member<L, &RollingTyre::rest_damping>),
           rolling_number("damping_speed", "at which `rest_damping` has faded out",
                          positive_number("m/s"), member<L, &RollingTyre::damping_speed>, 2.5)}};
}

/// All keys of a rolling tyre.
template <class L, std::size_t n>
constexpr auto rolling_keys(const ElementKey (&own)[n]) {
  constexpr auto first = rolling_places<L>();
  constexpr auto last = rolling_options<L>();
  std::array<ElementKey, first.size() + n + last.size()> all{};
  auto to = std::copy(first.begin(), first.end(), all.begin());
  to = std::copy(own, own + n, to);
  std::copy(last.begin(), last.end(), to);
  return all;
}

/// Checks of the keys in combination.
void validate_rolling_tyre(const ElementCheck& check);
/// Axis, road and marker; the kind sets `element.data`.
bool build_rolling_tyre(ElementBuild& build, RollingTyre& keys);
/// The tyre of the other side.
void mirror_rolling_tyre(RollingTyre& keys, const Placement& x);
Picture picture_of_rolling_tyre(const Element& element, const RollingTyre& keys, double radius);
/// A wheel far above its road or deep in it, or one that lies.
void note_rolling_tyre(const Element& element, const RollingTyre& keys, double radius,
                       const SystemMotion& start, std::vector<std::string>& notes);
/// Of a wheel beyond its road; else empty.
std::string complaint_of_rolling_tyre(const Ports& in);
/// From the normal of its contact forwards [rad].
double angle_of_wheel(const Ports& in, const RollingTyre& keys,
                      const RollingContact<double>& c) noexcept;

template <class Law>
BranchSide rolling_side(const Ports& in) noexcept {
  const auto at = [&](std::int64_t branch) noexcept {
    Ports there = in;
    there.branch = branch;
    const RollingContact<double> c = contact_of_tyre<Law>(there);
    return std::pair{rolling_load<Law>(there, c), c.x};
  };
  const PiecewisePolynomial& road = in.model.roads[in.element.road].pieces;
  const bool pieces = in.keys<typename Law::Keys>().contact == TyreContact::point;
  const auto branch_of = [&](std::size_t stretch) noexcept {
    const auto [l, x] = at(RollingBranch::of(stretch, false));
    return RollingBranch::of(stretch, l.spring > 0.0 && l.load > 0.0);
  };
  if (in.branch == free_branch) {
    const double x = contact_of_tyre<Law>(in).x;
    return {-1.0, branch_of(pieces ? road.stretch_index(x) : 0)};
  }
  const RollingBranch held{in.branch};
  const auto [l, x] = at(in.branch);
  // Forces expressed as depths.
  const double stiffness = l.stiffness > 0.0 ? l.stiffness : 1.0, push = l.load / stiffness;
  const double touch = held.touches() ? -push : std::min(l.spring / stiffness, push);
  if (pieces) {
    const StretchSide s = stretch_side(road, held.stretch(), x);
    if (s.beyond > touch) return {s.beyond, branch_of(s.next)};
  }
  return {touch, RollingBranch::of(held.stretch(), !held.touches())};
}

/// What the slips of a wheel that touches follow from; else nothing.
template <class Law>
struct RollingRest {
  RollingContact<double> c;
  RollingLoad<double> l;
  TyreLengths<double> lengths;
  double r_e = 0.0;
  bool touches = false;
  explicit RollingRest(const Ports& in) noexcept
      : c(contact_of_tyre<Law>(in)), l(rolling_load<Law>(in, c)) {
    touches = l.touches && l.load > 0.0;
    if (!touches) return;
    const auto& keys = in.keys<typename Law::Keys>();
    const auto& data = in.data<typename Law::Data>();
    lengths = limited_lengths<Law>(keys, data, l.load, c.camber, c.friction);
    r_e = Law::effective_radius(keys, data, l.load, l.deflection, c.spin);
  }
};

/// Slips of the steady motion at a start; none of a wheel that hardly rolls.
template <class Law>
void rolling_start(const Ports& in, double* states) noexcept {
  constexpr double rolls = 0.01;  // [m/s]
  if (in.element.states == 0) return;
  const RollingRest<Law> at(in);
  if (!at.c.found) return;
  const RollingTyre& keys = in.keys<typename Law::Keys>();
  double* kept = states + rolling::states;
  Eigen::Map<Vec3> place(kept);
  place = at.c.point;
  kept[rolling::angle] = angle_of_wheel(in, keys, at.c);
  const double speed = std::abs(at.c.v_cx);
  kept[rolling::rolled] = speed < rolls ? 0.0 : 1.0;
  if (!at.touches || speed < rolls) return;
  const auto within = [](double x, double limit) { return std::clamp(x, -limit, limit); };
  const TyreLengths<double>& l = at.lengths;
  const double v_sx = keys.spinning ? at.c.v_cx - at.c.spin * at.r_e : 0.0;
  states[0] = within(-v_sx * l.sigma_x / speed, Law::falls ? l.sigma_x : l.limit_x);
  states[1] = within(-at.c.v_cy * l.sigma_y / speed, Law::falls ? l.sigma_y : l.limit_y);
}

/// The slips of the place that an equilibrium has been found at.
template <class Law>
void rolling_settle(const Ports& in, double* states) noexcept {
  if (in.element.states > 0 && states[rolling::states + rolling::rolled] != 0.0)
    rolling_start<Law>(in, states);
}

template <class Law>
Deflection rolling_deflection(const Ports& in, int state) noexcept {
  const RollingRest<Law> at(in);
  if (!at.touches) return {};
  const RollingTyre& keys = in.keys<typename Law::Keys>();
  const double* kept = in.states + rolling::states;
  const Vec3 moved = at.c.point - Vec3(kept[0], kept[1], kept[2]);
  if (state == 1) return {-moved.dot(at.c.e_y), at.lengths.limit_y};
  if (!keys.spinning) return {};
  const double turned = angle_of_wheel(in, keys, at.c) - kept[rolling::angle];
  return {-moved.dot(at.c.e_x) + at.r_e * turned, at.lengths.limit_x,
          2.0 * std::numbers::pi * at.r_e};
}

template <class Law>
const typename Law::Keys& keys_of_tyre(const Element& element) noexcept {
  return *std::get_if<typename Law::Keys>(element.keys.get());
}
template <class Law>
double radius_of_tyre(const Element& element) noexcept {
  return Law::radius(keys_of_tyre<Law>(element), data_of<typename Law::Data>(element));
}

/// The regimes of `rolling_example`, in the order of the list below.
inline constexpr const char* rolling_leaves_out =
    "what the forces in the road have of the load and of the place, moments, the turning of axes";
enum class RollingRegime {
  rolling,
  on_slope,
  on_bump,
  cambered,
  patch,
  carried,
  backwards,
  slides,
  rests,
  other_side,
  direct,
  airborne,
  lying
};
inline constexpr ElementRegime rolling_regime_list[] = {
    {.name = "rolling", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "on_slope", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "on_bump", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "cambered", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "patch", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "carried", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "backwards", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "slides", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "rests", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "other_side", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "direct", .rows_leave_out = rolling_leaves_out, .conservative = false},
    {.name = "airborne", .acts = false},
    {.name = "lying", .acts = false, .regular = false}};

/// All but `about`, `keys`, `build` and what belongs to tests.
template <class Law>
constexpr ElementKind rolling_tyre_kind() {
  using Keys = typename Law::Keys;
  ElementKind kind{};
  kind.energy = EnergyCategory::tyres;
  kind.blank = [] { return ElementKeys(Keys()); };
  kind.validate = validate_rolling_tyre;
  kind.mirror = [](ElementDescription& element, const Placement& x) {
    mirror_rolling_tyre(std::get<Keys>(element.kind), x);
  };
  kind.states = [](Element& element) {
    if (!std::get<Keys>(*element.keys).relaxation) return;
    element.states = rolling::states;
    element.kept = rolling::kept;
    element.rates_first = true;
  };
  kind.values = rolling_values;
  kind.start = rolling_start<Law>;
  kind.complaint = complaint_of_rolling_tyre;
  kind.settle = rolling_settle<Law>;
  kind.deflection = rolling_deflection<Law>;
  kind.rolls = true;
  kind.lifted = "road";
  kind.dual = rolling_tyre_law<Law, Dual>;
  kind.side = rolling_side<Law>;
  kind.regimes = rolling_regime_list;
  kind.picture = [](const Element& element) {
    return picture_of_rolling_tyre(element, keys_of_tyre<Law>(element),
                                   radius_of_tyre<Law>(element));
  };
  kind.note = [](const Element& element, const SystemMotion& start,
                 std::vector<std::string>& notes) {
    note_rolling_tyre(element, keys_of_tyre<Law>(element), radius_of_tyre<Law>(element), start,
                      notes);
  };
  return kind;
}

/// A number of either sign that is not near zero.
double on_either_side(ExampleNumbers& numbers, double least, double most);
/// Where a wheel of this radius is in a regime, how it moves, and its road; sets the keys of
/// RollingTyre. `depth`: the deflection [m].
MarkerState rolling_example_wheel(RollingRegime regime, double radius, double depth,
                                  ExampleNumbers& numbers, ElementExample& x, RollingTyre& keys);

/// A random example; `keys` with their own members set.
template <class Law>
ElementExample rolling_example(std::size_t number, ExampleNumbers& numbers, typename Law::Keys keys,
                               const typename Law::Data& data, double depth) {
  const auto regime = static_cast<RollingRegime>(number);
  ElementExample x;
  const double radius = Law::radius(keys, data);
  x.markers = {rolling_example_wheel(regime, radius, depth, numbers, x, keys)};
  x.keys(keys);
  x.element.data = std::make_shared<const typename Law::Data>(data);
  x.element.road = 0;
  if (!keys.relaxation) return x;
  const double load = Law::load(keys, data, depth, 0.0, 0.0);
  const TyreLengths<double> l = limited_lengths<Law>(keys, data, load, 0.0, 1.0);
  const bool slides = regime == RollingRegime::slides;
  // Against the slip, so that the deflection grows where it slides.
  const auto part = [&] {
    return slides ? numbers(-1.1, -0.9) : on_either_side(numbers, 0.05, 0.3);
  };
  x.states = {part() * l.limit_x, part() * l.limit_y};
  for (int i = 0; i < rolling::kept; ++i) x.states.push_back(0.0);
  x.state_weight = numbers(0.5, 200.0);
  return x;
}

}  // namespace floatframe
