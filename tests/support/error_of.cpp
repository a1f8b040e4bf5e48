#include "support/error_of.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <regex>

namespace floatframe::test {
namespace {

/// For tests/sentences/sentences_test.py: a line "code<tab>sentence" in the file that it names.
void record(ErrorCode code, std::string sentence) {
  static std::FILE* const file = [] {
    const char* const name = std::getenv("FLOATFRAME_SENTENCES");
    return name != nullptr ? std::fopen(name, "a") : nullptr;
  }();
  if (file == nullptr) return;
  for (std::size_t at = 0; (at = sentence.find('\n', at)) != std::string::npos; at += 2)
    sentence.replace(at, 1, "\\n");
  fmt::print(file, "{}\t{}\n", error_code_name(code), sentence);
  std::fflush(file);
}

}  // namespace

std::string code_of(const ErrorEntry& error) {
  record(error.code, error.message);
  const std::string code = error_code_name(error.code);
  const std::string count = error.count == 1 ? "" : fmt::format(" ({})", error.count);
  return error.mark.before(error.path + (error.path.empty() ? "" : ": ") + code + count);
}

std::string codes_of(const InputError& error) {
  std::string text;
  for (const ErrorEntry& entry : error.errors())
    text += (text.empty() ? "" : "\n") + code_of(entry);
  return text;
}

std::string codes_of(const RunError& error) {
  record(error.code(), error.what());
  return error_code_name(error.code());
}

std::string without_folders(const std::string& text) {
  static const std::regex folder("/[^ :']*/floatframe_test_[A-Za-z0-9]+/");
  return std::regex_replace(text, folder, "");
}

}  // namespace floatframe::test
