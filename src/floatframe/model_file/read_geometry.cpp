// The key `geometry` of a body: solids and surfaces drawn by other programs. It has no effect on
// the motion.
#include <fmt/format.h>

#include "floatframe/body/solid_shapes.hpp"
#include "floatframe/formats/geometry/geometry_file.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/parts/part_job.hpp"

namespace floatframe {
namespace {

constexpr double farthest_geometry = 1e6;           // [m]; pages have single precision
constexpr std::size_t most_geometry_shapes = 1000;  // of a body

std::string read_color(const YamlValue& value) {
  const auto text = value.text("a colour \"#rrggbb\"");
  if (!text) return {};
  const bool good = text->size() == 7 && text->front() == '#' &&
                    text->find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (good) return *text;
  value.unexpected("a colour \"#rrggbb\" (in quotes), as in \"#3a6ea5\"");
  return {};
}

// Each solid by its word; nullopt after an error.

std::optional<Solid> read_box_solid(const YamlValue& value) {
  const auto v = value.numbers(3, 3, positive_number("m"), "three lengths [x, y, z] [m]");
  if (!v) return std::nullopt;
  return BoxSolid{Vec3((*v)[0], (*v)[1], (*v)[2])};
}

/// Radius, length and the radius at the upper end of a cone; the others are what is left of it.
std::optional<Solid> read_round_solid(const YamlValue& value, const char* what, bool length,
                                      bool top, Solid (*make)(const ConeSolid&)) {
  auto s = value.section(what);
  if (!s) return std::nullopt;
  const std::size_t before = value.context().errors->size();
  ConeSolid cone;
  cone.radius = s->required_number("radius", positive_number("m"), 1.0);
  if (length) cone.length = s->required_number("length", positive_number("m"), 1.0);
  if (top) cone.top = s->number("top", non_negative_number("m"), 0.0);
  s->finish();
  if (value.context().errors->size() > before) return std::nullopt;
  return make(cone);
}

std::optional<Solid> read_cylinder_solid(const YamlValue& value) {
  return read_round_solid(value, "a map with radius, length", true, false,
                          [](const ConeSolid& x) -> Solid {
                            return CylinderSolid{x.radius, x.length};
                          });
}
std::optional<Solid> read_cone_solid(const YamlValue& value) {
  return read_round_solid(value, "a map with radius, length, top", true, true,
                          [](const ConeSolid& x) -> Solid { return x; });
}
std::optional<Solid> read_sphere_solid(const YamlValue& value) {
  return read_round_solid(value, "a map with radius", false, false,
                          [](const ConeSolid& x) -> Solid { return SphereSolid{x.radius}; });
}
std::optional<Solid> read_capsule_solid(const YamlValue& value) {
  return read_round_solid(value, "a map with radius, length", true, false,
                          [](const ConeSolid& x) -> Solid {
                            return CapsuleSolid{x.radius, x.length};
                          });
}

struct SolidWord {
  const char* word;
  bool has_axis;
  std::optional<Solid> (*read)(const YamlValue& value);
};
constexpr SolidWord solid_words[] = {{"box", false, read_box_solid},
                                     {"cylinder", true, read_cylinder_solid},
                                     {"cone", true, read_cone_solid},
                                     {"sphere", false, read_sphere_solid},
                                     {"capsule", true, read_capsule_solid}};

/// One map of `geometry`.
class GeometryShape {
 public:
  GeometryShape(const ModelInstance& self, YamlSection section)
      : self_(self), s_(std::move(section)) {}

  /// Appends its triangles; false after an error.
  bool append(BodyShape& shape) {
    const std::size_t before = s_.value().context().errors->size();
    const auto errors = [&] { return s_.value().context().errors->size() > before; };
    const auto file = choose();
    // Where no shape is given, that alone is said.
    const double scale = word_ == nullptr ? s_.number("scale", positive_number(""), 1.0) : 1.0;
    PlacedSolid placed;
    s_.vector("position", "m", placed.X_BS.p);
    turn(placed.X_BS.R, file.has_value());
    if (const auto v = s_.get("color")) placed.color = read_color(*v);
    std::optional<Solid> solid;
    if (word_ != nullptr) solid = word_->read(*s_.get(word_->word));
    s_.finish();
    if (errors() && !file) return false;
    const std::size_t points = shape.positions.cols();
    if (solid) {
      placed.solid = *solid;
      add_solid(placed, shape);
    } else if (!file || !append_file(*file, scale, placed, shape)) {
      return false;
    }
    return !errors() && fits(file ? *file : s_.value(), shape, points);
  }

