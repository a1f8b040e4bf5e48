// STL. Text: solid, facets of three vertices each, endsolid. Binary: 80 bytes of any text, the
// number of facets (u32), and 50 bytes for each: normal and three corners (f32, little-endian), two
// bytes more. A binary file may begin with "solid", too: it is identified by its length.
//
// Wavefront OBJ: points (v) and faces (f) of any number of corners, which are divided as fans from
// their first one. Everything else - lines, free-form curves, normals, texture coordinates,
// materials, groups - is ignored.
#include <bit>
#include <cstring>
#include <unordered_map>

#include "floatframe/core/regular_file.hpp"
#include "floatframe/formats/geometry/geometry_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

std::string geometry_ending(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

using PointKey = std::array<double, 3>;

struct PointKeyHash {
  std::size_t operator()(const PointKey& key) const noexcept {
    std::uint64_t h = 0;
    for (const double v : key) {
      h = (h ^ std::bit_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }
};

/// The next line without its end; `text` moves behind it, and `line` counts.
std::string_view next_geometry_line(std::string_view& text, int& line) {
  std::string_view rest = next_line(text);
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  ++line;
  return rest;
}

/// Three numbers of a line behind the word `key`.
Vec3 geometry_point(const char* key, std::string_view rest, int line, const GeometryBuilder& out) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = next_word(rest);
    const auto x = parse_real(word);
    if (!x)
      out.stop(ErrorCode::not_a_number, line, "{}: {}, expected three numbers", key,
               not_a_real(word));
    p[k] = *x;
  }
  return p;
}

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

void parse_stl(std::string_view bytes, GeometryBuilder& out) {
  const bool fits = bytes.size() >= stl_head &&
                    bytes.size() == stl_head + stl_facet * std::size_t{stl_facets(bytes)};
  if (!fits && begins_with(trimmed(bytes.substr(0, 80)), "solid"))
    text_stl(bytes, out);
  else
    binary_stl(bytes, out);
}

void parse_obj(std::string_view bytes, GeometryBuilder& out) {
  std::string joined;  // of continued lines
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

}  // namespace

int GeometryBuilder::point(const Vec3& p, int line) {
  if (!p.allFinite())
    stop(ErrorCode::not_finite, line, "point {} is not finite, expected three numbers",
         points_.size() + 1);
  if (points_.size() >= 3 * limits::geometry_triangles)
    stop(ErrorCode::too_large, line, "found more than {} points, expected at most so many",
         3 * limits::geometry_triangles);
  points_.push_back(p);
  return static_cast<int>(points_.size()) - 1;
}

void GeometryBuilder::triangle(int a, int b, int c) {
  if (triangles_.size() >= limits::geometry_triangles)
    stop(ErrorCode::too_large, "found more than {} triangles, expected at most so many",
         limits::geometry_triangles);
  triangles_.push_back({a, b, c});
}

TriangleGeometry GeometryBuilder::finish() const {
  TriangleGeometry out;
  std::unordered_map<PointKey, int, PointKeyHash> known;
  std::vector<int> used(points_.size(), -1);
  std::vector<const Vec3*> places;
  const auto place = [&](int k) {
    int& index = used[static_cast<std::size_t>(k)];
    if (index >= 0) return index;
    const Vec3& p = points_[static_cast<std::size_t>(k)];
    // + 0.0: a negative zero is the same place.
    const auto [at, fresh] = known.emplace(PointKey{p[0] + 0.0, p[1] + 0.0, p[2] + 0.0},
                                           static_cast<int>(places.size()));
    if (fresh) places.push_back(&p);
    return index = at->second;
  };
  for (const auto& t : triangles_) {
    const std::array<int, 3> corners{place(t[0]), place(t[1]), place(t[2])};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      out.triangles.push_back(corners);
  }
  if (out.triangles.empty()) stop(ErrorCode::missing, "found no triangles, expected a surface");
  out.positions.resize(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
    out.positions.col(static_cast<Eigen::Index>(k)) = *places[k];
  return out;
}

bool is_geometry_file(const std::filesystem::path& file) {
  const std::string ending = geometry_ending(file);
  return ending == ".stl" || ending == ".obj" || ending == ".gltf" || ending == ".glb";
}

TriangleGeometry parse_geometry(std::string_view bytes, const std::string& name,
                                const GeometryLoader& loader) {
  GeometryBuilder out(name);
  if (!is_geometry_file(name))
    out.stop(ErrorCode::wrong_file, "found this ending, expected .stl, .obj, .gltf or .glb");
  if (bytes.empty()) out.stop(ErrorCode::missing, "the file is empty");
  const std::string ending = geometry_ending(name);
  if (ending == ".stl")
    parse_stl(bytes, out);
  else if (ending == ".obj")
    parse_obj(bytes, out);
  else
    parse_gltf(bytes, loader, out);
  return out.finish();
}

TriangleGeometry read_geometry(const std::filesystem::path& file) {
  // An unsupported ending is reported before the file is searched.
  if (!is_geometry_file(file))
    throw InputError(ErrorCode::wrong_file, SourceMark{file.string(), 0, 0},
                     "found this ending, expected .stl, .obj, .gltf or .glb");
  std::vector<std::filesystem::path> others;
  const auto beside = [&](const std::string& name) {
    others.push_back((file.parent_path() / name).lexically_normal());
    return regular_file(others.back(), limits::geometry_bytes);
  };
  TriangleGeometry out =
      parse_geometry(regular_file(file, limits::geometry_bytes), file.string(), beside);
  out.others = std::move(others);
  return out;
}

}  // namespace floatframe
