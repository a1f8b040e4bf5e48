#include "floatframe/formats/body_file/npy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>

#include "floatframe/core/code_points.hpp"
#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory");

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t alignment = 64;  // of the values, as NumPy writes them

template <class... Args>
[[noreturn]] void fail(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
  throw InputError(code, fmt::format(text, std::forward<Args>(args)...));
}

std::size_t count_of(const std::vector<std::size_t>& shape) {
  std::size_t n = 1;
  for (const std::size_t k : shape) {
    if (k != 0 && n > std::numeric_limits<std::size_t>::max() / 16 / k)
      fail(ErrorCode::wrong_count, "found the shape {}, expected fewer values", shape_text(shape));
    n *= k;
  }
  return n;
}

/// The header is a Python dictionary of three known keys; any order, any blanks.
class Header {
 public:
  explicit Header(std::string_view text) : text_(text) {
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr")
        descr = quoted();
      else if (key == "fortran_order")
        fortran = truth();
      else if (key == "shape")
        shape = tuple();
      else
        damaged();
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    if (!descr || !fortran || !shape) damaged();
  }
  std::optional<std::string> descr;
  std::optional<bool> fortran;
  std::optional<std::vector<std::size_t>> shape;

 private:
  [[noreturn]] void damaged() const {
    fail(ErrorCode::damaged, "found a damaged header, expected descr, fortran_order and shape");
  }
  void blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  bool accept(char c) {
    blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) damaged();
  }
  std::string quoted() {
    blanks();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '\'' && quote != '"') damaged();
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) damaged();
    const std::string out(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return out;
  }
  bool truth() {
    blanks();
    for (const std::string_view word : {"True", "False"})
      if (text_.substr(at_, word.size()) == word) {
        at_ += word.size();
        return word == "True";
      }
    damaged();
  }
  std::vector<std::size_t> tuple() {
    std::vector<std::size_t> out;
    expect('(');
    while (!accept(')')) {
      blanks();
      const std::size_t first = at_;
      std::size_t n = 0;
      for (; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9'; ++at_) {
        if (at_ - first > 17) damaged();
        n = 10 * n + static_cast<std::size_t>(text_[at_] - '0');
      }
      if (at_ == first || out.size() >= 8) damaged();
      out.push_back(n);
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
    return out;
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

/// From Fortran order (the first index runs fastest) to C order.
template <class T>
std::vector<T> reordered(const std::vector<T>& in, const std::vector<std::size_t>& shape) {
  std::vector<T> out(in.size());
  std::vector<std::size_t> index(shape.size(), 0);
  for (std::size_t k = 0; k < in.size(); ++k) {
    std::size_t c = 0;
    for (std::size_t d = 0; d < shape.size(); ++d) c = c * shape[d] + index[d];
    out[c] = in[k];
    for (std::size_t d = 0; d < shape.size() && ++index[d] == shape[d]; ++d) index[d] = 0;
  }
  return out;
}

template <class T>
NpyArray values(std::string_view bytes, const Header& header) {
  const std::size_t n = count_of(*header.shape);
  if (bytes.size() != n * sizeof(T))
    fail(ErrorCode::wrong_count, "found {} bytes of values, expected {} for the shape {}",
         bytes.size(), n * sizeof(T), shape_text(*header.shape));
  std::vector<T> out(n);
  if (n > 0) std::memcpy(out.data(), bytes.data(), bytes.size());
  if (*header.fortran && header.shape->size() > 1) out = reordered(out, *header.shape);
  return {*header.shape, std::move(out)};
}

/// The bytes before the values.
std::string beginning(const std::string& type, const std::vector<std::size_t>& sizes) {
  std::string shape;
  for (const std::size_t n : sizes) shape += fmt::format("{}, ", n);
  // NumPy writes (3,) but (3, 4).
  if (sizes.size() == 1) shape.pop_back();
  if (sizes.size() > 1) shape.resize(shape.size() - 2);
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
  const std::size_t before = magic.size() + 4;
  header.append(alignment - (before + header.size() + 1) % alignment, ' ');
  header += '\n';
  std::string out(magic);
  out += '\1';
  out += '\0';
  out += static_cast<char>(header.size() & 0xff);
  out += static_cast<char>(header.size() >> 8);
  return out + header;
}

}  // namespace

std::string shape_text(const std::vector<std::size_t>& shape) {
  if (shape.empty()) return "one number";
  if (shape.size() == 1) return fmt::format("a list of {}", shape[0]);
  return fmt::format("{}", fmt::join(shape, " x "));
}

std::string npy_bytes(const NpyArray& array) {
  const char* descr[] = {"<f8", "<i4", "<i8"};
  std::string out = beginning(descr[array.values.index()], array.shape);
  std::visit(
      [&](const auto& v) {
        if (!v.empty())
          out.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(v.front()));
      },
      array.values);
  return out;
}

