#include "floatframe/export/stress_field.hpp"

#include <map>
#include <set>

#include "floatframe/model/gauge.hpp"
#include "floatframe/page/scene_stress.hpp"

namespace floatframe {
namespace {

/// Places of each end of a bar: (element, end) -> first place, end of places.
std::map<std::pair<int, int>, std::pair<int, int>> places_of_sections(const BodyStress& stress) {
  std::map<std::pair<int, int>, std::pair<int, int>> out;
  for (std::size_t s = 0; s < stress.first_place.size() && s < stress.sections.size(); ++s) {
    const BeamSectionPlace& section = stress.sections[s];
    int end = stress.first_place[s];
    const int first = end, all = static_cast<int>(stress.places.size());
    while (end < all && stress.places[end].layer == StressPlace::Layer::section &&
           (s + 1 == stress.first_place.size() || end < stress.first_place[s + 1]))
      ++end;
    out[{section.element, section.end}] = {first, end};
  }
  return out;
}

}  // namespace

VecX stress_loads(const SystemMotion& motion, int body) {
  const int nm = motion.model.bodies[body].modes();
  VecX c(body_load_cases + nm);
  c.head<body_load_cases>() = body_load_coefficients(motion, body);
  c.tail(nm) = -motion.body(body).ydd;
  return c;
}

Vec6 turned_stress(const Mat3& R, const Vec6& s) noexcept {
  Mat3 S;
  S << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const Mat3 T = R * S * R.transpose();
  return (Vec6() << T(0, 0), T(1, 1), T(2, 2), T(0, 1), T(1, 2), T(2, 0)).finished();
}

StressField::StressField(const BodyPicture& picture, const FlexibleBody& body)
    : stress_(body.stress && !body.stress->places.empty() ? body.stress.get() : nullptr) {
  if (stress_) add_places(picture);
}

void StressField::add_places(const BodyPicture& picture) {
  const auto n = static_cast<std::size_t>(picture.points.cols());
  std::vector<std::vector<int>> of_point(n);
  for (std::size_t k = 0; k < stress_->places.size(); ++k) {
    const int point = stress_->places[k].point;
    if (point >= 0 && point < picture.surface_points())
      of_point[point].push_back(static_cast<int>(k));
  }
  // A beam of a part is drawn as a line: its ends show the stress of the outer section points.
  std::map<int, std::set<int>> line_ends;  // of each node
  for (const auto& line : picture.lines)
    for (const int p : line) line_ends[picture.nodes[p]].insert(p);
  for (std::size_t k = 0; k < stress_->places.size(); ++k) {
    const StressPlace& place = stress_->places[k];
    if (place.point >= 0 || !line_ends.contains(place.node)) continue;
    for (const int p : line_ends[place.node]) of_point[p].push_back(static_cast<int>(k));
  }
  // Each corner of a swept section shows the stress of the nearest outer point.
  const auto sections = places_of_sections(*stress_);
  for (std::size_t v = 0; v < picture.bar_ends.size(); ++v) {
    const auto found = sections.find({picture.bar_ends[v].bar, picture.bar_ends[v].end});
    if (found == sections.end()) continue;
    const int nearest = nearest_place(*stress_, found->second.first, found->second.second,
                                      picture.points.col(static_cast<Eigen::Index>(v)));
    if (nearest >= 0) of_point[v].push_back(nearest);
  }
  first_.push_back(0);
  for (const std::vector<int>& some : of_point) {
    places_.insert(places_.end(), some.begin(), some.end());
    first_.push_back(static_cast<int>(places_.size()));
  }
}

const VecX& StressField::at(const VecX& y, const VecX& c) {
  values_.noalias() = stress_->modes * y;
  if (stress_->loads.size() > 0) values_.noalias() += stress_->loads * c;
  return values_;
}

bool StressField::shown(Eigen::Index point, Shown& out) const noexcept {
  if (!stress_) return false;
  const auto at = static_cast<std::size_t>(point);
  bool any = false;
  for (int i = first_[at]; i < first_[at + 1]; ++i) {
    const int k = places_[i];
    const Vec6 s = values_.segment<6>(6 * k);
    const double equivalent = von_mises(s);
    if (any && !(equivalent > out.von_mises)) continue;
    any = true;
    out = {s, equivalent, &stress_->places[k]};
  }
  return any;
}

}  // namespace floatframe
