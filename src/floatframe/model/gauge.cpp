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
/// Places and directions that differ by less than this, as a part of the size, are alike.
constexpr double tie = 1e-6;

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

template <class Place>
Vec3 centre_of(const std::vector<Place>& places) {
  Vec3 sum = Vec3::Zero();
  for (const Place& place : places) sum += place.p;
  return places.empty() ? sum : Vec3(sum / static_cast<double>(places.size()));
}

template <class Place>
double size_of(const std::vector<Place>& places) {
  const Vec3 centre = centre_of(places);
  double out = 0.0;
  for (const Place& place : places) out = std::max(out, 2.0 * (place.p - centre).norm());
  return out;
}

template <class Place>
std::string too_far(const std::string& body, const std::vector<Place>& places, double nearest) {
  if (nearest <= near_enough * size_of(places)) return "";
  return fmt::format("the nearest place of body '{}' with stress is {:.3g} m away", body, nearest);
}

/// Of the layer and the material that the gauge asks for, if it does.
bool is_asked_for(const BodyStress& stress, const StressPlace& place,
                  const GaugeDescription& gauge) {
  using L = GaugeDescription::Layer;
  if (!gauge.material.empty() && stress.groups[place.group].name != gauge.material) return false;
  return gauge.layer == L::any ||
         (gauge.layer == L::top && place.layer == StressPlace::Layer::top) ||
         (gauge.layer == L::bottom && place.layer == StressPlace::Layer::bottom);
}

std::string node_text(const GaugeDescription& gauge, const std::string& node_name) {
  return node_name.empty() ? fmt::format("node {}", gauge.node)
                           : fmt::format("node '{}'", node_name);
}

/// The one farthest along `toward`; of several (the edge of a section) the one in their middle.
int farthest(const std::vector<Candidate>& all, const Vec3& toward) {
  const Vec3 d = toward.normalized(), centre = centre_of(all);
  double most = -std::numeric_limits<double>::infinity(), aside = 0.0;
  for (const Candidate& c : all) most = std::max(most, d.dot(c.p - centre));
  int out = -1;
  for (const Candidate& c : all) {
    const Vec3 arm = c.p - centre;
    if (d.dot(arm) < most - tie * size_of(all)) continue;
    const double off = (arm - d * d.dot(arm)).norm();
    if (out >= 0 && off >= aside - tie * size_of(all)) continue;
    out = c.index;
    aside = off;
  }
  return out;
}

/// Places at the node, or at the node that is nearest to the point.
std::vector<Candidate> candidates(const BodyStress& stress, const GaugeDescription& gauge,
                                  const Vec3* point, bool by_name, int node_index,
                                  double& nearest) {
  nearest = std::numeric_limits<double>::infinity();
  int node_there = -1;
  for (const StressPlace& place : stress.places) {
    if (!point || !is_asked_for(stress, place, gauge)) continue;
    const double distance = (place.p - *point).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    node_there = place.node;
  }
  // Without a direction that tells which, the nearest place; equally near ones are no answer.
  const double within = gauge.toward.isZero(0.0) ? nearest + tie * size_of(stress.places)
                                                 : std::numeric_limits<double>::infinity();
  std::vector<Candidate> all;
  for (std::size_t k = 0; k < stress.places.size(); ++k) {
    const StressPlace& place = stress.places[k];
    if (!is_asked_for(stress, place, gauge)) continue;
    const bool here = point     ? place.node == node_there && (place.p - *point).norm() <= within
                      : by_name ? place.node == node_index
                                : place.number == gauge.node;
    if (here) all.push_back({static_cast<int>(k), place.p});
  }
  return all;
}

GaugeChoice choose_place(const BodyStress& stress, const std::string& body,
                         const GaugeDescription& gauge, const Vec3* point, const std::string& node,
                         int node_index, const Vec3& toward) {
  GaugeChoice out;
  double nearest = 0.0;
  const std::vector<Candidate> all =
      candidates(stress, gauge, point, !node.empty(), node_index, nearest);
  const std::string where = point ? "that point" : node_text(gauge, node);
  if (all.empty()) {
    const bool layered = gauge.layer != GaugeDescription::Layer::any;
    out.error =
        fmt::format("body '{}' has no stress at {}{}{}, expected a node of its surface{}", body,
                    where, layered ? " in that layer" : "",
                    gauge.material.empty() ? "" : " in the material '" + gauge.material + "'",
                    layered ? "; solids and beams have no layers" : "");
    return out;
  }
  if (point) out.error = too_far(body, stress.places, nearest);
  if (!out.error.empty()) return out;
  const int chosen = toward.isZero(0.0) ? all.front().index : farthest(all, toward);
  const StressPlace& place = stress.places[chosen];
  // Neither a direction nor, where elements of one material meet, anything else tells them apart.
  bool materials = false, apart = false;
  for (const Candidate& c : all) {
    const bool there = (c.p - place.p).norm() <= tie * size_of(stress.places);
    materials = materials || (there && stress.places[c.index].group != place.group);
    apart = apart || !there;
  }
  if (!materials && !(apart && toward.isZero(0.0))) {
    out.place = chosen;
    return out;
  }
  std::string list;
  for (const Candidate& c : all) {
    const StressPlace& other = stress.places[c.index];
    const std::string& material = stress.groups[other.group].name;
    const std::string one = layer_word(other.layer) + (material.empty() ? "" : " of " + material);
    if (list.size() < 100 && list.find(one) == std::string::npos)
      list += (list.empty() ? "" : ", ") + one;
  }
  out.error = fmt::format("body '{}' has {} places with stress at {} ({}), expected {}", body,
                          all.size(), where, list,
                          materials ? "'material', the name of the one that is meant"
                                    : "'toward', a direction that tells which");
  return out;
}

/// Of elements that leave a node in these unit directions the one that lies along `toward`; without
/// it one of a straight beam. -1: that does not tell which.
int element_along(const std::vector<Candidate>& all, const Vec3& toward) {
  if (toward.isZero(0.0)) {
    for (const Candidate& c : all)
      if (c.p.cross(all.front().p).norm() > tie) return -1;
    return all.size() > 2 ? -1 : all.front().index;
  }
  const Vec3 d = toward.normalized();
  const auto best = std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return a.p.dot(d) < b.p.dot(d);
  });
  for (const Candidate& c : all)
    if (c.index != best->index && c.p.dot(d) > best->p.dot(d) - tie) return -1;
  return best->index;
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
  const double within = nearest + tie * size_of(stress.sections);
  for (std::size_t k = 0; k < stress.sections.size(); ++k) {
    const BeamSectionPlace& section = stress.sections[k];
    const bool here = point          ? (section.p - *point).norm() <= within
                      : node.empty() ? section.number == gauge.node
                                     : section.node == node_index;
    if (!here) continue;
    // The other end of the element tells the elements at a node apart.
    const BeamSectionPlace& other = stress.sections[section.end == 0 ? k + 1 : k - 1];
    all.push_back({static_cast<int>(k), (other.p - section.p).normalized()});
  }
  if (stress.sections.empty())
    out.error = fmt::format("body '{}' has no beams, and so no section forces", body);
  else if (all.empty())
    out.error = fmt::format("no beam of body '{}' ends at {}", body, node_text(gauge, node));
  else if (point)
    out.error = too_far(body, stress.sections, nearest);
  if (!out.error.empty()) return out;
  out.section = element_along(all, toward);
  if (out.section < 0)
    out.error = fmt::format(
        "{} beam elements of body '{}' meet at {}, expected 'toward', a direction that tells which",
        all.size(), body, point ? "that point" : node_text(gauge, node));
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
