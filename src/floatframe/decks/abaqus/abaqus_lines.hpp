#pragma once
// The lines of an Abaqus or CalculiX deck: keyword lines with parameters, data lines, comments,
// continuation lines and *INCLUDE. Keywords, parameters and names do not depend on case or blanks.
//
// Abaqus and CalculiX have the same keywords, but not always the same meaning: the number of a
// round beam section is its radius in Abaqus and its diameter in CalculiX. Features of only one of
// the two programs identify the program of the deck.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

struct AbaqusKeyword {
  struct Parameter {
    std::string name;   ///< upper case without blanks: "REFNODE"
    std::string value;  ///< as written, trimmed; empty for a flag
  };
  std::string name;   ///< upper case without blanks: "SOLIDSECTION"
  std::string shown;  ///< for messages: "*SOLID SECTION"
  std::vector<Parameter> parameters;
  FeSource at;

  bool has(std::string_view parameter) const noexcept;
  /// Value of a parameter; empty if it is missing.
  std::string_view value(std::string_view parameter) const noexcept;
};

/// A name as Abaqus compares it: upper case without blanks, or between quotes as it is.
std::string abaqus_name(std::string_view text);

class AbaqusLines {
 public:
  explicit AbaqusLines(TextSource& source) : source_(source) {}

  /// The next keyword line; data lines before it are skipped. False at the end of the deck.
  bool next_keyword(AbaqusKeyword& keyword);
  /// The next data line of the present keyword, trimmed; false at the end.
  bool next_data(std::string_view& line);
  TextSource& source() noexcept { return source_; }

 private:
  bool next_line(std::string_view& line);
  void parse_keyword(std::string_view line, AbaqusKeyword& keyword);

  TextSource& source_;
};

// Keywords that are not read, in upper case without blanks. Those in neither list may
// change stiffness, mass or constraints.
/// Alternative to a keyword that is rejected; null if it is unknown.
const char* advice_for_abaqus(const std::string& name);
/// Does it change neither stiffness nor mass nor constraints of a linear part?
bool is_harmless_in_abaqus(const std::string& name);

/// The first thing found in a deck that only Abaqus has, and the first that only CalculiX has.
struct DialectClues {
  struct Clue {
    std::string what;  ///< "*PART"
    FeSource at;
  };
  std::optional<Clue> abaqus, calculix;
  /// SYSTEM=Z RECTANGULAR is of Abaqus too, but CalculiX reads it as RECTANGULAR without a message.
  std::optional<Clue> axes;
  bool by_axes = false;  ///< the only evidence of the program of the deck

  void add(DeckDialect of, std::string what, const FeSource& at);
  /// Checks a keyword, in a step or before it, and its parameters.
  void look_at(const AbaqusKeyword& keyword);
  /// Checks a type of elements.
  void look_at_type(const std::string& type, const FeSource& at);
  /// The whole deck has been checked.
  void settle();
};

}  // namespace floatframe
