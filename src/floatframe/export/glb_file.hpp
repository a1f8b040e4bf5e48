#pragma once
// The binary container of glTF 2.0 (Khronos): one JSON object and one buffer, whose arrays are
// named as accessors in the JSON. Little-endian.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace floatframe {

/// Constants of accessors and buffers, from the standard.
namespace gltf {
inline constexpr int float_type = 5126, uint_type = 5125;
inline constexpr int vertices = 34962, indices = 34963;  ///< targets of buffer views
inline constexpr int points = 0, lines = 1, triangles = 4;
}  // namespace gltf

class GlbFile {
 public:
  /// Index of the accessor of `numbers`, in tuples of `type` ("SCALAR", "VEC3", "VEC4"). Bounds are
  /// written if `bounded`. `target`: 0: none.
  int floats(std::span<const float> numbers, const char* type, bool bounded, int target = 0);
  int indices(const std::vector<std::uint32_t>& numbers);

  /// `document`: everything but the arrays. Throws InputError if the file would exceed 4 GB.
  std::string bytes(nlohmann::ordered_json document);

 private:
  int add(std::string_view content, nlohmann::ordered_json accessor, int target);

  std::string buffer_;
  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array(),
                         views_ = nlohmann::ordered_json::array();
};

}  // namespace floatframe
