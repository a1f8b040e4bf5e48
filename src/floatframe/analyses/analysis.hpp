#pragma once
// An analysis as a command of the program: what it is called, its options, and its result as text
// and as JSON. The program adds what all analyses share: MODEL and --set before the options, --json
// after them, the files that are written and --strict; it reads and builds the model and prints.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/analyses/analysis_list.hpp"
#include "floatframe/core/options.hpp"

namespace floatframe {

/// What an analysis found, for people and for programs.
struct AnalysisReport {
  std::string text;  ///< tables (core/text_table.hpp) and sentences, SI units
  std::string json;  ///< a document (report/json_values.hpp)
  /// They give the contents of the files, in the order of `Analysis::files`, while the model lives.
  std::vector<std::function<std::string()>> files{};
  std::vector<std::string> warnings{};  ///< a sentence each
};

/// A file that the user may ask for.
struct AnalysisFile {
  std::string option;  ///< "--write-state", which takes the name of the file
  std::string help;
};

struct Analysis {
  std::string name;  ///< of the command
  std::string help;  ///< one line, with the units of what it shows
  /// Makes steps: takes --step and --duration, which are then in `Model::simulation`.
  bool makes_steps = false;
  std::vector<Option> options{};  ///< its own (core/options.hpp); `run` owns what they fill
  std::string json_help = "JSON on standard output";
  std::vector<AnalysisFile> files{};
  /// What counts as failed if there are warnings and the user gives --strict, "equilibrium"; empty:
  /// there is no such option.
  std::string strict{};
  std::string footer{};  ///< below the options in its help; ends in the exit codes
  /// Throws InputError (exit code 2) or RunError (1).
  std::function<AnalysisReport(const Model& model)> run{};
  /// What a file says where `run` throws RunError, by its place in `files`; empty: none is written.
  std::function<std::string(const Model& model, std::size_t file, const std::string& why)>
      file_of_failure{};
};

#define FLOATFRAME_DECLARATION(name) Analysis name##_analysis();
FLOATFRAME_ANALYSES(FLOATFRAME_DECLARATION)
#undef FLOATFRAME_DECLARATION

/// One of each in the order of the list. Options have the places of one command line: whoever
/// parses another one asks again.
inline std::vector<Analysis> all_analyses() {
#define FLOATFRAME_CALL(name) name##_analysis(),
  return {FLOATFRAME_ANALYSES(FLOATFRAME_CALL)};
#undef FLOATFRAME_CALL
}

}  // namespace floatframe
