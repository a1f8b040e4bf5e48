// Wavefront OBJ: points (v) and faces (f) of any number of corners, which are divided as fans from
// their first one. All else - lines, free-form curves, normals, texture coordinates, materials,
// groups - is left out.
#include <fmt/format.h>

#include "floatframe/formats/geometry/geometry_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

Vec3 obj_point(std::string_view rest, int line, GeometryBuilder& out) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = next_word(rest);
    const auto x = parse_real(word);
    if (!x)
      out.stop(ErrorCode::not_a_number, "v: " + not_a_real(word) + ", expected three numbers",
               line);
    p[k] = *x;
  }
  return p;
}

/// "7", "7/1", "7//3", "7/1/3", "-1": points count from 1, negative ones from the last.
int obj_corner(std::string_view word, int line, GeometryBuilder& out) {
  const std::string_view number = word.substr(0, word.find('/'));
  const auto index = parse_integer(number);
  if (!index)
    out.stop(ErrorCode::not_a_number,
             "f: " + not_an_integer(number) + ", expected numbers of points", line);
  const auto count = static_cast<long>(out.points());
  const long k = *index < 0 ? count + *index : static_cast<long>(*index) - 1;
  if (*index == 0 || k < 0 || k >= count)
    out.stop(
        ErrorCode::not_found,
        fmt::format("f: found point {}, expected one of the {} points before it", *index, count),
        line);
  return static_cast<int>(k);
}

}  // namespace

void parse_obj(std::string_view bytes, GeometryBuilder& out) {
  std::string joined;  // of lines that go on
  std::vector<int> corners;
  int line = 0;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    std::string_view rest = bytes.substr(0, end);
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
    ++line;
    if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
    if (!rest.empty() && rest.back() == '\\') {
      joined.append(rest.substr(0, rest.size() - 1)).push_back(' ');
      if (!bytes.empty()) continue;
      rest = {};
    }
    joined.append(rest);
    std::string_view words = std::string_view(joined).substr(0, joined.find('#'));
    const std::string_view key = next_word(words);
    if (key == "v") {
      out.point(obj_point(words, line, out), line);
    } else if (key == "f") {
      corners.clear();
      for (std::string_view w = next_word(words); !w.empty(); w = next_word(words))
        corners.push_back(obj_corner(w, line, out));
      if (corners.size() < 3)
        out.stop(ErrorCode::wrong_count,
                 fmt::format("f: found {} corners, expected 3 or more", corners.size()), line);
      for (std::size_t k = 2; k < corners.size(); ++k)
        out.triangle(corners[0], corners[k - 1], corners[k]);
    }
    joined.clear();
  }
}

}  // namespace floatframe
