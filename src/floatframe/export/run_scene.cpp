#include "floatframe/export/run_scene.hpp"

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/simulation_option.hpp"
#include "floatframe/export/export_selection.hpp"
#include "floatframe/export/motion_grid.hpp"
#include "floatframe/history/new_channels.hpp"
#include "floatframe/history/recorded_motion.hpp"

namespace floatframe {
namespace {

/// The options of the run, including the formulation of its states.
SimulationDescription options_of_run(const HistoryHeader& h, SimulationDescription o) {
  set_simulation_option(o, "coordinates", h.coordinates);
  set_simulation_option(o, "inertia", h.inertia);
  o.step = h.step;
  o.duration = h.duration;
  o.output_interval = h.output_interval;
  return o;
}

const StateHistory& checked(const StateHistory& history, const Model& model) {
  require_model(history, model);
  return history;
}

}  // namespace

struct RunScene::Parts {
  Parts(const Model& model, StateHistory given)
      : history(std::move(given)),
        options(options_of_run(checked(history, model).header(), model.simulation)),
        motion(history, model, options),
        grid({&model, selected_bodies(history, model, {}), 1}),
        row(history.header().columns) {
    if (history.instants() == 0)
      throw InputError(ErrorCode::missing, SourceMark{history.name(), 0, 0},
                       "found no instant, expected the states of a run");
  }

  StateHistory history;
  SimulationDescription options;
  RecordedMotion motion;
  MotionGrid grid;
  std::vector<double> row;

  double time(std::size_t k) {
    history.instant(k, row);
    return row[0];
  }
};

RunScene::RunScene(const Model& model, StateHistory history)
    : parts_(std::make_unique<Parts>(model, std::move(history))) {}
RunScene::~RunScene() = default;

std::size_t RunScene::instants() const noexcept { return parts_->history.instants(); }

std::size_t RunScene::nearest(double time) const {
  // The first instant that is not before `time`, by bisection.
  std::size_t low = 0, high = instants() - 1;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (parts_->time(middle) < time)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == 0) return low;
  return time - parts_->time(low - 1) <= parts_->time(low) - time ? low - 1 : low;
}

const VtkGrid& RunScene::at(std::size_t instant) {
  return parts_->grid.at(parts_->motion.at(instant));
}

}  // namespace floatframe
