#include "floatframe/history/new_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/enum_index.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/model/validate.hpp"
#include "floatframe/simulation/stepped_model.hpp"

namespace floatframe {
namespace {

[[noreturn]] void refuse(const StateHistory& history, const std::string& what) {
  throw InputError(SourceMark{history.name(), 0, 0}, what);
}

/// What of a model an output looks at must have been recorded.
class RecordedParts {
 public:
  RecordedParts(const StateHistory& history, const Model& model)
      : history_(history), model_(model) {}

  void require(const Output& output) const {
    if (output.type == OutputType::projection_impulse)
      refuse(history_, fmt::format("output '{}': impulses of projections are not in the states of "
                                   "a run, expected an output of its model file",
                                   output.name));
    if (history_.header().complete()) return;
    if (output_kind(output.type).terms == OutputTerms::reactions)
      refuse(history_, fmt::format("output '{}': reactions need the states of all bodies, found "
                                   "those of some",
                                   output.name));
    marker(output, output.marker);
    marker(output, output.to);
    body(output, output.body);
    if (output.joint >= 0) {
      marker(output, model_.joints[output.joint].frame_F);
      marker(output, model_.joints[output.joint].frame_M);
    }
    if (output.force >= 0) {
      marker(output, model_.forces[output.force].a);
      marker(output, model_.forces[output.force].b);
    }
    if (output.rod >= 0) {
      marker(output, model_.rods[output.rod].a);
      marker(output, model_.rods[output.rod].b);
    }
  }

 private:
  void marker(const Output& output, int marker) const {
    if (marker >= 0) body(output, model_.markers[marker].body);
  }
  void body(const Output& output, int body) const {
    if (body < 0 || history_.header().bodies[static_cast<std::size_t>(body)].pose >= 0) return;
    refuse(history_, fmt::format("output '{}': the states of body '{}' were not recorded",
                                 output.name, model_.bodies[body].name));
  }

  const StateHistory& history_;
  const Model& model_;
};

template <class F>
class ChannelSampler {
 public:
  ChannelSampler(const StateHistory& history, const Model& model,
                 const SimulationDescription& options)
      : history_(history),
        steps_(model, options, {.duration = options.duration}),
        memory_(steps_.memory()),
        row_(history.header().columns),
        sample_(model.outputs.size() + 1) {
    const HistoryHeader& h = history.header();
    const F& f = steps_.formulation();
    if (h.configurations != f.configurations() || h.velocities != f.velocities() ||
        h.bodies.size() != model.bodies.size() || size_of("inputs") != f.inputs().size() ||
        size_of("spring_angles") != f.spring_angles().size())
      refuse(history, "its states are not of this model");
    // `a` of a step begins from what the integrator left; without it, it is solved for.
    if (!h.find("accelerations"))
      solver_.emplace(steps_.model(), options.inertia, memory_.state,
                      ReactionOptions{steps_.step_options().penalty_mass, steps_.grid().step(),
                                      !steps_.start_report().redundant.empty()});
  }

  /// Time and all outputs at an instant.
  const std::vector<double>& sample(std::size_t k) {
    history_.instant(k, row_);
    const HistoryHeader& h = history_.header();
    State& s = memory_.state;
    s.t = row_[0];
    fill("q", h.q, s.q);
    fill("v", h.v, s.v);
    const std::span<const double> angles = group("spring_angles");
    memory_.spring_angles.assign(angles.begin(), angles.end());
    F& f = steps_.formulation();
    f.set_inputs(group("inputs"));
    if (solver_) {
      s.a.setZero();
      solver_->solve(s, f.inputs(), memory_.spring_angles);
      s.a = solver_->accelerations();
    } else {
      fill("accelerations", h.v, s.a);
    }
    steps_.set_memory(memory_);
    steps_.sample(sample_.data());
    memory_.runner.outputs = steps_.memory().runner.outputs;  // turns that outputs count
    return sample_;
  }

 private:
  std::size_t size_of(const char* name) const {
    const HistoryGroup* g = history_.header().find(name);
    return g ? g->count : 0;
  }
  std::span<const double> group(const char* name) const {
    const HistoryGroup* g = history_.header().find(name);
    return g ? std::span<const double>(row_).subspan(g->first, g->count)
             : std::span<const double>();
  }
  void fill(const char* name, const std::vector<int>& places, VecX& x) const {
    const std::span<const double> numbers = group(name);
    for (std::size_t i = 0; i < places.size(); ++i) x[places[i]] = numbers[i];
  }

  const StateHistory& history_;
  SteppedModel<F> steps_;
  SteppedMemory memory_;
  std::optional<ReactionSolver<F>> solver_;
  std::vector<double> row_, sample_;
};

template <class F>
ResultTable channels_of(const StateHistory& history, const Model& model,
                        const SimulationDescription& options, std::size_t added) {
  ChannelSampler<F> sampler(history, model, options);
  ResultTable table;
  table.columns.push_back({"time", "s"});
  const std::size_t first = model.outputs.size() - added;
  for (std::size_t k = first; k < model.outputs.size(); ++k)
    table.columns.push_back({model.outputs[k].name, model.outputs[k].unit});
  for (std::size_t k = 0; k < history.instants(); ++k) {
    const std::vector<double>& row = sampler.sample(k);
    table.data.push_back(row[0]);
    table.data.insert(table.data.end(), row.begin() + 1 + static_cast<std::ptrdiff_t>(first),
                      row.end());
  }
  return table;
}

}  // namespace

void require_model(const StateHistory& history, const Model& model) {
  if (history.header().model_hash != model_hash(model))
    refuse(history, fmt::format("its states are not of this model: it was changed, or another copy "
                                "of the program ({}) made them",
                                history.header().origin.library));
}

ResultTable new_channels(const StateHistory& history, const Model& model,
                         const SimulationDescription& options, std::size_t added) {
  require_valid_run(options);
  const RecordedParts recorded(history, model);
  if (history.header().bodies.size() != model.bodies.size())
    refuse(history, "its states are not of this model");
  for (std::size_t k = model.outputs.size() - added; k < model.outputs.size(); ++k)
    recorded.require(model.outputs[k]);
  return options.coordinates == Coordinates::relative
             ? channels_of<RelativeFormulation>(history, model, options, added)
             : channels_of<AbsoluteFormulation>(history, model, options, added);
}

}  // namespace floatframe
