#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/export/export_file.hpp"
#include "floatframe/export/glb_file.hpp"
#include "floatframe/export/morph_targets.hpp"
#include "floatframe/page/scene_mesh.hpp"

namespace floatframe {
namespace {

using SceneJson = nlohmann::ordered_json;

/// Used in turn for bodies without a colour.
constexpr const char* gltf_colors[] = {"#8197ae", "#c7a777", "#8db08c", "#b791a8",
                                       "#7cb0b8", "#a3a0c9", "#c5957f", "#aab08a"};

/// The components of "#rrggbb", from 0 to 1 in linear RGB, as in glTF.
std::vector<double> linear_color(const std::string& color) {
  std::vector<double> out;
  for (std::size_t k = 1; k < 7; k += 2) {
    const double s = std::stoi(color.substr(k, 2), nullptr, 16) / 255.0;
    out.push_back(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  out.push_back(1.0);
  return out;
}

SceneJson triple_of(const Vec3& v) { return {v[0], v[1], v[2]}; }
SceneJson quaternion_of(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

class GlbScene : public ExportFile {
 public:
  GlbScene(const ExportBodies& bodies, std::string path)
      : bodies_(bodies), path_(std::move(path)), tracks_(bodies.bodies.size()) {
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const BodyPicture picture = body_picture(*bodies_.model, bodies_.bodies[i]);
      std::size_t known = 0;
      while (known < meshes_.size() && !same_picture(meshes_[known].picture, picture)) ++known;
      if (known == meshes_.size()) meshes_.push_back({picture, bodies_.bodies[i], {}, {}});
      meshes_[known].users.push_back(i);
      tracks_[i].mesh = known;
    }
  }

  void add(const SystemMotion& motion) override {
    // Times must ascend as floats, too.
    const auto time = static_cast<float>(motion.t - first_time_.value_or(motion.t));
    if (!first_time_) first_time_ = motion.t;
    if (!times_.empty() && !(time > times_.back())) return;
    times_.push_back(time);
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const BodyInstant m = body_motion(motion, bodies_.bodies[i]);
      Track& track = tracks_[i];
      track.places.push_back(m.p);
      track.turns.push_back(continued_quaternion(
          m.R, track.turns.empty() ? Eigen::Quaterniond::Identity() : track.turns.back()));
      track.amplitudes.insert(track.amplitudes.end(), m.y.data(), m.y.data() + m.y.size());
    }
  }

  std::string finish() override {
    set_origin_of_scene();
    for (std::size_t k = 0; k < meshes_.size(); ++k) write_mesh(k);
    for (std::size_t i = 0; i < tracks_.size(); ++i) write_body(i);
    SceneJson children = SceneJson::array();
    for (std::size_t i = 0; i < tracks_.size(); ++i) children.push_back(i + 1);
    const auto up = Eigen::Quaterniond::FromTwoVectors(scene_up(*bodies_.model), Vec3::UnitY());
    const SceneJson root{{"name", bodies_.model->name},
                         {"rotation", quaternion_of(up)},
                         {"children", children},
                         {"extras",
                          {{"origin_m", triple_of(origin_)},
                           {"first_time_s", first_time_.value_or(0.0)},
                           {"up", triple_of(scene_up(*bodies_.model))}}}};
    nodes_.insert(nodes_.begin(), root);
    SceneJson document;
    document["asset"] = {{"version", "2.0"}, {"generator", std::string("Floatframe ") + version()}};
    document["scene"] = 0;
    document["scenes"] = SceneJson::array({{{"nodes", {0}}}});
    document["nodes"] = std::move(nodes_);
    document["meshes"] = std::move(mesh_list_);
    document["materials"] = std::move(materials_);
    if (!channels_.empty())
      document["animations"] = SceneJson::array({{{"name", "motion"},
                                                  {"samplers", std::move(samplers_)},
                                                  {"channels", std::move(channels_)}}});
    const std::string bytes = file_.bytes(std::move(document));
    write_file(path_, bytes);
    return fmt::format("{}: {} key frames, {} bodies, {:.1f} MB", path_, times_.size(),
                       tracks_.size(), 1e-6 * static_cast<double>(bytes.size()));
  }

 private:
  struct Mesh {
    BodyPicture picture;
    int body = 0;                    ///< a body with this mesh
    std::vector<std::size_t> users;  ///< tracks
    std::vector<MorphTarget> targets;
  };
  struct Track {
    std::size_t mesh = 0;
    std::vector<Vec3> places;
    std::vector<Eigen::Quaterniond> turns;
    std::vector<double> amplitudes;
  };

  /// Half the last digit of a float is less than 4 um up to 128 m.
  void set_origin_of_scene() {
    constexpr double far = 100.0;  // [m]
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    for (const Track& track : tracks_)
      for (const Vec3& p : track.places) {
        const bool first = &p == &tracks_.front().places.front();
        low = first ? p : low.cwiseMin(p);
        high = first ? p : high.cwiseMax(p);
      }
    if (std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()) > far)
      origin_ = (0.5 * (low + high) / far).array().round().matrix() * far;
  }

  int material(const std::string& color) {
    const std::string name =
        color.empty() ? gltf_colors[mesh_list_.size() % std::size(gltf_colors)] : color;
    for (std::size_t k = 0; k < materials_.size(); ++k)
      if (materials_[k]["name"] == name) return static_cast<int>(k);
    materials_.push_back({{"name", name},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", linear_color(name)},
                            {"metallicFactor", 0.1},
                            {"roughnessFactor", 0.6}}},
                          {"doubleSided", true}});
    return static_cast<int>(materials_.size()) - 1;
  }

