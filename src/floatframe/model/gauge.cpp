#include "floatframe/model/gauge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/output_view.hpp"

namespace floatframe {
namespace {

/// A gauge that is asked for at a point must be this near to a place, as a part of the body's size.
constexpr double near_enough = 0.05;

/// eps = row . stress
Eigen::RowVector<double, 6> strain_row(const Vec3& d, const StressGroup& group) {
  Eigen::RowVector<double, 6> row;
  row << d(0) * d(0), d(1) * d(1), d(2) * d(2), 2.0 * d(0) * d(1), 2.0 * d(1) * d(2),
      2.0 * d(2) * d(0);
  row *= 1.0 + group.poisson;
  row.head<3>().array() -= group.poisson * d.squaredNorm();
  return row / group.young;
}

const char* layer_word(StressPlace::Layer layer) {
  switch (layer) {
    case StressPlace::Layer::top:
      return "top";
    case StressPlace::Layer::bottom:
      return "bottom";
    case StressPlace::Layer::section:
      return "a point of a section";
    case StressPlace::Layer::solid:
      break;
  }
  return "solid";
}

struct Candidate {
  int index;
  Vec3 p;
};

Vec3 centre_of(const std::vector<StressPlace>& places) {
  Vec3 sum = Vec3::Zero();
  for (const StressPlace& place : places) sum += place.p;
  return places.empty() ? sum : Vec3(sum / static_cast<double>(places.size()));
}

double size_of(const std::vector<StressPlace>& places) {
  const Vec3 centre = centre_of(places);
  double out = 0.0;
  for (const StressPlace& place : places) out = std::max(out, 2.0 * (place.p - centre).norm());
  return out;
}

bool of_layer(const StressPlace& place, GaugeDescription::Layer layer) {
  using L = GaugeDescription::Layer;
  return layer == L::any || (layer == L::top && place.layer == StressPlace::Layer::top) ||
         (layer == L::bottom && place.layer == StressPlace::Layer::bottom);
}

std::string node_text(const GaugeDescription& gauge, const std::string& node_name) {
  return node_name.empty() ? fmt::format("node {}", gauge.node)
                           : fmt::format("node '{}'", node_name);
}

/// The one farthest along `toward`.
int farthest(const std::vector<Candidate>& all, const Vec3& toward) {
  const auto it = std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return a.p.dot(toward) < b.p.dot(toward);
  });
  return it->index;
}

GaugeChoice choose_place(const BodyStress& stress, const std::string& body,
                         const GaugeDescription& gauge, const Vec3* point, const std::string& node,
                         int node_index, const Vec3& toward) {
  GaugeChoice out;
  std::vector<Candidate> all;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < stress.places.size(); ++k) {
    const StressPlace& place = stress.places[k];
    if (!of_layer(place, gauge.layer)) continue;
    const auto index = static_cast<int>(k);
    if (point) {
      const double distance = (place.p - *point).norm();
      if (distance < nearest) all = {{index, place.p}};
      nearest = std::min(nearest, distance);
    } else if (node.empty() ? place.number == gauge.node : place.node == node_index) {
      all.push_back({index, place.p});
    }
  }
  if (point && !all.empty() && !toward.isZero(0.0)) {
    // The node that is nearest, and of its places the one farthest along `toward`.
    const int node_there = stress.places[all.front().index].node;
    all.clear();
    for (std::size_t k = 0; k < stress.places.size(); ++k)
      if (stress.places[k].node == node_there && of_layer(stress.places[k], gauge.layer))
        all.push_back({static_cast<int>(k), stress.places[k].p});
  }
  if (all.empty()) {
    const bool layered = gauge.layer != GaugeDescription::Layer::any;
    out.error =
        fmt::format("body '{}' has no stress at {}{}, expected a node of its surface{}", body,
                    point ? "that point" : node_text(gauge, node), layered ? " in that layer" : "",
                    layered ? "; solids and beams have no layers" : "");
  } else if (point && nearest > near_enough * size_of(stress.places)) {
    out.error =
        fmt::format("the nearest place of body '{}' with stress is {:.3g} m away", body, nearest);
  } else if (all.size() > 1 && toward.isZero(0.0)) {
    std::string list;
    for (const Candidate& c : all) {
      const StressPlace& place = stress.places[c.index];
      const std::string& material = stress.groups[place.group].name;
      if (list.size() < 100)
        list += fmt::format("{}{}{}", list.empty() ? "" : ", ", layer_word(place.layer),
                            material.empty() ? "" : " of " + material);
    }
    out.error = fmt::format(
        "body '{}' has {} places with stress at {} ({}), expected 'toward', a direction that tells "
        "which",
        body, all.size(), node_text(gauge, node), list);
  } else {
    out.place = all.size() == 1 ? all.front().index : farthest(all, toward);
  }
  return out;
}

