#pragma once
// Pages for the viewer (viewer/README.md): a template built from the viewer's sources, a JSON
// object, and one buffer of numbers that the object refers to by views.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

namespace floatframe {

/// A half float (IEEE 754 binary16), rounded to nearest even; infinite beyond its range.
std::uint16_t half_of(float value) noexcept;

/// Little-endian numbers in sequence; `add` returns their view, {"type", "offset", "shape"}. The
/// product of the shape is the number of values.
class PageBuffer {
 public:
  using Shape = std::initializer_list<std::size_t>;
  nlohmann::ordered_json add(std::span<const double> values, Shape shape);
  nlohmann::ordered_json add(std::span<const float> values, Shape shape);
  nlohmann::ordered_json add(std::span<const std::uint32_t> values, Shape shape);
  nlohmann::ordered_json add_half(std::span<const float> values, Shape shape);

  const std::string& bytes() const noexcept { return bytes_; }

 private:
  nlohmann::ordered_json put(const char* type, const void* data, std::size_t bytes, Shape shape);
  std::string bytes_;
};

/// The template built from the viewer; empty in a program built without it.
std::string_view page_template() noexcept;

/// The template with its placeholder replaced by `page` and the compressed buffer.
std::string page_html(std::string_view page_template, const nlohmann::ordered_json& page,
                      const PageBuffer& buffer);

}  // namespace floatframe
