#include "floatframe/apps/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "floatframe/apps/own_file.hpp"
#include "floatframe/apps/terminal.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/description/simulation_option.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/model_file/model_reader.hpp"

namespace floatframe {

std::vector<Option> model_options(ModelArguments& arguments) {
  return {file_position("MODEL", arguments.path, "Model file (YAML) or packed model (.ffm)"),
          repeated_option("--set", arguments.settings, "NAME=VALUE",
                          "Set a parameter of the model file, or else an option of its section "
                          "simulation (step, tolerance, ...); may be repeated")};
}

std::vector<Option> joined(std::vector<Option> first, const std::vector<Option>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::pair<std::string, std::string> setting_of(const std::string& text) {
  const std::size_t equal = text.find('=');
  if (equal == std::string::npos || equal == 0)
    throw InputError(ErrorCode::wrong_value,
                     fmt::format("--set: found '{}', expected NAME=VALUE", text));
  return {text.substr(0, equal), text.substr(equal + 1)};
}

std::vector<Option> clock_options(std::string& step, std::string& duration) {
  return {text_option("--step", step, "SECONDS", "Time step [s]; default: that of the model file"),
          text_option("--duration", duration, "SECONDS",
                      "Time to simulate [s]; default: that of the model file")};
}

Option coordinates_option(std::string& word, std::string help) {
  return word_option("--coordinates", word, {"relative", "absolute"}, std::move(help));
}

Option inertia_option(std::string& word, std::string help) {
  return word_option("--inertia", word, {"preprocessing", "projection"}, std::move(help));
}

ModelSettings settings_of(const ModelArguments& arguments) {
  constexpr std::string_view prefix = "simulation.";
  const std::vector<std::string>& known = simulation_option_names();
  const auto is_among = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  ModelSettings settings;
  std::optional<std::vector<std::string>> parameters;  // read only where a name may mean either
  for (const std::string& setting : arguments.settings) {
    const auto [name, value] = setting_of(setting);
    if (name.starts_with(prefix) && is_among(known, name.substr(prefix.size()))) {
      settings.options.push_back({name.substr(prefix.size()), value});
      continue;
    }
    if (is_among(known, name) && !parameters) parameters = model_parameters(arguments.path);
    if (is_among(known, name) && !is_among(*parameters, name))
      settings.options.push_back({name, value});
    else
      settings.parameters.push_back({name, value});
  }
  return settings;
}

void set_options(const std::vector<ParameterOverride>& options, SimulationDescription& simulation) {
  ErrorList errors;
  for (const auto& [name, value] : options)
    if (const std::string error = set_simulation_option(simulation, name, value); !error.empty())
      errors.add(ErrorCode::wrong_value, {}, fmt::format("--set: {}: {}", name, error));
  if (!options.empty())
    if (const std::string error = simulation_error(simulation); !error.empty())
      errors.add(ErrorCode::wrong_value, {}, error);
  errors.throw_if_any();
}

ModelDescription read_model(const ModelArguments& arguments, bool quiet, ModelFingerprint* used) {
  const ModelSettings settings = settings_of(arguments);
  ReadOptions options;
  if (!quiet) options.say = say_line;
  options.keep_text = used != nullptr;
  options.outputs = arguments.outputs;
  ModelDescription description = read_model(arguments.path, settings.parameters, used, options);
  set_options(settings.options, description.simulation);
  return description;
}

namespace {

/// NaN, which violates every rule, unless the whole text is one number.
double number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool complete = end != text.c_str() && *end == '\0';
  return complete && std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

[[noreturn]] void refuse(ErrorCode code, const std::string& option, const std::string& text,
                         const std::string& expected) {
  throw InputError(code, fmt::format("{}: found '{}', expected {}", option, text, expected));
}

}  // namespace

double option_number(const std::string& option, const std::string& text, const NumberRule& rule) {
  const double value = number_in(text);
  if (!rule.holds(value)) refuse(ErrorCode::out_of_range, option, text, rule.expectation());
  return value;
}

int whole_option_number(const std::string& option, const std::string& text,
                        const WholeNumberRule& rule) {
  const double value = number_in(text);
  if (!rule.holds(value)) refuse(ErrorCode::out_of_range, option, text, rule.expectation());
  return static_cast<int>(value);
}

double positive_number(const std::string& option, const std::string& text) {
  return option_number(option, text, positive_number("s"));
}

void set_time_options(SimulationDescription& simulation, const std::string& step,
                      const std::string& duration) {
  if (!step.empty()) {
    simulation.step = positive_number("--step", step);
    simulation.given_by("--step", "step");
  }
  if (!duration.empty()) {
    simulation.duration = positive_number("--duration", duration);
    simulation.given_by("--duration", "duration");
  }
}

void set_formulation(SimulationDescription& simulation, const std::string& coordinates,
                     const std::string& inertia) {
  if (!coordinates.empty()) simulation.coordinates = coordinates_from(coordinates);
  if (!inertia.empty()) simulation.inertia = inertia_from(inertia);
}

Option overwrite_option(bool& overwrite) {
  return flag("--overwrite", overwrite,
              "Replace files that are there already and were not written by this program");
}

void refuse_foreign(const std::string& option, const std::string& path) {
  throw InputError(ErrorCode::exists, fmt::format("{}: the file '{}' was not written by this "
                                                  "program; expected another name, or --overwrite",
                                                  option, path));
}

void require_own(const OutputFile& output) {
  if (!is_own_file(output.path)) refuse_foreign(output.option, output.path);
}

void require_writable(const std::vector<OutputFile>& outputs,
                      const std::vector<std::string>& inputs, bool overwrite) {
  require_distinct(outputs, inputs);
  for (const OutputFile& output : outputs) {
    if (output.path.empty()) continue;
    try {
      check_writable(output.path);
      if (!overwrite) require_own(output);
    } catch (const OutputError& error) {
      throw InputError(ErrorCode::unreadable, error.what());
    }
  }
}

void require_folder(const std::string& path) {
  try {
    make_output_folder(path);
  } catch (const OutputError& error) {
    throw InputError(ErrorCode::unreadable, error.what());
  }
}

std::string results_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return path;
  return (std::filesystem::path(path) / "results.csv").string();
}

std::vector<std::string> files_of(const ModelFingerprint& used) {
  std::vector<std::string> files;
  for (const auto& [file, hash] : used.files) files.push_back(file);
  return files;
}

const char* word(Coordinates coordinates) noexcept {
  return coordinates == Coordinates::relative ? "relative" : "absolute";
}

const char* word(InertiaMethod inertia) noexcept {
  return inertia == InertiaMethod::preprocessing ? "preprocessing" : "projection";
}

Coordinates coordinates_from(const std::string& text) {
  return text == "absolute" ? Coordinates::absolute : Coordinates::relative;
}

InertiaMethod inertia_from(const std::string& text) {
  return text == "projection" ? InertiaMethod::projection : InertiaMethod::preprocessing;
}

void print(const std::string& text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) {
    throw OutputError(std::string("standard output cannot be written: ") + std::strerror(errno));
  }
}

void say_line(const std::string& line) {
  const std::string text = printable(line, true) + '\n';
  write_error(text);
}

namespace {

/// "floatframe: message", the first word of it in a colour that says what it is.
void say_with(Style style, const std::string& first, const std::string& rest) {
  const std::string text = styled(Stream::error, Style::bold, "floatframe:") + " " +
                           styled(Stream::error, style, printable(first, true)) +
                           printable(rest, true) + '\n';
  write_error(text);
}

}  // namespace

void say(const std::string& message) {
  constexpr std::string_view warning = "warning:";
  if (message.starts_with(warning))
    say_with(Style::yellow, std::string(warning), message.substr(warning.size()));
  else
    say_with(Style::bold, "", message);
}

void say_error(const std::string& message) { say_with(Style::red, message, ""); }

}  // namespace floatframe
