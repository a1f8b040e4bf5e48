#include <fmt/format.h>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/export/export_file.hpp"
#include "floatframe/export/hot_spots.hpp"
#include "floatframe/export/npz_file.hpp"
#include "floatframe/export/stress_field.hpp"
#include "floatframe/history/history_content.hpp"

namespace floatframe {
namespace {

class NumpyArchive : public ExportFile {
 public:
  NumpyArchive(const ExportBodies& bodies, std::string path, bool stress)
      : bodies_(bodies), path_(std::move(path)), tracks_(bodies.bodies.size()) {
    double numbers = 0.0;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      tracks_[i].named = named_nodes(*body(i).data);
      if (stress) tracks_[i].field = StressField({}, *body(i).data);
      if (tracks_[i].field.known())
        numbers += 6.0 * static_cast<double>(tracks_[i].field.stress().places.size());
    }
    if (stress && !(numbers > 0.0))
      throw InputError(ErrorCode::missing,
                       "--stress: none of the bodies whose states were recorded has stress data");
    // A zip archive of this kind is limited to 4 GB: checked before data is collected.
    const double size = 8.0 * numbers * static_cast<double>(bodies.instants);
    if (size > 4e9)
      throw InputError(
          ErrorCode::too_large,
          fmt::format("--npz: the stress of {} instants would take {:.1f} GB, expected 4 GB at "
                      "most: fewer instants (--every) or bodies (--body)",
                      bodies.instants, 1e-9 * size));
  }

  void add(const SystemMotion& motion) override {
    time_.push_back(motion.t);
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const BodyInstant m = body_motion(motion, bodies_.bodies[i]);
      Track& t = tracks_[i];
      t.turn = continued_quaternion(m.R, t.turn);
      keep(t.position, m.p);
      for (const double x : {t.turn.w(), t.turn.x(), t.turn.y(), t.turn.z()})
        t.rotation.push_back(x);
      keep(t.velocity, m.v);
      keep(t.angular_velocity, m.w);
      keep(t.acceleration, m.a);
      keep(t.angular_acceleration, m.alpha);
      keep(t.amplitudes, m.y);
      keep(t.rates, m.yd);
      keep(t.amplitude_accelerations, m.ydd);
      if (t.field.known()) keep(t.stress, t.field.at(m.y, stress_loads(motion, bodies_.bodies[i])));
      const Pose& design = body(i).X_WB;
      for (const int n : t.named) {
        const NodeMotion node = node_motion(body(i), n, m);
        const Vec3& p = body(i).data->nodes[static_cast<std::size_t>(n)].p;
        keep(t.node_positions, node.p);
        keep(t.node_displacements, node.p - (design.p + design.R * p));
        keep(t.node_deformations, node.deformation);
        keep(t.node_velocities, node.v);
      }
    }
  }

  std::string finish() override {
    const std::size_t instants = time_.size();
    file_.add("time", {instants}, std::move(time_));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < tracks_.size(); ++i) names.push_back(body(i).name);
    file_.add("bodies", names);
    for (std::size_t i = 0; i < tracks_.size(); ++i) body_members(i, instants);
    write_file(path_, file_.bytes());
    return fmt::format("{}: {} instants, {} bodies, {} arrays", path_, instants, tracks_.size(),
                       file_.size());
  }

 private:
  struct Track {
    std::vector<int> named;
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    std::vector<double> position, rotation, velocity, angular_velocity, acceleration,
        angular_acceleration, amplitudes, rates, amplitude_accelerations, node_positions,
        node_displacements, node_deformations, node_velocities, stress;
    StressField field;
  };

  const Body& body(std::size_t i) const { return bodies_.body(i); }
  static void keep(std::vector<double>& out, const Eigen::Ref<const VecX>& x) {
    out.insert(out.end(), x.data(), x.data() + x.size());
  }
  void body_members(std::size_t i, std::size_t instants) {
    Track& t = tracks_[i];
    const std::string at = body(i).name + "/";
    const auto add_array = [&](const char* name, std::vector<std::size_t> shape,
                               std::vector<double>& values) {
      shape.insert(shape.begin(), instants);
      file_.add(at + name, std::move(shape), std::move(values));
    };
    add_array("position", {3}, t.position);
    add_array("rotation", {4}, t.rotation);
    add_array("velocity", {3}, t.velocity);
    add_array("angular_velocity", {3}, t.angular_velocity);
    add_array("acceleration", {3}, t.acceleration);
    add_array("angular_acceleration", {3}, t.angular_acceleration);
    const auto nm = static_cast<std::size_t>(body(i).modes());
    if (nm > 0) {
      file_.add(at + "modes", names_of_modes(*body(i).data));
      add_array("amplitudes", {nm}, t.amplitudes);
      add_array("amplitude_rates", {nm}, t.rates);
      add_array("amplitude_accelerations", {nm}, t.amplitude_accelerations);
    }
    if (t.field.known()) stress_members(i, instants);
    if (t.named.empty()) return;
    std::vector<std::string> names;
    for (const int n : t.named)
      names.push_back(body(i).data->nodes[static_cast<std::size_t>(n)].name);
    file_.add(at + "nodes", names);
    add_array("node_positions", {t.named.size(), 3}, t.node_positions);
    add_array("node_displacements", {t.named.size(), 3}, t.node_displacements);
    add_array("node_deformations", {t.named.size(), 3}, t.node_deformations);
    add_array("node_velocities", {t.named.size(), 3}, t.node_velocities);
  }

  void stress_members(std::size_t i, std::size_t instants) {
    Track& t = tracks_[i];
    const std::string at = body(i).name + "/stress";
    const std::vector<StressPlace>& places = t.field.stress().places;
    file_.add(at, {instants, places.size(), 6}, std::move(t.stress));
    std::vector<double> positions;
    std::vector<std::int32_t> nodes, numbers, doubtful;
    std::vector<std::string> layers;
    for (const StressPlace& place : places) {
      positions.insert(positions.end(), place.p.begin(), place.p.end());
      nodes.push_back(place.node);
      numbers.push_back(place.number);
      doubtful.push_back(place.doubtful ? 1 : 0);
      layers.emplace_back(layer_name(place.layer));
    }
    file_.add(at + "_positions", {places.size(), 3}, std::move(positions));
    file_.add(at + "_nodes", {places.size()}, std::move(nodes));
    file_.add(at + "_numbers", {places.size()}, std::move(numbers));
    file_.add(at + "_doubtful", {places.size()}, std::move(doubtful));
    file_.add(at + "_layers", layers);
  }

  ExportBodies bodies_;
  std::string path_;
  std::vector<Track> tracks_;
  std::vector<double> time_;
  NpzFile file_;
};

}  // namespace

std::unique_ptr<ExportFile> numpy_archive(const ExportBodies& bodies, const std::string& path,
                                          bool stress) {
  return std::make_unique<NumpyArchive>(bodies, path, stress);
}

}  // namespace floatframe
