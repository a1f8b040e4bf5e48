#include "floatframe/apps/command_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <new>
#include <set>

#include "floatframe/apps/ample_stack.hpp"
#include "floatframe/apps/command_parser.hpp"
#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/source_line.hpp"
#include "floatframe/apps/terminal.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/core/table_width.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

/// An error with its place. On a terminal the message is in red and the line of the file follows,
/// with a caret; programs find one line for each error.
void show(const ErrorEntry& entry) {
  const std::size_t width = terminal_width(Stream::error);
  if (width == 0) return say_line(entry.text());
  const std::string place = printable(entry.mark.before(""), true);
  std::string text = styled(Stream::error, Style::bold, place) +
                     styled(Stream::error, Style::red, printable(entry.message, true)) + '\n';
  text += source_line(entry.mark, width);
  write_error(text);
}

/// One error per line, as compilers do; the number of errors last.
int report(const InputError& error) {
  std::set<std::string> files;
  for (const ErrorEntry& entry : error.errors()) {
    if (entry.mark.file.empty() || entry.mark.is_option()) {
      say_error(entry.text());
    } else {
      files.insert(entry.mark.file);
      show(entry);
    }
  }
  if (error.errors().size() > 1) {
    const std::string where = files.empty()       ? "the input"
                              : files.size() == 1 ? *files.begin()
                                                  : plural(static_cast<long>(files.size()), "file");
    say_line(fmt::format("{} errors in {}", error.count(), where));
  }
  return exit_code::bad_input;
}

int parse_and_act(int argc, char** argv, const std::vector<Command>& more) {
  const FitTables fit(terminal_width(Stream::output));
  std::vector<Command> commands = all_commands();
  for (const Command& command : more) {
    commands.push_back(command);
    commands.back().group = group_of_checks;
  }
  const ParsedCommand command = parse_command_line(commands, argc, argv);
  return command.run ? command.run() : command.exit_code;
}

/// A program may be started with its standard files closed. The next file opened would then get
/// such a descriptor, and messages would be written into a journal or a log. This reserves the
/// descriptors, so that writing to them remains an error.
void occupy_standard_files() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(file, F_GETFD) < 0 && errno == EBADF)  // this is the lowest free descriptor
      static_cast<void>(::open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

int run_and_report_errors(int argc, char** argv, const std::vector<Command>& more) {
  try {
    return parse_and_act(argc, argv, more);
  } catch (const InputError& error) {
    return report(error);
  } catch (const RunError& error) {
    say_error(error.what());
  } catch (const std::bad_alloc&) {
    say_error("there is not enough memory");
  } catch (const std::exception& error) {
    say_error(error.what());
  }
  return exit_code::failed;
}

}  // namespace

int command_line_main(int argc, char** argv, const std::vector<Command>& more) {
  occupy_standard_files();
  // Exceeding the file size limit is reported as a write error of the file.
  std::signal(SIGXFSZ, SIG_IGN);
  return on_ample_stack([&] { return run_and_report_errors(argc, argv, more); });
}

}  // namespace floatframe
