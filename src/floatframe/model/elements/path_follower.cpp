// The road-wheel angle with which a vehicle follows a path, by the law of path_law.hpp: its value
//   angle = clip(delta, -largest_angle, largest_angle), and the offset e
// with the state z, whose rate is 0 while delta is clipped and it would drive delta farther beyond.
// Kept: the s of the foot point at the end of the last step, from which the next is looked for, so
// that a path may cross itself. A start looks along the whole path.
#include <fmt/format.h>

#include <memory>
#include <numbers>

#include "floatframe/model/limits.hpp"
#include "floatframe/model/linear_block.hpp"
#include "floatframe/model/path_law.hpp"

namespace floatframe {

namespace {

PathGains path_follower_gains(const PathFollowing& keys) noexcept {
  return {.course = keys.course_gain,
          .offset = keys.offset_gain,
          .preview = keys.preview,
          .yaw_rate = keys.yaw_gain,
          .integral = keys.integral_time,
          .largest_angle = keys.largest_angle};
}

Limits path_follower_limits(const PathFollowing& keys) noexcept {
  return {-keys.largest_angle, keys.largest_angle};
}

template <class S>
PathAnswer<S> path_follower_answer(const PortsOf<S>& in) noexcept {
  const auto& keys = in.template keys<PathFollowing>();
  const PathView<S> view{in.signal(0).f, in.signal(1).f, in.signal(2).f, in.signal(3).f,
                         in.signal(4).f};
  return path_answer(in.template data<DrivenPath>(), path_follower_gains(keys), keys.wheelbase,
                     in.kept[0], view, in.state(0));
}

template <class S>
void path_follower_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const Limits limits = path_follower_limits(in.template keys<PathFollowing>());
  const PathAnswer<S> answer = path_follower_answer(in);
  const double delta = value_of(answer.angle);
  const std::int64_t branch = limits.branch(in.branch, delta);
  out.force = limits.clip(branch, answer.angle);
  out.further[0] = answer.offset;
  const double flow = value_of(answer.flow);
  const bool stops = branch != Limits::between && (branch == Limits::above) == (flow > 0.0);
  if (!stops) out.state_rates[0] = answer.flow;
}

BranchSide path_follower_side(const Ports& in) noexcept {
  return path_follower_limits(in.keys<PathFollowing>())
      .side(in.branch, path_follower_answer(in).angle);
}

}  // namespace

FLOATFRAME_LAW(path_follower)

