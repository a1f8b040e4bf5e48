#include "floatframe/formats/matlab/mat_file.hpp"

#include <zlib.h>

#include <bit>
#include <cstdint>

#include "floatframe/core/code_points.hpp"
#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

namespace {

enum DataType : std::uint32_t {
  mi_int8 = 1,
  mi_uint16 = 4,
  mi_int32 = 5,
  mi_uint32 = 6,
  mi_double = 9,
  mi_matrix = 14,
  mi_compressed = 15
};
enum ArrayClass : std::uint32_t { mx_cell = 1, mx_char = 4, mx_double = 6 };

std::string bytes_of(const void* values, std::size_t count) {
  return {static_cast<const char*>(values), count};
}

std::string tag(DataType type, std::size_t bytes) {
  if (bytes > 0x7fffffff)
    throw InputError(ErrorCode::too_large, "a matrix is too large for a MATLAB file of version 7");
  const std::uint32_t numbers[2] = {type, static_cast<std::uint32_t>(bytes)};
  return bytes_of(numbers, sizeof numbers);
}

std::string mat_element(DataType type, const std::string& content) {
  std::string element = tag(type, content.size()) + content;
  element.resize((element.size() + 7) / 8 * 8, '\0');
  return element;
}

std::string mat_array(ArrayClass kind, Eigen::Index rows, Eigen::Index columns,
                      const std::string& name, const std::string& values) {
  const std::uint32_t flags[2] = {kind, 0};
  const std::int32_t size[2] = {static_cast<std::int32_t>(rows),
                                static_cast<std::int32_t>(columns)};
  return mat_element(mi_matrix, mat_element(mi_uint32, bytes_of(flags, sizeof flags)) +
                                    mat_element(mi_int32, bytes_of(size, sizeof size)) +
                                    mat_element(mi_int8, name) + values);
}

std::u16string utf16(const std::string& text) {
  std::u16string out;
  for (const char32_t code : code_points(text)) {
    if (code >= 0x10000) {
      out += static_cast<char16_t>(0xd800 + ((code - 0x10000) >> 10));
      out += static_cast<char16_t>(0xdc00 + ((code - 0x10000) & 0x3ff));
    } else {
      out += static_cast<char16_t>(code);
    }
  }
  return out;
}

std::string numbers_array(const std::string& name, const MatX& m) {
  const std::string values =
      bytes_of(m.data(), static_cast<std::size_t>(m.size()) * sizeof(double));  // by columns
  return mat_array(mx_double, m.rows(), m.cols(), name, mat_element(mi_double, values));
}

std::string texts_array(const std::string& name, const std::vector<std::string>& texts) {
  std::string cells;
  for (const std::string& text : texts) {
    const std::u16string w = utf16(text);
    cells += mat_array(mx_char, w.empty() ? 0 : 1, static_cast<Eigen::Index>(w.size()), "",
                       mat_element(mi_uint16, bytes_of(w.data(), 2 * w.size())));
  }
  return mat_array(mx_cell, static_cast<Eigen::Index>(texts.size()), 1, name, cells);
}

std::string compressed(const std::string& content) {
  uLongf size = compressBound(static_cast<uLong>(content.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(content.data()), static_cast<uLong>(content.size()),
                Z_BEST_COMPRESSION) != Z_OK)
    throw InputError(ErrorCode::unsupported, "a matrix cannot be compressed");
  out.resize(size);
  return tag(mi_compressed, size) + out;  // not padded
}

}  // namespace

std::string mat_file(const std::vector<MatVariable>& variables) {
  std::string file = "MATLAB 5.0 MAT-file, written by Floatframe";
  file.resize(116, ' ');
  file.resize(124, '\0');
  const std::uint16_t version[2] = {0x0100, 'M' << 8 | 'I'};
  file += bytes_of(version, sizeof version);
  for (const MatVariable& v : variables) {
    if (const auto* m = std::get_if<MatX>(&v.value))
      file += compressed(numbers_array(v.name, *m));
    else
      file += compressed(texts_array(v.name, std::get<std::vector<std::string>>(v.value)));
  }
  return file;
}

}  // namespace floatframe
