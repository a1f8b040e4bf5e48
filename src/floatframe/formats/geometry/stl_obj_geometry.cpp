// STL. Text: solid, facets of three vertices each, endsolid. Binary: 80 bytes of any text, the
// number of facets (u32), and 50 bytes for each: normal and three corners (f32, little-endian), two
// bytes more. A binary file may begin with "solid", too: it is the one whose length fits.
//
// Wavefront OBJ: points (v) and faces (f) of any number of corners, which are divided as fans from
// their first one. All else - lines, free-form curves, normals, texture coordinates, materials,
// groups - is left out.
#include <cstring>

#include "floatframe/formats/geometry/geometry_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::size_t stl_head = 84, stl_facet = 50;

std::uint32_t stl_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= stl_head) std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

void binary_stl(std::string_view bytes, GeometryBuilder& out) {
  if (bytes.size() < stl_head)
    out.stop(ErrorCode::wrong_file,
             "found {} bytes, expected an STL file: text that begins with 'solid', or 84 bytes and "
             "facets",
             bytes.size());
  const std::uint32_t count = stl_facets(bytes);
  const std::size_t expected = stl_head + stl_facet * std::size_t{count};
  if (bytes.size() != expected)
    out.stop(ErrorCode::damaged,
             "found {} bytes, expected {} for the {} triangles that it announces: it is cut short "
             "or damaged",
             bytes.size(), expected, count);
  for (std::size_t k = 0; k < count; ++k) {
    std::array<float, 9> x{};
    std::memcpy(x.data(), bytes.data() + stl_head + k * stl_facet + 12, sizeof x);
    std::array<int, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i)
      corner[i] = out.point({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    out.triangle(corner[0], corner[1], corner[2]);
  }
}

void text_stl(std::string_view text, GeometryBuilder& out) {
  std::vector<int> corners;
  bool inside = false;
  int line = 0;
  while (!text.empty()) {
    std::string_view rest = next_geometry_line(text, line);
    const std::string_view word = next_word(rest);
    if (word.empty() || same_word(word, "facet") || same_word(word, "endfacet")) continue;
    if (same_word(word, "solid")) {
      inside = true;
    } else if (same_word(word, "endsolid")) {
      inside = false;
    } else if (same_word(word, "outer")) {
      corners.clear();
    } else if (same_word(word, "vertex")) {
      corners.push_back(out.point(geometry_point("vertex", rest, line, out), line));
    } else if (same_word(word, "endloop")) {
      if (corners.size() != 3)
        out.stop(ErrorCode::wrong_count, line, "found {} vertices of a facet, expected 3",
                 corners.size());
      out.triangle(corners[0], corners[1], corners[2]);
      corners.clear();
    } else {
      out.stop(ErrorCode::wrong_value, line,
               "found {}, expected facet, outer loop, vertex, endloop, endfacet or endsolid",
               shown(word));
    }
  }
  if (inside) out.stop(ErrorCode::damaged, line, "the file ends without endsolid: it is cut short");
}

/// "7", "7/1", "7//3", "7/1/3", "-1": points count from 1, negative ones from the last.
int obj_corner(std::string_view word, int line, GeometryBuilder& out) {
  const std::string_view number = word.substr(0, word.find('/'));
  const auto index = parse_integer(number);
  if (!index)
    out.stop(ErrorCode::not_a_number, line, "f: {}, expected numbers of points",
             not_an_integer(number));
  const auto count = static_cast<long>(out.points());
  const long k = *index < 0 ? count + *index : static_cast<long>(*index) - 1;
  if (*index == 0 || k < 0 || k >= count)
    out.stop(ErrorCode::not_found, line,
             "f: found point {}, expected one of the {} points before it", *index, count);
  return static_cast<int>(k);
}

}  // namespace

void parse_stl(std::string_view bytes, GeometryBuilder& out) {
  const bool fits = bytes.size() >= stl_head &&
                    bytes.size() == stl_head + stl_facet * std::size_t{stl_facets(bytes)};
  if (!fits && begins_with(trimmed(bytes.substr(0, 80)), "solid"))
    text_stl(bytes, out);
  else
    binary_stl(bytes, out);
}

void parse_obj(std::string_view bytes, GeometryBuilder& out) {
  std::string joined;  // of lines that go on
  std::vector<int> corners;
  int line = 0;
  while (!bytes.empty()) {
    std::string_view rest = next_geometry_line(bytes, line);
    if (!rest.empty() && rest.back() == '\\') {
      joined.append(rest.substr(0, rest.size() - 1)).push_back(' ');
      if (!bytes.empty()) continue;
      rest = {};
    }
    joined.append(rest);
    std::string_view words = std::string_view(joined).substr(0, joined.find('#'));
    const std::string_view key = next_word(words);
    if (key == "v") {
      out.point(geometry_point("v", words, line, out), line);
    } else if (key == "f") {
      corners.clear();
      for (std::string_view w = next_word(words); !w.empty(); w = next_word(words))
        corners.push_back(obj_corner(w, line, out));
      if (corners.size() < 3)
        out.stop(ErrorCode::wrong_count, line, "f: found {} corners, expected 3 or more",
                 corners.size());
      for (std::size_t k = 2; k < corners.size(); ++k)
        out.triangle(corners[0], corners[k - 1], corners[k]);
    }
    joined.clear();
  }
}

}  // namespace floatframe