  /// The points from `first` on, with their displacements in each target.
  struct Vertices {
    SceneJson attributes, targets;
  };
  Vertices vertices(const Mesh& mesh, Eigen::Index first, Eigen::Index count) {
    const auto accessor = [&](const double* numbers) {
      std::vector<float> floats(static_cast<std::size_t>(3 * count));
      bool zero = true;
      for (std::size_t k = 0; k < floats.size(); ++k) {
        floats[k] = static_cast<float>(numbers[k]);
        zero = zero && floats[k] == 0.0F;
      }
      if (!zero) return file_.floats(floats, "VEC3", true, gltf::vertices);
      // For targets that move named nodes only: one array of zeros for each size.
      const auto known = zeros_.find(count);
      if (known != zeros_.end()) return known->second;
      return zeros_[count] = file_.floats(floats, "VEC3", true, gltf::vertices);
    };
    Vertices out{SceneJson::object(), SceneJson::array()};
    out.attributes["POSITION"] = accessor(mesh.picture.points.data() + 3 * first);
    for (const MorphTarget& t : mesh.targets)
      out.targets.push_back({{"POSITION", accessor(t.field.data() + 3 * first)}});
    return out;
  }

  void write_mesh(std::size_t index) {
    Mesh& mesh = meshes_[index];
    const FlexibleBody& data = *bodies_.model->bodies[static_cast<std::size_t>(mesh.body)].data;
    std::vector<const std::vector<double>*> amplitudes;
    for (const std::size_t user : mesh.users) amplitudes.push_back(&tracks_[user].amplitudes);
    mesh.targets = morph_targets(mesh.picture, data, amplitudes);
    const int color = material(mesh.picture.color);
    SceneJson primitives = SceneJson::array();
    const auto primitive = [&](const Vertices& v, int mode, int indices) {
      SceneJson p{{"attributes", v.attributes}, {"mode", mode}, {"material", color}};
      if (indices >= 0) p["indices"] = indices;
      if (!v.targets.empty()) p["targets"] = v.targets;
      primitives.push_back(std::move(p));
    };
    const Eigen::Index surface = mesh.picture.surface_points();
    const Vertices drawn = vertices(mesh, 0, surface);  // a box, if there is nothing else
    const auto indices = [&](const auto& cells) {
      std::vector<std::uint32_t> out;
      for (const auto& cell : cells)
        for (const int p : cell) out.push_back(static_cast<std::uint32_t>(p));
      return file_.indices(out);
    };
    if (!mesh.picture.triangles.empty())
      primitive(drawn, gltf::triangles, indices(mesh.picture.triangles));
    if (!mesh.picture.lines.empty()) primitive(drawn, gltf::lines, indices(mesh.picture.lines));
    SceneJson extras = SceneJson::object();
    if (!mesh.picture.names.empty()) {
      primitive(vertices(mesh, surface, mesh.picture.points.cols() - surface), gltf::points, -1);
      extras["node_names"] = mesh.picture.names;
    }
    SceneJson out{{"name", bodies_.model->bodies[static_cast<std::size_t>(mesh.body)].name},
                  {"primitives", std::move(primitives)}};
    if (!mesh.targets.empty()) {
      SceneJson names = SceneJson::array();
      for (const MorphTarget& t : mesh.targets) names.push_back(t.name);
      extras["targetNames"] = std::move(names);  // shown by Blender and others
    }
    if (!extras.empty()) out["extras"] = std::move(extras);
    mesh_list_.push_back(std::move(out));
  }

