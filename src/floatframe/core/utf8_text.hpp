#pragma once
// Names from files and command lines as UTF-8. Older programs write them in Latin-1, where every
// byte is the number of its character; such text is hardly ever UTF-8 by chance.
#include <string>
#include <string_view>

namespace floatframe {

/// `text` if it is UTF-8, else its bytes as characters of Latin-1.
std::string utf8_text(std::string_view text);

}  // namespace floatframe
