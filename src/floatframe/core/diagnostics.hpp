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

/// Kind of error. Programs and tests compare these; sentences may change.
enum class ErrorCode : unsigned char {
  unknown_key,    ///< an unknown key, keyword, card or option
  not_found,      ///< a reference to something that does not exist
  missing,        ///< a value, line or part that is required
  incomplete,     ///< given without another that it requires
  exclusive,      ///< given together with another, which excludes it
  duplicate,      ///< given twice, or a name that is taken
  wrong_value,    ///< not one of the allowed values
  not_a_number,   ///< a text where a number must be
  not_finite,     ///< or too large: its square overflows
  out_of_range,   ///< a number outside of its limits
  wrong_count,    ///< a list of another length
  contradiction,  ///< two values that cannot both hold
  geometry,       ///< points, axes or sections that are degenerate or do not fit
  dependent,      ///< a degree of freedom with two dependencies
  cycle,          ///< a reference to itself
  singular,       ///< an unrestrained or a massless motion
  unsupported,    ///< known, but not read, written or computed
  unavailable,    ///< not part of this build or machine
  wrong_file,     ///< a file of another kind
  damaged,        ///< a file whose content was altered
  mismatch,       ///< of another model, study or version
  unreadable,     ///< a file or folder that cannot be opened
  too_large,      ///< more than memory or a stated limit allows
  in_use,         ///< a folder, file or address that another program uses
  exists,         ///< a file that is not overwritten
  not_assembled,  ///< loops that do not close, inconsistent velocities
  no_equilibrium,
  no_convergence,
  step_failed,  ///< a run that ended early; StepStatus says more
  not_steady,   ///< no steady state at a speed
  resonance,    ///< a response without bound
  worker_lost   ///< a process of a study that ended from outside
};
/// "unknown_key", ...
const char* error_code_name(ErrorCode code) noexcept;

/// A place in a file; line and column count from 1, 0 means unknown. Or, as the file, the command
/// line option that gave a value: "--step".
struct SourceMark {
  std::string file;
  int line = 0;
  int column = 0;
  bool is_option() const { return line == 0 && file.starts_with("--"); }
  /// "file:line:column: " before the message, as far as known.
  std::string before(const std::string& message) const;
};

/// Source location of an entity and its keys. Empty for models made in C++.
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
  ErrorCode code{};
  std::string message;
  std::size_t count = 1;  ///< number of errors it summarises: "... and 180 more unknown keys"
  /// Path of the entity and key, if the reader knows it: "joints.a.axis".
  std::string path = {};
  /// "file:line:column: message", as far as the mark is known.
  std::string text() const { return mark.before(message); }
};

class InputError : public std::exception {
 public:
  explicit InputError(std::vector<ErrorEntry> errors) : errors_(std::move(errors)) { compose(); }
  InputError(ErrorCode code, SourceMark mark, std::string message)
      : InputError(std::vector<ErrorEntry>{{std::move(mark), code, std::move(message)}}) {}
  InputError(ErrorCode code, std::string message)
      : InputError(code, SourceMark{}, std::move(message)) {}
  const std::vector<ErrorEntry>& errors() const noexcept { return errors_; }
  /// Number of errors that all messages summarise.
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
  /// `count`: number of errors that the message summarises.
  void add(ErrorCode code, const SourceMark& mark, std::string message, std::size_t count = 1) {
    add({mark, code, std::move(message), count});
  }
  void add(ErrorEntry entry) { errors_.push_back(std::move(entry)); }
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
