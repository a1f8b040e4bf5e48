#pragma once
// Reads a model file (YAML 1.2 subset, `floatframe: 1`) into a ModelDescription. docs/model-file.md
// is its reference.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/description.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/model_file/parameter_override.hpp"

namespace floatframe {

class ParsedFiles;  // parsed_files.hpp

/// Options of reading: messages about slow work, and caching.
struct ReadOptions {
  /// Receives a line about work in progress: parts that are reduced or taken from the cache, and
  /// warnings of their health reports.
  std::function<void(const std::string& line)> say;
  /// Also fills `ModelFingerprint::text`.
  bool keep_text = false;
  /// Additional outputs in model file syntax: "tip: {position: {body: arm, node: BALL}}". They come
  /// last.
  std::vector<std::string> outputs = {};
  /// Read instead of the file, whose name is used in messages and as the origin of relative paths.
  const std::string* text = nullptr;
  /// Caches parsed files for the next reading.
  std::shared_ptr<ParsedFiles> parsed = nullptr;
};

/// Throws InputError with every error found (file:line:column: sentence). `path` may contain
/// subsystem references, which are read relative to its folder. `used`, if given, receives what was
/// read, up to an error.
ModelDescription read_model(const std::string& path,
                            const std::vector<ParameterOverride>& overrides = {},
                            ModelFingerprint* used = nullptr, const ReadOptions& options = {});

/// The names of the parameters of a model file, without reading the rest; possibly incomplete if it
/// cannot be read.
std::vector<std::string> model_parameters(const std::string& path);

}  // namespace floatframe
