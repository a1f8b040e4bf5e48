#pragma once
// Arrays in the .npy format 1.0 of NumPy: a short text header with type, order and shape, then the
// values, little-endian. Doubles, 32-bit and 64-bit integers; any number of dimensions.
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace floatframe {

/// Values in C order (the last index runs fastest), for any order in the file.
struct NpyArray {
  std::vector<std::size_t> shape;  ///< empty: one number
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::int64_t>> values;
};

/// The bytes of a .npy file. The number of values must be that of the shape.
std::string npy_bytes(const NpyArray& array);

/// The bytes of a .npy file with a column of texts (UTF-8; unicode in NumPy).
std::string npy_texts(const std::vector<std::string>& texts);
/// The texts of such a file, in any shape; errors as those of `read_npy`.
std::vector<std::string> read_npy_texts(std::string_view bytes);

/// Throws InputError with one sentence, without a location: wrong beginning, unknown type, a shape
/// that does not fit the number of bytes.
NpyArray read_npy(std::string_view bytes);

/// "3 x 20", "one number"
std::string shape_text(const std::vector<std::size_t>& shape);

}  // namespace floatframe
