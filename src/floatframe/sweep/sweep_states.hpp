#pragma once
// The states of one run of a study, where its model file asks for them (`record: states`). As its
// rows they are held until the run has ended.
#include <filesystem>
#include <optional>
#include <vector>

#include "floatframe/history/history_content.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {

class SweepStates {
 public:
  /// `options` gives them here, if the run is asked to record; what is handed over must outlive the
  /// run.
  void take_from(RunOptions& options, const Model& model, const SimulationDescription& simulation,
                 const HistoryOrigin& origin);
  /// In place of what is there. Throws OutputError.
  void write(const std::filesystem::path& file, const RunSummary& summary) const;

 private:
  std::optional<HistoryContent> content_;
  std::vector<double> numbers_;
};

}  // namespace floatframe
