#include "floatframe/model/gauge_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/body/flexible_body.hpp"

namespace floatframe {
namespace {

/// Largest distance of a gauge given at a point from a location, relative to the body's size.
constexpr double near_enough = 0.05;
/// Locations and directions that differ by less than this, relative to the size, are equal.
constexpr double tie = 1e-6;

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

/// Those of the layer and the material given for the gauge, if any.
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

/// Locations at the node, or at the node nearest to the point.
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
  // Without a direction to select one, the nearest location; equally near ones are ambiguous.
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

std::string nothing_there(const BodyStress& stress, const std::string& body,
                          const GaugeDescription& gauge, const std::string& where, bool by_name,
                          int node_index) {
  for (std::size_t k = 0; k < stress.sections.size(); ++k) {
    const BeamSectionPlace& end = stress.sections[k];
    const bool here = by_name ? end.node == node_index : end.number == gauge.node;
    if (here && stress.first_place[k] == stress.first_place[k + 1])
      return fmt::format(
          "the beam of body '{}' at {} has a section given by constants: it has section forces "
          "(section_force) and no stress",
          body, where);
  }
  const bool layered = gauge.layer != GaugeDescription::Layer::any;
  return fmt::format("body '{}' has no stress at {}{}{}, expected a node of its surface{}", body,
                     where, layered ? " in that layer" : "",
                     gauge.material.empty() ? "" : " in the material '" + gauge.material + "'",
                     layered ? "; solids and beams have no layers" : "");
}

/// Of elements that leave a node in these unit directions the one along `along`; without it one of
/// a straight beam. -1: ambiguous.
int element_along(const std::vector<Candidate>& all, const Vec3& along) {
  if (along.isZero(0.0)) {
    for (const Candidate& c : all)
      if (c.p.cross(all.front().p).norm() > tie) return -1;
    return all.size() > 2 ? -1 : all.front().index;
  }
  const Vec3 d = along.normalized();
  const auto best = std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return a.p.dot(d) < b.p.dot(d);
  });
  for (const Candidate& c : all)
    if (c.index != best->index && c.p.dot(d) > best->p.dot(d) - tie) return -1;
  return best->index;
}

/// Ends of beam elements as candidates: the unit directions of the elements from there.
std::vector<Candidate> directions_of(const BodyStress& stress, const std::vector<int>& sections) {
  std::vector<Candidate> out;
  for (const int k : sections) {
    const BeamSectionPlace& end = stress.sections[k];
    const BeamSectionPlace& other = stress.sections[end.end == 0 ? k + 1 : k - 1];
    out.push_back({k, (other.p - end.p).normalized()});
  }
  return out;
}

std::string which_beam(std::size_t count, const std::string& body, const std::string& where) {
  return fmt::format(
      "{} beam elements of body '{}' meet at {}, expected 'along', the direction in which the one "
      "that is meant lies from there",
      count, body, where);
}

/// The end of a beam element that a location belongs to; -1: none.
int beam_end_of(const BodyStress& stress, int place) {
  if (stress.places[place].layer != StressPlace::Layer::section) return -1;
  const auto after = std::upper_bound(stress.first_place.begin(), stress.first_place.end(), place);
  return static_cast<int>(after - stress.first_place.begin()) - 1;
}

/// Ends of beam elements that the locations belong to.
std::vector<int> ends_at(const BodyStress& stress, const std::vector<Candidate>& all) {
  std::vector<int> sections;
  for (const Candidate& c : all) {
    const int k = beam_end_of(stress, c.index);
    if (k >= 0 && std::find(sections.begin(), sections.end(), k) == sections.end())
      sections.push_back(k);
  }
  return sections;
}

/// Keeps the outer points of one beam element at the node. False: ambiguous.
bool keep_one_beam(const BodyStress& stress, const Vec3& along, std::vector<Candidate>& all) {
  const std::vector<int> sections = ends_at(stress, all);
  if (sections.size() < 2) return true;
  const int chosen = element_along(directions_of(stress, sections), along);
  if (chosen < 0) return false;
  // In a straight beam either is valid, if it is the same beam.
  for (const int k : sections)
    if (along.isZero(0.0) && stress.places[stress.first_place[k]].group !=
                                 stress.places[stress.first_place[chosen]].group)
      return false;
  std::erase_if(all, [&](const Candidate& c) {
    const int k = beam_end_of(stress, c.index);
    return k >= 0 && k != chosen;
  });
  return true;
}