std::string npy_texts(const std::vector<std::string>& texts) {
  std::vector<std::u32string> wide;
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    wide.push_back(code_points(text));
    longest = std::max(longest, wide.back().size());
  }
  std::string out = beginning(fmt::format("<U{}", longest), {texts.size()});
  for (std::u32string& text : wide) {
    text.resize(longest, U'\0');
    out.append(reinterpret_cast<const char*>(text.data()), 4 * longest);
  }
  return out;
}

namespace {

/// The header, and the bytes of the values.
std::pair<Header, std::string_view> npy_parts(std::string_view bytes) {
  if (bytes.substr(0, magic.size()) != magic || bytes.size() < magic.size() + 6)
    fail(ErrorCode::wrong_file, "found no array, expected the .npy format of NumPy");
  const auto byte = [&](std::size_t k) -> std::size_t {
    return static_cast<unsigned char>(bytes[k]);
  };
  const std::size_t version = byte(6);
  if (version < 1 || version > 3)
    fail(ErrorCode::out_of_range, "found version {} of the .npy format, expected 1 to 3", version);
  std::size_t length = byte(8) | byte(9) << 8, start = 10;
  if (version > 1) {
    length |= byte(10) << 16 | byte(11) << 24;
    start = 12;
  }
  if (length > bytes.size() - start)
    fail(ErrorCode::damaged, "found {} bytes of a header of {}: the array is truncated",
         bytes.size() - start, length);
  return {Header(bytes.substr(start, length)), bytes.substr(start + length)};
}

}  // namespace

std::vector<std::string> read_npy_texts(std::string_view bytes) {
  const auto [header, rest] = npy_parts(bytes);
  const std::size_t n = count_of(*header.shape);
  std::size_t longest = 0;
  const std::string& type = *header.descr;
  if (type.starts_with("<U")) std::from_chars(type.data() + 2, type.data() + type.size(), longest);
  if (longest == 0 || longest > 10000)
    fail(ErrorCode::wrong_value, "found values of the type '{}', expected texts (<U)",
         type.substr(0, 20));
  if (rest.size() != 4 * longest * n)
    fail(ErrorCode::wrong_count, "found {} bytes of values, expected {} for the shape {}",
         rest.size(), 4 * longest * n, shape_text(*header.shape));
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < n; ++k) {
    std::u32string wide(longest, U'\0');
    std::memcpy(wide.data(), rest.data() + 4 * longest * k, 4 * longest);
    texts.push_back(utf8_of(wide.substr(0, wide.find(U'\0'))));
  }
  return texts;
}

NpyArray read_npy(std::string_view bytes) {
  const auto [header, rest] = npy_parts(bytes);
  if (*header.descr == "<f8") return values<double>(rest, header);
  if (*header.descr == "<i4") return values<std::int32_t>(rest, header);
  if (*header.descr == "<i8") return values<std::int64_t>(rest, header);
  fail(ErrorCode::wrong_value,
       "found values of the type '{}', expected <f8, <i4 or <i8 (little-endian doubles and "
       "integers)",
       header.descr->substr(0, 20));
}

}  // namespace floatframe
