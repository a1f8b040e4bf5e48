#include "floatframe/apps/command.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/model_file/model_reader.hpp"

namespace floatframe {

std::vector<Option> model_options(ModelArguments& arguments) {
  return {file_position("MODEL", arguments.path, "Model file (YAML)"),
          repeated_option("--set", arguments.settings, "NAME=VALUE",
                          "Change a parameter of the model file; may be repeated")};
}

std::vector<Option> joined(std::vector<Option> first, const std::vector<Option>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Option coordinates_option(std::string& word, std::string help) {
  return word_option("--coordinates", word, {"relative", "absolute"}, std::move(help));
}

Option inertia_option(std::string& word, std::string help) {
  return word_option("--inertia", word, {"preprocessing", "projection"}, std::move(help));
}

ModelDescription read_model(const ModelArguments& arguments, bool quiet, ModelFingerprint* used) {
  std::vector<ParameterOverride> overrides;
  for (const std::string& setting : arguments.settings) {
    const std::size_t equal = setting.find('=');
    if (equal == std::string::npos || equal == 0) {
      throw InputError(fmt::format("--set: found '{}', expected NAME=VALUE", setting));
    }
    overrides.push_back({setting.substr(0, equal), setting.substr(equal + 1)});
  }
  ReadOptions options;
  if (!quiet) options.say = say_line;
  options.keep_text = used != nullptr;
  options.outputs = arguments.outputs;
  return read_model(arguments.path, overrides, used, options);
}

namespace {

/// NaN, which no rule holds for, unless all of the text is one number.
double number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool complete = end != text.c_str() && *end == '\0';
  return complete && std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& expected) {
  throw InputError(fmt::format("{}: found '{}', expected {}", option, text, expected));
}

}  // namespace

double option_number(const std::string& option, const std::string& text, const NumberRule& rule) {
  const double value = number_in(text);
  if (!rule.holds(value)) refuse(option, text, rule.expectation());
  return value;
}

int whole_option_number(const std::string& option, const std::string& text,
                        const WholeNumberRule& rule) {
  const double value = number_in(text);
  if (!rule.holds(value)) refuse(option, text, rule.expectation());
  return static_cast<int>(value);
}

double positive_number(const std::string& option, const std::string& text) {
  return option_number(option, text, positive_number("s"));
}

void set_clock(SimulationDescription& simulation, const std::string& step,
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

void require_writable(const std::vector<OutputFile>& outputs,
                      const std::vector<std::string>& inputs) {
  require_distinct(outputs, inputs);
  for (const OutputFile& output : outputs) {
    if (output.path.empty()) continue;
    try {
      check_writable(output.path);
    } catch (const OutputError& error) {
      throw InputError(error.what());
    }
  }
}

void require_folder(const std::string& path) {
  try {
    make_output_folder(path);
  } catch (const OutputError& error) {
    throw InputError(error.what());
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
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

void say(const std::string& message) { say_line("floatframe: " + message); }

}  // namespace floatframe
