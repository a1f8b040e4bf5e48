#include "floatframe/formats/sid/sid_items.hpp"

#include <fmt/format.h>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

std::string without_blanks(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c != ' ' && c != '\t') out += c;
  }
  return out;
}

SidItem next_sid_item(TextSource& source, const char* wanted) {
  std::string_view text;
  while (source.next(text)) {
    text = trimmed(text);
    if (!text.empty()) break;
  }
  if (text.empty()) {
    source.stop(ErrorCode::damaged, source.here(), "the file ends where {} was expected", wanted);
  }
  SidItem item;
  const std::size_t equals = text.find('=');
  item.has_value = equals != std::string_view::npos;
  item.key = without_blanks(text.substr(0, equals));
  if (item.has_value) item.value = trimmed(text.substr(equals + 1));
  return item;
}

void expect_sid_item(TextSource& source, const char* key) {
  const std::string words = key == std::string_view("newmodal")  ? "new modal"
                            : key == std::string_view("endpart") ? "end part"
                                                                 : key;
  const SidItem item = next_sid_item(source, fmt::format("'{}'", words).c_str());
  if (item.key != key) {
    source.stop(ErrorCode::wrong_value, source.here(), "found {}, expected '{}'", shown(item.key),
                words);
  }
}

void skip_sid_block(TextSource& source, const std::string& key) {
  const FeSource begin = source.here();
  const std::string end = "end" + key;
  std::string_view text;
  while (source.next(text)) {
    if (without_blanks(text) == end) return;
  }
  source.stop(ErrorCode::missing, begin, "{} has no end", shown(key));
}

}  // namespace floatframe
