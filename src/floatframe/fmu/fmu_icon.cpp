#include "floatframe/fmu/fmu_icon.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace floatframe {
namespace {

constexpr int icon_size = 128;  ///< [pixel]

struct IconPoint {
  double x, y;  ///< to the right and down [pixel]
};
struct IconColour {
  double r, g, b;  ///< 0 to 255
};

/// Pixels of three bytes, with what is drawn later on top.
class IconCanvas {
 public:
  explicit IconCanvas(IconColour paper) { pixels_.fill(paper); }

  /// A line of this width with round ends.
  void line(IconPoint from, IconPoint to, double width, IconColour colour) {
    const double dx = to.x - from.x, dy = to.y - from.y, length2 = dx * dx + dy * dy;
    for (int y = 0; y < icon_size; ++y)
      for (int x = 0; x < icon_size; ++x) {
        const double px = x + 0.5 - from.x, py = y + 0.5 - from.y;
        const double s = length2 > 0.0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
        const double off = std::sqrt((px - s * dx) * (px - s * dx) + (py - s * dy) * (py - s * dy));
        blend(pixels_[y * icon_size + x], colour, std::clamp(0.5 * width + 0.5 - off, 0.0, 1.0));
      }
  }
  void dot(IconPoint at, double diameter, IconColour colour) { line(at, at, diameter, colour); }

  /// Rows of a PNG image, each with its filter: none.
  std::string rows() const {
    std::string out;
    for (int y = 0; y < icon_size; ++y) {
      out += '\0';
      for (int x = 0; x < icon_size; ++x) {
        const IconColour& c = pixels_[y * icon_size + x];
        for (const double part : {c.r, c.g, c.b}) out += static_cast<char>(std::lround(part));
      }
    }
    return out;
  }

 private:
  static void blend(IconColour& at, IconColour with, double share) {
    at = {at.r + share * (with.r - at.r), at.g + share * (with.g - at.g),
          at.b + share * (with.b - at.b)};
  }
  std::array<IconColour, icon_size * icon_size> pixels_{};
};

void put_big_endian(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xffu);
}

/// Length, type, content and checksum.
void put_chunk(std::string& out, std::string_view type, std::string_view content) {
  put_big_endian(out, static_cast<std::uint32_t>(content.size()));
  std::string checked(type);
  checked += content;
  out += checked;
  const uLong crc =
      crc32(0L, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  put_big_endian(out, static_cast<std::uint32_t>(crc));
}

std::string png_file(const std::string& rows) {
  std::string out("\x89PNG\r\n\x1a\n", 8), head, packed(compressBound(rows.size()), '\0');
  put_big_endian(head, icon_size);
  put_big_endian(head, icon_size);
  head += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, red green blue, not interlaced
  uLongf size = packed.size();
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
            reinterpret_cast<const Bytef*>(rows.data()), rows.size(), Z_BEST_COMPRESSION);
  packed.resize(size);
  put_chunk(out, "IHDR", head);
  put_chunk(out, "IDAT", packed);
  put_chunk(out, "IEND", "");
  return out;
}

/// The bent beam: w(s) of a cantilever under a load at its end, above the frame.
IconPoint on_beam(double s) {
  const double w = 0.5 * s * s * (3.0 - s);
  return {26.0 + 84.0 * s - 6.0 * w, 92.0 - 56.0 * w};
}

}  // namespace

std::string fmu_icon() {
  constexpr IconColour paper{247, 248, 250}, grey{178, 186, 196}, beam{46, 92, 138},
      red{200, 60, 50}, green{70, 140, 70};
  IconCanvas canvas(paper);
  constexpr int pieces = 12;
  constexpr IconPoint origin{26, 92};
  for (int k = 0; k < pieces; ++k)  // the undeformed axis, dashed
    canvas.line({origin.x + 7.0 * k, origin.y}, {origin.x + 7.0 * k + 3.0, origin.y}, 2.0, grey);
  for (int k = 0; k < pieces; ++k)
    canvas.line(on_beam(k / 12.0), on_beam((k + 1) / 12.0), 9.0, beam);
  for (int k = 0; k <= 4; ++k) canvas.dot(on_beam(k / 4.0), 5.0, paper);
  canvas.line(origin, {origin.x + 34.0, origin.y + 12.0}, 4.0, red);
  canvas.line(origin, {origin.x - 12.0, origin.y - 34.0}, 4.0, green);
  canvas.dot(origin, 8.0, {40, 44, 52});
  return png_file(canvas.rows());
}

}  // namespace floatframe
