#include "floatframe/sweep/sweep_states.hpp"

#include "floatframe/core/atomic_file.hpp"

namespace floatframe {

void SweepStates::take_from(RunOptions& options, const Model& model,
                            const SimulationDescription& simulation, const HistoryOrigin& origin) {
  if (simulation.record.states != RecordDescription::States::states) return;
  options.states = [&](const StateLayout& layout, std::span<const double> numbers) {
    if (!content_) content_ = history_content(model, simulation, layout, origin);
    numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
  };
}

void SweepStates::write(const std::filesystem::path& file, const RunSummary& summary) const {
  if (!content_) return remove_file(file.string());
  StatesFile out(file.string(), *content_, false);
  out.append(numbers_);
  out.finish(summary.status == "completed" || summary.strict ? "completed" : summary.status,
             summary.message);
}

}  // namespace floatframe
