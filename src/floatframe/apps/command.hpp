#pragma once
// What the subcommands share. Each `add_..._command` declares its options on the application; when
// it is the one that was given it sets `action`, which does the work and returns the exit code.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/output_files.hpp"
#include "floatframe/model/description.hpp"
#include "floatframe/simulation/results.hpp"

namespace CLI {
class App;
}

namespace floatframe {

struct ModelFingerprint;

using Action = std::function<int()>;

void add_run_command(CLI::App& app, Action& action);
void add_check_command(CLI::App& app, Action& action);
void add_statics_command(CLI::App& app, Action& action);
void add_realtime_command(CLI::App& app, Action& action);
void add_bench_command(CLI::App& app, Action& action);
void add_sweep_command(CLI::App& app, Action& action);
void add_advise_command(CLI::App& app, Action& action);
void add_reduce_command(CLI::App& app, Action& action);
void add_info_command(CLI::App& app, Action& action);

/// MODEL and --set, as every command that reads a model takes them.
struct ModelArguments {
  std::string path;
  std::vector<std::string> settings;  ///< "name=value"
};
void add_model_arguments(CLI::App& app, ModelArguments& arguments);

/// Parts that are reduced meanwhile are named on standard error, unless `quiet`. `used`, if given,
/// receives what was read. Throws InputError.
ModelDescription read_model(const ModelArguments& arguments, bool quiet = false,
                            ModelFingerprint* used = nullptr);

/// The number in an option's text; InputError unless it is finite and as the rule says.
double option_number(const std::string& option, const std::string& text, const NumberRule& rule);
int whole_option_number(const std::string& option, const std::string& text,
                        const WholeNumberRule& rule);
/// A positive number of seconds.
double positive_number(const std::string& option, const std::string& text);

/// Proves that files that are to be written at the end can be, and that none is one of `inputs` or
/// another output. Paths may be empty. Throws InputError.
void require_writable(const std::vector<OutputFile>& outputs,
                      const std::vector<std::string>& inputs = {});
/// The names of all files that were read.
std::vector<std::string> files_of(const ModelFingerprint& used);

/// The command line's words.
const char* word(Coordinates coordinates) noexcept;
const char* word(InertiaMethod inertia) noexcept;
Coordinates coordinates_from(const std::string& word);
InertiaMethod inertia_from(const std::string& word);

/// "17 bodies (12 flexible)"
std::string bodies_text(const ModelCounts& counts);

/// 1, "body" -> "1 body"; 2, "body", "bodies" -> "2 bodies"; without plural an "s" is added.
std::string plural(long count, const std::string& one, const std::string& many = "");

/// Writes to standard output; throws OutputError if that fails (a full disk).
void print(const std::string& text);

/// Writes "floatframe: message" or the bare line to standard error. Control characters are written
/// out: names that came from files and arguments may hold anything, and a terminal is not to obey
/// it. Whether that can be written makes no difference.
void say(const std::string& message);
void say_line(const std::string& line);

}  // namespace floatframe
