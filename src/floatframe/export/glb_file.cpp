#include "floatframe/export/glb_file.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

static_assert(std::endian::native == std::endian::little,
              "numbers are written as they lie in memory");

namespace {

using GlbJson = nlohmann::ordered_json;

std::size_t tuple_size(std::string_view type) {
  return type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
}

template <class T>
std::string_view bytes_of(const T& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(numbers[0])};
}

void append_word(std::string& out, std::uint32_t word) {
  out.append(reinterpret_cast<const char*>(&word), sizeof word);
}

}  // namespace

int GlbFile::add(std::string_view content, GlbJson accessor, int target) {
  GlbJson view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", content.size()}};
  if (target != 0) view["target"] = target;
  buffer_.append(content);  // of four-byte numbers
  accessor["bufferView"] = views_.size();
  views_.push_back(std::move(view));
  accessors_.push_back(std::move(accessor));
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbFile::floats(std::span<const float> numbers, const char* type, bool bounded, int target) {
  const std::size_t n = tuple_size(type);
  GlbJson accessor{
      {"componentType", gltf::float_type}, {"count", numbers.size() / n}, {"type", type}};
  if (bounded && !numbers.empty()) {
    std::vector<float> low(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
    std::vector<float> high = low;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      low[k % n] = std::min(low[k % n], numbers[k]);
      high[k % n] = std::max(high[k % n], numbers[k]);
    }
    // As doubles, which readers convert to the same floats.
    accessor["min"] = std::vector<double>(low.begin(), low.end());
    accessor["max"] = std::vector<double>(high.begin(), high.end());
  }
  return add(bytes_of(numbers), std::move(accessor), target);
}

int GlbFile::indices(const std::vector<std::uint32_t>& numbers) {
  return add(bytes_of(numbers),
             {{"componentType", gltf::uint_type}, {"count", numbers.size()}, {"type", "SCALAR"}},
             gltf::indices);
}

std::string GlbFile::bytes(GlbJson document) {
  document["buffers"] = GlbJson::array({{{"byteLength", buffer_.size()}}});
  document["bufferViews"] = std::move(views_);
  document["accessors"] = std::move(accessors_);
  // Names from files may contain invalid UTF-8.
  std::string text = document.dump(-1, ' ', false, GlbJson::error_handler_t::replace);
  text.append((4 - text.size() % 4) % 4, ' ');
  buffer_.append((4 - buffer_.size() % 4) % 4, '\0');
  const std::size_t length = 12 + 8 + text.size() + 8 + buffer_.size();
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw InputError(ErrorCode::too_large,
                     "the glTF file would be larger than 4 GB, expected fewer instants or bodies");
  std::string out = "glTF";
  append_word(out, 2);
  append_word(out, static_cast<std::uint32_t>(length));
  append_word(out, static_cast<std::uint32_t>(text.size()));
  out += "JSON";
  out += text;
  append_word(out, static_cast<std::uint32_t>(buffer_.size()));
  out.append("BIN\0", 4);
  out += buffer_;
  return out;
}

}  // namespace floatframe
