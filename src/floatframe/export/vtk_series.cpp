#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <set>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/export/export_file.hpp"
#include "floatframe/export/stress_field.hpp"
#include "floatframe/formats/vtk/vtk_file.hpp"

namespace floatframe {
namespace {

constexpr const char* series_name = "motion";

std::string file_of_series(std::size_t k) { return fmt::format("{}_{:06}.vtu", series_name, k); }

bool is_grid_of_series(const std::string& name) {
  const std::string begin = std::string(series_name) + "_", end = ".vtu";
  if (name.size() < begin.size() + end.size() + 6 || !name.starts_with(begin) ||
      !name.ends_with(end))
    return false;
  return name.find_first_not_of("0123456789", begin.size()) == name.size() - end.size();
}

class VtkSeries : public ExportFile {
 public:
  VtkSeries(const ExportBodies& bodies, std::string folder)
      : bodies_(bodies), folder_(std::move(folder)) {
    make_output_folder(folder_);
    remove_file(path(std::string(series_name) + ".pvd"));
    std::vector<std::string> node_names;
    for (const int b : bodies_.bodies) {
      pictures_.push_back(body_picture(*bodies_.model, b));
      add_cells(pictures_.back());
      for (const std::string& name : pictures_.back().names) node_names.push_back(name);
    }
    bool stressed = false;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      fields_.emplace_back(pictures_[i], *bodies_.body(i).data);
      stressed = stressed || fields_.back().known();
    }
    std::vector<std::string> body_names;
    for (const Body& b : bodies_.model->bodies) body_names.push_back(b.name);
    grid_.texts = {{"body_names", body_names}, {"node_names", node_names}};
    const std::size_t points = first_point_;
    grid_.points.resize(3 * points);
    grid_.point_data = {
        {"displacement", 3, std::vector<double>(3 * points)},
        {"deformation", 3, std::vector<float>(3 * points)},
        {"velocity", 3, std::vector<float>(3 * points)},
        {"body", 1, std::move(point_body_)},
        {"node", 1, std::move(point_node_)},
    };
    if (stressed) {
      constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
      grid_.point_data.push_back({"stress", 6, std::vector<float>(6 * points, unknown)});
      grid_.point_data.push_back({"von_mises", 1, std::vector<float>(points, unknown)});
      grid_.point_data.push_back({"stress_doubtful", 1, std::vector<std::int32_t>(points)});
      grid_.point_data.push_back({"node_number", 1, std::vector<std::int32_t>(points)});
    }
    grid_.cell_data = {{"body", 1, std::move(cell_body_)}, {"drawn", 1, std::move(cell_drawn_)}};
  }

  void add(const SystemMotion& motion) override {
    std::size_t first = 0;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      const BodyInstant m = body_motion(motion, bodies_.bodies[i]);
      place(i, m, first);
      if (fields_[i].known()) {
        fields_[i].at(m.y, stress_loads(motion, bodies_.bodies[i]));
        stress(i, m, first);
      }
      first += static_cast<std::size_t>(pictures_[i].points.cols());
    }
    grid_.time = motion.t;
    const std::string name = file_of_series(files_.size());
    write_file(path(name), vtu_bytes(grid_), Flush::later);
    files_.emplace_back(motion.t, name);
  }

