#pragma once
// What standard output and standard error are: terminals, with a width and colours, or files and
// pipes, which get neither.
#include <string>
#include <string_view>

namespace floatframe {

enum class Stream { output, error };

/// Characters of a line: $COLUMNS, or else what the terminal says, 80 if it says nothing; 0: no
/// terminal.
std::size_t terminal_width(Stream stream);

enum class Style { bold, red, yellow };

/// The text with the codes of its style; without them where the stream is no terminal, or one
/// without colours (TERM=dumb), or NO_COLOR is set (https://no-color.org).
std::string styled(Stream stream, Style style, std::string_view text);

/// To standard error as it is; errors of writing are ignored.
void write_error(const std::string& text);

}  // namespace floatframe
