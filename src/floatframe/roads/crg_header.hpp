#pragma once
// The header of an OpenCRG file: lines of which the first 72 characters count, in blocks that begin
// with $NAME and end with $; comments follow * or !. A line of $$ ends it, the numbers follow:
//   LRFI, LDFI   text, 10 or 20 characters a number, 80 a line, each row on new lines
//   KRBI, KDBI   IEEE floats or doubles, the most significant byte first, one after the other
// Channels of a row: heights of the long sections, of which some may be absent ("*missing*", NaN)
// and then are those of their right neighbour, or of the first one that is there; heading, slope
// and banking of the line. Heading and slope of row i are those of the step from row i - 1; the
// first ones are unused. The line is summed up from its beginning, and if the header gives its end
// as well, from there too: the mean of both, weighted by the distance, ends where the header says.
//   columns   by number: LONG_SECTION_V_RIGHT, _LEFT, _INCREMENT (0.01 m if none is given, and as
//             far to the left as to the right); or "at v = "
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/roads/crg_road.hpp"

namespace floatframe {

enum class CrgFormat { LRFI, LDFI, KRBI, KDBI };

struct CrgChannel {
  enum class What { heading, slope, banking, height, other } what = What::other;
  std::string name;
  double number = 0.0;  ///< of a height: its number, or its v [m]
  SourceMark mark;
};

struct CrgHeader {
  std::map<std::string, std::pair<double, SourceMark>> road;  ///< $ROAD_CRG, names in capitals
  CrgEdge edge_u, edge_v;                                     ///< $ROAD_CRG_OPTS
  CrgFormat format{};
  std::vector<CrgChannel> channels;
  bool by_position = false;           ///< heights are given "at v = "
  std::optional<double> start, step;  ///< of u, by a definition U: [m]
  std::vector<std::string> notes;
  std::optional<double> value(const std::string& key) const {
    const auto it = road.find(key);
    return it == road.end() ? std::nullopt : std::optional(it->second.first);
  }
  SourceMark mark(const std::string& key) const { return road.at(key).second; }
};

/// Takes the lines of a header one by one.
class CrgHeaderReader {
 public:
  explicit CrgHeaderReader(std::string file) : file_(std::move(file)) {}
  /// A line without its end; false after the last one of the header. Throws InputError.
  bool take(std::string_view line);
  /// After the last line. Throws InputError.
  CrgHeader finish();
  int line() const noexcept { return line_; }

 private:
  SourceMark mark(std::size_t column) const;
  [[noreturn]] void fail(ErrorCode code, std::size_t column, const std::string& sentence) const;
  void block(std::string_view line);
  void definition(std::string_view line);
  void channel(std::string_view line);
  void independent(std::string_view line);
  void setting(std::string_view line);
  void option(const std::string& key, double x, std::size_t column);

  std::string file_, block_;
  CrgHeader header_;
  std::vector<std::string> modifiers_, options_, channels_;
  bool formatted_ = false;
  int line_ = 0, opened_ = 0;
};

}  // namespace floatframe
