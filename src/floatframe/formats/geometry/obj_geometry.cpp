// Wavefront OBJ: points (v) and faces (f) of any number of corners, which are divided as fans from
// their first one. All else - lines, free-form curves, normals, texture coordinates, materials,
// groups - is left out.
#include "floatframe/formats/geometry/geometry_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

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
