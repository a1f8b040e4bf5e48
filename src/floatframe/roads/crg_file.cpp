#include "floatframe/roads/crg_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>

#include "floatframe/core/printable.hpp"
#include "floatframe/roads/crg_header.hpp"
#include "floatframe/roads/crg_number.hpp"
#include "floatframe/roads/crg_source.hpp"

namespace floatframe {
namespace {

using What = CrgChannel::What;
constexpr double shortest = 1e-6;  // step [m]
constexpr double absent = std::numeric_limits<double>::quiet_NaN();

class CrgFileReader {
 public:
  explicit CrgFileReader(CrgSource& source) : source_(source) {}

  CrgRoad read() {
    header();
    columns();
    if (header_.format == CrgFormat::LRFI || header_.format == CrgFormat::LDFI)
      text_rows();
    else
      binary_rows();
    if (rows_ < 2)
      fail(ErrorCode::missing, {source_.name(), line_, 0},
           fmt::format("found {} cross sections, expected at least 2", rows_));
    length();
    course();
    profile();
    if (filled_ > 0)
      note(fmt::format("{} heights are missing; the last one of their cross section is taken",
                       filled_));
    trim(road_.singles);
    trim(road_.doubles);
    return std::move(road_);
  }

 private:
  [[noreturn]] void fail(ErrorCode code, SourceMark mark, const std::string& sentence) const {
    throw InputError(code, std::move(mark), sentence);
  }
  void note(std::string sentence) { road_.notes.push_back(std::move(sentence)); }
  double value(const char* key, double fallback) const {
    return header_.value(key).value_or(fallback);
  }

  void header() {
    CrgHeaderReader reader(source_.name());
    for (bool more = true; more;) {
      const auto line = source_.line();
      if (!line)
        fail(ErrorCode::damaged, {source_.name(), reader.line(), 0},
             "found the end of the file within the header, expected $$ and numbers");
      more = reader.take(*line);
    }
    line_ = reader.line();
    header_ = reader.finish();
    road_.notes = std::move(header_.notes);
    road_.edge_u = header_.edge_u;
    road_.edge_v = header_.edge_v;
    step_ = header_.step.value_or(value("REFERENCE_LINE_INCREMENT", 0.01));
    if (!(step_ >= shortest))
      fail(ErrorCode::out_of_range,
           header_.step ? SourceMark{source_.name(), 0, 0}
                        : header_.mark("REFERENCE_LINE_INCREMENT"),
           fmt::format("found {:g} m between cross sections, expected at least 1e-6 m", step_));
  }

  void columns() {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < header_.channels.size(); ++k)
      if (header_.channels[k].what == What::height)
        order.emplace_back(header_.channels[k].number, k);
    std::ranges::sort(order);
    for (const auto& [number, k] : order) order_.push_back(k);
    for (std::size_t k = 1; k < order.size(); ++k)
      if (order[k].first - order[k - 1].first < shortest)
        fail(ErrorCode::duplicate, header_.channels[order[k].second].mark,
             "found the channel '" + printable(header_.channels[order[k].second].name) + "' twice");
    if (header_.by_position) {
      for (const auto& [v, k] : order) road_.v.push_back(v);
      const double first = road_.v[1] - road_.v[0];
      for (std::size_t k = 1; k < road_.v.size(); ++k)
        if (std::abs(road_.v[k] - road_.v[k - 1] - first) > 1e-9 * first) road_.uniform = false;
      return;
    }
    for (std::size_t k = 0; k < order.size(); ++k)
      if (order[k].first != k + 1.0)
        fail(ErrorCode::wrong_value, header_.channels[order[k].second].mark,
             fmt::format("found the long section {:g}, expected {}: they are numbered from 1 on",
                         order[k].first, k + 1));
    across(std::ssize(order) - 1.0);
  }

