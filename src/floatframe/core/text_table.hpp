#pragma once
// Aligned columns of text for the terminal.
#include <string>
#include <vector>

namespace floatframe {

/// The first column is aligned to the left, the others to the right unless `left` names them.
/// Widths count characters of UTF-8 text.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header, std::vector<std::size_t> left = {});
  void add(std::vector<std::string> row);
  bool empty() const noexcept { return rows_.size() <= 1; }
  /// Each line starts with `indent` blanks and ends with a line break, without trailing blanks.
  std::string text(std::size_t indent = 0) const;

 private:
  std::vector<std::size_t> left_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace floatframe
