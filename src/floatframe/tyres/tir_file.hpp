#pragma once
// Tyre property files (.tir): sections in brackets, lines KEYWORD = value, comments after ! and $,
// words in quotes. Numbers with a unit are turned into SI by the section [UNITS]; the coefficients
// of the formulas have none, or are per radian whatever ANGLE says.
// Tables of other programs ([SHAPE], {radial width}) are ignored, with a note.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

struct TirEntry {
  double number = 0.0;  ///< in SI units
  std::string word;     ///< without quotes, as written; empty for a number
  bool is_word = false;
  SourceMark mark;  ///< of its value
};

struct TirFile {
  SourceMark mark;  ///< the file
  /// By keyword, in capital letters; without those of [UNITS] and [MDI_HEADER].
  std::map<std::string, TirEntry, std::less<>> entries;
  /// What was ignored or assumed, a sentence each.
  std::vector<std::string> notes;

  bool has(std::string_view keyword) const { return entries.find(keyword) != entries.end(); }
  /// The number of a keyword, or what it is if the file does not give it: 1 for scale factors, 0
  /// for most coefficients.
  double number(std::string_view keyword) const;
  /// The word of a keyword in capital letters; empty if the file does not give it.
  std::string word(std::string_view keyword) const;
  /// Place of its value; that of the file if it does not give it.
  const SourceMark& place(std::string_view keyword) const;
};

/// Reads a file of at most 1 MiB. Throws InputError with file, line and column for each error:
/// lines that are no KEYWORD = value, numbers that are none, units that are unknown, keywords that
/// are given twice with different values, ranges whose ends are exchanged.
TirFile read_tir(const std::string& path);
/// Its text, as `parse_tir` takes it.
std::string tir_text(const std::string& path);
/// The same of its text; `path` is the name of the file in errors.
TirFile parse_tir(std::string_view text, const std::string& path);

/// True for the keywords that may stand in [SCALING_COEFFICIENTS]: "LMUY".
bool is_tir_scale(std::string_view keyword);
/// Their names, for messages.
std::vector<std::string> tir_scales();

}  // namespace floatframe
