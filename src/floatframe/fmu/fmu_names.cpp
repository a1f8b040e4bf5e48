#include "floatframe/fmu/fmu_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "floatframe/core/printable.hpp"

namespace floatframe {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A B-name with or without arrayIndices: "wheel", "wheel[2]", "a[1,2]".
bool is_word(std::string_view text) {
  std::size_t k = 0;
  while (k < text.size() && (is_letter(text[k]) || (k > 0 && is_digit(text[k])))) ++k;
  if (k == 0 || k == text.size()) return k > 0;
  if (text[k] != '[' || !text.ends_with(']')) return false;
  bool digit = false;
  for (const char c : text.substr(k + 1, text.size() - k - 2)) {
    if (!is_digit(c) && !(c == ',' && digit)) return false;
    digit = is_digit(c);
  }
  return digit;
}

// Q-char without letters and digits.
constexpr std::string_view quoted_signs = "!#$%&()*+,-./:;<>=?@[]^{}|~ ";
constexpr std::array<std::pair<char, const char*>, 10> name_escapes{{{'\'', "\\'"},
                                                                     {'"', "\\\""},
                                                                     {'\\', "\\\\"},
                                                                     {'\a', "\\a"},
                                                                     {'\b', "\\b"},
                                                                     {'\f', "\\f"},
                                                                     {'\n', "\\n"},
                                                                     {'\r', "\\r"},
                                                                     {'\t', "\\t"},
                                                                     {'\v', "\\v"}}};

bool is_plain(char c) {
  return is_letter(c) || is_digit(c) || quoted_signs.find(c) != std::string_view::npos;
}

const char* escape_of(char c) {
  for (const auto& [sign, text] : name_escapes)
    if (sign == c) return text;
  return nullptr;
}

/// The code point of a sequence of UTF-8 of this length.
unsigned code_point(std::string_view bytes) {
  constexpr std::array<unsigned, 5> masks{0, 0x7f, 0x1f, 0x0f, 0x07};
  unsigned out = static_cast<unsigned char>(bytes[0]) & masks[bytes.size()];
  for (const char c : bytes.substr(1)) out = out << 6 | (static_cast<unsigned char>(c) & 0x3fu);
  return out;
}

std::string quoted_name(std::string_view text) {
  std::string out = "'";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const char c = text[at];
    if (is_plain(c))
      out += c;
    else if (const char* escape = escape_of(c))
      out += escape;
    else if (length == 0)
      out += fmt::format("{{0x{:02X}}}", static_cast<unsigned char>(c));
    else
      out += fmt::format("{{U+{:04X}}}", code_point(text.substr(at, length)));
    at += std::max<std::size_t>(length, 1);
  }
  return out + "'";
}

std::vector<std::string_view> name_pieces(std::string_view name) {
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t point = name.find('.');
    out.push_back(name.substr(0, point));
    if (point == std::string_view::npos) return out;
    name.remove_prefix(point + 1);
  }
}

}  // namespace

std::string fmu_name(std::string_view name) {
  if (name.empty()) return "'{}'";
  const std::vector<std::string_view> pieces = name_pieces(name);
  if (std::any_of(pieces.begin(), pieces.end(), [](std::string_view p) { return p.empty(); }))
    return quoted_name(name);
  std::string out;
  for (const std::string_view piece : pieces) {
    if (!out.empty()) out += '.';
    out += is_word(piece) ? std::string(piece) : quoted_name(piece);
  }
  return out;
}

bool fmu_name_is_changed(std::string_view name) {
  return name.empty() || std::any_of(name.begin(), name.end(),
                                     [](char c) { return !is_plain(c) && !escape_of(c); });
}

std::string fmu_identifier(std::string_view name) {
  constexpr std::size_t longest = 60;
  std::string out;
  for (const char c : name.substr(0, longest)) out += is_letter(c) || is_digit(c) ? c : '_';
  if (out.empty()) return "model";
  if (is_digit(out.front())) out.insert(out.begin(), '_');
  return out.substr(0, longest);
}

std::string FmuNames::take(std::string_view name, const std::string& group) {
  const std::string wanted = fmu_name(name);
  if (taken_.insert(wanted).second) return wanted;
  for (int k = 1;; ++k) {
    const std::string other =
        k == 1 ? group + "." + wanted : fmt::format("{}_{}.{}", group, k, wanted);
    if (taken_.insert(other).second) return other;
  }
}

}  // namespace floatframe