  /// Equally spaced columns, `steps` between them.
  void across(double steps) {
    const auto right = header_.value("LONG_SECTION_V_RIGHT"),
               left = header_.value("LONG_SECTION_V_LEFT");
    if (right && left && *right >= *left)
      fail(ErrorCode::contradiction, header_.mark("LONG_SECTION_V_RIGHT"),
           fmt::format("found {:g} m, expected less than LONG_SECTION_V_LEFT, {:g} m", *right,
                       *left));
    const auto given = header_.value("LONG_SECTION_V_INCREMENT");
    const double h = given ? *given : right && left ? (*left - *right) / steps : 0.01;
    if (!(h >= shortest))
      fail(ErrorCode::out_of_range,
           header_.mark(given ? "LONG_SECTION_V_INCREMENT" : "LONG_SECTION_V_LEFT"),
           fmt::format("found {:g} m between long sections, expected at least 1e-6 m", h));
    if (right && left && std::abs(*right + steps * h - *left) > 0.01 * h)
      fail(ErrorCode::contradiction, header_.mark("LONG_SECTION_V_INCREMENT"),
           fmt::format("found {} long sections every {:g} m from {:g} m to {:g} m, expected {:.6g}",
                       steps + 1.0, h, *right, *left, (*left - *right) / h + 1.0));
    const double first = right ? *right : left ? *left - steps * h : -0.5 * steps * h;
    for (std::size_t k = 0; k < order_.size(); ++k) road_.v.push_back(first + h * k);
  }

  void text_rows() {
    const std::size_t width = header_.format == CrgFormat::LRFI ? 10 : 20, most = 80 / width;
    const std::size_t count = header_.channels.size();
    std::vector<double> row(count);
    std::vector<int> lines(count);
    for (;;) {
      const std::uint64_t before = source_.left();
      for (std::size_t k = 0; k < count; k += most) {
        const auto line = source_.line();
        ++line_;
        if (!line || (k == 0 && line->find_first_not_of(' ') == std::string_view::npos)) {
          if (k > 0)
            fail(ErrorCode::damaged, {source_.name(), line_, 0},
                 fmt::format("found the end of the file after {} of the {} numbers of a cross "
                             "section",
                             k, count));
          if (line) end_of_text();
          return;
        }
        const std::size_t end = std::min(k + most, count);
        for (std::size_t j = k; j < end; lines[j++] = line_)
          row[j] = field(*line, (j - k) * width, width);
        nothing_behind(*line, (end - k) * width);
      }
      if (rows_ == 0) reserve(source_.left() / std::max<std::uint64_t>(before - source_.left(), 1));
      take(row, [&](std::size_t k) {
        return SourceMark{source_.name(), lines[k], static_cast<int>(k % most * width) + 1};
      });
    }
  }

  /// After an empty line nothing may follow.
  void end_of_text() {
    while (const auto line = source_.line()) {
      ++line_;
      if (line->find_first_not_of(' ') != std::string_view::npos)
        fail(ErrorCode::damaged, {source_.name(), line_, 1},
             "found numbers after an empty line, expected none");
    }
  }

  void nothing_behind(std::string_view line, std::size_t end) const {
    if (line.size() <= end || line.find_first_not_of(' ', end) == std::string_view::npos) return;
    fail(ErrorCode::damaged, {source_.name(), line_, static_cast<int>(end) + 1},
         fmt::format("found '{}' behind the last number of the line, expected its end",
                     printable(line.substr(end, 20))));
  }

  double field(std::string_view line, std::size_t begin, std::size_t width) const {
    const SourceMark mark{source_.name(), line_, static_cast<int>(begin) + 1};
    std::string_view text = begin < line.size() ? line.substr(begin, width) : std::string_view();
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos)
      fail(ErrorCode::missing, mark,
           "found no number here, expected one in each " + std::to_string(width) + " characters");
    text = text.substr(first, text.find_last_not_of(' ') - first + 1);
    if (text.find('*') != std::string_view::npos) return absent;
    const auto x = crg_number(text);
    if (!x)
      fail(ErrorCode::not_a_number, mark, "found '" + printable(text) + "', expected a number");
    return *x;
  }

