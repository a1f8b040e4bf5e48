#include <algorithm>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/build_stages.hpp"
#include "floatframe/model/model_builder.hpp"
#include "floatframe/model/snap.hpp"
#include "floatframe/model/validate_model.hpp"

namespace floatframe {

void ModelBuilder::roads() {
  for (const RoadDescription& r : d.roads)
    model.roads.push_back({r.name, r.pieces, r.bumps, r.surface});
}

void ModelBuilder::inputs() {
  for (const InputDescription& i : d.inputs) {
    Input input;
    input.name = i.name;
    input.unit = i.unit;
    input.initial = i.initial;
    input.clamp = i.clamp;
    if (i.low) input.low = *i.low;
    if (i.high) input.high = *i.high;
    model.inputs.push_back(std::move(input));
  }
}

const Model& built(const Model& model) {
  const std::size_t n = model.bodies.size();
  const bool whole = n > 0 && model.amplitudes.size() == n && model.amplitude_rates.size() == n &&
                     std::all_of(model.bodies.begin(), model.bodies.end(),
                                 [](const Body& body) { return body.data != nullptr; });
  if (!whole)
    throw InputError(ErrorCode::missing,
                     n == 0
                         ? "found a model without bodies, expected one of build_model or load_model"
                         : "found a model whose bodies have lost their data or start values, "
                           "expected one of build_model or load_model");
  return model;
}

Model build_model(const ModelDescription& description, const ReduceBody& reduce,
                  const FindHints& find_hints) {
  ModelBuilder b(description);
  b.model.name = description.name;
  b.model.gravity = description.gravity;
  b.model.simulation = description.simulation;
  b.model.vehicle = description.vehicle;
  validate(description, b.errors);
  b.errors.throw_if_any();
  b.bodies(reduce);
  b.errors.throw_if_any();
  b.roads();
  b.inputs();
  b.joints();
  b.holding_elements();
  ModelHints found;
  if (b.errors.empty()) found.notes = snap_joints(b.model, description.snap, found.locked);
  b.forces();
  b.outputs();
  b.connect_formulas();
  b.link_signals();
  b.errors.throw_if_any();
  b.free_joints();
  b.modal_masses();
  b.finish();
  b.errors.throw_if_any();
  ModelHints hints = description.hints ? *description.hints : find_hints(description, b.model);
  found.notes.insert(found.notes.end(), hints.notes.begin(), hints.notes.end());
  found.bending = std::move(hints.bending);
  b.model.hints = std::move(found);
  return std::move(b.model);
}

}  // namespace floatframe