GaugeChoice choose_section(const BodyStress& stress, const std::string& body,
                           const GaugeDescription& gauge, const Vec3* point,
                           const std::string& node, int node_index, const Vec3& toward) {
  GaugeChoice out;
  std::vector<Candidate> all;
  double nearest = std::numeric_limits<double>::infinity();
  if (point)
    for (const BeamSectionPlace& section : stress.sections)
      nearest = std::min(nearest, (section.p - *point).norm());
  for (std::size_t k = 0; k < stress.sections.size(); ++k) {
    const BeamSectionPlace& section = stress.sections[k];
    const bool here = point          ? (section.p - *point).norm() <= nearest * (1.0 + 1e-9)
                      : node.empty() ? section.number == gauge.node
                                     : section.node == node_index;
    if (!here) continue;
    // The other end of the element tells the two sides of a node apart.
    const BeamSectionPlace& other = stress.sections[section.end == 0 ? k + 1 : k - 1];
    all.push_back({static_cast<int>(k), other.p});
  }
  if (stress.sections.empty())
    out.error = fmt::format("body '{}' has no beams, and so no section forces", body);
  else if (all.empty())
    out.error = fmt::format("no beam of body '{}' ends at {}", body, node_text(gauge, node));
  else
    out.section = toward.isZero(0.0) ? all.front().index : farthest(all, toward);
  return out;
}

}  // namespace

void fill_rows(const FlexibleBody& body, Gauge& gauge) {
  const BodyStress& stress = *body.stress;
  if (gauge.section >= 0) {
    const Eigen::Index row = 6 * static_cast<Eigen::Index>(gauge.section);
    gauge.modes = stress.section_modes.middleRows<6>(row);
    gauge.loads.resize(6, 0);
    if (gauge.inertia_loads && stress.section_loads.size() > 0)
      gauge.loads = stress.section_loads.middleRows<6>(row);
    return;
  }
  const Eigen::Index row = 6 * static_cast<Eigen::Index>(gauge.place);
  gauge.modes = stress.modes.middleRows<6>(row);
  gauge.loads.resize(6, 0);
  if (gauge.inertia_loads && stress.loads.size() > 0) gauge.loads = stress.loads.middleRows<6>(row);
  if (gauge.direction.isZero(0.0)) return;
  const auto strain = strain_row(gauge.direction, stress.groups[stress.places[gauge.place].group]);
  for (auto* m : {&gauge.modes, &gauge.loads}) {
    const Eigen::RowVectorXd values = strain * *m;
    m->setZero();
    m->row(0) = values;
  }
}

BodyLoadCoefficients body_load_coefficients(const OutputView& view, int body) noexcept {
  const Mat3& R = view.body_rotation(body);
  const Vec3 a = R.transpose() * (view.body_acceleration(body) - view.model().gravity);
  const Vec3 w = R.transpose() * view.body_angular_velocity(body);
  const Vec3 alpha = R.transpose() * view.body_angular_acceleration(body);
  const Mat3 A = skew(alpha) + skew(w) * skew(w);
  BodyLoadCoefficients c;
  c.head<3>() = -a;
  for (int i = 0; i < 3; ++i) c.segment<3>(3 + 3 * i) = -A.col(i);
  return c;
}

