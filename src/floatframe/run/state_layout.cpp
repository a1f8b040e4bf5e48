#include "floatframe/run/state_layout.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/suggest.hpp"

namespace floatframe {
namespace {

/// Default limit of states of a run in which every output instant could be a state.
constexpr long most_states = 20000;

void append_range(std::vector<int>& out, int first, int count) {
  for (int k = 0; k < count; ++k) out.push_back(first + k);
}

int column_among(const std::vector<int>& kept, int coordinate) {
  return static_cast<int>(std::lower_bound(kept.begin(), kept.end(), coordinate) - kept.begin());
}

}  // namespace

const StateLayout::Group* StateLayout::find(const std::string& name) const noexcept {
  for (const Group& g : groups)
    if (g.name == name) return &g;
  return nullptr;
}

long states_every(const RecordDescription& record, long rows) noexcept {
  return record.every > 0 ? record.every : std::max(1L, (rows + most_states - 1) / most_states);
}

StateSampler::StateSampler(const Formulation& formulation, const RecordDescription& record,
                           std::vector<HealthColumn> health)
    : f_(formulation) {
  keep_bodies(record);
  find_coordinates();
  layout_.health = std::move(health);
  place_columns(record);
}

/// The named bodies, and in joint coordinates also all between them and the ground.
void StateSampler::keep_bodies(const RecordDescription& record) {
  const std::vector<Body>& bodies = f_.model().bodies;
  kept_.assign(bodies.size(), record.bodies.empty() ? 1 : 0);
  for (const std::string& name : record.bodies) {
    int i = 0;
    while (i < static_cast<int>(bodies.size()) && bodies[i].name != name) ++i;
    if (i == static_cast<int>(bodies.size())) {
      std::vector<std::string> known;
      for (const Body& b : bodies) known.push_back(b.name);
      throw InputError(ErrorCode::not_found, "simulation.record.states.bodies: unknown body '" +
                                                 name + "'" + did_you_mean(name, known));
    }
    for (; i >= 0; i = f_.body_coordinates(i).parent) kept_[i] = 1;
  }
}

void StateSampler::find_coordinates() {
  StateLayout& l = layout_;
  l.configurations = f_.configurations();
  l.velocities = f_.velocities();
  for (int i = 0; i < static_cast<int>(kept_.size()); ++i) {
    if (!kept_[i]) continue;
    const BodyCoordinates c = f_.body_coordinates(i);
    append_range(l.q, c.q, c.q_count);
    append_range(l.v, c.v, c.v_count);
  }
  std::sort(l.q.begin(), l.q.end());
  std::sort(l.v.begin(), l.v.end());
  for (const int k : l.v) l.owners.push_back(f_.coordinate_owner(k));
}

void StateSampler::place_columns(const RecordDescription& record) {
  StateLayout& l = layout_;
  const auto group = [&](const char* name, std::size_t count) {
    l.groups.push_back({name, l.columns, static_cast<int>(count)});
    l.columns += static_cast<int>(count);
    return l.groups.back().first;
  };
  group("time", 1);
  const int q = group("q", l.q.size()), v = group("v", l.v.size());
  if (record.accelerations) group("accelerations", l.v.size());
  group("spring_angles", f_.spring_angles().size());
  if (f_.element_states().count() > 0) group("element_states", f_.element_states().count());
  group("inputs", f_.inputs().size());
  const auto bodies = static_cast<std::size_t>(std::count(kept_.begin(), kept_.end(), 1));
  int pose = group("poses", 7 * bodies);
  for (int i = 0; i < static_cast<int>(kept_.size()); ++i) {
    StateLayout::BodyColumns c;
    if (kept_[i]) {
      c.pose = pose;
      pose += 7;
      if (f_.model().bodies[i].modes() > 0) {
        const BodyCoordinates in = f_.body_coordinates(i);
        c.amplitudes = q + column_among(l.q, in.y);
        c.rates = v + column_among(l.v, in.yd);
      }
    }
    l.bodies.push_back(c);
  }
  if (!l.health.empty()) group(health_group, l.health.size());
}

void StateSampler::sample(const State& state, double* row) const noexcept {
  const StateLayout& l = layout_;
  *row++ = state.t;
  for (const int k : l.q) *row++ = state.q[k];
  for (const int k : l.v) *row++ = state.v[k];
  if (l.groups[3].name[0] == 'a')
    for (const int k : l.v) *row++ = state.a[k];
  for (const double x : f_.spring_angles()) *row++ = x;
  for (const double x : state.z) *row++ = x;
  for (const double x : f_.inputs()) *row++ = x;
  const SystemMotion& motion = f_.motion();
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (!kept_[i]) continue;
    const BodyKinematics& b = motion.bodies[i];
    const Eigen::Quaterniond turn(b.R_WB);
    const Eigen::Quaterniond unit = turn.normalized();
    for (int k = 0; k < 3; ++k) *row++ = b.p_WB[k];
    for (const double x : {unit.w(), unit.x(), unit.y(), unit.z()}) *row++ = x;
  }
}

}  // namespace floatframe
