#pragma once
// Cards of Nastran bulk data from lines in small field (8 columns), large field (16) or free field
// (commas), with their continuations and includes. A continuation follows its card; if both carry
// marks, these must agree. Of executive and case control before BEGIN BULK only what changes the
// part is kept: PARAM entries come as cards, matrices and sets that are selected are in `control`.
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/formats/nastran/nastran_card.hpp"

namespace floatframe {

/// What the case control selects.
struct NastranControl {
  bool there = false;                              ///< there is more than BEGIN BULK
  std::vector<std::pair<int, FeSource>> mpc, spc;  ///< MPC = n, SPC = n
  /// Commands that add stiffness or mass: "K2GG = STIF".
  std::vector<std::pair<std::string, FeSource>> additions;
  std::optional<FeSource> preload;            ///< STATSUB
  std::vector<std::string> missing_includes;  ///< of the executive control
};

/// What begins the bulk data: BEGIN BULK, or BEGIN SUPER of a punched superelement as well.
enum class NastranBegin { bulk, any };

class NastranCards {
 public:
  /// `has_control`: there is such a line to look for.
  NastranCards(TextSource& source, bool has_control, NastranBegin begin = NastranBegin::bulk);

  /// The next card; false at ENDDATA or at the end of the file.
  bool next(NastranCard& card);

  /// ENDDATA was met.
  bool ended() const { return ended_; }
  const NastranControl& control() const { return control_; }
  /// Names that pre-processors leave in comments, by number.
  const std::map<int, std::string>& property_names() const { return property_names_; }
  const std::map<int, std::string>& material_names() const { return material_names_; }
  const std::map<int, std::string>& set_names() const { return set_names_; }

 private:
  struct Line {
    std::string_view name;  ///< field 1 as it stands
    std::string_view mark;  ///< field 10
    std::vector<std::string_view> data;
    bool large = false;
  };
  bool next_text(std::string_view& text);
  void comment(std::string_view text);
  void split(std::string_view text, Line& line);
  void include(std::string_view text, bool executive);
  bool begins(std::string_view line) const;
  void read_control();
  void command(std::string_view line);

  TextSource& source_;
  NastranBegin begin_;
  bool begun_ = false;  // it was there
  bool ended_ = false;  // so was ENDDATA
  int too_long_ = 0;    // the last line with too many fields
  NastranControl control_;
  std::deque<NastranCard> cards_of_control_;
  std::deque<std::string> expanded_;  // lines of the card that had tabs
  std::map<int, std::string> property_names_, material_names_, set_names_;
};

/// Is there a line BEGIN (BULK, SUPER, ...) in a text or in the beginning of a file?
bool has_begin_bulk(std::string_view text);

}  // namespace floatframe
