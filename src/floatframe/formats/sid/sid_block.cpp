#include "floatframe/formats/sid/sid_block.hpp"

#include <cmath>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Entry m0(row,column) or m1(row,mode,column), counted from 0.
struct Entry {
  int order = 0, row = 0, mode = 0, column = 0;
};

class BlockReader {
 public:
  BlockReader(TextSource& source, const std::string& name, int modes, SidTaylor& block)
      : source_(source), name_(name), modes_(modes), block_(block) {}

  void read() {
    block_.line = source_.here().line;
    block_.m0.setZero();
    block_.m1.clear();
    const std::string end = "end" + name_;
    const std::string wanted = fmt::format("'end {}'", name_);
    while (true) {
      const SidItem item = next_sid_item(source_, wanted.c_str());
      if (item.key == end) break;
      if (!item.has_value)
        source_.stop(ErrorCode::wrong_value, "found {} in block {}, expected {}", shown(item.key),
                     name_, wanted);
      if (item.key.starts_with("m0(") || item.key.starts_with("m1(")) {
        if (sizes_fit_) read_entry(item);
      } else {
        read_header(item);
      }
    }
    if (sizes_fit_) finish();
  }

 private:
  void read_header(const SidItem& item) {
    if (seen0_.size() > 0)
      return source_.error(ErrorCode::wrong_value, "{} of block {} comes after its entries",
                           shown(item.key), name_);
    const auto value = parse_integer(item.value);
    if (!value)
      return source_.error(ErrorCode::not_a_number, "{} of block {}: {}", shown(item.key), name_,
                           not_an_integer(item.value));
    const auto size = [&](Eigen::Index expected, const char* why) {
      if (*value != expected)
        misfit(ErrorCode::wrong_value, "{} is {}, expected {}{}", item.key, *value, expected, why);
    };
    if (item.key == "order") {
      order_ = *value;
      if (order_ < 0 || order_ > 1)
        misfit(ErrorCode::out_of_range, "order is {}, expected 0 or 1", *value);
    } else if (item.key == "nrow") {
      if (name_ == "J" && *value == 3)
        block_.m0 = Mat3::Zero();
      else
        size(block_.m0.rows(), "");
    } else if (item.key == "ncol") {
      if (name_ == "sigma" && *value == 1)
        block_.m0 = Vec6::Zero();
      else
        size(name_ == "J" ? (block_.m0.rows() == 3 ? 3 : 1) : block_.m0.cols(), "");
    } else if (item.key == "nq") {
      if (*value != 0 || order_ == 1) size(modes_, ", the number of modes");
    } else if (item.key == "nqn") {
      size(0, ": terms of second order are not read");
    } else if (item.key == "structure") {
      structure_ = *value;
      if (structure_ < 0 || structure_ > 4)
        misfit(ErrorCode::out_of_range, "structure is {}, expected 0 to 4", *value);
      else if (structure_ == 4 && block_.m0.rows() != block_.m0.cols())
        misfit(ErrorCode::incomplete, "structure 4 (unit matrix) needs a square block, not {} x {}",
               block_.m0.rows(), block_.m0.cols());
    } else {
      source_.error(
          ErrorCode::unknown_key,
          "unknown item {} in block {} (expected order, nrow, ncol, nq, nqn, structure, m0 or m1)",
          shown(item.key), name_);
    }
  }

  /// An error after which entries are not checked.
  template <class... Args>
  void misfit(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
    sizes_fit_ = false;
    source_.error(code, "block {}: {}", name_, fmt::format(text, std::forward<Args>(args)...));
  }

  std::optional<Entry> entry_of(const std::string& key) {
    const std::size_t close = key.find(')');
    std::vector<std::string_view> fields;
    split_commas(std::string_view(key).substr(3, close == std::string::npos ? 0 : close - 3),
                 fields);
    Entry e;
    e.order = key[1] == '1' ? 1 : 0;
    std::vector<int> index;
    for (const std::string_view field : fields)
      index.push_back(parse_integer(field).value_or(0) - 1);
    if (close + 1 != key.size() || index.size() != (e.order == 1 ? 3u : 2u)) {
      source_.error(ErrorCode::wrong_value,
                    "{} in block {} is no entry; expected m0(row,column) or m1(row,mode,column)",
                    shown(key), name_);
      return std::nullopt;
    }
    e.row = index.front();
    e.column = index.back();
    if (e.order == 1) e.mode = index[1];
    if (e.row < 0 || e.row >= block_.m0.rows() || e.column < 0 || e.column >= block_.m0.cols() ||
        e.mode < 0 || (e.order == 1 && e.mode >= modes_)) {
      source_.error(ErrorCode::wrong_count,
                    "{} is outside of block {}, which is {} x {} with {} modes", shown(key), name_,
                    block_.m0.rows(), block_.m0.cols(), modes_);
      return std::nullopt;
    }
    if (e.order == 1 && order_ == 0) {
      source_.error(ErrorCode::contradiction, "{} in block {}, whose order is 0", shown(key),
                    name_);
      return std::nullopt;
    }
    return e;
  }

