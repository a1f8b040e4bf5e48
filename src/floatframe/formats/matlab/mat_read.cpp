#include "floatframe/formats/matlab/mat_read.hpp"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <optional>

#include "floatframe/core/code_points.hpp"
#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_mat_bytes = std::size_t{1} << 28;  // of a variable, not compressed

[[noreturn]] void mat_damaged() {
  throw InputError(ErrorCode::damaged, "the MATLAB file is damaged");
}

template <class T>
T mat_value(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < sizeof(T)) mat_damaged();
  T x;
  std::memcpy(&x, bytes.data() + at, sizeof(T));
  return x;
}

struct MatElement {
  std::uint32_t type = 0;
  std::string_view content;
};

/// Elements in their order.
class MatStream {
 public:
  explicit MatStream(std::string_view bytes) : rest_(bytes) {}
  bool empty() const { return rest_.empty(); }
  MatElement next() {
    const auto first = mat_value<std::uint32_t>(rest_, 0);
    if (first >> 16 != 0) return take(first & 0xffff, 4, first >> 16, 8);
    const auto size = mat_value<std::uint32_t>(rest_, 4);
    const std::size_t filled = first == 15 ? size : (std::size_t{size} + 7) / 8 * 8;
    return take(first, 8, size, 8 + filled);
  }

 private:
  MatElement take(std::uint32_t type, std::size_t start, std::size_t size, std::size_t all) {
    if (start + size > rest_.size()) mat_damaged();
    const MatElement element{type, rest_.substr(start, size)};
    rest_.remove_prefix(std::min(all, rest_.size()));
    return element;
  }
  std::string_view rest_;
};

std::string inflated(std::string_view packed) {
  z_stream z{};
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  z.avail_in = static_cast<uInt>(packed.size());
  if (inflateInit(&z) != Z_OK) mat_damaged();
  std::string out;
  int state = Z_OK;
  while (state == Z_OK && out.size() < most_mat_bytes) {
    const std::size_t had = out.size();
    out.resize(std::max<std::size_t>(1 << 16, 2 * had));
    z.next_out = reinterpret_cast<Bytef*>(out.data() + had);
    z.avail_out = static_cast<uInt>(out.size() - had);
    state = inflate(&z, Z_NO_FLUSH);
    out.resize(out.size() - z.avail_out);
    if (z.avail_in == 0 && state == Z_BUF_ERROR) break;
  }
  inflateEnd(&z);
  if (state == Z_OK)
    throw InputError(ErrorCode::too_large, "a variable of the MATLAB file has more than 256 MB");
  if (state != Z_STREAM_END) mat_damaged();
  return out;
}

template <class T>
std::vector<double> mat_numbers_as(std::string_view bytes) {
  std::vector<double> out;
  for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T))
    out.push_back(static_cast<double>(mat_value<T>(bytes, at)));
  return out;
}

std::vector<double> mat_numbers(const MatElement& e) {
  switch (e.type) {
    case 1:
      return mat_numbers_as<std::int8_t>(e.content);
    case 2:
    case 16:  // UTF-8: of texts without others than ASCII
      return mat_numbers_as<std::uint8_t>(e.content);
    case 3:
      return mat_numbers_as<std::int16_t>(e.content);
    case 4:
    case 17:  // UTF-16
      return mat_numbers_as<std::uint16_t>(e.content);
    case 5:
      return mat_numbers_as<std::int32_t>(e.content);
    case 6:
      return mat_numbers_as<std::uint32_t>(e.content);
    case 7:
      return mat_numbers_as<float>(e.content);
    case 9:
      return mat_numbers_as<double>(e.content);
    case 12:
      return mat_numbers_as<std::int64_t>(e.content);
    case 13:
      return mat_numbers_as<std::uint64_t>(e.content);
    default:
      mat_damaged();
  }
}

/// The rows of a matrix of UTF-16, without blanks at their ends.
std::vector<std::string> mat_texts(const MatX& M) {
  std::vector<std::string> out;
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    std::u32string text;
    for (Eigen::Index j = 0; j < M.cols(); ++j) {
      const auto unit = static_cast<char32_t>(M(i, j));
      const bool low = unit >= 0xdc00 && unit < 0xe000 && !text.empty() && text.back() >= 0xd800 &&
                       text.back() < 0xdc00;
      if (low)
        text.back() = 0x10000 + ((text.back() - 0xd800) << 10) + (unit - 0xdc00);
      else
        text += unit;
    }
    while (!text.empty() && (text.back() == U' ' || text.back() == U'\0')) text.pop_back();
    out.push_back(utf8_of(text));
  }
  return out;
}

/// None: of another class.
std::optional<MatVariable> mat_variable(std::string_view content, bool in_cell = false) {
  MatStream stream(content);
  const auto flags = mat_value<std::uint32_t>(stream.next().content, 0);
  const std::string_view sizes = stream.next().content;
  const std::uint32_t kind = flags & 0xff;
  const bool numbers = kind >= 6 && kind <= 15, text = kind == 4, cell = kind == 1 && !in_cell;
  if (sizes.size() != 8 || !(numbers || text || cell)) return std::nullopt;
  const Eigen::Index rows = mat_value<std::int32_t>(sizes, 0),
                     columns = mat_value<std::int32_t>(sizes, 4);
  if (rows < 0 || columns < 0) mat_damaged();
  MatVariable out{std::string(stream.next().content), {}};
  if (cell) {
    std::vector<std::string> texts;
    while (!stream.empty() && std::ssize(texts) < rows * columns) {
      const auto one = mat_variable(stream.next().content, true);
      const auto* words = one ? std::get_if<std::vector<std::string>>(&one->value) : nullptr;
      if (!words || words->size() > 1) return std::nullopt;
      texts.push_back(words->empty() ? "" : words->front());
    }
    out.value = std::move(texts);
    return out;
  }
  if (flags & 0x0800)
    throw InputError(ErrorCode::unsupported,
                     "found complex numbers in '" + out.name + "', expected real ones");
  const std::vector<double> values =
      rows * columns > 0 ? mat_numbers(stream.next()) : std::vector<double>();
  if (std::ssize(values) != rows * columns) mat_damaged();
  const MatX M = MatX::Map(values.data(), rows, columns);
  if (numbers)
    out.value = M;
  else
    out.value = mat_texts(M);
  return out;
}

}  // namespace

std::vector<MatVariable> read_mat(std::string_view bytes) {
  if (bytes.starts_with("MATLAB 7.3"))
    throw InputError(ErrorCode::unsupported,
                     "found a MATLAB file of version 7.3, expected one that is saved with -v7");
  if (bytes.size() < 128 || bytes.substr(126, 2) != "IM" || bytes[125] != '\1')
    throw InputError(ErrorCode::wrong_file,
                     "found no MATLAB file of level 5 with little-endian numbers");
  std::vector<MatVariable> all;
  MatStream stream(bytes.substr(128));
  while (!stream.empty()) {
    MatElement element = stream.next();
    std::string unpacked;
    if (element.type == 15) {
      unpacked = inflated(element.content);
      element = MatStream(unpacked).next();
    }
    if (element.type != 14) continue;
    if (auto variable = mat_variable(element.content)) all.push_back(std::move(*variable));
  }
  return all;
}

}  // namespace floatframe
