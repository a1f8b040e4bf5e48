#include "floatframe/page/page_writer.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "floatframe/core/base64.hpp"
#include "floatframe/core/output_error.hpp"

namespace floatframe {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::string_view place_of_data = "<!--FLOATFRAME-DATA-->";

/// Numbers of a motion are noise in most of their bytes: the highest level saves one byte in a
/// hundred for half as many instructions again.
std::string deflated(const std::string& bytes) {
  std::string out(compressBound(static_cast<uLong>(bytes.size())), '\0');
  uLongf size = static_cast<uLongf>(out.size());
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                Z_BEST_SPEED) != Z_OK)
    throw OutputError("the numbers of the page cannot be compressed");
  out.resize(size);
  return out;
}

/// Escapes texts so that none can end the enclosing element.
std::string json_in_html(const Json& page) {
  const std::string text = page.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

}  // namespace

std::uint16_t half_of(float value) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000u);
  const std::uint32_t size = bits & 0x7fffffffu;
  if (size > 0x7f800000u) return sign | 0x7e00u;   // not a number
  if (size >= 0x477ff000u) return sign | 0x7c00u;  // rounds beyond 65504
  if (size < 0x33000001u) return sign;             // half of the smallest or less
  if (size < 0x38800000u) {                        // denormal
    const int shift = 126 - static_cast<int>(size >> 23);
    const std::uint32_t mantissa = (size & 0x7fffffu) | 0x800000u;
    const std::uint32_t kept = mantissa >> shift, rest = mantissa & ((1u << shift) - 1u);
    const std::uint32_t middle = 1u << (shift - 1);
    const bool up = rest > middle || (rest == middle && (kept & 1u) != 0);
    return static_cast<std::uint16_t>(sign | (kept + (up ? 1u : 0u)));
  }
  const std::uint32_t rounded = size + 0xfffu + ((size >> 13) & 1u) - 0x38000000u;
  return static_cast<std::uint16_t>(sign | (rounded >> 13));
}

Json PageBuffer::put(const char* type, const void* data, std::size_t bytes, Shape shape) {
  bytes_.resize((bytes_.size() + 7) / 8 * 8);
  Json view{{"type", type}, {"offset", bytes_.size()}, {"shape", shape}};
  if (bytes > 0) bytes_.append(static_cast<const char*>(data), bytes);
  return view;
}

Json PageBuffer::add(std::span<const double> values, Shape shape) {
  return put("f64", values.data(), values.size_bytes(), shape);
}

Json PageBuffer::add(std::span<const float> values, Shape shape) {
  return put("f32", values.data(), values.size_bytes(), shape);
}

Json PageBuffer::add(std::span<const std::uint32_t> values, Shape shape) {
  std::vector<std::uint16_t> narrow;
  for (const std::uint32_t v : values) {
    if (v > 0xffffu) return put("u32", values.data(), values.size_bytes(), shape);
    narrow.push_back(static_cast<std::uint16_t>(v));
  }
  return put("u16", narrow.data(), narrow.size() * sizeof narrow[0], shape);
}

Json PageBuffer::add_half(std::span<const float> values, Shape shape) {
  std::vector<std::uint16_t> halves;
  halves.reserve(values.size());
  for (const float v : values) halves.push_back(half_of(v));
  return put("f16", halves.data(), halves.size() * sizeof halves[0], shape);
}

std::string page_html(std::string_view page_template, const Json& page, const PageBuffer& buffer) {
  const std::size_t at = page_template.find(place_of_data);
  if (at == std::string_view::npos)
    throw OutputError(fmt::format("the template of the page has no place '{}'", place_of_data));
  Json whole = page;
  whole["compression"] = "deflate";
  std::string html(page_template.substr(0, at));
  html += "<script type=\"application/json\" id=\"floatframe-page\">" + json_in_html(whole) +
          "</script>\n<script type=\"application/octet-stream;base64\" id=\"floatframe-buffer\">" +
          base64(deflated(buffer.bytes())) + "</script>";
  html += page_template.substr(at + place_of_data.size());
  return html;
}

}  // namespace floatframe
