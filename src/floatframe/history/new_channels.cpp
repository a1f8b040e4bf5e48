#include "floatframe/history/new_channels.hpp"

#include <fmt/format.h>

#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/work_progress.hpp"
#include "floatframe/history/recorded_motion.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

[[noreturn]] void refuse(ErrorCode code, const StateHistory& history, const std::string& what) {
  throw InputError(code, SourceMark{history.name(), 0, 0}, what);
}

/// Checks that everything an output depends on was recorded.
class RecordedParts {
 public:
  RecordedParts(const StateHistory& history, const Model& model)
      : history_(history), model_(model) {}

  void require(const Output& output) const {
    if (output.type == OutputType::projection_impulse)
      refuse(ErrorCode::unsupported, history_,
             fmt::format("output '{}': impulses of projections are not in the states of a run, "
                         "expected an output of its model file",
                         output.name));
    if (history_.header().complete()) return;
    const OutputKind& kind = output_kind(output.type);
    const bool whole = kind.of == OutputOf::mass && output.body < 0;
    if (kind.needs_of_motion.reactions || whole)
      refuse(ErrorCode::missing, history_,
             fmt::format("output '{}': {} need the states of all bodies, found those of some",
                         output.name, whole ? "quantities of the model" : "reactions"));
    for (const int m : {output.marker, output.to, output.relative, output.axes}) marker(output, m);
    for (const int m : measure_markers(model_, output)) marker(output, m);
    body(output, output.body);
    if (output.element >= 0)
      for (const int port : model_.elements[output.element].markers) marker(output, port);
  }

 private:
  void marker(const Output& output, int marker) const {
    if (marker >= 0) body(output, model_.markers[marker].body);
  }
  void body(const Output& output, int body) const {
    if (body < 0 || history_.header().bodies[static_cast<std::size_t>(body)].pose >= 0) return;
    refuse(ErrorCode::missing, history_,
           fmt::format("output '{}': the states of body '{}' were not recorded", output.name,
                       model_.bodies[body].name));
  }

  const StateHistory& history_;
  const Model& model_;
};

}  // namespace

void require_model(const StateHistory& history, const Model& model) {
  const std::string& library = history.header().origin.library;
  if (!library.empty() && library != build_description())
    refuse(ErrorCode::mismatch, history,
           fmt::format("its states were made by another copy of the program (found {}, this is {})",
                       library, build_description()));
  if (history.header().model_hash != model_hash(model))
    refuse(ErrorCode::mismatch, history,
           fmt::format("its states are not of this model: it was changed, or another copy of the "
                       "program ({}) made them",
                       library));
}

ResultTable new_channels(const StateHistory& history, const Model& model,
                         const SimulationDescription& options, std::size_t added) {
  RecordedMotion motion(history, model, options);
  const RecordedParts recorded(history, model);
  ResultTable table;
  table.columns.push_back({"time", "s"});
  const std::size_t first = model.outputs.size() - added;
  for (std::size_t k = first; k < model.outputs.size(); ++k) {
    recorded.require(model.outputs[k]);
    table.columns.push_back({model.outputs[k].name, model.outputs[k].unit});
  }
  for (std::size_t k = 0; k < motion.instants(); ++k) {
    if (k % 64 == 0) tell_progress("instants", 1.0 * k / motion.instants());
    motion.at(k);
    const std::vector<double>& row = motion.outputs();
    table.data.push_back(row[0]);
    table.data.insert(table.data.end(), row.begin() + 1 + static_cast<std::ptrdiff_t>(first),
                      row.end());
  }
  return table;
}

}  // namespace floatframe
