// The only file that uses CLI11.
#include "floatframe/apps/command_parser.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <sstream>

#include "floatframe/apps/terminal.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/suggest.hpp"

namespace floatframe {
namespace {

std::string alternatives_of(const std::vector<std::string>& words) {
  std::vector<const char*> texts;
  for (const std::string& word : words) texts.push_back(word.c_str());
  return alternatives(texts);
}

std::string names_of(const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name);
  return alternatives_of(names);
}

bool is_whole(const Option& option) {
  return std::holds_alternative<int*>(option.target) ||
         std::holds_alternative<std::vector<int>*>(option.target);
}

bool is_number(const Option& option) {
  return is_whole(option) || std::holds_alternative<double*>(option.target) ||
         std::holds_alternative<std::vector<double>*>(option.target);
}

/// Expected form of a value; empty if any is allowed.
std::string expectation(const Option& option) {
  if (!option.words.empty()) return alternatives_of(option.words);
  if (is_whole(option))
    return fmt::format("a whole number from {:.0f} to {:.0f}", option.low, option.high);
  if (is_number(option))
    return fmt::format("a number from {} to {}", number_text(option.low), number_text(option.high));
  return "";
}

bool is_allowed(const Option& option, const std::string& text) {
  if (!option.words.empty())
    return std::find(option.words.begin(), option.words.end(), text) != option.words.end();
  if (!is_number(option)) return true;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0') return false;
  return value >= option.low && value <= option.high &&
         (!is_whole(option) || value == std::round(value));
}

void add_option(CLI::App& app, const Option& option) {
  if (const auto* given = std::get_if<bool*>(&option.target)) {
    app.add_flag(option.name, **given, option.help);
    return;
  }
  const bool repeated = std::holds_alternative<std::vector<std::string>*>(option.target);
  CLI::Option* added = std::visit(
      [&](auto* target) -> CLI::Option* {
        return app.add_option(option.name, *target, option.help);
      },
      option.target);
  added->type_name(option.type);
  if (option.required) added->required();
  if (option.commas) {
    added->delimiter(',');
  } else if (repeated && option.name.starts_with('-')) {
    // One value per occurrence: `--set a=1 model.yaml` must not swallow the model.
    added->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
  }
  const auto check = [option](const std::string& text) {
    if (option.required && text.empty())  // from an unset shell variable
      return std::string("found an empty name, expected a file");
    if (is_allowed(option, text)) return std::string();
    return fmt::format("found '{}', expected {}", text, expectation(option));
  };
  added->check(CLI::Validator(check, ""));
}

/// Puts the selected command into `chosen`.
void add_command(CLI::App& app, const Command& command, const Command*& chosen) {
  CLI::App* sub = app.add_subcommand(command.name, command.help);
  for (const Option& option : command.options) add_option(*sub, option);
  for (const Command& below : command.commands) add_command(*sub, below, chosen);
  if (!command.footer.empty()) sub->footer(command.footer);
  if (!command.group.empty()) sub->group(command.group);
  if (command.commands.empty())
    sub->callback([&command, &chosen] { chosen = &command; });
  else
    sub->require_subcommand(1);
}

/// The commands that were parsed, for the hint which help to read.
std::string path_of(const CLI::App& app) {
  std::string path = app.get_name();
  for (const CLI::App* sub : app.get_subcommands()) path += " " + path_of(*sub);
  return path;
}

/// The sentence about a missing or unknown command; empty if the command is valid.
std::string command_complaint(const std::vector<Command>& commands, const CLI::App& app,
                              std::span<const std::string> words) {
  if (commands.empty()) return "";
  if (words.empty()) return fmt::format("a command is required: {}", names_of(commands));
  for (const Command& command : commands)
    if (command.name == words[0])
      return command_complaint(command.commands, *app.get_subcommand(command.name),
                               words.subspan(1));
  if (words[0].starts_with('-')) return "";
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name);
  return fmt::format("found the command '{}', expected {}{}", words[0], names_of(commands),
                     did_you_mean(words[0], names));
}

