// Cam: the coordinate of a follower is the lift s of the coordinate x of its cam,
//   q_follower - s(q_cam - phase) = 0,                                                         (1)
// one row of two parts: the coordinate of the follower (coupled_coordinates.hpp), and `cam_angle`
// or `cam_displacement` with the lift (cam_profile.hpp) and its exact derivatives. Its force is
// that on the follower; on the cam it is -s' times that. The row is scaled to lengths as that of a
// coupling with the factors 1 and max |s'|.
// A contact that only pushes is lost where the force changes its sign: the row holds on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/cam_profile.hpp"
#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/lift_checks.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(cam)

namespace {

constexpr const char* cam_segment_columns[] = {"to", "rise"};
constexpr const char* cam_lift_columns[] = {"x", "lift"};
constexpr const char* cam_variable[] = {"x"};

constexpr ElementKey cam_keys[] = {
    coordinate_key("follower", "of the follower", described_by<&Cam::follower>,
                   ElementAxis::coordinate),
    coordinate_key("cam", "of the cam, x", described_by<&Cam::cam>, ElementAxis::coordinate),
    {.name = "segments",
     .kind = KeyKind::points,
     .about =
         "the lift as rises one after the other, each to an x, from 0 on; a rise of 0 is a dwell",
     .words = cam_segment_columns,
     .member = described_by<&Cam::segments>},
    {.name = "law",
     .kind = KeyKind::word,
     .about = "of the rises",
     .words = cam_laws,
     .fallback = 1,
     .member = described_by<&Cam::law>},
    {.name = "points",
     .kind = KeyKind::points,
     .about = "instead of them points of the lift, joined by a cubic spline",
     .words = cam_lift_columns,
     .member = described_by<&Cam::points>},
    {.name = "formula",
     .kind = KeyKind::shape,
     .about = "instead of them the lift by a formula",
     .words = cam_variable,
     .member = described_by<&Cam::formula>},
    {.name = "phase",
     .kind = KeyKind::number,
     .about = "the coordinate of the cam at which x is 0",
     .fallback = 0.0,
     .member = described_by<&Cam::phase>}};

/// x ascends along the rows of a key, from `above` on.
bool cam_ascends(const ElementCheck& check, const char* key, const MatX& rows, double above) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (rows(i, 0) > above) {
      above = rows(i, 0);
      continue;
    }
    check.error(ErrorCode::wrong_value, key,
                fmt::format("found x = {} in row {} after {}, expected ascending x",
                            number_text(rows(i, 0)), i + 1, number_text(above)));
    return false;
  }
  return true;
}

/// A profile that fills a turn ends where it begins.
void cam_closes(const ElementCheck& check, const char* key, double first, double last,
                double range) {
  if (std::abs(last - first) <= 1e-9 * range) return;
  check.error(ErrorCode::contradiction, key,
              fmt::format("found the lift {} at the end of the turn, expected {} as at its "
                          "beginning",
                          number_text(last), number_text(first)));
}

void cam_segments_validate(const ElementCheck& check, const MatX& rows, bool turns) {
  if (!cam_ascends(check, "segments", rows, 0.0)) return;
  double lift = 0.0, range = 0.0;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    lift += rows(i, 1);
    range += std::abs(rows(i, 1));
  }
  if (turns && cam_fills_turn(0.0, rows(rows.rows() - 1, 0)))
    cam_closes(check, "segments", 0.0, lift, range);
}

void cam_points_validate(const ElementCheck& check, const MatX& rows, bool turns) {
  const Eigen::Index n = rows.rows();
  if (n < 3)
    return check.error(ErrorCode::wrong_count, "points",
                       fmt::format("found {}, expected at least 3 points [x, lift]",
                                   n == 1 ? "1 point" : "2 points"));
  if (!cam_ascends(check, "points", rows, -std::numeric_limits<double>::infinity())) return;
  if (turns && cam_fills_turn(rows(0, 0), rows(n - 1, 0)))
    cam_closes(check, "points", rows(0, 1), rows(n - 1, 1),
               rows.col(1).maxCoeff() - rows.col(1).minCoeff());
}

bool cam_turns(JointType type, const CoordinateTerm& term) {
  const int k = coupled_component(type, term.coordinate, ElementAxis::coordinate);
  return k >= 0 && coordinate_axis(type, Vec3::UnitX(), k)->turns;
}

