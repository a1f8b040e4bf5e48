#include <bit>
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

std::string_view next_geometry_line(std::string_view& text, int& line) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view rest = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  ++line;
  return rest;
}

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
  // An ending that is not read is said before the file is looked for.
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
