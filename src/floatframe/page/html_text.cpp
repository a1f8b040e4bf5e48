#include "floatframe/page/html_text.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "floatframe/core/printable.hpp"

namespace floatframe {
namespace {

constexpr std::array<std::pair<char, std::string_view>, 5> html_entities{
    {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}}};

}  // namespace

std::string html_escape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const std::size_t length = utf8_length(text, at);
    const auto entity = std::find_if(html_entities.begin(), html_entities.end(),
                                     [&](const auto& e) { return e.first == c; });
    if (length == 0 || (length == 1 && is_control(text, at) && c != '\n' && c != '\t'))
      out += "\xEF\xBF\xBD";
    else
      out += entity == html_entities.end() ? text.substr(at, length) : entity->second;
    at += std::max<std::size_t>(length, 1);
  }
  return out;
}

std::string spaced_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace floatframe
