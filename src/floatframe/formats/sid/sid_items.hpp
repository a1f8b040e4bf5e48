#pragma once
// A SID_FEM file as items, one per line: "key = value" or "key".
#include <string>
#include <string_view>

#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// A line; the key without blanks.
struct SidItem {
  std::string key;
  std::string_view value;
  bool has_value = false;
};

std::string without_blanks(std::string_view text);

/// The next line that is not blank. `wanted` says what should have come if the file ends: then it
/// throws InputError, as `expect` does.
SidItem next_sid_item(TextSource& source, const char* wanted);
void expect_sid_item(TextSource& source, const char* key);

/// To the end of something unknown; throws InputError if it has none.
void skip_sid_block(TextSource& source, const std::string& key);

}  // namespace floatframe
