#include "floatframe/export/motion_grid.hpp"

#include <limits>

namespace floatframe {

MotionGrid::MotionGrid(const ExportBodies& bodies) : bodies_(bodies) {
  std::vector<std::string> node_names;
  for (const int b : bodies_.bodies) {
    pictures_.push_back(body_picture(*bodies_.model, b));
    add_cells(pictures_.back(), b);
    for (const std::string& name : pictures_.back().names) node_names.push_back(name);
  }
  std::vector<std::string> body_names;
  for (const Body& b : bodies_.model->bodies) body_names.push_back(b.name);
  grid_.texts = {{"body_names", body_names}, {"node_names", node_names}};
  add_arrays();
}

void MotionGrid::add_arrays() {
  bool stressed = false;
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    fields_.emplace_back(pictures_[i], *bodies_.body(i).data);
    stressed = stressed || fields_.back().known();
  }
  grid_.points.resize(3 * points_);
  grid_.point_data = {
      {"displacement", 3, std::vector<double>(3 * points_)},
      {"deformation", 3, std::vector<float>(3 * points_)},
      {"velocity", 3, std::vector<float>(3 * points_)},
      {"body", 1, std::move(point_body_)},
      {"node", 1, std::move(point_node_)},
  };
  if (stressed) {
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    grid_.point_data.push_back({"stress", 6, std::vector<float>(6 * points_, unknown)});
    grid_.point_data.push_back({"von_mises", 1, std::vector<float>(points_, unknown)});
    grid_.point_data.push_back({"stress_doubtful", 1, std::vector<std::int32_t>(points_)});
    grid_.point_data.push_back({"node_number", 1, std::vector<std::int32_t>(points_)});
  }
  grid_.cell_data = {{"body", 1, std::move(cell_body_)}, {"drawn", 1, std::move(cell_drawn_)}};
}

const VtkGrid& MotionGrid::at(const SystemMotion& motion) {
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
  return grid_;
}

void MotionGrid::add_cells(const BodyPicture& picture, int body) {
  const auto first = static_cast<std::int32_t>(points_);
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
  points_ += static_cast<std::size_t>(picture.points.cols());
}

void MotionGrid::place(std::size_t i, const BodyInstant& m, std::size_t first) {
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

void MotionGrid::stress(std::size_t i, const BodyInstant& m, std::size_t first) {
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

}  // namespace floatframe
