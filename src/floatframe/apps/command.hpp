#pragma once
// The description of a command, and helpers shared by the commands.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/options.hpp"
#include "floatframe/core/output_files.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/description/description.hpp"
#include "floatframe/model_file/parameter_override.hpp"

namespace floatframe {

struct ModelFingerprint;

namespace exit_code {
inline constexpr int done = 0, failed = 1, bad_input = 2;
}

/// A command of the program. Parser and help are generated from this table.
struct Command {
  std::string name;
  std::string help;  ///< one line
  std::vector<Option> options{};
  std::string footer{};             ///< below the options in its help
  std::function<int()> run{};       ///< returns the exit code; owns the option targets
  std::vector<Command> commands{};  ///< those below it (bench), which has no `run`
  std::string group{};              ///< its heading in the help
};

/// MODEL and --set, as accepted by every command that reads a model.
struct ModelArguments {
  std::string path;
  std::vector<std::string> settings;   ///< "name=value"
  std::vector<std::string> outputs{};  ///< additional outputs, in model file syntax
};
std::vector<Option> model_options(ModelArguments& arguments);
/// `first`, then `second`.
std::vector<Option> joined(std::vector<Option> first, const std::vector<Option>& second);
/// Targets of --set: parameters of the model file, and options of its section simulation.
struct ModelSettings {
  std::vector<ParameterOverride> parameters, options;
};
/// Reads the names of the parameters where a name may mean either. Throws InputError.
ModelSettings settings_of(const ModelArguments& arguments);
/// Throws InputError.
void set_options(const std::vector<ParameterOverride>& options, SimulationDescription& simulation);
/// "NAME=VALUE" of --set. Throws InputError.
std::pair<std::string, std::string> setting_of(const std::string& text);
/// --coordinates and --inertia.
Option coordinates_option(
    std::string& word,
    std::string help =
        "Formulation: relative (joint coordinates) or absolute (natural coordinates)");
Option inertia_option(
    std::string& word,
    std::string help =
        "Inertia terms: preprocessing (constant integrals) or projection (all nodes)");
/// --step and --duration.
std::vector<Option> clock_options(std::string& step, std::string& duration);

/// Names reductions of parts in progress on standard error, unless `quiet`. `used`, if given,
/// receives the files that were read. Throws InputError.
ModelDescription read_model(const ModelArguments& arguments, bool quiet = false,
                            ModelFingerprint* used = nullptr);

/// The number in an option's text; InputError unless it is finite and satisfies the rule.
double option_number(const std::string& option, const std::string& text, const NumberRule& rule);
int whole_option_number(const std::string& option, const std::string& text,
                        const WholeNumberRule& rule);
/// A positive number of seconds.
double positive_number(const std::string& option, const std::string& text);
/// Applies --step and --duration where they are given.
void set_time_options(SimulationDescription& simulation, const std::string& step,
                      const std::string& duration);
/// Applies --coordinates and --inertia where they are given.
void set_formulation(SimulationDescription& simulation, const std::string& coordinates,
                     const std::string& inertia);

/// Files written by other programs are replaced only with --overwrite.
Option overwrite_option(bool& overwrite);
/// Checks that the output files can be written, that none is one of `inputs` or another output,
/// and, unless `overwrite`, that none was written by another program (own_file.hpp). Paths may be
/// empty. Throws InputError.
void require_writable(const std::vector<OutputFile>& outputs,
                      const std::vector<std::string>& inputs, bool overwrite);
/// Only the last of these checks.
void require_own(const OutputFile& output);
/// Throws the InputError for a file of another program.
[[noreturn]] void refuse_foreign(const std::string& option, const std::string& path);
/// Creates a folder for output files. Throws InputError.
void require_folder(const std::string& path);
/// For a folder, the path of the results.csv in it.
std::string results_file(const std::string& path);
/// The names of all files that were read.
std::vector<std::string> files_of(const ModelFingerprint& used);

/// The command line's words.
const char* word(Coordinates coordinates) noexcept;
const char* word(InertiaMethod inertia) noexcept;
Coordinates coordinates_from(const std::string& word);
InertiaMethod inertia_from(const std::string& word);

/// Writes to standard output; throws OutputError if that fails (a full disk).
void print(const std::string& text);

/// Writes "floatframe: message" or the bare line to standard error. Control characters are escaped:
/// names from files and arguments may contain any bytes, and a terminal must not interpret them.
/// Write errors are ignored.
/// On a terminal `say` shows "warning:" in yellow, `say_error` its message in red.
void say(const std::string& message);
void say_error(const std::string& message);
void say_line(const std::string& line);

}  // namespace floatframe