  std::string finish() override {
    std::set<std::string> written;
    for (const auto& [time, name] : files_) written.insert(name);
    std::error_code ignored;
    std::vector<std::string> old;
    for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
      const std::string name = entry.path().filename().string();
      if (is_grid_of_series(name) && !written.contains(name)) old.push_back(name);
    }
    for (const std::string& name : old) remove_file(path(name));
    flush_files(folder_);
    const std::string pvd = path(std::string(series_name) + ".pvd");
    write_file(pvd, pvd_text(files_));
    return fmt::format("{}: {} instants, {} bodies, {} points", pvd, files_.size(),
                       pictures_.size(), first_point_);
  }

 private:
  std::string path(const std::string& name) const {
    return (std::filesystem::path(folder_) / name).string();
  }

  void add_cells(const BodyPicture& picture) {
    const int body = bodies_.bodies[pictures_.size() - 1];
    const auto first = static_cast<std::int32_t>(first_point_);
    const auto cell = [&](std::uint8_t type, auto... points) {
      (grid_.connectivity.push_back(first + points), ...);
      grid_.offsets.push_back(static_cast<std::int32_t>(grid_.connectivity.size()));
      grid_.types.push_back(type);
      cell_body_.push_back(body);
      const int any = std::get<0>(std::tuple(points...));
      cell_drawn_.push_back(static_cast<int>(picture.origins[static_cast<std::size_t>(any)]));
    };
    for (const auto& t : picture.triangles) cell(vtk_cell::triangle, t[0], t[1], t[2]);
    for (const auto& l : picture.lines) cell(vtk_cell::line, l[0], l[1]);
    for (Eigen::Index k = picture.surface_points(); k < picture.points.cols(); ++k)
      cell(vtk_cell::vertex, static_cast<int>(k));
    for (const int n : picture.nodes) {
      point_node_.push_back(n);
      point_body_.push_back(body);
    }
    first_point_ += static_cast<std::size_t>(picture.points.cols());
  }

  void place(std::size_t i, const BodyInstant& m, std::size_t first) {
    const BodyPicture& picture = pictures_[i];
    const Pose& design = bodies_.body(i).X_WB;
    move_picture(picture, m, moved_);
    auto& displacement = std::get<std::vector<double>>(grid_.point_data[0].values);
    auto& deformation = std::get<std::vector<float>>(grid_.point_data[1].values);
    auto& velocity = std::get<std::vector<float>>(grid_.point_data[2].values);
    for (Eigen::Index k = 0; k < picture.points.cols(); ++k) {
      const Vec3 u = moved_.u.col(k), p = picture.points.col(k);
      const Vec3 arm = m.R * (p + u), x = m.p + arm;
      const Vec3 d = x - (design.p + design.R * p), e = m.R * u;
      const Vec3 v = m.v + m.w.cross(arm) + m.R * moved_.rate.col(k);
      const std::size_t at = 3 * (first + static_cast<std::size_t>(k));
      for (std::size_t c = 0; c < 3; ++c) {
        const auto axis = static_cast<Eigen::Index>(c);
        grid_.points[at + c] = x[axis];
        displacement[at + c] = d[axis];
        deformation[at + c] = static_cast<float>(e[axis]);
        velocity[at + c] = static_cast<float>(v[axis]);
      }
    }
  }

  void stress(std::size_t i, const BodyInstant& m, std::size_t first) {
    auto& tensor = std::get<std::vector<float>>(grid_.point_data[5].values);
    auto& von_mises = std::get<std::vector<float>>(grid_.point_data[6].values);
    auto& doubtful = std::get<std::vector<std::int32_t>>(grid_.point_data[7].values);
    auto& number = std::get<std::vector<std::int32_t>>(grid_.point_data[8].values);
    StressField::Shown shown;
    for (Eigen::Index k = 0; k < pictures_[i].points.cols(); ++k) {
      if (!fields_[i].shown(k, shown)) continue;
      const std::size_t at = first + static_cast<std::size_t>(k);
      const Vec6 s = turned_stress(m.R, shown.stress);
      for (std::size_t c = 0; c < 6; ++c)
        tensor[6 * at + c] = static_cast<float>(s[static_cast<Eigen::Index>(c)]);
      von_mises[at] = static_cast<float>(shown.von_mises);
      doubtful[at] = shown.place->doubtful ? 1 : 0;
      number[at] = shown.place->number;
    }
  }

  ExportBodies bodies_;
  std::string folder_;
  std::vector<BodyPicture> pictures_;
  std::vector<StressField> fields_;
  VtkGrid grid_;
  std::size_t first_point_ = 0;
  std::vector<std::int32_t> point_body_, point_node_, cell_body_, cell_drawn_;
  PictureMotion moved_;
  std::vector<std::pair<double, std::string>> files_;
};

}  // namespace

bool is_file_of_series(const std::string& name) {
  return name == std::string(series_name) + ".pvd" || is_grid_of_series(name);
}

std::unique_ptr<ExportFile> vtk_series(const ExportBodies& bodies, const std::string& folder) {
  return std::make_unique<VtkSeries>(bodies, folder);
}

}  // namespace floatframe
