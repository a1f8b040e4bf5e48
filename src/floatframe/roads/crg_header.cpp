#include "floatframe/roads/crg_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "floatframe/core/printable.hpp"
#include "floatframe/core/text_pieces.hpp"
#include "floatframe/roads/crg_number.hpp"

namespace floatframe {
namespace {

constexpr std::size_t longest = 72;  // characters of a line that count
constexpr double largest = 1e12;
constexpr std::size_t most_channels = 100000;
constexpr const char* formats[] = {"LRFI", "LDFI", "KRBI", "KDBI"};

std::string capitals(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c -= 'a' - 'A';
  return out;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string_view without_comment(std::string_view line) {
  if (line.starts_with('*')) return {};
  return line.substr(0, line.find('!'));
}

std::string shown(std::string_view text) { return "'" + printable(std::string(text)) + "'"; }

}  // namespace

SourceMark CrgHeaderReader::mark(std::size_t column) const {
  return {file_, line_, static_cast<int>(column) + 1};
}

void CrgHeaderReader::fail(ErrorCode code, std::size_t column, const std::string& sentence) const {
  throw InputError(code, mark(column), sentence);
}

bool CrgHeaderReader::take(std::string_view line) {
  ++line_;
  line = line.substr(0, longest);
  if (line.starts_with("$$")) {
    if (!block_.empty())
      fail(ErrorCode::damaged, 0,
           fmt::format("found the end of the header, expected '$', which closes the block ${} of "
                       "line {}",
                       block_, opened_));
    return false;
  }
  if (line.starts_with('$')) {
    block(line);
  } else if (block_ == "KD_DEFINITION") {
    definition(trimmed(without_comment(line)));
  } else if (block_ == "ROAD_CRG" || block_ == "ROAD_CRG_OPTS" || block_ == "ROAD_CRG_MODS") {
    setting(without_comment(line));
  } else if (block_ == "ROAD_CRG_FILE" && !trimmed(without_comment(line)).empty()) {
    fail(ErrorCode::unsupported, 0,
         "found a reference to another file in $ROAD_CRG_FILE, expected the data in this one");
  }
  return true;
}

void CrgHeaderReader::block(std::string_view line) {
  const std::string name = capitals(trimmed(line.substr(1, line.find_first_of(" !\t\r", 1) - 1)));
  if (name.empty()) {
    if (block_.empty())
      fail(ErrorCode::damaged, 0, "found '$' outside of a block, expected $ and the name of one");
    block_.clear();
    return;
  }
  if (block_ == "CT") return;  // a comment
  if (!block_.empty())
    fail(ErrorCode::damaged, 0,
         fmt::format("found {}, expected '$', which closes the block ${} of line {}",
                     shown(trimmed(line)), block_, opened_));
  block_ = name;
  opened_ = line_;
}

void CrgHeaderReader::definition(std::string_view line) {
  if (line.starts_with("#:")) {
    const std::string word = capitals(trimmed(line.substr(2)));
    const auto it = std::find(std::begin(formats), std::end(formats), word);
    if (it == std::end(formats))
      fail(ErrorCode::unsupported, 2,
           "found the data format " + shown(word) + ", expected LRFI, LDFI, KRBI or KDBI");
    header_.format = static_cast<CrgFormat>(it - std::begin(formats));
    formatted_ = true;
  } else if (line.starts_with("D:")) {
    if (header_.channels.size() == most_channels)
      fail(ErrorCode::too_large, 0,
           fmt::format("found more than {} channels, which are not read", most_channels));
    channel(line.substr(2));
  } else if (line.starts_with("U:")) {
    independent(line.substr(2));
  }
}

void CrgHeaderReader::channel(std::string_view line) {
  using What = CrgChannel::What;
  const std::vector<std::string> parts = pieces_of(std::string(line), ',');
  const std::string name(trimmed(parts[0]));
  const std::string unit(parts.size() > 1 ? trimmed(parts[1]) : std::string_view());
  CrgChannel c{What::other, name, 0.0, mark(2)};
  const char* expected = "";
  constexpr std::string_view section = "long section ", position = "at v =";
  if (name == "reference line phi") {
    c.what = What::heading;
    expected = "rad";
  } else if (name == "reference line slope" || name == "reference line banking") {
    c.what = name == "reference line slope" ? What::slope : What::banking;
    expected = "m/m";
  } else if (name.starts_with(section)) {
    c.what = What::height;
    expected = "m";
    std::string_view rest = trimmed(std::string_view(name).substr(section.size()));
    const bool at = rest.starts_with(position);
    if (at) rest = trimmed(rest.substr(position.size()));
    const bool first = std::ranges::none_of(
        header_.channels, [](const CrgChannel& other) { return other.what == What::height; });
    if (!first && at != header_.by_position)
      fail(ErrorCode::contradiction, 2,
           "found long sections by number and by position, expected one of them");
    header_.by_position = at;
    const auto number = crg_number(rest);
    if (!number)
      fail(ErrorCode::not_a_number, 2,
           "found " + shown(name) + ", expected 'long section' and its number or 'at v =' and v");
    c.number = *number;
  } else if (name == "reference line x" || name == "reference line y" ||
             name == "reference line u") {
    fail(ErrorCode::unsupported, 2,
         "found the channel " + shown(name) +
             ", expected the line by its heading, 'reference line "
             "phi'");
  } else {
    channels_.push_back(name);
  }
  if (unit != expected && c.what != What::other)
    fail(ErrorCode::wrong_value, 2,
         fmt::format("found the unit {} of '{}', expected {}", shown(unit), name, expected));
  const bool again = std::ranges::any_of(header_.channels, [&](const CrgChannel& other) {
    return other.what == c.what && other.number == c.number && c.what != What::other;
  });
  if (again && c.what != What::height)
    fail(ErrorCode::duplicate, 2, "found the channel " + shown(name) + " twice");
  header_.channels.push_back(std::move(c));
}

void CrgHeaderReader::independent(std::string_view line) {
  const std::vector<std::string> parts = pieces_of(std::string(line), ',');
  if (trimmed(parts[0]) != "reference line u" || parts.size() < 4) return;
  header_.start = crg_number(trimmed(parts[2]));
  header_.step = crg_number(trimmed(parts[3]));
  if (!header_.start || !header_.step || !(*header_.step > 0.0))
    fail(
        ErrorCode::not_a_number, 2,
        "found " + shown(line) + ", expected 'reference line u,m,START,STEP' with a positive step");
}

void CrgHeaderReader::setting(std::string_view line) {
  if (trimmed(line).empty()) return;
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos)
    fail(ErrorCode::wrong_value, 0, "found " + shown(trimmed(line)) + ", expected NAME = number");
  const std::string key = capitals(trimmed(line.substr(0, equals)));
  const std::size_t column = std::min(line.find_first_not_of(" \t", equals + 1), line.size());
  if (block_ == "ROAD_CRG_MODS") {
    modifiers_.push_back(key);
    return;
  }
  const auto number = crg_number(trimmed(line.substr(equals + 1)));
  if (!number)
    fail(ErrorCode::not_a_number, column,
         fmt::format("found {} for {}, expected a number", shown(trimmed(line.substr(equals + 1))),
                     printable(key)));
  if (std::abs(*number) > largest)
    fail(ErrorCode::out_of_range, column,
         fmt::format("found {:g} for {}, expected at most {:g}", *number, printable(key), largest));
  if (block_ == "ROAD_CRG_OPTS") return option(key, *number, column);
  if (!header_.road.emplace(key, std::pair(*number, mark(column))).second)
    fail(ErrorCode::duplicate, 0, "found " + printable(key) + " twice in $ROAD_CRG");
}

void CrgHeaderReader::option(const std::string& key, double x, std::size_t column) {
  if (key == "BORDER_MODE_U" || key == "BORDER_MODE_V") {
    if (!(x >= 0.0 && x <= 4.0) || x != std::floor(x))
      fail(ErrorCode::wrong_value, column,
           fmt::format("found {:g} for {}, expected 0, 1, 2, 3 or 4", x, key));
    CrgEdge& edge = key.back() == 'U' ? header_.edge_u : header_.edge_v;
    edge.mode = static_cast<CrgBorder>(std::lround(x));
  } else if (key == "BORDER_OFFSET_U") {
    header_.edge_u.offset = x;
  } else if (key == "BORDER_OFFSET_V") {
    header_.edge_v.offset = x;
  } else {
    options_.push_back(key);
  }
}

CrgHeader CrgHeaderReader::finish() {
  const auto missing = [&](const char* what) {
    throw InputError(ErrorCode::missing, {file_, line_, 0},
                     fmt::format("found a header without {}", what));
  };
  if (!formatted_) missing("a data format, expected $KD_DEFINITION with #:LRFI or another one");
  const auto sections = std::ranges::count_if(
      header_.channels, [](const CrgChannel& c) { return c.what == CrgChannel::What::height; });
  if (sections < 2) missing("two long sections, expected D:long section 1,m and more");
  const auto note = [&](const char* what, const std::vector<std::string>& names,
                        const char* sentence) {
    if (!names.empty())
      header_.notes.push_back(fmt::format("{} {} {}", what, names_text(names, 5), sentence));
  };
  note("the modifiers of the header are not applied:", modifiers_,
       "(the road is as its numbers say; scale and move it before, or use 'begin')");
  note("the options of the header are not applied:", options_, "");
  note("the channels of the file are not used:", channels_, "");
  for (std::string& text : header_.notes)
    while (text.ends_with(' ')) text.pop_back();
  return std::move(header_);
}

}  // namespace floatframe
