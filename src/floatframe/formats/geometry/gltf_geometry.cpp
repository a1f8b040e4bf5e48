// glTF 2.0: a JSON object that names meshes in a tree of nodes, their numbers in buffers: in the
// second chunk of a .glb, in data: addresses or in files next to it. Triangles, strips and fans are
// read, with the transformations of their nodes; every length and index is checked against the
// actual sizes.
#include <algorithm>
#include <charconv>
#include <cstring>
#include <nlohmann/json.hpp>

#include "floatframe/core/base64.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/formats/geometry/geometry_build.hpp"

namespace floatframe {
namespace {

using GltfJson = nlohmann::ordered_json;

struct GltfPlace {
  Mat3 A = Mat3::Identity();
  Vec3 t = Vec3::Zero();
};

/// Numbers of an accessor.
struct GltfNumbers {
  std::string_view bytes;
  std::size_t count = 0, stride = 0;
  int component = 0;
};

constexpr int gltf_u8 = 5121, gltf_u16 = 5123, gltf_u32 = 5125, gltf_f32 = 5126;
constexpr std::pair<int, std::size_t> gltf_sizes[] = {
    {gltf_u8, 1}, {gltf_u16, 2}, {gltf_u32, 4}, {gltf_f32, 4}};

class GltfReader {
 public:
  GltfReader(const GltfJson& json, std::string_view chunk, const GeometryLoader& loader,
             GeometryBuilder& out)
      : json_(json), chunk_(chunk), loader_(loader), out_(out) {}

  void read() {
    if (!json_.is_object())
      out_.stop(ErrorCode::wrong_file, "found {}, expected glTF", json_excerpt(json_));
    const GltfJson* asset = member(json_, "asset");
    const GltfJson* version = asset ? member(*asset, "version") : nullptr;
    if (!version || !version->is_string() ||
        !version->get_ref<const std::string&>().starts_with("2."))
      out_.stop(ErrorCode::wrong_file, "found no asset.version 2.x, expected glTF 2.0");
    extensions();
    std::vector<std::pair<std::size_t, GltfPlace>> open;
    for (const std::size_t n : roots()) open.emplace_back(n, GltfPlace{});
    std::vector<bool> seen(size("nodes"), false);
    while (!open.empty()) {
      const auto [n, above] = open.back();
      open.pop_back();
      const GltfJson& node = element("nodes", n);
      if (seen[n])
        out_.stop(ErrorCode::duplicate, "found node {} twice, expected a tree of nodes", n);
      seen[n] = true;
      const GltfPlace own = place_of(node, n);
      const GltfPlace here{above.A * own.A, above.t + above.A * own.t};
      if (const auto m = index(node, "mesh")) mesh(*m, here);
      for (const std::size_t child : indices(node, "children")) open.emplace_back(child, here);
    }
    if (size("nodes") == 0)
      for (std::size_t m = 0; m < size("meshes"); ++m) mesh(m, {});
  }

 private:
  static const GltfJson* member(const GltfJson& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
  }
  std::size_t size(const char* list) const {
    const GltfJson* items = member(json_, list);
    return items && items->is_array() ? items->size() : 0;
  }
  const GltfJson& element(const char* list, std::size_t k) const {
    if (k >= size(list))
      out_.stop(ErrorCode::not_found, "found number {} of '{}', expected one below {}", k, list,
                size(list));
    return (*member(json_, list))[k];
  }
  std::size_t whole(const GltfJson& value, const char* key) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffffffu)
      out_.stop(ErrorCode::out_of_range, "{}: found {}, expected a whole number", key,
                json_excerpt(value));
    return value.get<std::size_t>();
  }
  std::optional<std::size_t> index(const GltfJson& object, const char* key) const {
    const GltfJson* value = member(object, key);
    return value ? std::optional(whole(*value, key)) : std::nullopt;
  }
  std::size_t required(const GltfJson& object, const char* key) const {
    const auto value = index(object, key);
    if (!value) out_.stop(ErrorCode::damaged, "'{}' is missing: the file is damaged", key);
    return *value;
  }
  std::vector<std::size_t> indices(const GltfJson& object, const char* key) const {
    std::vector<std::size_t> list;
    if (const GltfJson* items = member(object, key); items && items->is_array())
      for (const GltfJson& item : *items) list.push_back(whole(item, key));
    return list;
  }
  /// False if there is none.
  bool numbers(const GltfJson& object, const char* key, std::span<double> values) const {
    const GltfJson* items = member(object, key);
    if (!items) return false;
    bool good = items->is_array() && items->size() == values.size();
    for (std::size_t k = 0; good && k < values.size(); ++k) {
      good = (*items)[k].is_number();
      if (good) values[k] = (*items)[k].get<double>();
    }
    if (!good)
      out_.stop(ErrorCode::wrong_count, "{}: found {}, expected {} numbers", key,
                json_excerpt(*items), values.size());
    return true;
  }

