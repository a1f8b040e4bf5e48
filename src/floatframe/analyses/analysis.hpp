#pragma once
// An analysis as a command of the program: its name, its options, and its result as text and as
// JSON. The program adds the common parts: MODEL and --set before the options, --json after them,
// output files and --strict; it reads and builds the model and prints the result.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/analyses/analysis_list.hpp"
#include "floatframe/core/options.hpp"

namespace floatframe {

/// The result of an analysis, for people and for programs.
struct AnalysisReport {
  std::string text;  ///< tables (core/text_table.hpp) and sentences, SI units
  std::string json;  ///< a document (results/json_values.hpp)
  /// Contents of the files, in the order of `Analysis::files`; valid while the model exists.
  std::vector<std::function<std::string()>> files{};
  std::vector<std::string> warnings{};  ///< one sentence each
};

/// An optional output file.
struct AnalysisFile {
  std::string option;  ///< "--write-state", followed by the name of the file
  std::string help;
};

struct Analysis {
  std::string name;  ///< of the command
  std::string help;  ///< one line, with the units of the result
  /// Makes steps: takes --step and --duration, which are then in `Model::simulation`.
  bool makes_steps = false;
  std::vector<Option> options{};  ///< its options (core/options.hpp); `run` owns their targets
  std::string json_help = "JSON on standard output";
  std::vector<AnalysisFile> files{};
  /// What fails if there are warnings and the user gives --strict, "equilibrium"; empty: there is
  /// no such option.
  std::string strict{};
  std::string footer{};  ///< below the options in its help; ends in the exit codes
  /// Throws InputError (exit code 2) or RunError (1).
  std::function<AnalysisReport(const Model& model)> run{};
  /// Content of a file if `run` throws RunError, by its index in `files`; empty: not written.
  std::function<std::string(const Model& model, std::size_t file, const std::string& why)>
      file_of_failure{};
};

#define FLOATFRAME_DECLARATION(name) Analysis name##_analysis();
FLOATFRAME_ANALYSES(FLOATFRAME_DECLARATION)
#undef FLOATFRAME_DECLARATION

/// One of each in the order of the list. Options point to values of one command line: another
/// command line needs another call.
inline std::vector<Analysis> all_analyses() {
#define FLOATFRAME_CALL(name) name##_analysis(),
  return {FLOATFRAME_ANALYSES(FLOATFRAME_CALL)};
#undef FLOATFRAME_CALL
}

}  // namespace floatframe
