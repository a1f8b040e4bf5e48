#pragma once
// Names from files and command lines as UTF-8. Older programs write Latin-1, where each byte is the
// code of its character; such text is hardly ever valid UTF-8 by chance.
#include <string>
#include <string_view>

namespace floatframe {

/// `text` if it is valid UTF-8, else its bytes interpreted as Latin-1.
std::string utf8_text(std::string_view text);

}  // namespace floatframe
