#pragma once
// Numbers and texts as bytes, for writing and for reading. One function `pass(s, x)` for each
// struct gives the order of its members for both: with a ByteWriter it stores x, with a ByteReader
// it restores x. Structs are decomposed by structured bindings: after a new member this does not
// compile until it is passed.
//   whole numbers   groups of seven bits, the lowest first
//   doubles         little-endian, bit by bit; only finite ones are read
//   texts           short ones by their number if they have been there before
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/enum_index.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Texts up to this length are written once.
inline constexpr std::size_t longest_shared_text = 64;

class ByteWriter {
 public:
  static constexpr bool reads = false;

  std::uint64_t whole(std::uint64_t n) {
    std::uint64_t rest = n;
    for (; rest >= 128u; rest >>= 7) bytes.push_back(std::byte{std::uint8_t(rest | 128u)});
    bytes.push_back(std::byte{std::uint8_t(rest)});
    return n;
  }
  /// Of things that take `least` bytes each.
  std::uint64_t count(std::uint64_t n, std::size_t /*least*/ = 1) { return whole(n); }
  void reals(double* x, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      doubles.push_back(std::uint32_t(bytes.size()));
      const auto bits = std::bit_cast<std::uint64_t>(x[k]);
      for (int i = 0; i < 8; ++i) bytes.push_back(std::byte(bits >> (8 * i)));
    }
  }
  void singles(float* x, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      const auto bits = std::bit_cast<std::uint32_t>(x[k]);
      for (int i = 0; i < 4; ++i) bytes.push_back(std::byte(bits >> (8 * i)));
    }
  }
  void text(std::string& x) {
    if (x.size() <= longest_shared_text) {
      const auto [it, fresh] = known_.emplace(x, known_.size() + 1);
      whole(fresh ? 0 : it->second);
      if (!fresh) return;
    } else {
      whole(0);
    }
    whole(x.size());
    for (const char c : x) bytes.push_back(std::byte(c));
  }
  void require(bool /*good*/, const char* /*what*/) const {}
  /// Without the texts of formulas, in which numbers of the file stand: two models of the same
  /// structure then differ in their doubles alone.
  bool formula_texts = true;
  /// Texts are written anew from here on.
  void forget() { known_.clear(); }

  std::vector<std::byte> bytes;
  std::vector<std::uint32_t> doubles;  ///< where each begins

 private:
  std::map<std::string, std::uint64_t> known_;
};

/// Takes no more memory than a multiple of the bytes that remain.
class ByteReader {
 public:
  static constexpr bool reads = true;

  explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}
  bool at_end() const { return left_.empty(); }
  std::size_t left() const { return left_.size(); }

  /// Something that the bytes say is not so.
  [[noreturn]] static void damaged(const char* what) {
    throw InputError(ErrorCode::damaged,
                     std::string("found a packed model that is damaged: ") + what);
  }
  static void require(bool good, const char* what) {
    if (!good) damaged(what);
  }

  std::uint64_t whole(std::uint64_t /*n*/ = 0) {
    std::uint64_t n = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      require(!left_.empty(), "it ends too early");
      const auto b = std::to_integer<std::uint64_t>(left_[0]);
      left_ = left_.subspan(1);
      require(shift < 63 || b <= 1, "a number that is too large");
      n |= (b & 127u) << shift;
      if (b < 128u) return n;
    }
    damaged("a number that is too large");
  }
  std::uint64_t count(std::uint64_t /*n*/ = 0, std::size_t least = 1) {
    const std::uint64_t n = whole();
    require(n <= left_.size() / least, "it ends too early");
    return n;
  }
  void reals(double* x, std::size_t n) {
    require(n <= left_.size() / 8, "it ends too early");
    for (std::size_t k = 0; k < n; ++k) {
      std::uint64_t bits = 0;
      if constexpr (std::endian::native == std::endian::little)
        std::memcpy(&bits, left_.data() + 8 * k, 8);
      else
        for (std::size_t i = 0; i < 8; ++i)
          bits |= std::to_integer<std::uint64_t>(left_[8 * k + i]) << (8 * i);
      x[k] = std::bit_cast<double>(bits);
      require(std::isfinite(x[k]), "a number that is not finite");
    }
    left_ = left_.subspan(8 * n);
  }
  void singles(float* x, std::size_t n) {
    require(n <= left_.size() / 4, "it ends too early");
    for (std::size_t k = 0; k < n; ++k) {
      std::uint32_t bits = 0;
      for (std::size_t i = 0; i < 4; ++i)
        bits |= std::to_integer<std::uint32_t>(left_[4 * k + i]) << (8 * i);
      x[k] = std::bit_cast<float>(bits);
      require(std::isfinite(x[k]), "a number that is not finite");
    }
    left_ = left_.subspan(4 * n);
  }
  void text(std::string& x) {
    if (const std::uint64_t known = whole()) {
      require(known <= known_.size(), "a text that has not been there");
      x = known_[known - 1];
      return;
    }
    const std::size_t n = count();
    x.resize(n);
    if (n > 0) std::memcpy(x.data(), left_.data(), n);
    left_ = left_.subspan(n);
    if (n <= longest_shared_text) known_.push_back(x);
  }
  void forget() { known_.clear(); }
  /// Formulas within formulas.
  int depth = 0;

 private:
  std::span<const std::byte> left_;
  std::vector<std::string> known_;
};