GaugeChoice choose_place(const BodyStress& stress, const std::string& body,
                         const GaugeDescription& gauge, const Vec3* point, const std::string& node,
                         int node_index) {
  GaugeChoice out;
  double nearest = 0.0;
  std::vector<Candidate> all = candidates(stress, gauge, point, !node.empty(), node_index, nearest);
  const std::string where = point ? "that point" : node_text(gauge, node);
  if (all.empty())
    out.error = nothing_there(stress, body, gauge, where, !node.empty(), node_index);
  else if (point)
    out.error = too_far(body, stress.places, nearest);
  if (!out.error.empty()) return out;
  const std::size_t beams = ends_at(stress, all).size();
  if (beams == 0 && !gauge.along.isZero(0.0))
    out.error = fmt::format("body '{}' has no beam at {} that could lie 'along'", body, where);
  else if (!keep_one_beam(stress, gauge.along, all))
    out.error = which_beam(beams, body, where);
  if (!out.error.empty()) return out;
  const int chosen = gauge.toward.isZero(0.0) ? all.front().index : farthest(all, gauge.toward);
  const StressPlace& place = stress.places[chosen];
  // Neither a direction nor, where elements of one material meet, anything else selects one.
  bool materials = false, apart = false;
  for (const Candidate& c : all) {
    const bool there = (c.p - place.p).norm() <= tie * size_of(stress.places);
    materials = materials || (there && stress.places[c.index].group != place.group);
    apart = apart || !there;
  }
  if (!materials && !(apart && gauge.toward.isZero(0.0))) {
    if (!gauge.direction.isZero(0.0) && !(stress.groups[place.group].young > 0.0))
      out.error = fmt::format(
          "the material of body '{}' at {} is not isotropic: its strain does not follow from the "
          "stress that the body knows, expected an output of stress",
          body, where);
    else
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

GaugeChoice choose_section(const BodyStress& stress, const std::string& body,
                           const GaugeDescription& gauge, const Vec3* point,
                           const std::string& node, int node_index) {
  GaugeChoice out;
  double nearest = std::numeric_limits<double>::infinity();
  if (point)
    for (const BeamSectionPlace& section : stress.sections)
      nearest = std::min(nearest, (section.p - *point).norm());
  const double within = nearest + tie * size_of(stress.sections);
  std::vector<int> all;
  for (std::size_t k = 0; k < stress.sections.size(); ++k) {
    const BeamSectionPlace& section = stress.sections[k];
    const bool here = point          ? (section.p - *point).norm() <= within
                      : node.empty() ? section.number == gauge.node
                                     : section.node == node_index;
    if (here) all.push_back(static_cast<int>(k));
  }
  const std::string where = point ? "that point" : node_text(gauge, node);
  if (stress.sections.empty())
    out.error = fmt::format("body '{}' has no beams, and so no section forces", body);
  else if (all.empty())
    out.error = fmt::format("no beam of body '{}' ends at {}", body, where);
  else if (point)
    out.error = too_far(body, stress.sections, nearest);
  if (!out.error.empty()) return out;
  out.section = element_along(directions_of(stress, all), gauge.along);
  if (out.section < 0) out.error = which_beam(all.size(), body, where);
  return out;
}

}  // namespace

GaugeChoice find_place(const FlexibleBody& body, const std::string& name,
                       const GaugeDescription& gauge, const Vec3* point,
                       const std::string& node_name, bool section) {
  if (!body.stress || body.modes() == 0)
    return {
        -1, -1,
        fmt::format("body '{}' {}", name,
                    body.modes() == 0
                        ? "is rigid and has no stress"
                        : "has no stress data: its part was reduced without (stresses: false), is "
                          "given by matrices, or its file has none")};
  int node_index = -1;
  if (!node_name.empty()) {
    // Unnamed nodes of bars are denoted by their position in the list, as in tables.
    const auto it = std::find_if(body.nodes.begin(), body.nodes.end(), [&](const ModalNode& n) {
      return n.name.empty() ? node_name == fmt::format("#{}", &n - body.nodes.data())
                            : n.name == node_name;
    });
    // Nodes of bars are those of the body; interfaces of a part are not on its surface.
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
  return section ? choose_section(*body.stress, name, gauge, point, node_name, node_index)
                 : choose_place(*body.stress, name, gauge, point, node_name, node_index);
}

}  // namespace floatframe
