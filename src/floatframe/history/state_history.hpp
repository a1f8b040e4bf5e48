#pragma once
// A result file as `floatframe run` writes it (states.ffr): the states of a run, and what they
// belong to. Numbers stay in the file until they are asked for.
//
//   StateHistory history("out/vehicle/states.ffr");
//   std::vector<double> row(history.header().columns);
//   for (std::size_t k = 0; k < history.instants(); ++k) history.instant(k, row);
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "floatframe/history/history_header.hpp"

namespace floatframe {

class StateHistory {
 public:
  /// Looks at every block. Throws InputError, with the name of the file, for a file that is not
  /// one, is damaged, or ends within its header.
  explicit StateHistory(const std::string& path);
  ~StateHistory();
  StateHistory(StateHistory&&) noexcept;
  StateHistory& operator=(StateHistory&&) noexcept;
  /// The same from the bytes of a file; `name` is for messages.
  static StateHistory of_bytes(std::string bytes, const std::string& name);

  const std::string& name() const noexcept;
  const HistoryHeader& header() const noexcept;
  /// Whole ones: the last block of a run that was killed is left out if it is not complete.
  std::size_t instants() const noexcept;
  /// The row of one. Throws InputError if there is none or its numbers are not finite.
  void instant(std::size_t k, std::span<double> row) const;
  /// All numbers of an array of the header. Throws InputError if they are not finite.
  std::vector<double> numbers(std::size_t array) const;
  /// By its name; empty if there is none.
  std::vector<double> numbers(const std::string& array) const;

  /// "completed", "failed" or "interrupted"; "running" if the file has no end: the run is at work,
  /// or was killed.
  const std::string& status() const noexcept;
  const std::string& message() const noexcept;
  /// What was left out at the end, in sentences.
  const std::vector<std::string>& notes() const noexcept;

 private:
  struct Data;
  explicit StateHistory(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace floatframe