// -------------------------------------------------------------------------------------------
// numbers, texts, lists

template <class S, class... T>
void all(S& s, T&... x);

template <class S>
void pass(S& s, double& x) {
  s.reals(&x, 1);
}
template <class S>
void pass(S& s, std::string& x) {
  s.text(x);
}
template <class S>
void pass(S& s, bool& x) {
  const std::uint64_t n = s.whole(x ? 1 : 0);
  s.require(n <= 1, "a flag that is neither set nor not");
  if constexpr (S::reads) x = n == 1;
}
/// 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
template <class S>
void pass(S& s, int& x) {
  const std::int64_t wide = x;
  const std::uint64_t n = s.whole((std::uint64_t(wide) << 1) ^ std::uint64_t(wide >> 63));
  if constexpr (S::reads) {
    s.require(n <= 0xffffffffu, "a number that is too large");
    x = int(std::int64_t(n >> 1) ^ -std::int64_t(n & 1u));
  }
}
template <class S>
void pass(S& s, unsigned& x) {
  const std::uint64_t n = s.whole(x);
  s.require(n <= 0xffffffffu, "a number that is too large");
  if constexpr (S::reads) x = unsigned(n);
}
/// One of the enumerators up to `last`.
template <class S, class Enum>
void pass_word(S& s, Enum& x, Enum last) {
  const std::uint64_t n = s.whole(index_of(x));
  s.require(n <= index_of(last), "a word that does not exist");
  if constexpr (S::reads) x = Enum(n);
}

template <class S, class T>
void pass(S& s, std::vector<T>& x) {
  if constexpr (std::is_same_v<T, double>) {
    const std::size_t n = s.count(x.size(), 8);
    if constexpr (S::reads) x.resize(n);
    s.reals(x.data(), n);
  } else {
    const std::size_t n = s.count(x.size());
    if constexpr (S::reads) x.clear();
    for (std::size_t k = 0; k < n; ++k) {
      if constexpr (S::reads) x.emplace_back();
      pass(s, x[k]);
    }
  }
}
template <class S>
void pass(S& s, std::vector<float>& x) {
  const std::size_t n = s.count(x.size(), 4);
  if constexpr (S::reads) x.resize(n);
  s.singles(x.data(), n);
}
template <class S, class T, std::size_t n>
void pass(S& s, std::array<T, n>& x) {
  for (T& item : x) pass(s, item);
}
template <class S, class T>
void pass(S& s, std::optional<T>& x) {
  bool there = x.has_value();
  pass(s, there);
  if constexpr (S::reads) {
    if (there)
      x.emplace();
    else
      x.reset();
  }
  if (there) pass(s, *x);
}
template <class S, class T>
void pass(S& s, std::map<std::string, T>& x) {
  const std::size_t n = s.count(x.size(), 2);
  if constexpr (S::reads) {
    x.clear();
    for (std::size_t k = 0; k < n; ++k) {
      std::string key;
      pass(s, key);
      pass(s, x.emplace_hint(x.end(), std::move(key), T())->second);
    }
    s.require(x.size() == n, "a name that is there twice");
  } else {
    for (auto& [key, value] : x) {
      std::string name = key;
      all(s, name, value);
    }
  }
}
/// Null, or what it points to.
template <class S, class T>
void pass(S& s, std::shared_ptr<const T>& x) {
  bool there = x != nullptr;
  pass(s, there);
  if constexpr (S::reads) {
    std::shared_ptr<T> made;
    if (there) pass(s, *(made = std::make_shared<T>()));
    x = std::move(made);
  } else if (there) {
    pass(s, const_cast<T&>(*x));  // a writer changes nothing
  }
}

// A matrix: rows and columns as far as its type leaves them open, then columns.
template <class S, int rows, int columns>
void pass(S& s, Eigen::Matrix<double, rows, columns>& x) {
  Eigen::Index r = rows, c = columns;
  const auto size = [&](Eigen::Index n) {
    const std::uint64_t found = s.whole(std::uint64_t(n));
    s.require(found <= 100'000'000u, "a matrix that is too large");
    return Eigen::Index(found);
  };
  if constexpr (rows == Eigen::Dynamic) r = size(x.rows());
  if constexpr (columns == Eigen::Dynamic) c = size(x.cols());
  if constexpr (S::reads) {
    s.require(std::size_t(r) * std::size_t(c) <= s.left() / 8, "it ends too early");
    x.resize(r, c);
  }
  s.reals(x.data(), std::size_t(r) * std::size_t(c));
}

template <class S, class... T>
void all(S& s, T&... x) {
  (pass(s, x), ...);
}

template <class S>
void pass(S& s, SourceMark& x) {
  auto& [file, line, column] = x;
  all(s, file, line, column);
}
template <class S>
void pass(S& s, Origin& x) {
  auto& [mark, keys] = x;
  all(s, mark, keys);
}

}  // namespace floatframe
