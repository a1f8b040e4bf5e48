#include "floatframe/apps/terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>

namespace floatframe {
namespace {

int descriptor_of(Stream stream) {
  return stream == Stream::output ? STDOUT_FILENO : STDERR_FILENO;
}

bool is_terminal(Stream stream) { return ::isatty(descriptor_of(stream)) == 1; }

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

std::size_t terminal_width(Stream stream) {
  if (!is_terminal(stream)) return 0;
  const std::string_view columns = variable("COLUMNS");
  std::size_t given = 0;
  std::from_chars(columns.data(), columns.data() + columns.size(), given);
  if (given > 0) return given;
  winsize size{};
  if (::ioctl(descriptor_of(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

std::string styled(Stream stream, Style style, std::string_view text) {
  if (text.empty() || !is_terminal(stream) || !variable("NO_COLOR").empty() ||
      variable("TERM") == "dumb")
    return std::string(text);
  const char* code = style == Style::bold ? "1" : style == Style::red ? "1;31" : "1;33";
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

void write_error(const std::string& text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

}  // namespace floatframe
