#pragma once
// Reads a model file (YAML 1.2 subset, `floatframe: 1`) into a ModelDescription. docs/model-file.md
// is its reference.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/model/description.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/model_file/parameter_override.hpp"

namespace floatframe {

class ParsedFiles;  // parsed_files.hpp

/// What takes time while a model is read, and what is remembered of it.
struct ReadOptions {
  /// Receives in one line what is going on: parts that are reduced or taken from the cache, what
  /// their health reports warn of.
  std::function<void(const std::string& line)> say;
  /// Gives `ModelFingerprint::text`, too.
  bool keep_text = false;
  /// Further outputs, as a model file writes them: "tip: {position: {body: arm, node: BALL}}". They
  /// come last.
  std::vector<std::string> outputs = {};
  /// Read instead of the file, whose name stands for it in messages and says where the files are
  /// that it names.
  const std::string* text = nullptr;
  /// Keeps what was parsed, for the next reading.
  std::shared_ptr<ParsedFiles> parsed = nullptr;
};

/// Throws InputError with every error found (file:line:column: sentence). `path` may hold subsystem
/// references, which are read relative to its folder. `used`, if given, receives what was read, as
/// far as the reading came.
ModelDescription read_model(const std::string& path,
                            const std::vector<ParameterOverride>& overrides = {},
                            ModelFingerprint* used = nullptr, const ReadOptions& options = {});

/// The names of the parameters of a model file, without reading what they are for: few, if it
/// cannot be read.
std::vector<std::string> model_parameters(const std::string& path);

/// The numbers of the section `simulation`: a key of the file, or an option by that name.
struct SimulationNumber {
  const char* name;
  double SimulationDescription::*at;
  NumberRule rule;
};
const std::vector<SimulationNumber>& simulation_numbers();

}  // namespace floatframe
