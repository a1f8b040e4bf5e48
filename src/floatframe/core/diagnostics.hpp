#pragma once
// Errors in a user's input. Load-time code collects every error and throws one InputError; each
// error is one sentence that names the entity, what was found and what was expected, with file,
// line and column if known.
#include <cstddef>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace floatframe {

/// A place in a file; line and column count from 1, 0 means unknown. Or, as the file, the option of
/// the command line that gave a value: "--step".
struct SourceMark {
  std::string file;
  int line = 0;
  int column = 0;
  bool is_option() const { return line == 0 && file.starts_with("--"); }
};

/// Where an entity and its keys were written. Empty for models made in C++.
struct Origin {
  SourceMark mark;
  std::map<std::string, SourceMark> keys;
  const SourceMark& of(const std::string& key) const {
    const auto it = keys.find(key);
    return it == keys.end() ? mark : it->second;
  }
};

struct ErrorEntry {
  SourceMark mark;
  std::string message;
  std::size_t count = 1;  ///< of the errors it stands for: "... and 180 more unknown keys"
  /// "file:line:column: message", with what is known of the mark.
  std::string text() const {
    if (mark.file.empty()) return message;
    if (mark.line == 0) return mark.file + ": " + message;
    if (mark.column == 0) return mark.file + ":" + std::to_string(mark.line) + ": " + message;
    return mark.file + ":" + std::to_string(mark.line) + ":" + std::to_string(mark.column) + ": " +
           message;
  }
};

class InputError : public std::exception {
 public:
  explicit InputError(std::vector<ErrorEntry> errors) : errors_(std::move(errors)) { compose(); }
  InputError(SourceMark mark, std::string message)
      : InputError(std::vector<ErrorEntry>{{std::move(mark), std::move(message)}}) {}
  explicit InputError(std::string message) : InputError(SourceMark{}, std::move(message)) {}
  const std::vector<ErrorEntry>& errors() const noexcept { return errors_; }
  /// Of the errors that all messages stand for.
  std::size_t count() const noexcept {
    std::size_t sum = 0;
    for (const ErrorEntry& f : errors_) sum += f.count;
    return sum;
  }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  void compose() {
    for (const ErrorEntry& f : errors_) {
      if (!text_.empty()) text_ += '\n';
      text_ += f.text();
    }
  }
  std::vector<ErrorEntry> errors_;
  std::string text_;
};

/// Collects errors; `throw_if_any` ends a loading stage.
class ErrorList {
 public:
  /// `count`: of the errors that the message stands for.
  void add(const SourceMark& mark, std::string message, std::size_t count = 1) {
    errors_.push_back({mark, std::move(message), count});
  }
  bool empty() const noexcept { return errors_.empty(); }
  std::size_t size() const noexcept { return errors_.size(); }
  std::vector<ErrorEntry> take() { return std::move(errors_); }
  void throw_if_any() {
    if (!errors_.empty()) throw InputError(std::move(errors_));
  }

 private:
  std::vector<ErrorEntry> errors_;
};

}  // namespace floatframe
