#pragma once
// The errors of one reading of a model file: each once, a few of every kind, the rest counted; and
// the limits of one reading, so that any file takes time proportional to its length and bounded
// memory.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/suggest.hpp"

namespace floatframe {

/// Limits of a model file and its subsystems; docs/model-file.md lists them.
namespace limits {
inline constexpr std::size_t errors_of_a_kind = 20;
inline constexpr std::size_t errors = 500;
inline constexpr std::size_t name_length = 100;
inline constexpr std::size_t file_values = 1'000'000;     ///< maps, lists and scalars of one file
inline constexpr std::size_t total_values = 2'000'000;    ///< total over all uses of files
inline constexpr std::size_t entities = 20'000;           ///< number of one kind
inline constexpr std::size_t parameter_text = 4'000'000;  ///< texts of all parameters [bytes]
inline constexpr std::size_t elements = 1'000'000;        ///< of all bars
inline constexpr std::size_t table_rows = 1'000'000;      ///< of all CSV files of tables
inline constexpr std::size_t table_text = 64'000'000;     ///< of all CSV files of tables [bytes]
}  // namespace limits

class ReadErrors {
 public:
  /// Keeps the error unless it was added before (a file may be used many times) or there are enough
  /// of its kind: sentences that differ only in names, numbers and places are of one kind. `count`:
  /// number of errors that the message summarises.
  void add(ErrorCode code, const SourceMark& mark, std::string message, std::size_t count = 1) {
    add({mark, code, std::move(message), count});
  }
  void add(ErrorEntry entry);
  bool empty() const noexcept { return added_ == 0; }
  /// Number of messages added, kept or not.
  std::size_t size() const noexcept { return added_; }
  /// The errors kept, and the number of those that were not.
  std::vector<ErrorEntry> take();

  /// ", did you mean ...?" for a name not found among `known()`, up to the limit of suggestions.
  template <class Known>
  std::string suggestion(std::string_view name, Known known) {
    return suggest() ? did_you_mean(name, known()) : std::string();
  }
  /// True a limited number of times.
  bool suggest() noexcept { return suggestions_ < most_suggestions && ++suggestions_ > 0; }

  /// Adds `amount` to the total used of a limit; false beyond `most`, with an error the first time.
  bool take_of(const char* what, std::size_t amount, std::size_t most, const SourceMark& mark,
               const std::string& path);
  /// True once a limit was exceeded: further reading makes no sense.
  bool exhausted() const noexcept { return exhausted_; }

 private:
  struct Kind {
    std::size_t kept = 0, omitted = 0;
    ErrorCode code{};
    SourceMark first;  ///< ignored
  };
  std::vector<ErrorEntry> errors_;
  std::unordered_set<std::uint64_t> seen_;
  std::unordered_map<std::uint64_t, Kind> kinds_;
  std::unordered_map<std::string, std::size_t> taken_;
  Kind others_;  ///< errors of further kinds when the list is full
  std::size_t added_ = 0, suggestions_ = 0;
  bool exhausted_ = false;
};

}  // namespace floatframe