  /// Those that change triangles or how they are written are not read.
  void extensions() const {
    const GltfJson* needed = member(json_, "extensionsRequired");
    if (!needed || !needed->is_array()) return;
    for (const GltfJson& item : *needed) {
      const std::string name = item.is_string() ? item.get<std::string>() : json_excerpt(item);
      if (!name.starts_with("KHR_materials_") && !name.starts_with("KHR_texture_") &&
          !name.starts_with("EXT_texture_") && !name.starts_with("KHR_lights_"))
        out_.stop(ErrorCode::unsupported,
                  "found the required extension '{}', expected glTF 2.0 without it (no "
                  "compression, no quantization)",
                  excerpt(name));
    }
  }

  std::vector<std::size_t> roots() const {
    if (size("scenes") > 0) {
      const auto scene = index(json_, "scene");
      return indices(element("scenes", scene.value_or(0)), "nodes");
    }
    std::vector<bool> child(size("nodes"), false);
    for (std::size_t n = 0; n < child.size(); ++n)
      for (const std::size_t k : indices(element("nodes", n), "children"))
        if (k < child.size()) child[k] = true;
    std::vector<std::size_t> list;
    for (std::size_t n = 0; n < child.size(); ++n)
      if (!child[n]) list.push_back(n);
    return list;
  }

  GltfPlace place_of(const GltfJson& node, std::size_t n) const {
    GltfPlace place;
    std::array<double, 16> m{};
    if (numbers(node, "matrix", m)) {  // by columns
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t r = 0; r < 3; ++r)
          place.A(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = m[4 * c + r];
      place.t = {m[12], m[13], m[14]};
    } else {
      std::array<double, 4> q{0.0, 0.0, 0.0, 1.0};
      std::array<double, 3> s{1.0, 1.0, 1.0}, t{};
      numbers(node, "rotation", q);
      numbers(node, "scale", s);
      numbers(node, "translation", t);
      Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
      if (!(turn.norm() > 1e-6))
        out_.stop(ErrorCode::geometry, "node {}: found a rotation of length zero", n);
      place.A = turn.normalized().toRotationMatrix() * Vec3(s[0], s[1], s[2]).asDiagonal();
      place.t = {t[0], t[1], t[2]};
    }
    return place;
  }

  // -- numbers

  std::string_view buffer(std::size_t k) {
    if (const auto known = buffers_.find(k); known != buffers_.end()) return known->second;
    const GltfJson& json = element("buffers", k);
    const GltfJson* uri = member(json, "uri");
    if (!uri) {
      if (k != 0 || chunk_.empty())
        out_.stop(ErrorCode::damaged, "buffer {} has no content: the file is cut short or damaged",
                  k);
      return chunk_;
    }
    if (!uri->is_string())
      out_.stop(ErrorCode::wrong_value, "uri: found {}, expected a text", json_excerpt(*uri));
    return buffers_.emplace(k, content(uri->get<std::string>())).first->second;
  }

