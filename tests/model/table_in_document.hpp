#pragma once
// The tables of docs/model-file.md.
#include <fstream>
#include <sstream>
#include <string>

namespace floatframe::test {

/// The text of the document from the heading of a table to its end.
inline std::string table_in_document(const std::string& head) {
  std::ifstream file(FLOATFRAME_EXAMPLES "/../docs/model-file.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::size_t at = text.str().find(head);
  if (at == std::string::npos) return "no such table";
  return text.str().substr(at, text.str().find("\n\n", at) + 1 - at);
}

}  // namespace floatframe::test
