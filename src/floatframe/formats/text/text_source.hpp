#pragma once
// Text files of finite-element programs: read whole (decompressed if they are gzip), given line by
// line with their place, through includes. Errors are collected with file and line, as UTF-8.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Limit of a file after decompression: a file of a few kilobytes can be built to fill any
/// memory.
inline constexpr std::uint64_t largest_text = std::uint64_t{4} << 30;  ///< [byte]
/// Above 64 MiB, no file may be compressed better than this; decks and matrices reach 20.
inline constexpr std::uint64_t largest_compression = 40;

/// Content of a regular file, decompressed if it is gzip (by its first bytes, not by its
/// name). Throws InputError naming the file.
std::string read_whole_file(const std::filesystem::path& file);
/// The first `bytes` of the same, for recognition.
std::string read_beginning(const std::filesystem::path& file, std::size_t bytes);
/// The same on bytes in memory; `name` is for messages. Bytes that are not gzip stay as they are.
std::string decompressed(std::string bytes, const std::string& name);

/// Empty if the bytes are text (any 8-bit encoding), else the reason: "the file is binary, not
/// text: byte 0x00 in line 3".
std::string not_text(std::string_view bytes);

/// Reads the file behind a path; throws InputError if it cannot.
using FileLoader = std::function<std::string(const std::filesystem::path&)>;

/// Lines of a text with its includes, and the errors found in it.
class TextSource {
 public:
  /// A file on disk.
  explicit TextSource(const std::filesystem::path& file);
  /// A text in memory; without a loader every include is an error. Throws InputError if the text is
  /// binary.
  TextSource(std::string text, std::string name, FileLoader loader = {});
  TextSource(const TextSource&) = delete;
  TextSource& operator=(const TextSource&) = delete;

  /// The next line without its end; false after the last line of the first file. Views stay valid
  /// as long as the source lives.
  bool next(std::string_view& line);
  /// Returns the line of the last `next` again, once only; `here` is the line before it until then.
  void put_back() noexcept {
    again_ = true;
    std::swap(here_, before_);
  }
  /// The whole first file.
  std::string_view first_text() const noexcept { return *texts_.front(); }
  /// Place of the last line.
  FeSource here() const noexcept { return here_; }

  /// Continues with the first line of another file and returns after its last. The path (quotes
  /// are removed, backslashes become slashes) is looked up next to the including file, then next to
  /// the first file, also with `.gz`. Errors (missing, circular, too deep, too many) are thrown
  /// immediately.
  void include(std::string_view path, const FeSource& at);
  /// The same; only returns false if the file is missing.
  bool include_if_there(std::string_view path, const FeSource& at);

  SourceMark mark(const FeSource& source) const;
  /// Collects an error; throws all of them when there are `most_errors`.
  void error(ErrorCode code, const FeSource& at, const std::string& message);
  /// Collects an error at the last line.
  void error(ErrorCode code, const std::string& message) { error(code, here_, message); }
  [[noreturn]] void stop(ErrorCode code, const FeSource& at, const std::string& message);
  /// Each also with a text of fmt and its values.
  template <class First, class... Rest>
  void error(ErrorCode code, const FeSource& at, fmt::format_string<First, Rest...> text,
             First&& first, Rest&&... rest) {
    error(code, at, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  template <class First, class... Rest>
  void error(ErrorCode code, fmt::format_string<First, Rest...> text, First&& first,
             Rest&&... rest) {
    error(code, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  template <class First, class... Rest>
  [[noreturn]] void stop(ErrorCode code, const FeSource& at,
                         fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
    stop(code, at, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  template <class... Args>
  [[noreturn]] void stop(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
    stop(code, here_, fmt::format(text, std::forward<Args>(args)...));
  }
  /// "file:line: ..." for FeModel::notes; line 0: of the whole file.
  template <class... Args>
  void note(FeModel& model, const FeSource& at, fmt::format_string<Args...> text,
            Args&&... args) const {
    model.notes.push_back(mark(at).before(fmt::format(text, std::forward<Args>(args)...)));
  }
  void throw_if_any() { errors_.throw_if_any(); }
  std::size_t errors() const noexcept { return errors_.size(); }
  static constexpr std::size_t most_errors = 50;

  /// A line may define many nodes, elements or cards (generated, copied, repeated): each reports
  /// how many it creates or visits. Throws when the total is too large, since a short file
  /// could fill any memory.
  void make(std::int64_t count);
  void may_make(std::int64_t most) noexcept { may_make_ = most; }
  static constexpr std::int64_t most_made = 4'000'000;

  /// Names of the files read so far, for FeModel::files.
  const std::vector<std::string>& files() const noexcept { return names_; }

 private:
  struct Open {
    int file = 0;
    const char* at = nullptr;
    int line = 0;
  };
  int add_file(std::string name, std::string text);
  bool include_file(std::string_view path, const FeSource& at, bool required);
  void open(int file);

  FileLoader loader_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<const std::string>> texts_;
  std::vector<std::string> keys_;                      // canonical paths
  std::unordered_map<std::string, int> index_of_key_;  // to find included files again
  std::vector<Open> stack_;
  std::uint64_t expanded_ = 0;  // characters pushed onto the stack
  std::size_t includes_ = 0;
  std::int64_t may_make_ = most_made, made_ = 0;
  std::string_view line_;
  bool again_ = false;
  FeSource here_, before_;
  ErrorList errors_;
};

}  // namespace floatframe