Vec6 gauge_values(const OutputView& view, const Gauge& gauge) noexcept {
  Vec6 out = Vec6::Zero();
  const auto nm = static_cast<int>(gauge.modes.cols());
  for (int k = 0; k < nm; ++k) out += gauge.modes.col(k) * view.amplitude(gauge.body, k);
  if (gauge.loads.cols() == 0) return out;
  const BodyLoadCoefficients c = body_load_coefficients(view, gauge.body);
  for (int k = 0; k < body_load_cases; ++k) out += gauge.loads.col(k) * c(k);
  for (int k = 0; k < nm; ++k)
    out -= gauge.loads.col(body_load_cases + k) * view.amplitude_acceleration(gauge.body, k);
  return out;
}

double von_mises(const Vec6& s) noexcept {
  const double a = s(0) - s(1), b = s(1) - s(2), c = s(2) - s(0);
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * s.tail<3>().squaredNorm());
}

Vec3 principal_stresses(const Vec6& s) noexcept {
  const double mean = (s(0) + s(1) + s(2)) / 3.0;
  const Vec3 d = s.head<3>().array() - mean;
  const double p = std::sqrt((d.squaredNorm() + 2.0 * s.tail<3>().squaredNorm()) / 6.0);
  if (!(p > 0.0)) return Vec3::Constant(mean);
  // det((s - mean I) / p) / 2 = cos(3 phi)
  const Vec3 e = d / p;
  const double xy = s(3) / p, yz = s(4) / p, zx = s(5) / p;
  const double half_det = 0.5 * (e(0) * (e(1) * e(2) - yz * yz) - xy * (xy * e(2) - yz * zx) +
                                 zx * (xy * yz - e(1) * zx));
  const double phi = std::acos(std::clamp(half_det, -1.0, 1.0)) / 3.0;
  const double first = mean + 2.0 * p * std::cos(phi);
  const double third = mean + 2.0 * p * std::cos(phi + 2.0 * std::numbers::pi / 3.0);
  return {first, 3.0 * mean - first - third, third};
}

GaugeChoice find_place(const FlexibleBody& body, const std::string& name,
                       const GaugeDescription& gauge, const Vec3* point,
                       const std::string& node_name, const Vec3& toward, bool section) {
  if (!body.stress || body.modes() == 0)
    return {-1, -1,
            fmt::format("body '{}' {}", name,
                        body.modes() == 0
                            ? "is rigid and knows no stress"
                            : "knows no stress: its part was reduced without (stresses: false), is "
                              "given by matrices, or its file has none")};
  int node_index = -1;
  if (!node_name.empty()) {
    const auto it = std::find_if(body.nodes.begin(), body.nodes.end(),
                                 [&](const ModalNode& n) { return n.name == node_name; });
    // Nodes of bars are those of the body; a part's interfaces are not on its surface.
    const bool bars = !body.stress->places.empty() ? body.stress->places.front().number == 0
                                                   : !body.stress->sections.empty() &&
                                                         body.stress->sections.front().number == 0;
    if (it == body.nodes.end() || !bars)
      return {-1, -1,
              it == body.nodes.end()
                  ? fmt::format("body '{}' has no node '{}'", name, node_name)
                  : fmt::format("node '{}' of body '{}' is none of its surface, expected the "
                                "number of a node in the finite-element file, or 'at'",
                                node_name, name)};
    node_index = static_cast<int>(it - body.nodes.begin());
  }
  return section ? choose_section(*body.stress, name, gauge, point, node_name, node_index, toward)
                 : choose_place(*body.stress, name, gauge, point, node_name, node_index, toward);
}

}  // namespace floatframe