  std::string content(const std::string& uri) const {
    if (uri.starts_with("data:")) {
      const std::size_t at = uri.find(";base64,");
      auto bytes = at == std::string::npos ? std::nullopt
                                           : from_base64(std::string_view(uri).substr(at + 8));
      if (!bytes)
        out_.stop(ErrorCode::damaged,
                  "found a data: address that is not base64: the file is damaged");
      return std::move(*bytes);
    }
    std::string name;
    for (std::size_t k = 0; k < uri.size(); ++k) {
      unsigned code = 0;
      const char* const digits = uri.data() + k + 1;
      const bool escaped = uri[k] == '%' && k + 2 < uri.size() &&
                           std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
      name += escaped ? static_cast<char>(code) : uri[k];
      if (escaped) k += 2;
    }
    if (!loader_ || name.find(':') != std::string::npos || name.find('\0') != std::string::npos)
      out_.stop(ErrorCode::unsupported,
                "found a buffer at '{}', expected one inside or in a file in the same folder",
                excerpt(uri));
    const auto place = std::filesystem::path(name).lexically_normal();
    if (name.empty() || place.is_absolute() || *place.begin() == "..")
      out_.stop(ErrorCode::unsupported,
                "found a buffer at '{}', expected one in the folder of this file or below it",
                excerpt(uri));
    return loader_(name);
  }

  GltfNumbers accessor(std::size_t k, const char* type, std::size_t values) {
    const GltfJson& json = element("accessors", k);
    const GltfJson* given = member(json, "type");
    if (!given || !given->is_string() || given->get_ref<const std::string&>() != type)
      out_.stop(ErrorCode::wrong_count, "accessor {}: found another type, expected {}", k, type);
    if (member(json, "sparse"))
      out_.stop(ErrorCode::unsupported, "accessor {} is sparse, expected all of its numbers", k);
    GltfNumbers n;
    n.component = static_cast<int>(required(json, "componentType"));
    n.count = required(json, "count");
    const auto* const known =
        std::find_if(std::begin(gltf_sizes), std::end(gltf_sizes),
                     [&](const auto& size) { return size.first == n.component; });
    const std::size_t one = known == std::end(gltf_sizes) ? 0 : known->second;
    if (one == 0)
      out_.stop(ErrorCode::unsupported,
                "accessor {}: found numbers of type {}, expected 5121, 5123, 5125 or 5126", k,
                n.component);
    const GltfJson& view = element("bufferViews", required(json, "bufferView"));
    const std::string_view all = buffer(required(view, "buffer"));
    const std::size_t offset = index(view, "byteOffset").value_or(0);
    const std::size_t length = required(view, "byteLength");
    const std::size_t start = index(json, "byteOffset").value_or(0);
    n.stride = index(view, "byteStride").value_or(one * values);
    const bool inside =
        offset <= all.size() && length <= all.size() - offset && start <= length &&
        n.stride >= one * values &&
        (n.count == 0 || (one * values <= length - start &&
                          n.count - 1 <= (length - start - one * values) / n.stride));
    if (!inside)
      out_.stop(
          ErrorCode::damaged,
          "accessor {} reaches beyond its buffer of {} bytes: the file is cut short or damaged", k,
          all.size());
    n.bytes = all.substr(offset + start);
    return n;
  }

  template <class Number>
  static Number number(const GltfNumbers& n, std::size_t row, std::size_t column) {
    Number x{};
    std::memcpy(&x, n.bytes.data() + row * n.stride + column * sizeof(Number), sizeof x);
    return x;
  }
  static std::size_t whole_number(const GltfNumbers& n, std::size_t row) {
    return n.component == gltf_u8    ? number<std::uint8_t>(n, row, 0)
           : n.component == gltf_u16 ? number<std::uint16_t>(n, row, 0)
                                     : number<std::uint32_t>(n, row, 0);
  }

  // -- meshes

  void mesh(std::size_t m, const GltfPlace& place) {
    const GltfJson* primitives = member(element("meshes", m), "primitives");
    if (!primitives || !primitives->is_array())
      out_.stop(ErrorCode::damaged, "mesh {} has no primitives: the file is damaged", m);
    for (const GltfJson& p : *primitives) {
      const std::size_t mode = index(p, "mode").value_or(4);
      if (mode < 4) continue;  // points and lines
      if (mode > 6) out_.stop(ErrorCode::out_of_range, "mode: found {}, expected 0 to 6", mode);
      primitive(p, mode, place);
    }
  }

