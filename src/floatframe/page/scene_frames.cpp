#include "floatframe/page/scene_frames.hpp"

#include <algorithm>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/history/recorded_motion.hpp"
#include "floatframe/history/state_history.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/model/gauge.hpp"

namespace floatframe {
namespace {

std::size_t mode_count(const Model& model) {
  std::size_t n = 0;
  for (const Body& b : model.bodies) n += static_cast<std::size_t>(b.modes());
  return n;
}

/// Pose of a body in the design configuration.
void set_design_pose(const Body& body, double* pose) {
  const Eigen::Quaterniond q(body.X_WB.R);
  for (int k = 0; k < 3; ++k) pose[k] = body.X_WB.p[k];
  for (int k = 0; k < 4; ++k) pose[3 + k] = q.coeffs()[k];
}

/// Floats have seven digits: a scene far from the origin of the world gets a local origin.
void set_origin(SceneFrames& frames) {
  constexpr double far = 1000.0;  // [m], where the last digit of a float is 0.1 mm
  Vec3 first = Vec3::Zero();
  for (std::size_t b = 0; b < frames.known.size(); ++b)
    if (frames.known[b]) {
      first = Eigen::Map<const Vec3>(frames.pose(0, b));
      break;
    }
  if (!(first.norm() > far)) return;
  frames.origin = (first / far).array().round().matrix() * far;
  for (std::size_t i = 0; i < frames.poses.size(); i += 7)
    for (std::size_t k = 0; k < 3; ++k)
      frames.poses[i + k] -= frames.origin[static_cast<Eigen::Index>(k)];
}

}  // namespace

SceneFrames scene_frames(const Model& model, const StateHistory& history) {
  const HistoryHeader& h = history.header();
  bool same = h.bodies.size() == model.bodies.size();
  for (std::size_t b = 0; same && b < h.bodies.size(); ++b)
    same = h.bodies[b].name == model.bodies[b].name &&
           h.bodies[b].modes.size() == static_cast<std::size_t>(model.bodies[b].modes());
  if (!same)
    throw InputError(ErrorCode::mismatch, {history.name(), 0, 0},
                     "its states are not of this model");
  SceneFrames out;
  for (const HistoryBody& b : h.bodies) out.known.push_back(b.pose >= 0);
  const std::size_t modes = mode_count(model), instants = history.instants();
  if (instants == 0) return out;
  const std::size_t most = std::max<std::size_t>(
      2, most_numbers_of_frames / std::max<std::size_t>(1, 7 * h.bodies.size() + modes));
  const std::size_t count = std::min({instants, most, most_frames});
  out.whole = count == instants;
  out.poses.resize(7 * count * h.bodies.size());
  std::vector<double> row(h.columns);
  for (std::size_t f = 0; f < count; ++f) {
    out.instants.push_back(count == 1 ? 0 : f * (instants - 1) / (count - 1));
    history.instant(out.instants.back(), row);
    out.time.push_back(row[0]);
    for (std::size_t b = 0; b < h.bodies.size(); ++b) {
      double* pose = out.pose(f, b);
      set_design_pose(model.bodies[b], pose);
      const HistoryBody& body = h.bodies[b];
      for (std::size_t m = 0; m < body.modes.size(); ++m)
        out.amplitudes.push_back(
            body.amplitudes >= 0 ? row[static_cast<std::size_t>(body.amplitudes) + m] : 0.0);
      if (body.pose < 0) continue;
      const double* x = row.data() + body.pose;
      for (const double value : {x[0], x[1], x[2], x[4], x[5], x[6], x[3]}) *pose++ = value;
    }
  }
  set_origin(out);
  return out;
}

SceneFrames scene_frames(const Model& model, const SystemState& state) {
  SceneFrames out;
  out.time = {state.time};
  out.known.assign(model.bodies.size(), 1);
  out.poses.resize(7 * model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    double* pose = out.pose(0, b);
    set_design_pose(model.bodies[b], pose);
    const bool given = b < state.bodies.size();
    for (int m = 0; m < model.bodies[b].modes(); ++m)
      out.amplitudes.push_back(
          given && m < state.bodies[b].amplitudes.size() ? state.bodies[b].amplitudes[m] : 0.0);
    if (!given) continue;
    const Vec3& p = state.bodies[b].position;
    const Eigen::Vector4d& q = state.bodies[b].orientation;
    for (const double value : {p[0], p[1], p[2], q[1], q[2], q[3], q[0]}) *pose++ = value;
  }
  set_origin(out);
  return out;
}

void add_replayed_values(const Model& model, const StateHistory& history,
                         const SimulationDescription& options, SceneFrames& frames) {
  std::vector<int> first;
  int columns = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto& stress = model.bodies[b].data->stress;
    const bool has = frames.instants.size() > 1 && stress && stress->loads.size() > 0 &&
                     b < frames.known.size() && frames.known[b] != 0;
    first.push_back(has ? columns : -1);
    if (has) columns += body_load_cases;
  }
  EffortCollector efforts(model);
  const bool collects = history.header().complete() && !efforts.empty();
  if (frames.instants.empty() || (columns == 0 && !collects)) return;
  try {
    RecordedMotion motion(history, model, options);
    std::vector<double> loads;
    for (const std::size_t k : frames.instants) {
      const SystemMotion& view = motion.without_outputs(k, columns > 0);
      if (collects) efforts.add(view);
      for (std::size_t b = 0; b < first.size(); ++b) {
        if (first[b] < 0) continue;
        const BodyLoadCoefficients c = body_load_coefficients(view, static_cast<int>(b));
        loads.insert(loads.end(), c.begin(), c.end());
      }
    }
    if (collects) frames.efforts = efforts.take();
    if (columns == 0) return;
    frames.loads = std::move(loads);
    frames.first_load = std::move(first);
  } catch (const RunError&) {
    // The page shows the stress of the amplitudes only, and no arrows.
  } catch (const InputError&) {
    // The same, of states that cannot be replayed.
  }
}

}  // namespace floatframe