/// The sentence about the first word that matches no option or position; empty if there is none.
std::string extra_complaint(const CLI::App& app) {
  const CLI::App* last = &app;
  while (!last->get_subcommands().empty()) last = last->get_subcommands().back();
  const std::vector<std::string> extra = app.remaining(true);
  for (const std::string& word : extra) {
    if (word.size() < 2 || word[0] != '-') continue;
    const std::string name = word.substr(0, word.find('='));
    std::vector<std::string> known;
    for (const CLI::Option* option : last->get_options())
      for (const std::string& option_name : option->get_lnames())
        known.push_back("--" + option_name);
    return fmt::format("unknown option '{}'{}", name, did_you_mean(name, known));
  }
  if (extra.empty()) return "";
  return fmt::format("found '{}', expected nothing more", extra.front());
}

/// A help, its headings bold on a terminal.
std::string with_headings(const std::string& help, Stream stream) {
  std::istringstream lines(help);
  std::string out, line;
  while (std::getline(lines, line)) {
    const bool heading = line.size() > 1 && line.size() < 40 && line.ends_with(':') &&
                         std::isupper(static_cast<unsigned char>(line.front())) != 0;
    out += (heading ? styled(stream, Style::bold, line) : line) + '\n';
  }
  return out;
}

/// `floatframe help COMMAND` is `floatframe COMMAND --help`: the words of the latter; others as
/// they are.
std::vector<std::string> words_of(std::span<char*> given) {
  std::vector<std::string> words(given.begin(), given.end());
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  std::erase_if(words, [](const std::string& word) { return word.starts_with('-'); });
  words.emplace_back("--help");
  return words;
}

/// A help may be asked for of commands with others below them, but not of what is no command.
bool is_help_of_nothing(const std::vector<Command>& commands, std::span<const std::string> words) {
  if (commands.empty() || words.empty() || words.front().starts_with('-')) return false;
  const auto known = std::ranges::find(commands, words.front(), &Command::name);
  return known == commands.end() || is_help_of_nothing(known->commands, words.subspan(1));
}

/// Nothing was given: the help, as an error for scripts whose variable is empty.
ParsedCommand show_help(const CLI::App& app) {
  write_error(with_headings(app.help(), Stream::error));
  say_error("a command is required");
  return {{}, exit_code::bad_input};
}

}  // namespace

ParsedCommand parse_command_line(const std::vector<Command>& commands, int argc, char** argv) {
  CLI::App app(
      "Simulates flexible multibody systems with the floating frame of reference formulation.",
      "floatframe");
  app.get_formatter()->column_width(34);
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.get_formatter()->label("Subcommands", "Commands");
  app.set_version_flag("--version", "floatframe " + build_description());
  app.require_subcommand(1);
  app.footer(
      "SI units, angles in radians. Exit codes: 0 done, 1 failed run, 2 bad input.\n"
      "`floatframe help COMMAND` shows the options of a command.");
  const Command* chosen = nullptr;
  for (const Command& command : commands) add_command(app, command, chosen);
  const std::vector<std::string> words = words_of({argv + std::min(argc, 1), argv + argc});
  if (words.empty()) return show_help(app);
  try {
    // `parse` takes the words from the end of the vector.
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    std::string message;
    const bool no_help = words.back() == "--help" && is_help_of_nothing(commands, words);
    if (error.get_exit_code() == 0 && !no_help) {  // --help, --version
      std::ostringstream shown;
      const int code = app.exit(error, shown, shown);
      print(with_headings(shown.str(), Stream::output));
      return {{}, code};
    }
    message = command_complaint(commands, app, words);
    if (message.empty()) message = extra_complaint(app);
    if (message.empty()) message = error.what();
    say_error(fmt::format("{} (see {} --help)", message, path_of(app)));
    return {{}, exit_code::bad_input};
  }
  return {chosen->run, exit_code::done};
}

}  // namespace floatframe