  void channel(std::size_t node, const char* path, const std::vector<float>& numbers,
               const char* type) {
    if (times_.size() < 2) return;
    if (times_accessor_ < 0) times_accessor_ = file_.floats(times_, "SCALAR", true);
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times_accessor_},
                         {"interpolation", "LINEAR"},
                         {"output", file_.floats(numbers, type, false)}});
  }

  void write_body(std::size_t i) {
    const Track& track = tracks_[i];
    const Mesh& mesh = meshes_[track.mesh];
    const Body& body = bodies_.body(i);
    std::vector<float> places, turns, weights;
    for (const Vec3& p : track.places)
      for (const double x : Vec3(p - origin_)) places.push_back(static_cast<float>(x));
    for (const Eigen::Quaterniond& q : track.turns)
      for (const double x : q.coeffs()) turns.push_back(static_cast<float>(x));
    const auto nm = static_cast<std::size_t>(body.modes());
    for (std::size_t k = 0; k < track.places.size(); ++k)
      for (const MorphTarget& t : mesh.targets)
        weights.push_back(static_cast<float>(t.weight(track.amplitudes.data() + k * nm)));
    const auto beginning = [](const std::vector<float>& x, std::size_t n) {
      return std::vector<double>(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n));
    };
    SceneJson node{{"name", body.name},
                   {"mesh", track.mesh},
                   {"translation", beginning(places, 3)},
                   {"rotation", beginning(turns, 4)}};
    channel(i + 1, "translation", places, "VEC3");
    channel(i + 1, "rotation", turns, "VEC4");
    if (!mesh.targets.empty()) {
      node["weights"] = beginning(weights, mesh.targets.size());
      channel(i + 1, "weights", weights, "SCALAR");
    }
    nodes_.push_back(std::move(node));
  }

  ExportBodies bodies_;
  std::string path_;
  std::vector<Mesh> meshes_;
  std::vector<Track> tracks_;
  std::vector<float> times_;
  std::optional<double> first_time_;
  Vec3 origin_ = Vec3::Zero();
  GlbFile file_;
  int times_accessor_ = -1;
  std::map<Eigen::Index, int> zeros_;  ///< accessors
  SceneJson nodes_ = SceneJson::array(), mesh_list_ = SceneJson::array(),
            materials_ = SceneJson::array(), samplers_ = SceneJson::array(),
            channels_ = SceneJson::array();
};

}  // namespace

std::unique_ptr<ExportFile> glb_scene(const ExportBodies& bodies, const std::string& path) {
  return std::make_unique<GlbScene>(bodies, path);
}

}  // namespace floatframe