void cam_validate(const ElementCheck& check) {
  validate_coordinates(check);
  const bool segments = check.given("segments"), points = check.given("points");
  const int given = segments + points + check.has("formula");
  if (given == 0 && check.wrong.empty())
    check.error(ErrorCode::missing, "", "missing key 'segments', 'points' or 'formula'");
  if (given > 1)
    check.error(ErrorCode::exclusive, "",
                "found several lifts, expected one of segments, points and formula");
  if (check.description().origin.keys.contains("law") && !segments)
    check.error(ErrorCode::incomplete, "law", "found without 'segments', whose rises it is of");
  const auto type =
      check.good("cam") ? check.joint_type(check.coordinate("cam").joint) : std::nullopt;
  const bool turns = type && cam_turns(*type, check.coordinate("cam"));
  const MatX rises = check.matrix("segments"), lifts = check.matrix("points");
  if (check.good("segments") && rises.rows() > 0) cam_segments_validate(check, rises, turns);
  if (check.good("points") && lifts.rows() > 0) cam_points_validate(check, lifts, turns);
}

bool cam_build(ElementBuild& build) {
  if (!connect_coupled(build, "follower") || !connect_coupled(build, "cam")) return false;
  const Cam& keys = build.keys<Cam>();
  const CoordinatePort& port = build.element.coordinates[1];
  CamProfile profile = cam_profile(keys, port.counted);
  const Joint* joint = build.joint(keys.cam.joint);
  const double start = joint->position.empty() ? 0.0 : joint->position[port.component];
  if (const auto jump = lift_corners(profile, port.counted, keys.cam.factor * start).jump) {
    build.error(ErrorCode::contradiction,
                fmt::format("found a jump by {:.6g} at x = {:.9g} in '{}', expected a lift without "
                            "jumps: a follower cannot jump",
                            jump->size, jump->at, profile.formula->text));
    return false;
  }
  keep_from_ends(profile, keys.cam.factor * start - profile.phase);
  build.element.data = std::make_shared<CamProfile>(std::move(profile));
  return true;
}

void cam_rows(const Model& model, const Element& element, ConstraintPart part,
              std::vector<ConstraintPart>& parts) {
  const Cam& keys = std::get<Cam>(*element.keys);
  const CamProfile& profile = data_of<CamProfile>(element);
  const double factors[] = {keys.follower.factor, profile.steepest()};
  append_sum(model, element, factors, nullptr, part, parts);
  ConstraintPart& cam = parts.back();
  cam.type = cam.type == ConstraintType::coordinate_angle ? ConstraintType::cam_angle
                                                          : ConstraintType::cam_displacement;
  cam.c = keys.cam.factor;
  cam.lift = &profile;
}

ElementExample cam_example(std::size_t, ExampleNumbers& numbers) {
  Cam keys{.follower = {"a"}, .cam = {"b"}};
  keys.segments = MatX{{2.0, numbers(0.1, 0.3)}, {5.0, -0.1}};
  return coupled_example(keys, 2, numbers);
}

/// What the follower touches, as drawn: of a cam that turns by q the place at -q from it.
std::vector<Stroke> cam_strokes(const Model& model, const Element& element) {
  const CamProfile& profile = data_of<CamProfile>(element);
  Strokes out(model, element);
  const int cam = out.child(1);
  const Vec3 z = out.axis(1), up = out.in(cam, out.world_axis(0));
  const bool turns = element.coordinates[1].counted;
  const double turn = 2.0 * std::numbers::pi, reach = turns ? 0.5 * turn : out.size(cam);
  constexpr int count = 180;
  std::vector<double> lifts;
  for (int k = 0; k <= count; ++k) lifts.push_back(profile(reach * (1.0 - 2.0 * k / count)).f);
  const auto [low, high] = std::ranges::minmax(lifts);
  const Vec3 across = out.in(cam, out.across(1, 0));
  const double distance = across.norm(), at_start = profile(0.0).f;
  const double base = std::max(distance - at_start, 2.0 * (high - low) - low);
  const Vec3 e = distance > 1e-9                      ? Vec3(across / distance)
                 : up.cross(z).cross(z).norm() > 1e-6 ? Vec3((up - up.dot(z) * z).normalized())
                                                      : Vec3(frame_with_z(z).col(0));
  std::vector<Vec3> points;
  for (int k = 0; k <= count; ++k) {
    const double x = reach * (2.0 * k / count - 1.0), lift = lifts[k];
    if (turns)
      points.push_back((base + lift) * (std::cos(x) * e + std::sin(x) * z.cross(e)));
    else
      points.push_back(x * z + (lift - at_start) * up);
  }
  out.add(cam, std::move(points));
  return out.take();
}

}  // namespace

constinit const ElementKind cam_element = {
    .about =
        "the coordinate of a follower is the lift of a cam, a function of its coordinate. A "
        "profile of a cam that turns which fills a turn repeats. The force is that on the "
        "follower: where it changes its sign, a contact that only pushes would be lost",
    .keys = cam_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(Cam()); },
    .validate = cam_validate,
    .build = cam_build,
    .rows = cam_rows,
    .picture = picture_of_coupling,
    .strokes = cam_strokes,
    .regimes = holding_regimes};

constinit const ExampleMaker cam_examples = cam_example;

}  // namespace floatframe