  template <class Float, class Bits>
  void binary_rows_of() {
    const std::size_t count = header_.channels.size();
    reserve(source_.left() / (sizeof(Float) * count));
    std::vector<double> row(count);
    // Rows without a number may be padding: they count if another one follows.
    std::size_t blank = 0, have = 0;
    const auto mark = [&](std::size_t) { return SourceMark{source_.name(), 0, 0}; };
    for (;;) {
      have = 0;
      bool number = false;
      for (std::size_t k = 0; k < count; ++k, ++have) {
        const std::string_view bytes = source_.bytes(sizeof(Float));
        if (bytes.size() < sizeof(Float)) break;
        Bits bits = 0;
        for (const char c : bytes)
          bits = static_cast<Bits>(bits << 8) | static_cast<unsigned char>(c);
        row[k] = std::bit_cast<Float>(bits);
        number = number || !std::isnan(row[k]);
      }
      if (have < count) {
        if (number)
          fail(ErrorCode::damaged, mark(0),
               fmt::format("found {} numbers after cross section {}, expected {} for another one",
                           have, rows_, count));
        return;
      }
      if (!number) {
        ++blank;
      } else if (blank > 0) {
        ++rows_;
        fail(ErrorCode::missing, mark(0),
             fmt::format("found cross section {} without a number, expected heights", rows_));
      } else {
        take(row, mark);
      }
    }
  }

  void binary_rows() {
    if (header_.format == CrgFormat::KRBI)
      binary_rows_of<float, std::uint32_t>();
    else
      binary_rows_of<double, std::uint64_t>();
  }

  void reserve(std::uint64_t rows) {
    const std::uint64_t count = (rows + 1) * order_.size();
    if (header_.format == CrgFormat::KRBI)
      road_.singles.reserve(count);
    else
      road_.doubles.reserve(count);
    for (const CrgChannel& c : header_.channels)
      if (c.what != What::height && c.what != What::other) values_of(c.what).reserve(rows + 1);
  }

  /// Memory that was reserved and never touched is none; to give it back takes a second copy.
  static void trim(auto& heights) {
    if (heights.capacity() - heights.size() > heights.size() / 4) heights.shrink_to_fit();
  }

  std::vector<double>& values_of(What what) {
    return what == What::heading ? heading_ : what == What::slope ? slope_ : road_.banking;
  }

