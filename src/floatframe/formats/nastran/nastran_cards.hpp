#pragma once
// Cards of Nastran bulk data from lines in small field (8 columns), large field (16) or free field
// (commas), with their continuations and includes. A continuation follows its card; if both carry
// marks, these must agree. Of executive and case control before BEGIN BULK only what changes the
// part is kept: PARAM entries come as cards, matrices and sets that are selected are in `control`.
#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// A name and fields.
struct NastranCard {
  std::string name;                      ///< upper case, without '*'
  std::vector<std::string_view> fields;  ///< trimmed, from field 2; those of continuations follow
  FeSource at;
  /// First field of each continuation and its location.
  std::vector<std::pair<std::size_t, FeSource>> continuations;

  /// Location of a field.
  FeSource place(std::size_t i) const {
    const auto next = std::upper_bound(continuations.begin(), continuations.end(), i,
                                       [](std::size_t k, const auto& c) { return k < c.first; });
    return next == continuations.begin() ? at : std::prev(next)->second;
  }
  std::string_view field(std::size_t i) const {
    return i < fields.size() ? fields[i] : std::string_view{};
  }
};

/// Selections of the case control.
struct NastranControl {
  bool there = false;                              ///< there is more than BEGIN BULK
  std::vector<std::pair<int, FeSource>> mpc, spc;  ///< MPC = n, SPC = n
  /// Commands that add stiffness or mass: "K2GG = STIF".
  std::vector<std::pair<std::string, FeSource>> additions;
  std::optional<FeSource> preload;            ///< STATSUB
  std::vector<std::string> missing_includes;  ///< of the executive control
};

/// Names that pre-processors leave in comments, by number.
struct NastranNames {
  std::map<int, std::string> properties, materials, sets;
};

/// Start of the bulk data: BEGIN BULK, or BEGIN SUPER of a punched superelement as well.
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
  const NastranNames& names() const { return names_; }

 private:
  struct Line {
    std::string_view name;  ///< field 1 as written
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
  NastranNames names_;
};

/// The name that a line of bulk data begins with.
std::string_view card_name(std::string_view line) noexcept;
/// Is there a line BEGIN (BULK, SUPER, ...) in a text or in the beginning of a file?
bool has_begin_bulk(std::string_view text);

}  // namespace floatframe
