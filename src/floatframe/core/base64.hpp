#pragma once
// Bytes as text (RFC 4648, with padding).
#include <optional>
#include <string>
#include <string_view>

namespace floatframe {

std::string base64(std::string_view bytes);
/// The bytes; nullopt if the text is not base64.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace floatframe
