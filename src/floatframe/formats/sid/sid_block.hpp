#pragma once
// A SID_FEM file as items, one per line: "key = value" or "key"; and its blocks: "name", order,
// nrow, ncol, nq, nqn, structure, entries m0(r,c) and m1(r,q,c), "end name".
#include <optional>
#include <string>
#include <string_view>

#include "floatframe/formats/sid/sid_content.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// A line; the key without blanks.
struct SidItem {
  std::string key;
  std::string_view value;
  bool has_value = false;
};

std::string without_blanks(std::string_view text);

/// The next line that is not blank. `wanted` describes the expected item if the file ends: then it
/// throws InputError, as `expect` does.
SidItem next_sid_item(TextSource& source, const char* wanted);
void expect_sid_item(TextSource& source, const char* key);

/// A number; null with an error.
std::optional<double> sid_real(TextSource& source, std::string_view field);

/// Skips to the end of an unknown item; throws InputError if it has none.
void skip_sid_block(TextSource& source, const std::string& key);

/// Reads the block whose name was the last line. `block` has the required size on input;
/// memory is allocated for that and for the number of modes, never for the sizes in the block.
void read_sid_block(TextSource& source, const std::string& name, int modes, SidTaylor& block);

}  // namespace floatframe
