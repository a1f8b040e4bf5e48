#pragma once
// Entries of a symmetric matrix as they stand in a file: one triangle, or both, in any order.
#include <string>
#include <vector>

#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// Collects entries and makes the symmetric matrix with both halves. Errors: entries twice, halves
/// that differ, a diagonal that is negative or a penalty.
class SymmetricEntries {
 public:
  /// `what` for messages: "stiffness", "mass".
  SymmetricEntries(TextSource& source, std::string what)
      : source_(source), what_(std::move(what)) {}
  /// Rows and columns count from 0. The place is the last line of the source.
  void add(int row, int column, double value) { add(row, column, value, source_.here()); }
  void add(int row, int column, double value, const FeSource& at);
  std::size_t size() const noexcept { return entries_.size(); }
  /// Largest row or column so far; -1 without entries.
  int last() const noexcept { return last_; }
  /// n x n; `last()` must be less than n. `labels`: of the rows, for messages. With
  /// `whole_diagonal` each row must have its diagonal entry, be it zero.
  SparseMatrix finish(int n, const std::vector<std::string>& labels, bool whole_diagonal);

 private:
  struct Entry {
    int row, column;  // row <= column
    double value;
    int line;  // negative: of the lower half
  };
  bool check(const std::vector<std::string>& labels);

  TextSource& source_;
  std::string what_;
  std::vector<Entry> entries_;
  int last_ = -1;
  int file_ = 0;
};

}  // namespace floatframe
