#pragma once
// Faults in a user's input. Load-time code collects every fault and throws one InputError; each
// fault is one sentence that names the entity, what was found and what was expected, with file,
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

struct InputFault {
  SourceMark mark;
  std::string message;
  std::size_t count = 1;  ///< of the faults it stands for: "... and 180 more unknown keys"
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
  explicit InputError(std::vector<InputFault> faults) : faults_(std::move(faults)) { compose(); }
  InputError(SourceMark mark, std::string message)
      : InputError(std::vector<InputFault>{{std::move(mark), std::move(message)}}) {}
  explicit InputError(std::string message) : InputError(SourceMark{}, std::move(message)) {}
  const std::vector<InputFault>& faults() const noexcept { return faults_; }
  /// Of the faults that all messages stand for.
  std::size_t count() const noexcept {
    std::size_t sum = 0;
    for (const InputFault& f : faults_) sum += f.count;
    return sum;
  }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  void compose() {
    for (const InputFault& f : faults_) {
      if (!text_.empty()) text_ += '\n';
      text_ += f.text();
    }
  }
  std::vector<InputFault> faults_;
  std::string text_;
};

/// Collects faults; `throw_if_any` ends a loading stage.
class Faults {
 public:
  /// `count`: of the faults that the message stands for.
  void add(const SourceMark& mark, std::string message, std::size_t count = 1) {
    faults_.push_back({mark, std::move(message), count});
  }
  bool empty() const noexcept { return faults_.empty(); }
  std::size_t size() const noexcept { return faults_.size(); }
  std::vector<InputFault> take() { return std::move(faults_); }
  void throw_if_any() {
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }

 private:
  std::vector<InputFault> faults_;
};

}  // namespace floatframe
