#pragma once
// Input of one run of a study: the model file read with the values of the run.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/description.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/sweep/sweep_plan.hpp"

namespace floatframe {

struct SweepCase {
  ModelDescription description;
  ModelFingerprint fingerprint;  ///< `simulation` includes the options set by the study
};

class SweepCaseReader {
 public:
  /// Resolves the names of the plan and of `fixed`. Throws InputError if the model file cannot be
  /// read at all or a name is unknown. All references must outlive the reader. `text`, if given, is
  /// read instead of the file.
  SweepCaseReader(std::string model, const std::optional<std::string>& text,
                  const std::vector<SweepSetting>& fixed, const SweepPlan& plan);

  /// Reads the model for a run (from 0). May be called by several threads. Throws InputError.
  SweepCase read(std::size_t run) const;

  const std::string& model() const noexcept { return model_; }

 private:
  struct Target {
    bool option = false;  ///< option of the simulation instead of a parameter
    std::string name;
  };
  Target target(const std::string& name, const std::string& subject, ErrorList& errors) const;
  void apply(const Target& target, const std::string& value, const std::string& subject,
             SimulationDescription& simulation, SweepCase& out, ErrorList& errors) const;

  std::string model_;
  ReadOptions options_;
  const std::vector<SweepSetting>& fixed_;
  const SweepPlan& plan_;
  std::vector<std::string> parameters_;
  std::vector<Target> fixed_targets_, targets_;
};

}  // namespace floatframe
