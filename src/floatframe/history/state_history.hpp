#pragma once
// A result file of `floatframe run` (states.ffr): the states of a run, and their origin. Numbers
// are read from the file on demand.
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
  /// Checks every block. Throws InputError, with the name of the file, for a file of another kind,
  /// a damaged one, or one that ends within its header.
  explicit StateHistory(const std::string& path);
  ~StateHistory();
  StateHistory(StateHistory&&) noexcept;
  StateHistory& operator=(StateHistory&&) noexcept;
  /// The same for the bytes of a file; `name` is for messages.
  static StateHistory of_bytes(std::string bytes, const std::string& name);

  const std::string& name() const noexcept;
  const HistoryHeader& header() const noexcept;
  /// Number of complete instants: an incomplete last block of a killed run is ignored.
  std::size_t instants() const noexcept;
  /// The row of an instant. Throws InputError if there is none or its numbers are not finite.
  void instant(std::size_t k, std::span<double> row) const;
  /// All numbers of an array of the header. Throws InputError if they are not finite.
  std::vector<double> numbers(std::size_t array) const;
  /// By its name; empty if there is none.
  std::vector<double> numbers(const std::string& array) const;

  /// "completed", "failed" or "interrupted"; "running" if the file has no end: the run is in
  /// progress, or was killed.
  const std::string& status() const noexcept;
  const std::string& message() const noexcept;
  /// Sentences on data ignored at the end.
  const std::vector<std::string>& notes() const noexcept;

 private:
  struct Data;
  explicit StateHistory(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace floatframe
