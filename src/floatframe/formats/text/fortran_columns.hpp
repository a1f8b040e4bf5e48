#pragma once
// Lines in the columns of a Fortran format.
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace floatframe {

/// (3i9,6e21.13e3) is 'i' 9 three times, then 'e' 21 six times; a scale factor (1P) is ignored.
struct FortranColumns {
  std::vector<std::pair<char, int>> columns;  ///< kind in lower case, width
  std::size_t integers() const noexcept;      ///< columns 'i' at the beginning
  /// The cells of a line, trimmed; those that the line does not reach are not there. What is left
  /// of the line behind the last column.
  std::string_view split(std::string_view line, std::vector<std::string_view>& cells) const;
};

/// Nothing if the text is no format of whole numbers, reals and texts with their widths.
std::optional<FortranColumns> parse_fortran_columns(std::string_view text);

}  // namespace floatframe