  void primitive(const GltfJson& json, std::size_t mode, const GltfPlace& place) {
    const GltfJson* attributes = member(json, "attributes");
    const auto at = attributes ? index(*attributes, "POSITION") : std::nullopt;
    if (!at) return;
    const GltfNumbers points = accessor(*at, "VEC3", 3);
    if (points.component != gltf_f32)
      out_.stop(ErrorCode::unsupported,
                "accessor {}: found positions of type {}, expected 5126 (float)", *at,
                points.component);
    const std::size_t first = out_.points();
    for (std::size_t k = 0; k < points.count; ++k) {
      const Vec3 p(number<float>(points, k, 0), number<float>(points, k, 1),
                   number<float>(points, k, 2));
      out_.point(place.A * p + place.t);
    }
    GltfNumbers order;
    order.count = points.count;
    const auto indexed = index(json, "indices");
    if (indexed) {
      order = accessor(*indexed, "SCALAR", 1);
      if (order.component == gltf_f32)
        out_.stop(ErrorCode::unsupported, "accessor {}: found floats, expected indices", *indexed);
    }
    const auto corner = [&](std::size_t k) {
      const std::size_t v = indexed ? whole_number(order, k) : k;
      if (v >= points.count)
        out_.stop(ErrorCode::not_found, "accessor {}: found point {}, expected one below {}",
                  *indexed, v, points.count);
      return static_cast<int>(first + v);
    };
    const bool turned = place.A.determinant() < 0.0;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      out_.triangle(corner(a), corner(turned ? c : b), corner(turned ? b : c));
    };
    if (mode == 4) {
      if (order.count % 3 != 0)
        out_.stop(ErrorCode::wrong_count, "found {} corners of triangles, expected a multiple of 3",
                  order.count);
      for (std::size_t k = 0; k + 2 < order.count; k += 3) add(k, k + 1, k + 2);
    } else {
      for (std::size_t k = 0; k + 2 < order.count; ++k)
        mode == 6 ? add(0, k + 1, k + 2) : k % 2 == 0 ? add(k, k + 1, k + 2) : add(k + 1, k, k + 2);
    }
  }

  const GltfJson& json_;
  std::string_view chunk_;
  const GeometryLoader& loader_;
  GeometryBuilder& out_;
  std::map<std::size_t, std::string> buffers_;
};

std::uint32_t gltf_word(std::string_view bytes, std::size_t at) {
  std::uint32_t x = 0;
  std::memcpy(&x, bytes.data() + at, sizeof x);
  return x;
}

/// JSON and the numbers of a .glb: chunks of a length, a type and their content.
void gltf_chunks(std::string_view bytes, GeometryBuilder& out, std::string_view& json,
                 std::string_view& numbers) {
  if (bytes.size() < 20)
    out.stop(ErrorCode::damaged, "the file ends in its header: it is cut short");
  if (gltf_word(bytes, 4) != 2)
    out.stop(ErrorCode::unsupported, "found version {} of glTF, expected 2", gltf_word(bytes, 4));
  if (gltf_word(bytes, 8) > bytes.size())
    out.stop(ErrorCode::damaged, "found {} bytes, expected {}: it is cut short", bytes.size(),
             gltf_word(bytes, 8));
  bytes = bytes.substr(0, gltf_word(bytes, 8));
  std::size_t at = 12;
  for (int k = 0; k < 2 && at + 8 <= bytes.size(); ++k) {
    const std::size_t length = gltf_word(bytes, at);
    const std::uint32_t type = gltf_word(bytes, at + 4);
    at += 8;
    if (length > bytes.size() - at)
      out.stop(ErrorCode::damaged, "a chunk reaches beyond the end of the file: it is damaged");
    if (k == 0 && type == 0x4e4f534a) json = bytes.substr(at, length);
    if (k == 1 && type == 0x004e4942) numbers = bytes.substr(at, length);
    at += length;
  }
  if (json.empty()) out.stop(ErrorCode::missing, "found no JSON in the first chunk, expected glTF");
}

}  // namespace

void parse_gltf(std::string_view bytes, const GeometryLoader& loader, GeometryBuilder& out) {
  std::string_view text = bytes, chunk;
  if (bytes.starts_with("glTF")) gltf_chunks(bytes, out, text, chunk);
  std::string why;
  const GltfJson json = read_json(text, why);
  if (json.is_discarded()) out.stop(ErrorCode::wrong_file, "the file is not glTF: {}", why);
  GltfReader(json, chunk, loader, out).read();
}

}  // namespace floatframe
