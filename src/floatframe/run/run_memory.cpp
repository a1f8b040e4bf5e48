#include "floatframe/run/run_memory.hpp"

#include <fmt/format.h>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/stepping/memory_check.hpp"

namespace floatframe {

std::string record_text(const RecordDescription& record, long every) {
  std::string text = fmt::format("every {}", every);
  if (!record.accelerations) text += ", without accelerations";
  for (const std::string& body : record.bodies) text += ", " + body;
  return text;
}

RunIdentity run_identity(const Model& model, const SimulationDescription& o,
                         const RunKeeps& keeps) {
  const auto number = [](double x) { return fmt::format("{}", x); };
  const auto yes = [](bool x) { return std::string(x ? "yes" : "no"); };
  // The method of inertia before the model, whose data are those of the method.
  return {{"inertia", rules::inertia_methods[index_of(o.inertia)]},
          {"model", model_hash(model)},
          {"coordinates", rules::coordinates[index_of(o.coordinates)]},
          {"step", number(o.step)},
          {"duration", number(o.duration)},
          {"output_interval", number(o.output_interval)},
          {"spectral_radius", number(o.spectral_radius)},
          {"tolerance", number(o.tolerance)},
          {"max_iterations", std::to_string(o.max_iterations)},
          {"min_step", number(o.min_step)},
          {"penalty", number(o.penalty)},
          {"position_tolerance", number(o.position_tolerance)},
          {"velocity_tolerance", number(o.velocity_tolerance)},
          {"locate_edges", yes(o.locate_edges)},
          {"rows recorded", yes(keeps.rows)},
          {"range watched", yes(keeps.watch)},
          {"state kept for the end (--write-state)", yes(keeps.state)},
          {"states recorded", keeps.states}};
}

namespace {

template <class Stream, class Memory>
void serialize_run(Stream& s, Memory& m) {
  s(m.made);
  s(m.cpu);
  m.step_times.serialize(s);
  serialize_steps(s, m.steps);
  s(m.joints);
}

std::string difference(const RunIdentity& found, const RunIdentity& own) {
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (found[k] == own[k]) continue;
    if (own[k].first == "model") return "is of another model";
    return fmt::format("was made with another value of {}: found {}, this run has {}", own[k].first,
                       found[k].second, own[k].second);
  }
  return {};
}

}  // namespace

void serialize_memory(StateWriter& s, const RunIdentity& identity, RunMemory& memory) {
  for (const auto& [name, value] : identity) {
    s(name);
    s(value);
  }
  serialize_run(s, memory);
}

RunMemory serialize_memory(StateReader& s, const RunIdentity& identity, const StepperMemory& own,
                           const Formulation& f, double step, std::size_t joints,
                           std::int64_t planned) {
  RunIdentity found(identity.size());
  for (auto& [name, value] : found) {
    s(name);
    s(value);
  }
  const auto refuse = [](ErrorCode code, const std::string& text) {
    throw InputError(code, std::string(checkpoint_name) + " " + text);
  };
  if (const std::string text = difference(found, identity); !text.empty())
    refuse(ErrorCode::mismatch, text);
  RunMemory memory;
  serialize_run(s, memory);
  if (const std::string text = memory_complaint(memory.steps, own, f, step); !text.empty())
    refuse(ErrorCode::mismatch, text);
  if (memory.made != memory.steps.since_base || memory.made >= planned ||
      memory.joints.size() != joints || !all_finite(memory.joints) || !(memory.cpu >= 0.0) ||
      !memory.step_times.holds(static_cast<std::uint64_t>(memory.made)))
    refuse(ErrorCode::damaged, "is damaged: times or counters that do not fit together");
  return memory;
}

}  // namespace floatframe