 private:
  /// The value of `file`, or a word of a solid in `word_`, or an error.
  std::optional<YamlValue> choose() {
    auto file = s_.get("file");
    const char* first = file ? "file" : nullptr;
    for (const SolidWord& w : solid_words) {
      const auto value = s_.get(w.word);
      if (!value) continue;
      if (first != nullptr)
        value->error(ErrorCode::exclusive,
                     fmt::format("found with '{}', expected one of them", first));
      else
        word_ = &w, first = w.word;
    }
    if (first == nullptr)
      s_.error(ErrorCode::missing,
               "found none of file, box, cylinder, cone, sphere, capsule, expected one of them");
    return file;
  }

  void turn(Mat3& R, bool of_file) {
    const auto orientation = s_.get("orientation");
    if (orientation) R = read_orientation(*orientation);
    if (of_file || (word_ != nullptr && !word_->has_axis)) return;
    const auto axis = s_.get("axis");
    if (!axis) return;
    if (orientation)
      axis->error(ErrorCode::exclusive, "found with 'orientation', expected one of them");
    if (const auto z = read_direction(*axis))
      R = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), *z).toRotationMatrix();
  }

  bool append_file(const YamlValue& file, double scale, const PlacedSolid& placed,
                   BodyShape& shape) {
    const auto name = file.text("the name of a file (.stl, .obj, .gltf, .glb)");
    if (!name) return false;
    try {
      const std::string path = sibling_path(self_, *name);
      const TriangleGeometry geometry = read_geometry(path);
      note_file_read(path, file_hash(path));
      for (const auto& other : geometry.others) note_file_read(other.string(), file_hash(other));
      const Mat3X positions =
          (scale * placed.X_BS.R * geometry.positions).colwise() + placed.X_BS.p;
      add_triangles(positions, geometry.triangles, placed.color, shape);
    } catch (const InputError& error) {
      add_errors(file, error);
      return false;
    }
    return true;
  }

  /// Of the points from `first` on, which were appended.
  bool fits(const YamlValue& place, const BodyShape& shape, std::size_t first) const {
    const double reach =
        shape.positions.rightCols(shape.positions.cols() - first).colwise().norm().maxCoeff();
    if (!(reach <= farthest_geometry)) {
      place.error(
          ErrorCode::out_of_range,
          fmt::format("found a point {:.3g} m from the origin of the body, expected at "
                      "most {:.0e} m{}",
                      reach, farthest_geometry,
                      word_ == nullptr ? " (does 'scale' fit the units of the file?)" : ""));
      return false;
    }
    if (shape.triangles.size() > limits::geometry_triangles) {
      place.error(ErrorCode::too_large,
                  fmt::format("found {} triangles of the body up to here, expected at most {}",
                              shape.triangles.size(), limits::geometry_triangles));
      return false;
    }
    return true;
  }

  const ModelInstance& self_;
  YamlSection s_;
  const SolidWord* word_ = nullptr;
};

}  // namespace

std::shared_ptr<const BodyShape> read_body_geometry(const ModelInstance& self,
                                                    const YamlValue& value) {
  const char* what =
      "a map with file, box, cylinder, cone, sphere or capsule, and position, orientation, color; "
      "or a list of such maps";
  if (!value.is_list() && !value.is_map()) {
    value.unexpected(what);
    return nullptr;
  }
  const std::vector<YamlValue> shapes = value.is_list() ? value.list() : std::vector{value};
  if (shapes.empty() || shapes.size() > most_geometry_shapes) {
    value.error(ErrorCode::wrong_count, fmt::format("found {} shapes, expected 1 to {}",
                                                    shapes.size(), most_geometry_shapes));
    return nullptr;
  }
  auto out = std::make_shared<BodyShape>();
  bool good = true;
  for (const YamlValue& shape : shapes) {
    auto section = shape.section(what);
    const bool read = section && GeometryShape(self, *section).append(*out);
    good = good && read;
    if (out->triangles.size() > limits::geometry_triangles) break;
  }
  return good ? out : nullptr;
}

}  // namespace floatframe
