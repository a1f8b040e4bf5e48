#include "floatframe/page/scene_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "floatframe/body/alike.hpp"
#include "floatframe/body/surface_points.hpp"
#include "floatframe/history/history_content.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/road.hpp"
#include "floatframe/page/scene_mesh.hpp"
#include "floatframe/page/scene_stress.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v) { return {v[0], v[1], v[2]}; }

Json quaternion_json(const Mat3& R) {
  const Eigen::Quaterniond q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}

std::vector<float> as_floats(const std::vector<double>& x) { return {x.begin(), x.end()}; }

class SceneWriter {
 public:
  SceneWriter(const Model& model, const SceneFrames& frames, PageBuffer& buffer)
      : model_(model),
        frames_(frames),
        buffer_(buffer),
        stress_(model, frames, buffer),
        efforts_(frames.efforts),
        extent_(scene_extent(model)),
        places_(model.bodies.size()) {}

  Json write() {
    connections();
    named_nodes();
    Json bodies = Json::array();
    std::size_t first = 0;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      bodies.push_back(body(b, first));
      first += static_cast<std::size_t>(model_.bodies[b].modes());
    }
    Json scene;
    scene["frames"] = frames(first);
    scene["origin"] = triple(frames_.origin);
    scene["up"] = triple(scene_up(model_));
    scene["bodies"] = std::move(bodies);
    scene["points"] = std::move(points_);
    scene["joints"] = std::move(joints_);
    scene["forces"] = std::move(forces_);
    scene["rods"] = std::move(rods_);
    scene["strokes"] = std::move(strokes_);
    scene["efforts"] = efforts_.numbers(frames_.time.size(), buffer_);
    scene["roads"] = roads();
    scene["gravity"] = triple(model_.gravity);
    return scene;
  }

 private:
  Json frames(std::size_t modes) {
    const std::size_t count = frames_.time.size();
    if (count == 0) return nullptr;
    Json out;
    out["time"] = buffer_.add(std::span<const double>(frames_.time), {count});
    out["pose"] = buffer_.add(std::span<const float>(as_floats(frames_.poses)),
                              {count, model_.bodies.size(), 7});
    out["amplitudes"] = nullptr;
    if (modes == 0) return out;
    // After the amplitudes, the load coefficients of the stress shown.
    std::vector<float> rows;
    for (std::size_t f = 0; f < count; ++f) {
      for (std::size_t m = 0; m < modes; ++m)
        rows.push_back(static_cast<float>(frames_.amplitudes[f * modes + m]));
      stress_.append_loads(f, rows);
    }
    out["amplitudes"] = buffer_.add(std::span<const float>(rows), {count, rows.size() / count});
    return out;
  }

  // -- points: one for each marker used by a joint or force

  int point(int marker) {
    if (marker < 0) return -1;
    const auto known = point_of_.find(marker);
    if (known != point_of_.end()) return known->second;
    const int index = point_at(model_.markers[marker]);
    point_of_.emplace(marker, index);
    return index;
  }

  /// Named nodes without a point, so that they can be picked, too.
  void named_nodes() {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      const std::vector<ModalNode>& nodes = model_.bodies[b].data->nodes;
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        Marker m;
        m.body = static_cast<int>(b);
        m.node = static_cast<int>(n);
        const bool held = held_.contains({m.body, m.node});
        if (!held && !nodes[n].name.empty() && !is_surface_point(nodes[n])) point_at(m);
      }
    }
  }

  int point_at(const Marker& m) {
    Json out{{"name", ""}, {"body", m.body}, {"p", nullptr}, {"modes", nullptr}};
    Vec3 p = m.X_NM.p;
    if (m.body < 0) {
      p -= frames_.origin;
    } else {
      const FlexibleBody& data = *model_.bodies[m.body].data;
      if (m.node >= 0) {
        const ModalNode& node = data.nodes[m.node];
        if (data.modes() > 0) {
          Json modes = Json::array();
          for (Eigen::Index k = 0; k < data.modes(); ++k)
            modes.push_back(triple(node.X.col(k) + Vec3(node.X_theta.col(k)).cross(m.X_NM.p)));
          out["modes"] = std::move(modes);
        }
        p += node.p;
        out["name"] = node.name;
        held_.emplace(m.body, m.node);
      }
      places_[m.body].push_back(p);
    }
    out["p"] = triple(p);
    points_.push_back(std::move(out));
    return static_cast<int>(points_.size()) - 1;
  }

  void connections() {
    for (int i = 0; i < std::ssize(model_.joints); ++i) {
      const Joint& j = model_.joints[i];
      if (j.automatic) continue;
      const Mat3& R = model_.markers[j.frame_F].X_NM.R;
      const JointKind& kind = joint_kind(j.type);
      const bool has_axis = kind.axes != JointAxes::none;
      const auto coordinates = kind.coordinates.all();
      const auto turns = std::ranges::count(coordinates, JointUnit::rad, &JointCoordinate::unit);
      joints_.push_back({{"name", j.name},
                         {"type", joint_type_name(j.type)},
                         {"turns", turns},
                         {"slides", kind.coordinates.count() - turns},
                         {"a", point(j.frame_F)},
                         {"b", point(j.frame_M)},
                         {"axis", has_axis ? triple(R.col(2)) : Json()},
                         {"axes", quaternion_json(R)},
                         {"cut", j.cut},
                         {"values", efforts_.values_of_joint(i)}});
    }
    for (int k = 0; k < std::ssize(model_.elements); ++k) {
      const Element& e = model_.elements[k];
      const Picture bar = picture_of(e);
      if (bar.symbol == Picture::Symbol::bar)
        rods_.push_back({{"name", e.name}, {"a", point(bar.a)}, {"b", point(bar.b)}});
      else if (e.exerts() || e.links() || bar.symbol != Picture::Symbol::none)
        forces_.push_back(force(k));
      for (const Stroke& s : strokes_of(model_, e)) strokes_.push_back(stroke(e, s));
    }
  }

  /// Points in the axes of the body, from the point it is fixed to.
  Json stroke(const Element& e, const Stroke& s) {
    const Mat3& R = model_.markers[s.marker].X_NM.R;
    std::vector<float> points;
    for (const Vec3& p : s.points)
      for (const double x : Vec3(R * p)) points.push_back(static_cast<float>(x));
    Json view = buffer_.add(std::span<const float>(points), {s.points.size(), 3});
    return {{"name", e.name}, {"a", point(s.marker)}, {"points", std::move(view)}};
  }

  Json force(int index) {
    const Element& e = model_.elements[index];
    const Picture picture = picture_of(e);
    Json out{{"name", e.name},
             {"type", element_type_name(e.type)},
             {"picture", symbol_name(picture.symbol)},
             {"a", point(picture.a)},
             {"b", picture.b < 0 ? -1 : point(picture.b)},
             {"axis", nullptr},
             {"follows", picture.axis_of >= 0},
             {"radius", nullptr},
             {"width", nullptr},
             {"wrench", nullptr}};
    if (!picture.axis.isZero(0.0))
      out["axis"] =
          triple(picture.axis_of < 0 ? picture.axis
                                     : Vec3(model_.markers[picture.axis_of].X_NM.R * picture.axis));
    if (picture.radius > 0.0) {
      out["radius"] = picture.radius;
      out["width"] = picture.width;
    }
    if (!frames_.efforts.empty()) {
      const int port = frames_.efforts.elements[index].port;
      efforts_.add_element(index, port < 0 ? -1 : point(e.markers[port]), out);
    }
    return out;
  }

  // -- bodies

  Json body(std::size_t index, std::size_t first) {
    const Body& b = model_.bodies[index];
    const FlexibleBody& data = *b.data;
    Json out{{"name", b.name}, {"mass", data.invariants.m}, {"facts", body_facts(data)}};
    out["modes"] = data.modes() > 0 ? modes(data, first) : Json();
    auto known = std::find_if(shapes_.begin(), shapes_.end(),
                              [&](const auto& other) { return look_alike(*other.first, data); });
    if (known == shapes_.end()) known = shapes_.insert(shapes_.end(), {&data, shape(data)});
    Shape mine = known->second;
    if (mine.json.is_null()) {
      // A wheel is drawn as its tyre; a box would extend beyond it.
      if (has_tyre(index))
        mine.bound = b.length;
      else
        mine = box(data, places_[index]);
    }
    for (const Vec3& p : places_[index]) mine.bound = std::max(mine.bound, p.norm());
    out["shape"] = mine.json;
    out["stress"] = stress_.of(data, known->second.stress, first, index);
    if (const std::size_t numbers = known->second.stress.stress.left_out; numbers > 0)
      out["stress_left_out"] = numbers;
    out["bound"] = mine.bound;
    out["size"] = b.length;
    if (!frames_.known.empty() && !frames_.known[index]) out["recorded"] = false;
    return out;
  }

  bool has_tyre(std::size_t body) const {
    return std::any_of(model_.elements.begin(), model_.elements.end(), [&](const Element& e) {
      return is_wheel_of(model_, e, static_cast<int>(body));
    });
  }

  static Json body_facts(const FlexibleBody& data) {
    Json out = Json::array();
    out.push_back({"mass", fmt::format("{:.6g} kg", data.invariants.m)});
    if (data.invariants.m > 0.0) {
      const Vec3 c = data.invariants.m_u / data.invariants.m;
      out.push_back({"centre of mass", fmt::format("{:.4g}, {:.4g}, {:.4g} m", c[0], c[1], c[2])});
    }
    if (data.modes() > 0) out.push_back({"modes", std::to_string(data.modes())});
    if (data.nodes.size() > 0) out.push_back({"nodes", std::to_string(data.nodes.size())});
    return out;
  }

  static Json modes(const FlexibleBody& data, std::size_t first) {
    Json frequencies = Json::array();
    for (const double f : own_frequencies(data))
      frequencies.push_back(std::isfinite(f) ? Json(f) : Json());
    return {{"first", first},
            {"count", data.modes()},
            {"frequencies", std::move(frequencies)},
            {"names", names_of_modes(data)}};
  }

  struct Shape {
    Json json;
    double bound = 0.0;
    SceneStressWriter::Shape stress;
  };

  /// Identical bodies share their views.
  Shape shape(const FlexibleBody& data) {
    const SceneMesh mesh = scene_mesh(data);
    if (mesh.triangles.empty()) return {};
    const std::size_t vertices = mesh.vertices.size() / 3;
    Shape out;
    for (std::size_t v = 0; v < vertices; ++v)
      out.bound = std::max<double>(
          out.bound,
          std::hypot(mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2]));
    Json& j = out.json;
    j["kind"] = "mesh";
    j["vertices"] = buffer_.add(std::span<const float>(mesh.vertices), {vertices, 3});
    j["triangles"] =
        buffer_.add(std::span<const std::uint32_t>(mesh.triangles), {mesh.triangles.size() / 3, 3});
    j["normals"] = nullptr;
    j["displacements"] = nullptr;
    if (!mesh.displacements.empty())
      j["displacements"] = buffer_.add_half(mesh.displacements,
                                            {vertices, static_cast<std::size_t>(data.modes()), 3});
    j["nodes"] = nullptr;
    if (mesh.nodes.size() == vertices)
      j["nodes"] = buffer_.add(std::span<const std::uint32_t>(mesh.nodes), {vertices});
    j["generated"] = mesh.generated;
    if (!data.shape->color.empty()) j["color"] = data.shape->color;
    for (const BodyShape::Paint& p : data.shape->paints)
      j["paints"].push_back({p.first, p.color.empty() ? Json() : Json(p.color)});
    out.stress = stress_.shape(data);
    return out;
  }

  /// Empty of a dummy: it is drawn by its points.
  Shape box(const FlexibleBody& data, const std::vector<Vec3>& places) const {
    const SceneBox box = scene_box(data, places, extent_);
    Shape out;
    if (box.dummy) return out;
    out.json = {{"kind", box.round ? "cylinder" : "box"},
                {"size", triple(box.size)},
                {"position", triple(box.position)},
                {"quaternion", quaternion_json(box.axes)}};
    out.bound = box.position.norm() + 0.5 * box.size.norm();
    return out;
  }

  // -- roads, in the area reached by wheels

  Json roads() {
    Json out = Json::array();
    for (std::size_t r = 0; r < model_.roads.size(); ++r) {
      Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
      double radius = 0.0;
      for (const Element& e : model_.elements) {
        if (e.road != static_cast<int>(r)) continue;
        const Picture wheel = picture_of(e);
        const int body = model_.markers[wheel.a].body;
        radius = std::max(radius, wheel.radius);
        for (std::size_t k = 0; body >= 0 && k < frames_.time.size(); ++k) {
          const Vec3 p = Eigen::Map<const Vec3>(frames_.pose(k, static_cast<std::size_t>(body)));
          low = low.cwiseMin(p);
          high = high.cwiseMax(p);
        }
      }
      if (!(low[0] <= high[0])) continue;  // no wheel reaches it
      out.push_back(road(model_.roads[r], low - Vec3::Constant(6.0 * radius),
                         high + Vec3::Constant(6.0 * radius)));
    }
    return out;
  }

  Json road(const Road& road, const Vec3& low, const Vec3& high) {
    constexpr std::size_t most = 4000;
    constexpr double finest = 0.01;  // [m]
    const auto count = static_cast<std::size_t>(
        std::clamp(std::ceil((high[0] - low[0]) / finest), 2.0, static_cast<double>(most)));
    const double middle = 0.5 * (low[1] + high[1]) + frames_.origin[1];
    std::vector<float> profile;  // of a road with width that along its middle, no road far below
    for (std::size_t k = 0; k < count; ++k) {
      const double x =
          low[0] + (high[0] - low[0]) * static_cast<double>(k) / static_cast<double>(count - 1);
      profile.push_back(static_cast<float>(x));
      const double z = surface_at(road, x + frames_.origin[0], middle).z - frames_.origin[2];
      profile.push_back(std::isfinite(z) ? z : low[2]);
    }
    return {{"name", road.name},
            {"profile", buffer_.add(std::span<const float>(profile), {count, 2})},
            {"width", {low[1], high[1]}}};
  }

  const Model& model_;
  const SceneFrames& frames_;
  PageBuffer& buffer_;
  SceneStressWriter stress_;
  EffortWriter efforts_;
  SceneExtent extent_;
  std::vector<std::vector<Vec3>> places_;  ///< points on each body
  std::map<int, int> point_of_;            ///< index of the point of a marker
  std::set<std::pair<int, int>> held_;     ///< (body, node) pairs that have a point
  std::vector<std::pair<const FlexibleBody*, Shape>> shapes_;
  Json points_ = Json::array(), joints_ = Json::array(), forces_ = Json::array(),
       rods_ = Json::array(), strokes_ = Json::array();
};

}  // namespace

nlohmann::ordered_json scene_json(const Model& model, const SceneFrames& frames,
                                  PageBuffer& buffer) {
  return SceneWriter(model, frames, buffer).write();
}

}  // namespace floatframe