namespace {

constexpr const char* path_follower_columns[] = {"x", "y"};
constexpr const char* path_follower_circle[] = {"x", "y", "radius"};

constexpr ElementKey path_follower_signal(const char* name, const char* about, KeyMember member) {
  return {.name = name,
          .kind = KeyKind::load,
          .about = about,
          .required = true,
          .axis = ElementAxis::none,
          .member = member};
}
constexpr ElementKey path_follower_gain(const char* name, const char* about, NumberRule rule,
                                        double fallback, KeyMember member) {
  return {.name = name,
          .kind = KeyKind::number,
          .about = about,
          .rule = rule,
          .fallback = fallback,
          .member = member};
}

constexpr ElementKey path_follower_keys[] = {
    path_follower_signal("x", "of the point that follows the path, in the world",
                         described_by<&PathFollowing::x>),
    path_follower_signal("y", "the same", described_by<&PathFollowing::y>),
    path_follower_signal("vx", "its velocity along the world's x",
                         described_by<&PathFollowing::vx>),
    path_follower_signal("vy", "along y", described_by<&PathFollowing::vy>),
    path_follower_signal("yaw_rate", "of the vehicle, about the world's z",
                         described_by<&PathFollowing::yaw_rate>),
    {.name = "points",
     .kind = KeyKind::points,
     .about = "of the path in the world, joined by a cubic spline; beyond its ends it goes on "
              "straight; or ...",
     .words = path_follower_columns,
     .member = described_by<&PathFollowing::points>},
    {.name = "circle",
     .kind = KeyKind::numbers,
     .about = "... its centre and its radius, positive: driven to the left",
     .words = path_follower_circle,
     .member = described_by<&PathFollowing::circle>},
    {.name = "closed",
     .kind = KeyKind::flag,
     .about = "the points are a ring, which needs no last point at the first one",
     .member = described_by<&PathFollowing::closed>},
    {.name = "wheelbase",
     .kind = KeyKind::number,
     .about = "of the vehicle",
     .required = true,
     .rule = positive_number("m"),
     .fallback = 1.0,
     .member = described_by<&PathFollowing::wheelbase>},
    path_follower_gain("course_gain", "ω₀", positive_number("1/s"), 10.0,
                       described_by<&PathFollowing::course_gain>),
    path_follower_gain("offset_gain", "ω_e", positive_number("1/s"), 0.5,
                       described_by<&PathFollowing::offset_gain>),
    path_follower_gain("preview", "T", non_negative_number("s"), 0.2,
                       described_by<&PathFollowing::preview>),
    path_follower_gain("yaw_gain", "k_r", non_negative_number("s"), 0.08,
                       described_by<&PathFollowing::yaw_gain>),
    path_follower_gain("integral_time", "T₀", positive_number("s"), 0.05,
                       described_by<&PathFollowing::integral_time>),
    path_follower_gain("largest_angle", "limit of the angle", positive_number("rad"), 0.7,
                       described_by<&PathFollowing::largest_angle>)};

void path_follower_validate(const ElementCheck& check) {
  const MatX points = check.matrix("points"), circle = check.matrix("circle");
  const bool has_points = points.size() > 0, has_circle = circle.size() > 0;
  if (has_points == has_circle && check.wrong.empty())
    return check.error(has_points ? ErrorCode::exclusive : ErrorCode::missing, "",
                       has_points ? "found points and a circle, expected one of them"
                                  : "missing key 'points' or 'circle'");
  if (check.flag("closed") && !has_points && check.wrong.empty())
    check.error(ErrorCode::incomplete, "closed", "found without points");
  if (check.good("circle") && circle.size() == 3 && circle(2) == 0.0)
    check.error(ErrorCode::out_of_range, "circle",
                "found the radius 0, expected one that is not zero");
  if (!check.good("points") || points.cols() != 2) return;
  const Eigen::Index n = points.rows(), least = check.flag("closed") ? 3 : 2;
  if (n < least)
    return check.error(ErrorCode::wrong_count, "points",
                       fmt::format("found {}, expected at least {} points [x, y]",
                                   n == 1 ? "1 point" : "2 points", least));
  for (Eigen::Index i = check.flag("closed") ? 0 : 1; i < n; ++i)
    if ((points.row(i) - points.row(i > 0 ? i - 1 : n - 1)).norm() < 1e-9)
      return check.error(
          ErrorCode::geometry, "points",
          fmt::format("found row {} at the point before it, expected points apart", i + 1));
}

std::shared_ptr<const DrivenPath> path_follower_path(const PathFollowing& keys) {
  if (keys.points.rows() == 0)  // from its rightmost point on
    return std::make_shared<const DrivenPath>(
        DrivenPath::circle({keys.circle(0) + std::abs(keys.circle(2)), keys.circle(1)},
                           std::copysign(0.5 * std::numbers::pi, keys.circle(2)), keys.circle(2)));
  std::vector<PathPoint> points;
  for (Eigen::Index i = 0; i < keys.points.rows(); ++i)
    points.push_back({keys.points(i, 0), keys.points(i, 1)});
  return std::make_shared<const DrivenPath>(points, keys.closed);
}

bool path_follower_build(ElementBuild& build) {
  build.element.data = path_follower_path(build.keys<PathFollowing>());
  return true;
}

void path_follower_states(Element& element) {
  element.states = element.kept = 1;
  element.remembers = true;
}

void path_follower_start(const Ports& in, double* states) noexcept {
  states[0] = 0.0;
  states[1] = in.data<DrivenPath>().nearest(in.signal(0).f, in.signal(1).f);
}
void path_follower_settle(const Ports& in, double* states) noexcept {
  states[1] = in.data<DrivenPath>().nearest(in.signal(0).f, in.signal(1).f);
}
void path_follower_after_step(const Ports& in, double* states) noexcept {
  states[1] = in.data<DrivenPath>().foot(states[1], in.signal(0).f, in.signal(1).f);
}

constexpr ElementRegime path_follower_regimes[] = {
    {.name = "between", .conservative = false, .acts = false},
    {.name = "limited", .conservative = false, .acts = false},
    {.name = "circle", .conservative = false, .acts = false}};

ElementExample path_follower_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  PathFollowing f;
  const auto signal = [&](double value) {
    SignalDescription s = x.linked_signal(numbers);
    s.pieces = PiecewisePolynomial::polynomial({value - x.links.back()});
    return s;
  };
  f.x = signal(numbers(-2.0, 2.0));
  f.y = signal(numbers(-2.0, 2.0));
  f.vx = signal(numbers(15.0, 25.0));
  f.vy = signal(numbers(-2.0, 2.0));
  f.yaw_rate = signal(numbers(-0.2, 0.2));
  f.wheelbase = numbers(2.0, 3.0);
  f.largest_angle = regime == 1 ? 1e-4 : 1e3;
  f.points = MatX(6, 2);
  for (int i = 0; i < 6; ++i) f.points.row(i) << 20.0 * (i - 2), numbers(-1.0, 1.0);
  if (regime == 2) {
    f.points = MatX();
    f.circle = MatX{{0.0, 50.0, 50.0}};
  }
  x = block_example(std::move(x), std::move(f), numbers);
  const auto path = path_follower_path(*std::get_if<PathFollowing>(x.element.keys.get()));
  x.element.data = path;
  x.states[1] = path->nearest(0.0, 0.0);
  return x;
}

}  // namespace

constinit const ElementKind path_follower_element = [] {
  auto kind = block_kind<PathFollowing>(
      "the road-wheel angle with which a vehicle follows a path [rad], positive to the left; its "
      "values are `angle` and `offset`",
      path_follower_keys);
  kind.validate = path_follower_validate;
  kind.build = path_follower_build;
  kind.states = path_follower_states;
  kind.values = [](const ElementKeys&) {
    return std::vector<ElementValue>{{"angle", "-"}, {"offset", "-"}};
  };
  kind.start = path_follower_start;
  kind.settle = path_follower_settle;
  kind.after_step = path_follower_after_step;
  kind.dual = path_follower_law<Dual>;
  kind.side = path_follower_side;
  kind.resting_branch = Limits::between;
  kind.regimes = path_follower_regimes;
  return kind;
}();

constinit const ExampleMaker path_follower_examples = path_follower_example;

}  // namespace floatframe