  template <class MarkOf>
  void take(const std::vector<double>& row, const MarkOf& mark_of) {
    ++rows_;
    const auto wrong = [&](std::size_t k, const char* what) {
      fail(ErrorCode::missing, mark_of(k),
           fmt::format("found no number for '{}' in cross section {}, expected {}",
                       printable(header_.channels[k].name), rows_, what));
    };
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (std::isinf(row[k]))
        fail(ErrorCode::not_finite, mark_of(k),
             fmt::format("found an infinite number in cross section {}", rows_));
      const What what = header_.channels[k].what;
      if (what == What::height || what == What::other) continue;
      const bool unused = rows_ == 1 && what != What::banking;
      if (std::isnan(row[k]) && !unused) wrong(k, "one");
      values_of(what).push_back(unused ? 0.0 : row[k]);
    }
    const auto there = [&](std::size_t k) { return !std::isnan(row[k]); };
    const auto first = std::ranges::find_if(order_, there);
    if (first == order_.end()) wrong(order_[0], "a height of at least one long section");
    double z = row[*first];
    for (const std::size_t k : order_) {
      if (there(k))
        z = row[k];
      else
        ++filled_;
      if (header_.format == CrgFormat::KRBI)
        road_.singles.push_back(z);
      else
        road_.doubles.push_back(z);
    }
  }

  // -- the line

  void length() {
    start_ = header_.start.value_or(value("REFERENCE_LINE_START_U", 0.0));
    const auto end = header_.value("REFERENCE_LINE_END_U");
    if (!end) return;
    const double expected = (*end - start_) / step_ + 1.0;
    if (std::abs(expected - rows_) > 0.5)
      fail(ErrorCode::mismatch, header_.mark("REFERENCE_LINE_END_U"),
           fmt::format("found {} cross sections, expected {:.6g}, every {:g} m from {:g} m to {:g} "
                       "m",
                       rows_, expected, step_, start_, *end));
  }

  /// x(k) for each row: from its beginning by steps, and if an end is given, bent so that it ends
  /// there.
  void sum_up(double start, std::optional<double> end, const auto& rise, const auto& x) const {
    const double n = rows_ - 1.0;
    if (end) {
      x(rows_ - 1) = *end;
      for (std::size_t k = rows_ - 1; k > 0; --k) x(k - 1) = x(k) - step_ * rise(k);
    }
    x(0) = start;
    for (std::size_t k = 1; k < rows_; ++k) {
      const double forward = x(k - 1) + step_ * rise(k), share = end ? k / n : 0.0;
      x(k) = end ? (1.0 - share) * forward + share * x(k) : forward;
    }
  }

  void course() {
    const double x = value("REFERENCE_LINE_START_X", 0.0), y = value("REFERENCE_LINE_START_Y", 0.0);
    auto end_x = header_.value("REFERENCE_LINE_END_X"),
         end_y = header_.value("REFERENCE_LINE_END_Y");
    if (!end_x || !end_y) end_x = end_y = std::nullopt;
    const std::size_t steps = rows_ - 1;
    if (heading_.empty()) {
      const double drawn = end_x ? std::atan2(*end_y - y, *end_x - x) : 0.0;
      const double heading = value("REFERENCE_LINE_START_PHI", drawn);
      road_.line = ReferenceLine(start_, step_, steps, {x, y}, heading);
    } else {
      const auto along_x = [&](std::size_t k) { return std::cos(heading_[k]); };
      const auto along_y = [&](std::size_t k) { return std::sin(heading_[k]); };
      std::vector<ReferenceLine::Node> nodes(rows_);
      sum_up(x, end_x, along_x, [&](std::size_t k) -> double& { return nodes[k].x; });
      sum_up(y, end_y, along_y, [&](std::size_t k) -> double& { return nodes[k].y; });
      double gap_x = x, gap_y = y;
      for (std::size_t k = 1; k < rows_; ++k)
        gap_x += step_ * along_x(k), gap_y += step_ * along_y(k);
      ends_apart(gap_x, gap_y, end_x, end_y);
      const double first = heading_[1], last = heading_.back();
      heading_ = std::vector<double>();  // before the line takes memory of its own
      road_.line = ReferenceLine(start_, step_, std::move(nodes), first, last);
      return;
    }
    const ReferenceLine::Node last = road_.line.node(steps);
    ends_apart(last.x, last.y, end_x, end_y);
  }

  void ends_apart(double x, double y, std::optional<double> end_x, std::optional<double> end_y) {
    if (!end_x) return;
    const double gap = std::hypot(x - *end_x, y - *end_y);
    if (gap > 1e-3 && gap > 1e-4 * step_ * rows_)
      note(fmt::format("its headings lead {:.3g} m away from the end that the header gives{}", gap,
                       heading_.empty() ? "; they are taken" : "; the line is bent to end there"));
  }

  void profile() {
    const double z = value("REFERENCE_LINE_START_Z", 0.0), s = value("REFERENCE_LINE_START_S", 0.0);
    road_.line_heights.assign(slope_.empty() && s == 0.0 ? 1 : rows_, z);
    if (road_.line_heights.size() > 1)
      sum_up(
          z, header_.value("REFERENCE_LINE_END_Z"),
          [&](std::size_t k) { return slope_.empty() ? s : slope_[k]; },
          [&](std::size_t k) -> double& { return road_.line_heights[k]; });
    if (road_.banking.empty()) road_.banking.assign(1, value("REFERENCE_LINE_START_B", 0.0));
  }

  CrgSource& source_;
  CrgHeader header_;
  CrgRoad road_;
  std::vector<std::size_t> order_;  ///< channels of the columns, from the right to the left
  std::vector<double> heading_, slope_;
  std::size_t rows_ = 0, filled_ = 0;
  double step_ = 0.0, start_ = 0.0;
  int line_ = 0;
};

CrgRoad road_of(CrgSource& source) {
  try {
    return CrgFileReader(source).read();
  } catch (const std::bad_alloc&) {
    throw InputError(ErrorCode::too_large, {source.name(), 0, 0},
                     "the file needs more memory than is available");
  }
}

}  // namespace

CrgRoad read_crg(const std::filesystem::path& file) {
  CrgSource source(file);
  return road_of(source);
}

CrgRoad read_crg(std::string_view content, const std::string& name) {
  CrgSource source(content, name);
  return road_of(source);
}

}  // namespace floatframe