  void read_entry(const SidItem& item) {
    const auto e = entry_of(item.key);
    if (!e) return;
    const auto value = sid_real(source_, item.value);
    if (!value) return;
    if (structure_ == 0 || structure_ == 4)
      return source_.error(ErrorCode::missing, "{} in block {}, whose structure {} has no entries",
                           shown(item.key), name_, structure_);
    if (structure_ == 1 && e->row != e->column && *value != 0.0)
      return source_.error(ErrorCode::contradiction,
                           "{} in block {}, whose structure 1 is diagonal", shown(item.key), name_);
    if (seen0_.size() == 0) seen0_ = MatX::Zero(block_.m0.rows(), block_.m0.cols());
    if (e->order == 1 && block_.m1.empty()) {
      const std::size_t modes = modes_;
      block_.m1.assign(modes, MatX::Zero(block_.m0.rows(), block_.m0.cols()));
      seen1_ = block_.m1;
    }
    const std::size_t mode = e->mode;
    MatX& values = e->order == 1 ? block_.m1[mode] : block_.m0;
    double& line = (e->order == 1 ? seen1_[mode] : seen0_)(e->row, e->column);
    if (line > 0.0)
      return source_.error(ErrorCode::duplicate,
                           "{} of block {} is in the file twice, first in line {}", shown(item.key),
                           name_, line);
    line = source_.here().line;
    values(e->row, e->column) = *value;
  }

  /// Fills the entries implied by the structure.
  void finish() {
    if (structure_ == 4) block_.m0.setIdentity();
    if (order_ == 1 && block_.m1.empty())
      block_.m1.assign(modes_, MatX::Zero(block_.m0.rows(), block_.m0.cols()));
    if (structure_ != 2 || block_.m0.rows() != block_.m0.cols() || seen0_.size() == 0) return;
    const double scale = block_.m0.cwiseAbs().maxCoeff();
    for (Eigen::Index r = 0; r < block_.m0.rows(); ++r) {
      for (Eigen::Index c = 0; c < r; ++c) {
        double &lower = block_.m0(r, c), &upper = block_.m0(c, r);
        if (seen0_(r, c) == 0.0)
          lower = upper;
        else if (seen0_(c, r) == 0.0)
          upper = lower;
        else if (std::abs(upper - lower) > 1e-6 * scale)
          source_.error(
              ErrorCode::contradiction, {0, static_cast<int>(std::max(seen0_(r, c), seen0_(c, r)))},
              "block {} is symmetric by its structure 2, but m0({},{}) = {} and m0({},{}) = {}",
              name_, r + 1, c + 1, lower, c + 1, r + 1, upper);
      }
    }
  }

  TextSource& source_;
  const std::string& name_;
  int modes_;
  SidTaylor& block_;
  int order_ = 0, structure_ = 3;
  bool sizes_fit_ = true;
  MatX seen0_;  // line of each entry of m0
  std::vector<MatX> seen1_;
};

}  // namespace

std::string without_blanks(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (c != ' ' && c != '\t') out += c;

  return out;
}

SidItem next_sid_item(TextSource& source, const char* wanted) {
  std::string_view text;
  while (source.next(text)) {
    text = trimmed(text);
    if (!text.empty()) break;
  }
  if (text.empty()) source.stop(ErrorCode::damaged, "the file ends where {} was expected", wanted);

  SidItem item;
  const std::size_t equals = text.find('=');
  item.has_value = equals != std::string_view::npos;
  item.key = without_blanks(text.substr(0, equals));
  if (item.has_value) item.value = trimmed(text.substr(equals + 1));
  return item;
}

void expect_sid_item(TextSource& source, const char* key) {
  const std::string words = key == std::string_view("newmodal")  ? "new modal"
                            : key == std::string_view("endpart") ? "end part"
                                                                 : key;
  const SidItem item = next_sid_item(source, fmt::format("'{}'", words).c_str());
  if (item.key != key)
    source.stop(ErrorCode::wrong_value, "found {}, expected '{}'", shown(item.key), words);
}

void skip_sid_block(TextSource& source, const std::string& key) {
  const FeSource begin = source.here();
  const std::string end = "end" + key;
  std::string_view text;
  while (source.next(text))
    if (without_blanks(text) == end) return;

  source.stop(ErrorCode::missing, begin, "{} has no end", shown(key));
}

std::optional<double> sid_real(TextSource& source, std::string_view field) {
  const auto value = parse_real(field);
  if (!value) source.error(ErrorCode::not_a_number, not_a_real(field));
  return value;
}

void read_sid_block(TextSource& source, const std::string& name, int modes, SidTaylor& block) {
  BlockReader(source, name, modes, block).read();
}

}  // namespace floatframe
