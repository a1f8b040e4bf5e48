#include "floatframe/simulation/turn_watch.hpp"

#include <fmt/format.h>

namespace floatframe {

TurnWatch::TurnWatch(const Model& model, double step) : model_(model), step_(step) {
  for (std::size_t k = 0; k < model.forces.size(); ++k) {
    const Force& force = model.forces[k];
    const bool counts = force.rotational;
    if (!counts && !ends_at_half_turn(force)) continue;
    Watched x;
    x.force = static_cast<int>(k);
    x.counts = counts;
    watched_.push_back(x);
  }
}

void TurnWatch::warn(std::vector<RangeWarning>& out) const {
  const Watched* first = nullptr;
  int others = -1;
  for (const Watched& x : watched_) {
    if (x.first < 0.0) continue;
    ++others;
    if (first == nullptr || x.first < first->first) first = &x;
  }
  if (first == nullptr) return;
  const Force& force = model_.forces[first->force];
  const std::string who = fmt::format("{} '{}'{}", force_type_name(force.type), force.name,
                                      others > 0 ? fmt::format(" (and {} more)", others) : "");
  if (first->counts) {
    out.push_back({RangeLimit::half_turn,
                   fmt::format("{} turns by more than half a turn in one step of {:g} s at t = "
                               "{:.4g} s ({:.3g} rad at most) and so loses count of its turns; "
                               "take a step of at most {:.2g} s",
                               who, step_, first->first, first->most,
                               0.5 * step_ * std::numbers::pi / first->most)});
    return;
  }
  out.push_back(
      {RangeLimit::half_turn,
       fmt::format("{} has turned past half a turn at t = {:.4g} s: the rotation vector that its "
                   "laws are of jumps there to the other side, and its moments with it; what turns "
                   "further needs a joint_spring on a revolute joint, which counts turns, or, for "
                   "dampers alone, rotation_rate: angular_velocity",
                   who, first->first)});
}

}  // namespace floatframe
